// SPDX-License-Identifier: MIT
//
// Collects the causes for which a pose and the caller's places disagree, and their text. Each kind of mistake has its
// own file.
#pragma once

#include "batch/explain/compared_limb.h"

namespace swivel {

// A mistake in reading a pose's numbers, and the sentence that names it.
struct Mistake {
    void (*make)(Reading& how);
    const char* sentence;
};

struct Causes {
    const ComparedLimb& limb;
    Text& text;
    unsigned count = 0;
    bool is_sure = true;  // the places agree with the cause applied
    double off = 0;       // distance of the places with the cause applied, in limb lengths

    // Counts one more cause, and returns the text to name it in. ours: the limb with the cause applied.
    Text& add(const LimbPlaces& ours);
    // The same for a cause with which the limb's place is unknown.
    Text& add_unsure();
    // Adds a cause if the caller has the limb at `ours`. Returns whether it was added.
    bool guess(const LimbPlaces& ours, const char* sentence);
    // The same for a mistake, if it is possible in this pose.
    bool guess(bool is_possible, const Mistake& mistake);
};

inline bool has_quaternions(const ComparedLimb& limb) { return limb.pose.form == SWIVEL_ROTATIONS; }

// compare_rotations.cpp: quaternions in another order or the other way round, rows for columns, and rotations to the
// root for those to the parent.
void guess_rotations(Causes& causes);
// In the body's space, places do not follow from rotations. But if bones are as long as at rest, rotations must carry
// the joints to their places. Returns whether they fail to, for a known reason.
bool guess_turns_in_body(Causes& causes);
// Whether a quaternion's length is far from 1, as with wrong strides or offsets.
bool guess_strides(Causes& causes);

// compare_joints.cpp: places of another limb's joints, or of joints one too high or too low.
void guess_joints(Causes& causes);

// compare_lengths.cpp: lengths in other units, and translations or scales that do not count.
void guess_lengths(Causes& causes);

// compare_root.cpp: a root that is ignored or counted twice, floats read as doubles or the reverse, and a root not
// given.
void guess_root(Causes& causes);
void guess_root_numbers(Causes& causes);
void guess_no_root(Causes& causes);

// compare_doubts.cpp: mistakes that spoil a solve though the places agree. Returns whether there is one.
bool doubt(Causes& causes);

}  // namespace swivel

// SPDX-License-Identifier: MIT
//
// The causes that explain why a pose and the caller's places disagree, as they are found one after the other, and what
// the text says of them. Each kind of mistake has a file of its own.
#pragma once

#include "batch/explain/compared_limb.h"

namespace swivel {

// A mistake in how a pose's numbers are taken, and the sentence that names it.
struct Mistake {
    void (*make)(Reading& how);
    const char* sentence;
};

struct Causes {
    const ComparedLimb& limb;
    Text& text;
    unsigned count = 0;
    bool is_sure = true;  // that with the cause the places agree
    double off = 0;       // how far the places are off with the cause, in limb lengths

    // The text, for one more cause. ours: where the limb is with it.
    Text& add(const LimbPlaces& ours);
    // The text, for the only cause, with which nobody knows where the limb would be.
    Text& add_unsure();
    // Adds a cause if the caller has the limb there. Returns whether so.
    bool guess(const LimbPlaces& ours, const char* sentence);
    // Adds a mistake that this pose can have, if the caller has the limb where the mistake puts it.
    bool guess(bool is_possible, const Mistake& mistake);
};

inline bool has_quaternions(const ComparedLimb& limb) { return limb.pose.form == SWIVEL_ROTATIONS; }

// compare_rotations.cpp: quaternions in another order or the other way round, rows for columns, and rotations to the
// root for those to the parent.
void guess_rotations(Causes& causes);
// In the body's space places say nothing of rotations. But if bones are as long as at rest, the rotations have to carry
// the joints there. Returns whether they do not, for a reason that has a name.
bool guess_turns_in_body(Causes& causes);
// Whether a quaternion has no length of about 1, as at wrong strides or offsets.
bool guess_strides(Causes& causes);

// compare_joints.cpp: places of other joints: those of another limb, or one too high or too low.
void guess_joints(Causes& causes);

// compare_lengths.cpp: lengths in other units, and translations or scales that do not count.
void guess_lengths(Causes& causes);

// compare_root.cpp: a root that does not count, or counts twice; one in floats that is read as doubles, or the other
// way round; and one that was not given.
void guess_root(Causes& causes);
void guess_root_numbers(Causes& causes);
void guess_no_root(Causes& causes);

// compare_doubts.cpp: mistakes that no place shows, but that a solve would suffer from. Returns whether there is one.
bool doubt(Causes& causes);

}  // namespace swivel

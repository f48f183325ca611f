// SPDX-License-Identifier: MIT
//
// Names the input of a body's pose that disagrees with the caller's places of a limb, for people. Each kind of mistake
// has its own file.
#pragma once

#include <cstdint>
#include <span>

#include "batch/crowd/crowd.h"
#include "batch/explain/explain_text.h"
#include "batch/explain/posed_body.h"
#include "core/conformal.h"
#include "include/swivel/swivel_explain.h"

namespace swivel {

// In the world.
struct LimbPlaces {
    Vector<double> at[3];  // shoulder, elbow, wrist
};

// Compares as swivel_compare() promises. Returns whether pose and places agree. The pose must be valid and of full
// size, and the group must have limbs. text: a byte or more.
bool compare(const swivel_crowd& crowd, std::uint32_t group, std::uint32_t body, const swivel_pose& pose,
             const LimbPlaces& places, std::span<char> text);

double distance(const Vector<double>& a, const Vector<double>& b);
double length(const LimbPlaces& limb);  // of both bones
template <class Move>
LimbPlaces moved(const LimbPlaces& limb, const Move& move)
{
    return {{move(limb.at[0]), move(limb.at[1]), move(limb.at[2])}};
}
inline LimbPlaces scaled_about(const Vector<double>& centre, double factor, const LimbPlaces& limb)
{
    return moved(limb, [&](const Vector<double>& v) { return centre + factor * (v - centre); });
}

inline constexpr const char* kLimbParts[3] = {"shoulder", "elbow", "wrist"};

// Joints of a limb, as PosedBody numbers them: shoulder, elbow, wrist.
struct LimbJoints {
    std::uint32_t at[3];
};

// A limb of a body's pose beside the caller's places of it. Knows whether they agree, but no causes.
struct ComparedLimb {
    const swivel_crowd& crowd;
    const std::uint32_t group;
    const swivel_pose& pose;
    const LimbPlaces& theirs;  // the caller's
    const PosedBody body;
    const Reading as_given{pose};  // as a solve reads it
    const LimbJoints joints = joints_of(group);
    const LimbPlaces posed = places(joints, as_given);

    LimbJoints joints_of(std::uint32_t other_group) const;
    LimbPlaces places(const LimbJoints& chosen, const Reading& how) const;
    // The joint's number in the skeleton; part: 0 to 2.
    std::uint32_t named(int part) const { return body.skeleton_joint(joints.at[part]); }

    // The largest distance of the three places from the caller's; NaN if one is NaN.
    double worst(const LimbPlaces& ours) const;
    // The distance that still agrees. Floats in the world are rounded, by engines, too.
    double allowed(const LimbPlaces& ours) const;
    double rounding() const;  // of floats this far from the origin
    // A distance in lengths of the caller's limb.
    double in_lengths(double off) const;
    bool agrees(const LimbPlaces& ours) const { return worst(ours) <= allowed(ours); }
    // The factor from the pose's places to the caller's about a centre, by least squares.
    double factor_about(const Vector<double>& centre) const;
};

// Whether the caller's three places form the same triangle as the pose's.
bool has_same_shape(const ComparedLimb& limb);

// Says where an unexplained difference begins, and what to check.
void describe_difference(const ComparedLimb& limb, Text& text);

// A mistake in reading a pose's numbers, and the sentence that names it.
struct Mistake {
    void (*make)(Reading& how);
    const char* sentence;
};

// The causes for which a pose and the caller's places disagree, and their text.
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

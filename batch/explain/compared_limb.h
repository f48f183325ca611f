// SPDX-License-Identifier: MIT
//
// A limb of a body's pose beside the caller's places of it. Knows whether they agree, but no causes.
#pragma once

#include "batch/explain/compare.h"
#include "batch/explain/explain_text.h"
#include "batch/explain/posed_body.h"

namespace swivel {

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

}  // namespace swivel

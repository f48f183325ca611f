// SPDX-License-Identifier: MIT
//
// The rotations that each joint of a skeleton takes from joints of another. Knows figures at rest, no motion.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tools/retarget/joint_pairs.h"
#include "tools/rig/body_parts.h"

namespace swivel::tools {

// A figure at rest: its places, the axes it stands in, and how long its limbs are.
struct RestFigure {
    std::vector<formats::JointPose> pose_w;                    // of each joint, in the world
    Eigen::Quaterniond axes = Eigen::Quaterniond::Identity();  // columns: the figure's left, up and forwards
    bool mirrored = false;                                     // as a whole: its left limbs are on its right
    KnownLimbs limbs;
    std::array<int, 2> toes{-1, -1};  // left and right; -1: it has none
    double leg = 0;                   // thigh and shin together, mean of the sides that are known; 0: none is

    const Eigen::Vector3d& place_w(int joint) const { return pose_w[static_cast<std::size_t>(joint)].position; }
    Eigen::Vector3d up_w() const { return axes * Eigen::Vector3d::UnitY(); }
    // A direction of the world in the figure's axes: left, up, forwards. Left is the side of its left limbs.
    Eigen::Vector3d own(const Eigen::Vector3d& direction_w) const { return in_mirror(axes.conjugate() * direction_w); }
    Eigen::Vector3d world(const Eigen::Vector3d& own_direction) const { return axes * in_mirror(own_direction); }
    // The same for a turn.
    Eigen::Quaterniond own(const Eigen::Quaterniond& turn_w) const
    {
        return in_mirror(axes.conjugate() * turn_w * axes);
    }
    Eigen::Quaterniond world(const Eigen::Quaterniond& own_turn) const
    {
        return axes * in_mirror(own_turn) * axes.conjugate();
    }
    // A limb's end, or the toe of a leg: the joint that touches the ground.
    int ground_joint(std::size_t limb, bool has_toes) const
    {
        return limb >= 2 && has_toes ? toes[limb - 2] : (*limbs[limb])[2];
    }
    // A limb's two bones together at rest; of one that is known.
    double length(std::size_t limb) const
    {
        const LimbJoints& at = *limbs[limb];
        return own_way(at[0], at[1]).norm() + own_way(at[1], at[2]).norm();
    }
    // From one joint to another at rest, in the figure's axes.
    Eigen::Vector3d own_way(int from, int to) const { return own(place_w(to) - place_w(from)); }

private:
    template <class Geometry>
    Geometry in_mirror(const Geometry& geometry) const
    {
        return mirrored ? formats::mirrored(geometry) : geometry;
    }
};

// Up is the axis of the world nearest to facing_of()'s up. Forwards is at right angles to it: an axis of the world
// within 15 degrees of facing_of()'s forwards, else that itself. So a toe a little off does not turn a walk.
RestFigure rest_figure(const formats::Clip& clip, const std::vector<BodyPart>& parts);

// A figure's standing feet: their height over the world's origin, and their slope from ankle to toe.
struct Stance {
    std::optional<double> height;                // of toes, or else ankles, on the ground, along the figure's up
    std::array<std::optional<double>, 2> slope;  // from ankle to toe of a flat foot, left and right: the angle over
                                                 // the ground, radians; nothing without toes, too
};

// The angle of a vector in the figure's axes over the ground: radians, below 0 downwards.
double slope_of(const Eigen::Vector3d& way);

// The stance of the rest pose, if its feet are within 0.3 leg lengths of height 0. Otherwise the clip shows the stance,
// if it has more than one frame. A foot is still in a frame if ankle and toe come to it slower than 0.3 legs a second.
// With ten still feet or more, the slope of both feet is the 90th percentile of theirs, and the height is the median of
// those that were the lower foot. With fewer, the height is the lower foot's 5th percentile, and there is no slope.
Stance stance_of(const formats::Clip& clip, const RestFigure& figure, bool has_toes);

// A target's joint turns from rest like a source's joint, or like a blend of two.
struct Transfer {
    int before = -1, after = -1;  // joints of the source; before -1: the world, which never turns
    double share = 1;             // of the way from `before` to `after`
    // The target's rest brought to the source's, in the figure's axes: first this turn, then the source's.
    Eigen::Quaterniond align = Eigen::Quaterniond::Identity();
};

// A figure at rest, and how it stands.
struct StandingFigure {
    const formats::Clip& clip;
    const RestFigure& rest;
    const Stance& stance;
};

// One for each joint of the target; nothing: it keeps its rest. If a part has n joints in the source and m in the
// target, these m divide the part's turns evenly: the target's last joint turns like the source's last.
// Limbs and fingers are aligned bone by bone, each by the least turn beyond that of the joint above. A foot is aligned
// so that it is flat where the source's is. Where one of the two does not say when it is flat, it takes the source's
// direction. Hips, spine, neck, head and clavicles are not aligned: both figures rest upright, whatever the shape of
// their backs.
std::vector<std::optional<Transfer>> transfers_of(const JointPairs& pairs, const StandingFigure& source,
                                                  const StandingFigure& target);

}  // namespace swivel::tools

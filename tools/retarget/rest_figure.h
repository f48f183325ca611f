// SPDX-License-Identifier: MIT
//
// A figure at rest: its places, the axes it stands in, how long its limbs are, and how its feet stand. Knows clips and
// rigs.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tools/rig/body_parts.h"

namespace swivel::tools {

struct RestFigure {
    std::vector<formats::JointPose> pose_w;                    // of each joint, in the world
    Eigen::Quaterniond axes = Eigen::Quaterniond::Identity();  // columns: the figure's left, up and forwards
    bool mirrored = false;  // as a whole: its left side is on the right of where it faces
    KnownLimbs limbs;
    std::array<int, 2> toes{-1, -1};  // left and right; -1: it has none
    double leg = 0;                   // thigh and shin together, mean of the sides that are known; 0: none is

    const Eigen::Vector3d& place_w(int joint) const { return pose_w[static_cast<std::size_t>(joint)].position; }
    Eigen::Vector3d up_w() const { return axes * Eigen::Vector3d::UnitY(); }
    // A direction of the world as the figure has it: left, up, forwards. Left is where its left limbs are.
    Eigen::Vector3d own(const Eigen::Vector3d& direction_w) const { return in_mirror(axes.conjugate() * direction_w); }
    Eigen::Vector3d world(const Eigen::Vector3d& own_direction) const { return axes * in_mirror(own_direction); }
    // The same of a turn.
    Eigen::Quaterniond own(const Eigen::Quaterniond& turn_w) const
    {
        return in_mirror(axes.conjugate() * turn_w * axes);
    }
    Eigen::Quaterniond world(const Eigen::Quaterniond& own_turn) const
    {
        return axes * in_mirror(own_turn) * axes.conjugate();
    }
    // A limb's two bones together at rest; of one that is known.
    double length(std::size_t limb) const
    {
        const LimbJoints& at = *limbs[limb];
        return own_way(at[0], at[1]).norm() + own_way(at[1], at[2]).norm();
    }
    // From one joint to another at rest, as the figure has it.
    Eigen::Vector3d own_way(int from, int to) const { return own(place_w(to) - place_w(from)); }

private:
    template <class Geometry>
    Geometry in_mirror(const Geometry& of) const
    {
        return mirrored ? formats::mirrored(of) : of;
    }
};

// Up is the axis of the world nearest to the way up that facing_of() tells. Forwards is at right angles to it: the axis
// of the world that is within 15 degrees, else what facing_of() tells. So a toe a little off does not turn a walk.
RestFigure rest_figure(const formats::Clip& clip, const std::vector<BodyPart>& parts);

// How feet stand: how high over the world's origin, and how steep from ankle to toe.
struct Stance {
    std::optional<double> height;                // of toes, or else ankles, on the ground, along the figure's up
    std::array<std::optional<double>, 2> slope;  // from ankle to toe of a flat foot, left and right: the angle over
                                                 // the ground, radians; nothing without toes, too
};

// The angle of a way, as a figure has it, over the ground: radians, below 0 downwards.
double slope_of(const Eigen::Vector3d& way);

// A figure whose feet at rest are within 0.3 leg lengths of height 0 stands so: its rest tells all. Otherwise its clip
// tells it, where that has more than one frame. A foot is still in a frame to which ankle and toe come slower than 0.3
// legs a second. With ten still feet or more, the slope of both feet is the one that nine
// tenths of them are not above, and the height is the median of those that were the lower foot. With fewer, the height
// is that which the lower foot is not above in a twentieth of the frames, and no slope is told.
Stance stance_of(const formats::Clip& clip, const RestFigure& figure, bool has_toes);

}  // namespace swivel::tools

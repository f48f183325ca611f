// SPDX-License-Identifier: MIT
//
// The places of a clip's legs in all frames. Knows clips and limbs.
#pragma once

#include <span>
#include <vector>

#include "tools/rig/limbs.h"

namespace swivel::tools {

// Places are in the world, one for each frame.
struct LegPath {
    formats::LimbName name;
    int toe = -1;         // the joint that stands: the toe's, or without one the ankle's
    bool has_toe = true;  // false: it is the ankle's
    double length = 1;    // of both bones at rest
    double tip_rise = 0;  // how high the toes' tip is over the toe at rest
    std::vector<Eigen::Vector3d> hip_w, knee_w, ankle_w, toe_w;
    std::vector<Eigen::Vector3d> across_w;  // the toes' axis, fixed in the foot: a turn about it brings them up
    std::vector<Eigen::Vector3d> tip_w;  // of the toes: the end of the skeleton that is furthest from the toe, a joint
                                         // or BVH's End Site. Without any it is ahead of the toe, as far as people's.
};

struct LegMotion {
    Eigen::Vector3d up_w = Eigen::Vector3d::UnitY();  // one of the world's axes
    double frame_time = 0;                            // seconds
    int carrier = -1;                                 // the joint whose place moves the body: see carrier_of()
    std::vector<Eigen::Vector3d> carrier_w;           // its place
    std::vector<LegPath> legs;

    std::size_t frame_count() const { return carrier_w.size(); }
    double leg_length() const;  // the mean
    Eigen::Vector3d level(const Eigen::Vector3d& v) const { return v - v.dot(up_w) * up_w; }
};

// The largest second difference of places from frame to frame: the jump of velocity times the frame's time.
double largest_jump(std::span<const Eigen::Vector3d> places_w);

// The joint that a foot stands on: the first of toes_of(). Without one it is the ankle.
int toe_of(const formats::Clip& clip, const Limb& leg);

// The lowest joint above all known limbs. If it has no keys of translation, the lowest joint above it that has some, if
// there is one.
int carrier_of(const formats::Clip& clip, const FigureJoints& figure);

// legs: bound limbs of the clip. up_w: of the figure; the world's axis nearest to it counts.
LegMotion leg_motion(const formats::Clip& clip, std::span<const Limb> legs, int carrier, const Eigen::Vector3d& up_w);

}  // namespace swivel::tools

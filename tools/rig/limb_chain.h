// SPDX-License-Identifier: MIT
//
// A limb's joints with all joints between them, and their places. The solver has two bones; a skeleton may have twist
// bones, scales and mirrors in between. This file converts between both. Knows clips alone.
#pragma once

#include <array>
#include <vector>

#include "tools/formats/clip.h"
#include "tools/rig/limb_joints.h"

namespace swivel::tools {

struct LimbChain {
    std::vector<int> joints;  // from the upper joint to the end joint, each the parent of the next
    std::size_t lower = 0;    // where in them the lower joint is
    bool is_plain = true;     // no joints between, and no scale is or may become negative

    int upper() const { return joints.front(); }
    int end() const { return joints.back(); }
    std::vector<int> between() const;  // those that are none of the three
};

// joints: as is_chain() says.
LimbChain chain_of(const formats::Clip& clip, const LimbJoints& joints);

// Upper, lower and end joint relative to the upper joint's parent (the world, where there is none), in its space.
struct ChainPose {
    std::array<Eigen::Vector3d, 3> position;
    std::array<Eigen::Quaterniond, 3> turn;  // of the joint's axes before its own scale, mirrors above taken out

    // From upper to lower joint, and from there to the end, in the axes of the joint each starts at.
    Eigen::Vector3d upper_bone() const { return turn[0].conjugate() * (position[1] - position[0]); }
    Eigen::Vector3d lower_bone() const { return turn[1].conjugate() * (position[2] - position[1]); }
};

// The joint above a joint at rest, in the world; the world itself for a root.
formats::JointPose parent_at_rest(const formats::Clip& clip, int joint);

ChainPose rest_pose(const formats::Clip& clip, const LimbChain& chain);
ChainPose chain_pose(const formats::Clip& clip, std::size_t frame, const LimbChain& chain);

// How far the joints between two of a chain's joints move the later one in a frame, by their own motion alone, as a
// share of the distance of the two at rest. first, last: places of the two in the chain.
double moved_between(const formats::Clip& clip, std::size_t frame, const LimbChain& chain, std::size_t first,
                     std::size_t last);

// The local rotations, as the clip stores them, that give the three joints these turns in a frame while all between
// them stays as it is there.
std::array<Eigen::Quaterniond, 3> local_rotations(const formats::Clip& clip, std::size_t frame, const LimbChain& chain,
                                                  const std::array<Eigen::Quaterniond, 3>& turn);

// The least rotation that takes the direction of `from` to that of `to`; for opposite ones a half turn about any axis
// across. None where either is zero or both agree.
Eigen::Quaterniond aim(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace swivel::tools

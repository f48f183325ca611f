// SPDX-License-Identifier: MIT
//
// The skeleton of character B, its limbs' joints and its pose, as swivel takes them.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "bench/rivals/bodies.h"
#include "swivel/swivel_bodies.hpp"

namespace bench {

inline swivel_skeleton body_skeleton()
{
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = {kBodyParents, sizeof kBodyParents[0]};
    skeleton.translations = {kBodyOffsets, sizeof kBodyOffsets[0]};
    skeleton.joint_count = kBodyJoints;
    return skeleton;
}
inline std::array<swivel_limb_joints, kBodyLimbs> body_limbs()
{
    std::array<swivel_limb_joints, kBodyLimbs> joints;
    for (std::size_t limb = 0; limb < kBodyLimbs; ++limb) {
        const BodyChain& chain = kBodyChains[limb];
        joints[limb] = swivel_default_limb_joints(chain.first, chain.middle, chain.last);
        std::ranges::copy(chain.bend, joints[limb].bend);
    }
    return joints;
}
// Of bodies that lie `stride` bytes apart. What is given must outlive the pose.
inline swivel_pose body_pose(BodyCharacter& from, BodyCharacter& to, std::size_t stride, const float& time)
{
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {from.rotations, stride, sizeof from.rotations[0], nullptr};
    pose.results = {to.rotations, stride, sizeof to.rotations[0], nullptr};
    pose.root_position = {from.root_place, stride};
    pose.root_rotation = {from.root_rotation, stride};
    pose.time = {&time, 0};
    return pose;
}

}  // namespace bench

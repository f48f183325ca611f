// SPDX-License-Identifier: MIT
//
// A skeleton of a limb alone, for tests that need nothing else of a figure.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "swivel/swivel.hpp"

namespace swivel::test {

// Joint 0 is the shoulder, 1 the elbow, 2 the wrist. It must outlive what skeleton() gives.
struct ThreeJoints {
    static constexpr std::int32_t kParents[] = {-1, 0, 1};
    std::array<std::array<float, 4>, 3> rotations = {{{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}}};
    std::array<std::array<float, 3>, 3> translations = {};
    std::array<float, 3> bend = {};

    swivel_skeleton skeleton() const
    {
        swivel_skeleton made = swivel_default_skeleton();
        made.parents = {kParents, sizeof kParents[0]};
        made.rotations = {rotations.data(), sizeof rotations[0]};
        made.translations = {translations.data(), sizeof translations[0]};
        made.joint_count = 3;
        return made;
    }
    swivel_limb_joints joints() const
    {
        swivel_limb_joints made = swivel_default_limb_joints(0, 1, 2);
        std::ranges::copy(bend, made.bend);
        return made;
    }
    swivel_binding bound() const { return bind(skeleton(), joints()); }
};

// A limb whose joints are the arm frame, with bones of length 1.
inline ThreeJoints arm_frame_joints()
{
    ThreeJoints limb;
    limb.translations[1][2] = limb.translations[2][2] = limb.bend[1] = 1;
    return limb;
}

}  // namespace swivel::test

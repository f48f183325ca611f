// SPDX-License-Identifier: MIT
//
// Bodies as numbers: a skeleton of three limbs for each recipe, and poses of it, with elbows bent to any side, straight
// and folded.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tools/corpus/arms.h"

namespace swivel::corpus {

struct LimbJoints {
    std::uint32_t shoulder, elbow, wrist;
    std::array<float, 3> bend;  // where flexion carries the forearm, in the shoulder joint's frame
    std::vector<std::uint32_t> twist_bones;
};
// Children come before their parents.
struct Skeleton {
    std::vector<std::int32_t> parents;
    std::vector<std::array<float, 4>> rotations;
    std::vector<std::array<float, 3>> translations;
    std::array<LimbJoints, kGroupCount> limbs;

    std::uint32_t joint_count() const { return static_cast<std::uint32_t>(parents.size()); }
};
Skeleton skeleton_of(const Recipe& recipe);

struct Body {
    std::vector<std::array<float, 4>> rotations;
    std::vector<std::array<float, 3>> translations;
    std::vector<float> scales;
    std::array<double, 3> root_position{};
    std::array<float, 4> root_rotation{0, 0, 0, 1};
    float root_scale = 1;
};
bool has_matrices(const Recipe& recipe);
// The same pose with all joints relative to the root.
Body in_body_space(const Skeleton& skeleton, const Body& local);
// Other poses in every frame.
std::vector<Body> bodies_of(const Recipe& recipe, std::uint32_t body_count, std::uint32_t frame);

// The limbs of a group, with the bodies' bones, and their goals. One in eight is at its goal already, and one in eight
// has an undefined pole.
std::vector<Arm> body_arms(const Recipe& recipe, std::uint32_t group, std::uint32_t body_count, std::uint32_t frame);

}  // namespace swivel::corpus

// SPDX-License-Identifier: MIT
//
// Random bodies that stand, over some frames: poses that swing and rest, times, supports that move and change, labels,
// targets, and some of all that is bad. For tests of bits, so nothing here says what is right.
#pragma once

#include <cmath>

#include "tests/random_bodies.h"

namespace swivel::test {

inline constexpr std::uint32_t kPlantFrames = 10;

struct PlantFrames {
    struct Of {  // one frame
        std::vector<Body> bodies;
        std::vector<float> times, wishes, coming_times;
        std::array<std::vector<Float3>, 2> supports;  // of which each body stands on one
        std::array<std::vector<Float4>, 2> support_rotations;
        std::vector<std::uint32_t> stands_on, resets;       // a support; a group, or one past the last
        std::vector<std::vector<float>> contacts;           // of each group
        std::vector<std::vector<Float3>> targets, comings;  // the same; NaN: the pose's own
    };
    BodySkeleton skeleton;
    std::vector<swivel_features> features;  // of each limb
    std::vector<swivel_plant> plants;
    bool has_shift = false;
    std::vector<Of> frames;

    // Limbs get some of the features that are not left out.
    PlantFrames(Random& random, std::uint32_t body_count, swivel_features left_out = 0);
};

}  // namespace swivel::test

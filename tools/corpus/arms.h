// SPDX-License-Identifier: MIT
//
// Plain arms as numbers: ordinary ones, well inside the plain formula's range, in every band of reach.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/corpus/random.h"
#include "tools/corpus/recipe.h"

namespace swivel::corpus {

// All inputs of a plain arm; a crowd writes the ones that it has. In the world if it has parents.
struct Arm {
    std::array<float, 3> target = {0.5f, 0.75f, 1}, pole = {0.25f, -1, 0.5f};
    std::array<float, 2> lengths = {1, 0.75f};
    std::array<float, 3> parent_position = {0, 0, 0};
    std::array<float, 4> parent_rotation = {0, 0, 0, 1};
    std::array<float, 1> parent_scale = {1};
    std::array<float, 4> hand = {0.1f, 0.5f, 0.5f, 0.7f};

    // Empty for fields that plain arms do not have.
    std::span<float> values(swivel_field field);
    double length() const { return double{lengths[0]} + lengths[1]; }
};
inline constexpr swivel_field kArmFields[] = {
    SWIVEL_TARGET,          SWIVEL_POLE,         SWIVEL_LENGTHS, SWIVEL_SHOULDER_POSITION,
    SWIVEL_PARENT_ROTATION, SWIVEL_PARENT_SCALE, SWIVEL_HAND};

// An arm's target, in one of the bands of its reach, and its pole.
void set_goals(const Recipe& recipe, Random& targets, Random& poles, Arm& arm);

// limb_count arms of a group. Their goals change with the frame, all else stays.
std::vector<Arm> ordinary_arms(const Recipe& recipe, std::uint32_t group, std::uint32_t limb_count,
                               std::uint32_t frame);

// Every other run of 64 limbs has hard numbers among its values.
inline constexpr std::uint32_t kRunLimbs = 64;
inline bool is_spoilt_run(std::uint32_t limb) { return limb / kRunLimbs % 2 == 0; }

// A field's value for each limb of a group, of as many floats as the field has. Standing bodies keep their values, and
// none is spoilt.
std::vector<float> limb_values(const Recipe& recipe, swivel_field field, std::uint32_t components, std::uint32_t group,
                               std::span<const Arm> arms);

}  // namespace swivel::corpus

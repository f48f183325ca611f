// SPDX-License-Identifier: MIT
//
// What the values of an input must be: in words, and which of its numbers have unit length. The kernels decide; this is
// for people.
#pragma once

#include <cstdint>

#include "simd/fields.h"

namespace swivel {

// What a value must be to be in its range.
constexpr const char* range_of(Field field)
{
    switch (field) {
        case Field::lengths:
            return "0 or 1e-15 to 1e15 each";
        case Field::parent_scale:
            return "1e-15 to 1e15";
        case Field::parent_rotation:
        case Field::hand:
        case Field::incoming_shoulder:
        case Field::incoming_elbow:
        case Field::incoming_wrist:
            return "a quaternion of length 1e-9 to 1e9";
        case Field::angle:
            return "cos and sin, 1e-9 to 1e9 long; swivel_turn() makes them";
        case Field::weights:
            return "0 to 1 each";
        case Field::reach:
            return "0 to 1 each, the stretch 1 to 1000";
        case Field::most_swivel:
            return "cos and sin of 0 to pi; swivel_turn() makes them";
        case Field::flexion_limit:
            return "cosines of half angles; swivel_flexion() makes them";
        case Field::shoulder_cone:
        case Field::hand_cone:
            return "a unit axis and a cosine; swivel_cone() makes them";
        case Field::humeral_twist:
        case Field::forearm_twist:
        case Field::shoulder_box:
        case Field::wrist_box:
            return "ranges of angles; swivel_range() makes them";
        case Field::hand_twist:
            return "a unit axis and a range of angles; swivel_range() makes it";
        case Field::aim:
            return "a unit axis, cos and sin; swivel_aim() makes them";
        case Field::clavicle:
            return "a place no further than 1e15 and a share of 0 to 1";
        default:
            return "no further than 1e15";
    }
}

// How many of a field's numbers are a unit axis, and how many pairs of cosine and sine follow.
struct UnitParts {
    std::uint32_t axis_size, pair_count;
};
constexpr UnitParts unit_parts(Field field)
{
    switch (field) {
        case Field::shoulder_cone:
        case Field::hand_cone:
            return {3, 0};
        case Field::hand_twist:
            return {3, 2};
        case Field::aim:
            return {3, 1};
        case Field::most_swivel:
            return {0, 1};
        case Field::humeral_twist:
        case Field::forearm_twist:
            return {0, 2};
        case Field::shoulder_box:
        case Field::wrist_box:
            return {0, 6};
        default:
            return {0, 0};
    }
}

}  // namespace swivel

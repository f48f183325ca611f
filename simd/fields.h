// SPDX-License-Identifier: MIT
//
// The kernels' own numbers: what a crowd can be asked for, and the fields of its limbs in the order of their rows.
// Knows nothing of the public ones, which batch/numbers.h maps.
#pragma once

#include <cstddef>
#include <cstdint>

namespace swivel {

inline constexpr std::uint32_t kLanes = 16;  // limbs in a block
inline constexpr std::uint32_t kMostTwistBones = 7;

// Inputs, then results.
enum class Field : std::uint8_t {
    target,
    pole,
    lengths,
    shoulder_position,
    parent_rotation,
    parent_scale,
    hand,
    effector,
    angle,
    incoming_shoulder,
    incoming_elbow,
    incoming_wrist,
    weights,
    reach,
    most_swivel,
    flexion_limit,
    shoulder_cone,
    humeral_twist,
    shoulder_box,
    hand_cone,
    forearm_twist,
    hand_twist,
    wrist_box,
    aim,
    clavicle,
    shoulder,
    elbow,
    wrist,
    flags,
    stretch,
    normal,
    twist_bones,
    clavicle_turn,
};
inline constexpr std::size_t kInputCount = std::size_t(Field::shoulder),
                             kFieldCount = std::size_t(Field::clavicle_turn) + 1;
constexpr std::size_t index_of(Field field) { return static_cast<std::size_t>(field); }
constexpr bool is_input(Field field) { return field < Field::shoulder; }

// A set of features, with the number of twist bones, 0 to 7, times feature::twist_bones.
using FeatureSet = std::uint64_t;
namespace feature {
constexpr FeatureSet bit(int n) { return FeatureSet{1} << n; }
// The three that change the formula of plain arms come first: they number its kernels.
inline constexpr FeatureSet world = bit(0), joints = bit(1), hand = bit(2), pole_direction = bit(3), compact = bit(4);
inline constexpr FeatureSet effector = bit(5), angle = bit(6), pole_normal = bit(7), incoming = bit(8);
inline constexpr FeatureSet pole_incoming = bit(9), weights = bit(10), reach = bit(11), most_swivel = bit(12);
inline constexpr FeatureSet flexion_limit = bit(13), shoulder_cone = bit(14), humeral_twist = bit(15);
inline constexpr FeatureSet shoulder_box = bit(16), hand_cone = bit(17), forearm_twist = bit(18), hand_twist = bit(19);
inline constexpr FeatureSet wrist_box = bit(20), aim = bit(21), clavicle = bit(22), budget = bit(23);
inline constexpr FeatureSet twist_bones = bit(40);
}  // namespace feature

}  // namespace swivel

// SPDX-License-Identifier: MIT
//
// The layout of a crowd's rows: which fields a set of features has, in which order, and where a lane of a row lies. No
// other file knows it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/fields.h"

namespace swivel {

// Rows of a result field of a compact crowd, whose rows are words; rotations take the smallest three components.
constexpr std::uint32_t compact_row_count(FeatureSet features, Field field)
{
    switch (field) {
        case Field::shoulder:
            return 3;
        case Field::elbow:
            return features & feature::joints ? 3 : 2;
        case Field::wrist:
            return features & feature::hand ? 3 : 0;
        case Field::flags:
            return 2;
        default:
            return 0;
    }
}

// For every field: its name in messages, its rows, the features that a crowd must have for it, and those that it must
// not have.
struct FieldLayout {
    const char* name;
    std::uint32_t row_count;
    FeatureSet needs, without = 0;
};
constexpr FieldLayout kFields[] = {
    {"target", 3, 0},
    {"pole", 3, 0, feature::pole_incoming},
    {"lengths", 2, 0},
    {"shoulder_position", 3, feature::world},
    {"parent_rotation", 4, feature::world},
    {"parent_scale", 1, feature::world},
    {"hand", 4, feature::hand},
    {"effector", 3, feature::effector},
    {"angle", 2, feature::angle},
    {"incoming_shoulder", 4, feature::incoming},
    {"incoming_elbow", 4, feature::incoming},
    {"incoming_wrist", 4, feature::incoming | feature::hand},
    {"weights", 3, feature::weights},
    {"reach", 4, feature::reach},
    {"most_swivel", 2, feature::most_swivel},
    {"flexion_limit", 2, feature::flexion_limit},
    {"shoulder_cone", 4, feature::shoulder_cone},
    {"humeral_twist", 4, feature::humeral_twist},
    {"shoulder_box", 12, feature::shoulder_box},
    {"hand_cone", 4, feature::hand_cone},
    {"forearm_twist", 4, feature::forearm_twist},
    {"hand_twist", 7, feature::hand_twist},
    {"wrist_box", 12, feature::wrist_box},
    {"aim", 5, feature::aim},
    {"clavicle", 4, feature::clavicle},
    {"shoulder", 4, 0},
    {"elbow", 2, 0},  // or 4, see below
    {"wrist", 4, feature::hand},
    {"flags", 1, 0},
    {"stretch", 1, feature::reach},
    {"normal", 3, feature::most_swivel},
    {"twist_bones", 0, feature::twist_bones},  // see below
    {"clavicle_turn", 4, feature::clavicle},
};
static_assert(sizeof kFields / sizeof *kFields == kFieldCount);
constexpr const FieldLayout& layout_of(Field field) { return kFields[index_of(field)]; }
constexpr const char* name_of(Field field) { return layout_of(field).name; }

constexpr std::uint32_t twist_bone_count(FeatureSet features)
{
    return static_cast<std::uint32_t>(features / feature::twist_bones % 8);
}

// Rows of a field; 0 if crowds with these features do not have it.
constexpr std::uint32_t field_row_count(FeatureSet features, Field field)
{
    if ((features & feature::compact) && !is_input(field)) return compact_row_count(features, field);
    if (field == Field::elbow && (features & feature::joints)) return 4;
    if (field == Field::twist_bones) return 4 * twist_bone_count(features);
    const FieldLayout& layout = layout_of(field);
    return (features & layout.needs) == layout.needs && !(features & layout.without) ? layout.row_count : 0;
}

// The floats, or the one uint32_t, of a field's value as callers read and write it. 0 if crowds with these features do
// not have it.
constexpr std::uint32_t field_component_count(FeatureSet features, Field field)
{
    return field_row_count(features & ~feature::compact, field);
}

// The fields that are positions, and those from which an origin is subtracted: not poles that are directions or
// normals.
constexpr bool is_position(Field field)
{
    return field == Field::target || field == Field::pole || field == Field::shoulder_position;
}
constexpr bool has_origin(FeatureSet features, Field field)
{
    return is_position(field) &&
           !(field == Field::pole && (features & (feature::pole_direction | feature::pole_normal)));
}

// Rows of the fields from one number to another; those before a field, among the input or the result rows; and all.
constexpr std::uint32_t rows_before(FeatureSet features, std::size_t first, std::size_t end)
{
    std::uint32_t rows = 0;
    for (std::size_t n = first; n < end; ++n) rows += field_row_count(features, static_cast<Field>(n));
    return rows;
}
constexpr std::uint32_t field_first_row(FeatureSet features, Field field)
{
    return rows_before(features, is_input(field) ? 0 : kInputCount, index_of(field));
}
constexpr std::uint32_t input_row_count(FeatureSet features) { return rows_before(features, 0, kInputCount); }
constexpr std::uint32_t result_row_count(FeatureSet features)
{
    return rows_before(features, kInputCount, kFieldCount);
}

// The features with the most rows that a block of floats can have.
inline constexpr FeatureSet kEveryFeature = ~(feature::compact | feature::pole_incoming);

// Bytes of a row, and of a block.
inline constexpr std::size_t kInputRowBytes = kLanes * sizeof(float);
constexpr std::size_t result_row_bytes(FeatureSet features)
{
    return kLanes * (features & feature::compact ? sizeof(std::uint16_t) : sizeof(float));
}
constexpr std::size_t block_bytes(FeatureSet features)
{
    return input_row_count(features) * kInputRowBytes + result_row_count(features) * result_row_bytes(features);
}

// Where row `row` of limb `limb` lies in storage of row_count rows a block, in floats or words.
constexpr std::size_t row_offset(std::size_t limb, std::uint32_t row_count, std::uint32_t row)
{
    return ((limb / kLanes) * row_count + row) * kLanes + limb % kLanes;
}

// Copies one lane of row_count rows from block to block.
template <class Word>
[[gnu::always_inline]] inline void copy_lane(std::uint32_t row_count, const Word* from, Word* to)
{
    for (std::uint32_t row = 0; row < row_count; ++row) to[row * kLanes] = from[row * kLanes];
}

}  // namespace swivel

// SPDX-License-Identifier: MIT
//
// The layout of a crowd's rows: which fields a set of features has, in which order, and where a lane of a row lies. The
// only place that knows.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "batch/swivel.h"

namespace swivel {

inline constexpr std::uint32_t kInputFieldCount = SWIVEL_SHOULDER;

constexpr bool is_input(swivel_field field) { return field < SWIVEL_SHOULDER; }

// Rows of a result field of a compact crowd, whose rows are words; rotations take the smallest three components.
constexpr std::uint32_t compact_row_count(std::uint32_t features, swivel_field field)
{
    switch (field) {
        case SWIVEL_SHOULDER:
            return 3;
        case SWIVEL_ELBOW:
            return features & SWIVEL_JOINTS ? 3 : 2;
        case SWIVEL_WRIST:
            return features & SWIVEL_WITH_HAND ? 3 : 0;
        case SWIVEL_FLAGS:
            return 2;
        default:
            return 0;
    }
}

// What every field is called in messages, its rows, and the features that a crowd must have for it, and must not.
struct FieldLayout {
    const char* name;
    std::uint32_t row_count, needs, without = 0;
};
constexpr FieldLayout kFields[] = {
    {"target", 3, 0},
    {"pole", 3, 0, SWIVEL_POLE_INCOMING},
    {"lengths", 2, 0},
    {"shoulder_position", 3, SWIVEL_WORLD},
    {"parent_rotation", 4, SWIVEL_WORLD},
    {"parent_scale", 1, SWIVEL_WORLD},
    {"hand", 4, SWIVEL_WITH_HAND},
    {"effector", 3, SWIVEL_WITH_EFFECTOR},
    {"angle", 2, SWIVEL_WITH_ANGLE},
    {"incoming_shoulder", 4, SWIVEL_WITH_INCOMING},
    {"incoming_elbow", 4, SWIVEL_WITH_INCOMING},
    {"incoming_wrist", 4, SWIVEL_WITH_INCOMING | SWIVEL_WITH_HAND},
    {"weights", 3, SWIVEL_WITH_WEIGHTS},
    {"reach", 4, SWIVEL_WITH_REACH},
    {"most_swivel", 2, SWIVEL_WITH_MOST_SWIVEL},
    {"flexion_limit", 2, SWIVEL_WITH_FLEXION_LIMIT},
    {"shoulder_cone", 4, SWIVEL_WITH_SHOULDER_CONE},
    {"humeral_twist", 4, SWIVEL_WITH_HUMERAL_TWIST},
    {"shoulder_box", 12, SWIVEL_WITH_SHOULDER_BOX},
    {"hand_cone", 4, SWIVEL_WITH_HAND_CONE},
    {"forearm_twist", 4, SWIVEL_WITH_FOREARM_TWIST},
    {"hand_twist", 7, SWIVEL_WITH_HAND_TWIST},
    {"wrist_box", 12, SWIVEL_WITH_WRIST_BOX},
    {"aim", 5, SWIVEL_WITH_AIM},
    {"clavicle", 4, SWIVEL_WITH_CLAVICLE},
    {"shoulder", 4, 0},
    {"elbow", 2, 0},  // or 4, see below
    {"wrist", 4, SWIVEL_WITH_HAND},
    {"flags", 1, 0},
    {"stretch", 1, SWIVEL_WITH_REACH},
    {"normal", 3, SWIVEL_WITH_MOST_SWIVEL},
    {"twist", 0, 0},  // see below
    {"clavicle_turn", 4, SWIVEL_WITH_CLAVICLE},
};
static_assert(sizeof kFields / sizeof *kFields == SWIVEL_FIELD_COUNT);

// The feature's name that a crowd lacks, or has too much, for a field that it does not have.
constexpr const char* needed_feature(std::uint32_t features, swivel_field field)
{
    constexpr const char* names[] = {
        "SWIVEL_WORLD",
        "SWIVEL_JOINTS",
        "SWIVEL_WITH_HAND",
        "SWIVEL_POLE_DIRECTION",
        "SWIVEL_COMPACT",
        "SWIVEL_WITH_EFFECTOR",
        "SWIVEL_WITH_ANGLE",
        "SWIVEL_POLE_NORMAL",
        "SWIVEL_WITH_INCOMING",
        "SWIVEL_POLE_INCOMING",
        "SWIVEL_WITH_WEIGHTS",
        "SWIVEL_WITH_REACH",
        "SWIVEL_WITH_MOST_SWIVEL",
        "SWIVEL_WITH_FLEXION_LIMIT",
        "SWIVEL_WITH_SHOULDER_CONE",
        "SWIVEL_WITH_HUMERAL_TWIST",
        "SWIVEL_WITH_SHOULDER_BOX",
        "SWIVEL_WITH_HAND_CONE",
        "SWIVEL_WITH_FOREARM_TWIST",
        "SWIVEL_WITH_HAND_TWIST",
        "SWIVEL_WITH_WRIST_BOX",
        nullptr,  // the three bits of SWIVEL_WITH_TWIST_BONES
        nullptr,
        nullptr,
        "SWIVEL_WITH_AIM",
        "SWIVEL_WITH_CLAVICLE",
    };
    if (field == SWIVEL_TWIST_BONES) return "SWIVEL_WITH_TWIST_BONES";
    const FieldLayout& layout = kFields[field];
    const std::uint32_t wrong = (layout.needs & ~features) | (layout.without & features);
    return wrong ? names[std::countr_zero(wrong)] : "";
}

constexpr std::uint32_t twist_bone_count(std::uint32_t features) { return features / SWIVEL_WITH_TWIST_BONES % 8; }

// Rows of a field; 0 if crowds with these features do not have it.
constexpr std::uint32_t field_row_count(std::uint32_t features, swivel_field field)
{
    const auto n = static_cast<std::uint32_t>(field);
    if (n >= SWIVEL_FIELD_COUNT) return 0;
    if ((features & SWIVEL_COMPACT) && !is_input(field)) return compact_row_count(features, field);
    if (field == SWIVEL_ELBOW && (features & SWIVEL_JOINTS)) return 4;
    if (field == SWIVEL_TWIST_BONES) return 4 * twist_bone_count(features);
    const FieldLayout& layout = kFields[n];
    return (features & layout.needs) == layout.needs && !(features & layout.without) ? layout.row_count : 0;
}

// Floats, or the one uint32_t, of a field's value as callers read and write it; 0 likewise.
constexpr std::uint32_t field_component_count(std::uint32_t features, swivel_field field)
{
    return field_row_count(features & ~std::uint32_t{SWIVEL_COMPACT}, field);
}

// Fields that are positions, and those of them that an origin is taken from: not poles that are directions
// or normals.
constexpr bool is_position(swivel_field field)
{
    return field == SWIVEL_TARGET || field == SWIVEL_POLE || field == SWIVEL_SHOULDER_POSITION;
}
constexpr bool has_origin(std::uint32_t features, swivel_field field)
{
    return is_position(field) && !(field == SWIVEL_POLE && (features & (SWIVEL_POLE_DIRECTION | SWIVEL_POLE_NORMAL)));
}

// What messages call a field; null for a number that is no field.
constexpr const char* field_name(swivel_field field)
{
    const auto n = static_cast<std::uint32_t>(field);
    return n < SWIVEL_FIELD_COUNT ? kFields[n].name : nullptr;
}

// First row of a field among the input rows, or among the result rows.
constexpr std::uint32_t field_first_row(std::uint32_t features, swivel_field field)
{
    std::uint32_t row = 0;
    for (int f = is_input(field) ? 0 : SWIVEL_SHOULDER; f < field; ++f)
        row += field_row_count(features, static_cast<swivel_field>(f));
    return row;
}
constexpr std::uint32_t input_row_count(std::uint32_t features)
{
    constexpr auto last = static_cast<swivel_field>(SWIVEL_SHOULDER - 1);
    return field_first_row(features, last) + field_row_count(features, last);
}
constexpr std::uint32_t result_row_count(std::uint32_t features)
{
    constexpr auto last = static_cast<swivel_field>(SWIVEL_FIELD_COUNT - 1);
    return field_first_row(features, last) + field_row_count(features, last);
}

// The features with the most rows that a block of floats can have.
inline constexpr std::uint32_t kEveryFeature = ~std::uint32_t{SWIVEL_COMPACT | SWIVEL_POLE_INCOMING};

// Bytes of a row, and of a block.
inline constexpr std::size_t kInputRowBytes = SWIVEL_LANES * sizeof(float);
constexpr std::size_t result_row_bytes(std::uint32_t features)
{
    return SWIVEL_LANES * (features & SWIVEL_COMPACT ? sizeof(std::uint16_t) : sizeof(float));
}
constexpr std::size_t block_bytes(std::uint32_t features)
{
    return input_row_count(features) * kInputRowBytes + result_row_count(features) * result_row_bytes(features);
}

// Where row `row` of limb `limb` lies in storage of row_count rows a block, in floats or words.
constexpr std::size_t row_offset(std::size_t limb, std::uint32_t row_count, std::uint32_t row)
{
    return ((limb / SWIVEL_LANES) * row_count + row) * SWIVEL_LANES + limb % SWIVEL_LANES;
}

}  // namespace swivel

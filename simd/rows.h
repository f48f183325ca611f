// SPDX-License-Identifier: MIT
//
// The layout of a crowd's rows: which fields a set of features has, in which order, and where a lane of a row lies. The
// only place that knows.
#pragma once

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

// Rows of a field; 0 if crowds with these features do not have it.
constexpr std::uint32_t field_row_count(std::uint32_t features, swivel_field field)
{
    if ((features & SWIVEL_COMPACT) && !is_input(field)) return compact_row_count(features, field);
    switch (field) {
        case SWIVEL_TARGET:
        case SWIVEL_POLE:
            return 3;
        case SWIVEL_LENGTHS:
            return 2;
        case SWIVEL_PARENT_POSITION:
            return features & SWIVEL_WORLD ? 3 : 0;
        case SWIVEL_PARENT_ROTATION:
            return features & SWIVEL_WORLD ? 4 : 0;
        case SWIVEL_PARENT_SCALE:
            return features & SWIVEL_WORLD ? 1 : 0;
        case SWIVEL_HAND:
        case SWIVEL_WRIST:
            return features & SWIVEL_WITH_HAND ? 4 : 0;
        case SWIVEL_SHOULDER:
            return 4;
        case SWIVEL_ELBOW:
            return features & SWIVEL_JOINTS ? 4 : 2;
        case SWIVEL_FLAGS:
            return 1;
        default:
            return 0;
    }
}

// Floats, or the one uint32_t, of a field's value as callers read and write it; 0 likewise.
constexpr std::uint32_t field_component_count(std::uint32_t features, swivel_field field)
{
    return field_row_count(features & ~std::uint32_t{SWIVEL_COMPACT}, field);
}

// Fields that are positions, and those of them that an origin is taken from: not poles that are directions.
constexpr bool is_position(swivel_field field)
{
    return field == SWIVEL_TARGET || field == SWIVEL_POLE || field == SWIVEL_PARENT_POSITION;
}
constexpr bool has_origin(std::uint32_t features, swivel_field field)
{
    return is_position(field) && !(field == SWIVEL_POLE && (features & SWIVEL_POLE_DIRECTION));
}

// What messages call a field: its enumerator in small letters. Null for a number that is no field.
constexpr const char* field_name(swivel_field field)
{
    constexpr const char* names[] = {
        "target", "pole",     "lengths", "parent_position", "parent_rotation", "parent_scale",
        "hand",   "shoulder", "elbow",   "wrist",           "flags",
    };
    static_assert(sizeof names / sizeof *names == SWIVEL_FIELD_COUNT);
    const auto n = static_cast<std::uint32_t>(field);
    return n < SWIVEL_FIELD_COUNT ? names[n] : nullptr;
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
    return field_first_row(features, SWIVEL_HAND) + field_row_count(features, SWIVEL_HAND);
}
constexpr std::uint32_t result_row_count(std::uint32_t features)
{
    return field_first_row(features, SWIVEL_FLAGS) + field_row_count(features, SWIVEL_FLAGS);
}

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

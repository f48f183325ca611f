// SPDX-License-Identifier: MIT
//
// The layout of a group's rows: which fields a set of features has, in which order, and where a lane of a row lies. No
// other file knows it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/fields.h"

namespace swivel {

// Rows of a result field of a compact group, whose rows are words; rotations take the smallest three components.
constexpr std::uint32_t compact_row_count(swivel_features features, swivel_field field)
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

constexpr std::uint32_t twist_bone_count(swivel_features features)
{
    return static_cast<std::uint32_t>(features / SWIVEL_WITH_TWIST_BONES % (SWIVEL_MOST_TWIST_BONES + 1));
}

// Rows of a field; 0 if groups with these features do not have it.
constexpr std::uint32_t field_row_count(swivel_features features, swivel_field field)
{
    if ((features & SWIVEL_COMPACT) && !is_input(field)) return compact_row_count(features, field);
    if (field == SWIVEL_ELBOW && (features & SWIVEL_JOINTS)) return 4;
    if (field == SWIVEL_TWIST_BONES) return 4 * twist_bone_count(features);
    const FieldRow& row = row_of(field);
    return (features & row.needs) == row.needs && !(features & row.excludes) ? row.component_count : 0;
}

// The floats, or the one uint32_t, of a field's value as callers read and write it. 0 if groups with these features do
// not have it.
constexpr std::uint32_t field_component_count(swivel_features features, swivel_field field)
{
    return field_row_count(features & ~SWIVEL_COMPACT, field);
}

// The fields that are positions, and those from which an origin is subtracted: not poles that are directions or
// normals.
constexpr bool is_position(swivel_field field) { return row_of(field).place == Place::yes; }
constexpr bool has_origin(swivel_features features, swivel_field field)
{
    return is_position(field) && !(field == SWIVEL_POLE && (features & (SWIVEL_POLE_DIRECTION | SWIVEL_POLE_NORMAL)));
}

// Rows of the fields from one place in the table to another; those before a field, among the input or the result rows;
// and all.
constexpr std::uint32_t rows_before(swivel_features features, std::size_t first, std::size_t end)
{
    std::uint32_t rows = 0;
    for (std::size_t n = first; n < end; ++n) rows += field_row_count(features, kFields[n].field);
    return rows;
}
constexpr std::uint32_t field_first_row(swivel_features features, swivel_field field)
{
    return rows_before(features, is_input(field) ? 0 : kInputCount, index_of(field));
}
constexpr std::uint32_t input_row_count(swivel_features features) { return rows_before(features, 0, kInputCount); }
constexpr std::uint32_t result_row_count(swivel_features features)
{
    return rows_before(features, kInputCount, kFieldCount);
}

// Compact groups have words for four results. Their features exclude those that bring others.
static_assert([] {
    swivel_features excluded = 0;
    for (const FeatureRow& row : kFeatures)
        if (row.feature == SWIVEL_COMPACT) excluded = row.excludes;
    for (const FieldRow& row : kFields)
        if (!is_input(row.field) && compact_row_count(SWIVEL_WITH_HAND, row.field) == 0 && !(row.needs & excluded))
            return false;
    return true;
}());

// The rows that a set of features has. A kernel's own is a constant, so that no loop over the table is left in it.
struct RowPlan {
    std::uint32_t input_count, result_count;
    std::uint16_t first[kFieldCount] = {};  // of each field, among input or result rows

    constexpr explicit RowPlan(swivel_features features)
        : input_count(input_row_count(features)), result_count(result_row_count(features))
    {
        for (std::size_t n = 0; n < kFieldCount; ++n)
            first[n] = static_cast<std::uint16_t>(field_first_row(features, kFields[n].field));
    }
};

// The features with the most rows that a block of floats can have.
inline constexpr swivel_features kEveryFeature = ~(SWIVEL_COMPACT | SWIVEL_POLE_INCOMING);

// Bytes of a row, and of a block.
inline constexpr std::size_t kInputRowBytes = kLanes * sizeof(float);
constexpr std::size_t result_row_bytes(swivel_features features)
{
    return kLanes * (features & SWIVEL_COMPACT ? sizeof(std::uint16_t) : sizeof(float));
}
constexpr std::size_t block_bytes(swivel_features features)
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

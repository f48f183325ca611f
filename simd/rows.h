// SPDX-License-Identifier: MIT
//
// The layout of a group's rows: which fields a set of features has, in which order, and where a lane of a row lies. No
// other file knows it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/fields.h"

namespace swivel {

constexpr std::uint32_t twist_bone_count(swivel_features features)
{
    return static_cast<std::uint32_t>(features / kOneTwistBone % (SWIVEL_MAX_TWIST_BONES + 1));
}

// Rows of a field, one for each float or uint32_t of a value. 0 if groups with these features do not have it.
constexpr std::uint32_t field_row_count(swivel_features features, swivel_field field)
{
    if (field == SWIVEL_ELBOW && (features & SWIVEL_JOINTS)) return 4;
    if (field == SWIVEL_TWIST_BONES) return 4 * twist_bone_count(features);
    if (field == SWIVEL_CLAVICLE && (features & kBody)) return (features & SWIVEL_WITH_CLAVICLE) != 0;
    const FieldRow& row = row_of(field);
    if ((features ^ row.needs) & kNoLimb && field != SWIVEL_FLAGS) return 0;
    return (features & row.needs) == row.needs && !(features & row.excludes) ? row.component_count : 0;
}

// The fields that are positions, and those from which an origin is subtracted: not poles that are directions or
// normals.
constexpr bool is_position(swivel_field field) { return row_of(field).value.parts[0] == ValuePart::position; }
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

// Whether a field's numbers are places and rotations in one.
constexpr bool is_frame(swivel_field field)
{
    return field == SWIVEL_RECORD || field == SWIVEL_SOLVED_GOAL || field == SWIVEL_PROBE ||
           field == SWIVEL_HAND_TRANSFORM || field == SWIVEL_PROP_TRANSFORM || field == SWIVEL_SIGHT;
}
// Rows of words that a field is packed into (swivel_pack). Values of four floats are rotations.
constexpr std::uint32_t packed_row_count(swivel_features features, swivel_field field)
{
    const std::uint32_t rows = field_row_count(features, field);
    if (row_of(field).kind != kResult || is_frame(field)) return 0;
    if (field == SWIVEL_FLAGS) return 2;
    return rows % 4 == 0 ? rows / 4 * 3 : rows;
}

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

// The features with the most rows that a block can have: none that takes a field away.
inline constexpr swivel_features kEveryFeature = [] {
    swivel_features features = ~kNoLimb;
    for (const FieldRow& row : kFields) features &= ~row.excludes;
    return features;
}();
static_assert([] {
    for (const FieldRow& row : kFields)
        if (field_row_count(kEveryFeature | row.needs, row.field) == 0) return false;
    return true;
}());
// The most rows that a field has in any group.
constexpr std::uint32_t max_rows(swivel_field field)
{
    return field_row_count(kEveryFeature | row_of(field).needs, field);
}

// Bytes of a row, and of a block.
inline constexpr std::size_t kRowBytes = kLanes * sizeof(float);
constexpr std::size_t block_bytes(swivel_features features)
{
    return (input_row_count(features) + result_row_count(features)) * kRowBytes;
}

// Where row `row` of limb `limb` lies in storage of row_count rows a block.
constexpr std::size_t row_offset(std::size_t limb, std::uint32_t row_count, std::uint32_t row)
{
    return ((limb / kLanes) * row_count + row) * kLanes + limb % kLanes;
}

// Copies one lane of row_count rows from block to block.
[[gnu::always_inline]] inline void copy_lane(std::uint32_t row_count, const float* from, float* to)
{
    for (std::uint32_t row = 0; row < row_count; ++row) to[row * kLanes] = from[row * kLanes];
}

}  // namespace swivel

// SPDX-License-Identifier: MIT
//
// The values that the stages of the whole limb hand on to each other (strip.h), and the memory that they take.
#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/rows.h"
#include "simd/stages.h"

namespace swivel {

// The most blocks that a strip has. Half of them fit a small stack.
inline constexpr std::uint32_t kStripBlocks = 8, kStackBlocks = 4;
inline constexpr std::uint32_t kMaxLimitLines = kLineLimitCount, kMaxLimitBoxes = 2;

// The rows of a strip's block, by the first of each value. Within a block they lie as a group's rows do.
enum StripRow : std::uint32_t {
    kTargetRow,                       // as the parent sees it
    kWristRow = kTargetRow,           // where the wrist goes: to the target, in groups without the stage `goal`
    kPoleRow = kWristRow + 3,         // as the parent sees it
    kTargetHandRow = kPoleRow + 3,    // the wanted hand as the parent sees it, or with aim as it is given
    kHandRow = kTargetHandRow,        // the hand's orientation in the arm frame, or with aim relative to the forearm
    kLineRow = kHandRow + 4,          // to the wrist, of unit length
    kNormalRow = kLineRow + 3,        // of the swivel plane
    kLiftRow = kNormalRow + 3,        // a hinge, or with aim a rotor
    kShoulderRow = kLiftRow,          // the shoulder's rotation
    kFlexionRow = kLiftRow + 4,       // cos and sin of its half
    kFlagsRow = kFlexionRow + 2,      // bits
    kStretchRow = kFlagsRow + 1,      // of the bones
    kSwivelRow = kStretchRow + 1,     // the chosen one's cos and sin
    kTwistRow = kSwivelRow + 2,       // the wrist's rotation from the forearm
    kClavicleRow = kTwistRow + 4,     // its turn
    kIncomingRow = kClavicleRow + 4,  // shoulder, elbow, wrist
    kLimitRow = kIncomingRow,         // a line of three rows for each limit
    kBoxRow = kLimitRow + 3 * kMaxLimitLines,  // five curves of three rows for each box
    kStripRows = kBoxRow + 15 * kMaxLimitBoxes
};
// Where the upper arm points: a line of three rows for each component.
inline constexpr std::uint32_t kRegionRows[3] = {kWristRow, kPoleRow, kTwistRow};

// When a value is in its rows: from the first stage that writes it to the last that reads it.
struct StripValue {
    std::uint32_t row, row_count;
    Stage first, last;
};
inline constexpr StripValue kStripValues[] = {
    {kTargetRow, 3, Stage::goal_to_parent, Stage::goal},
    {kWristRow, 3, Stage::goal, Stage::yield},
    {kPoleRow, 3, Stage::goal_to_parent, Stage::wish},
    {kTargetHandRow, 4, Stage::goal_to_parent, Stage::goal},
    {kHandRow, 4, Stage::goal, Stage::wrist},
    {kLineRow, 3, Stage::place, Stage::store},
    {kNormalRow, 3, Stage::place, Stage::store},
    {kLiftRow, 4, Stage::place, Stage::store},
    {kShoulderRow, 4, Stage::store, Stage::wrist},
    {kFlexionRow, 2, Stage::place, Stage::wrist},
    {kFlagsRow, 1, Stage::place, Stage::store},
    {kStretchRow, 1, Stage::place, Stage::store},
    {kSwivelRow, 2, Stage::choose, Stage::store},
    {kTwistRow, 4, Stage::wrist, Stage::hand_transform},
    {kClavicleRow, 4, Stage::clavicle, Stage::hand_transform},
    {kIncomingRow, 12, Stage::posed, Stage::wish},
    {kLimitRow, 3 * kMaxLimitLines, Stage::line, Stage::choose_in_region},
    {kBoxRow, 15 * kMaxLimitBoxes, Stage::shoulder_box, Stage::choose_in_region},
    {kRegionRows[0], 3, Stage::region, Stage::choose_in_region},
    {kRegionRows[1], 3, Stage::region, Stage::choose_in_region},
    {kRegionRows[2], 3, Stage::region, Stage::choose_in_region},
};
// Each row has a value, and never two at once. A stage reads a slice's rows before it writes them, so one value may
// begin in the stage that another one ends in.
static_assert([] {
    bool is_used[kStripRows] = {};
    for (const StripValue& a : kStripValues) {
        for (std::uint32_t row = a.row; row < a.row + a.row_count; ++row) is_used[row] = true;
        for (const StripValue& b : kStripValues)
            if (&a != &b && a.row < b.row + b.row_count && b.row < a.row + a.row_count && a.first < b.last &&
                b.first < a.last)
                return false;
    }
    for (const bool each : is_used)
        if (!each) return false;
    return true;
}());
// Plain arms that are solved as whole limbs have only the rows before the clavicle's.
inline constexpr std::size_t kPlainStripFloats = kClavicleRow * kLanes;
inline constexpr std::size_t kStripBlockFloats = std::size_t{kStripRows} * kLanes;

}  // namespace swivel

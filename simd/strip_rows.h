// SPDX-License-Identifier: MIT
//
// The values that the stages of the whole limb hand on to each other (strip.h), and the memory that they take.
#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/rows.h"

namespace swivel {

// The most blocks that a strip has. Half of them fit a small stack.
inline constexpr std::uint32_t kStripBlocks = 8, kStackBlocks = 4;
inline constexpr std::uint32_t kMaxLimitLines = kLineLimitCount, kMaxLimitBoxes = 2;

// The rows of a strip's block, by the first of each value. Within a block they lie as a group's rows do.
enum StripRow : std::uint32_t {
    kWristRow,                     // the target as the parent sees it; from the stage `goal` on, where the wrist goes
    kPoleRow = kWristRow + 3,      // the pole as the parent sees it
    kHandRow = kPoleRow + 3,       // the hand as the parent sees it; from `goal` on, its orientation in the arm frame
    kLineRow = kHandRow + 4,       // to the wrist, of unit length
    kNormalRow = kLineRow + 3,     // of the swivel plane
    kLiftRow = kNormalRow + 3,     // a hinge, or with aim a rotor
    kShoulderRow = kLiftRow,       // the shoulder's rotation, once the arm is lifted
    kFlexionRow = kLiftRow + 4,    // cos and sin of its half
    kFlagsRow = kFlexionRow + 2,   // bits
    kStretchRow = kFlagsRow + 1,   // of the bones
    kSwivelRow = kStretchRow + 1,  // the chosen one's cos and sin
    kTwistRow = kSwivelRow + 2,    // the wrist's rotation, for twist bones
    kClavicleRow = kTwistRow + 4,  // its turn
    kIncomingRow = kClavicleRow + 4,           // shoulder, elbow, wrist
    kLimitRow = kIncomingRow,                  // a line of three rows for each limit, once the wish is known
    kBoxRow = kLimitRow + 3 * kMaxLimitLines,  // five curves of three rows for each box
    kStripRows = kBoxRow + 15 * kMaxLimitBoxes
};
// Where the upper arm points, a line of three rows for each component, once the hand yields no more: in rows that then
// have no use.
inline constexpr std::uint32_t kRegionRows[3] = {kWristRow, kPoleRow, kTwistRow};
// Plain arms that are solved as whole limbs have only the rows before the clavicle's.
inline constexpr std::size_t kPlainStripFloats = kClavicleRow * kLanes;
inline constexpr std::size_t kStripBlockFloats = std::size_t{kStripRows} * kLanes;

}  // namespace swivel

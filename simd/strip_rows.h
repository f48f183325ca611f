// SPDX-License-Identifier: MIT
//
// What the stages of the whole limb hand on to each other (strip.h), and the memory that it takes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/rows.h"

namespace swivel {

// The most blocks that a strip has. Half of them fit a small stack.
inline constexpr std::uint32_t kStripBlocks = 8, kStackBlocks = 4;
inline constexpr std::uint32_t kMostLimitLines = 5, kMostLimitBoxes = 2;

// The rows of a strip's block, by the first of each value. They lie as a group's do.
enum StripRow : std::uint32_t {
    kWristRow,                                  // where the wrist goes
    kPoleRow = kWristRow + 3,                   // what was given as a pole
    kHandRow = kPoleRow + 3,                    // the hand's orientation
    kLineRow = kHandRow + 4,                    // to the wrist, of unit length
    kNormalRow = kLineRow + 3,                  // of the swivel plane
    kLiftRow = kNormalRow + 3,                  // a hinge, or with aim a rotor
    kFlexionRow = kLiftRow + 4,                 // cos and sin of its half
    kFlagsRow = kFlexionRow + 2,                //
    kStretchRow = kFlagsRow + 1,                // of the bones
    kSwivelRow = kStretchRow + 1,               // the chosen one's cos and sin
    kTwistRow = kSwivelRow + 2,                 // the wrist's rotation, for twist bones
    kClavicleRow = kTwistRow + 4,               // its turn
    kIncomingRow = kClavicleRow + 4,            // shoulder, elbow, wrist
    kLimitRow = kIncomingRow,                   // a line of three rows for each limit, once the wish is known
    kBoxRow = kLimitRow + 3 * kMostLimitLines,  // five curves of three rows for each box
    kStripRows = kBoxRow + 15 * kMostLimitBoxes
};
// A plain arm has no later rows.
inline constexpr std::size_t kPlainStripFloats = kClavicleRow * kLanes;
inline constexpr std::size_t kStripBlockFloats = std::size_t{kStripRows} * kLanes;

}  // namespace swivel

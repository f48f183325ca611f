#pragma once
// SPDX-License-Identifier: MIT
// Which of a character's two arms a row of a table speaks of.

#include <cstdint>
#include <string_view>

namespace swivel::formats {

enum class Side : std::uint8_t { left, right };

// The word the tables use: "left" or "right".
constexpr std::string_view side_name(Side side) { return side == Side::left ? "left" : "right"; }

}  // namespace swivel::formats

#pragma once
// SPDX-License-Identifier: MIT
// Makes any text safe to print. Terminals obey control characters, and Unicode's marks and overrides of direction
// reorder a line. Both become escapes, such as \x1b and \u202e. All else stays; of bytes that are no UTF-8, those
// from 0x80 to 0x9f become escapes, too.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace swivel::formats {

// The max number of characters that a message quotes from a file: about two lines.
constexpr std::size_t kMaxQuoted = 200;

// Takes the next character off the front of `rest`, which is not empty. Returns the character, or its escape in `room`.
// Allocates nothing.
using EscapeRoom = std::array<char, 8>;
std::string_view take_printable(std::string_view& rest, EscapeRoom& room) noexcept;

// `text` for a message of one line, cut to `max` characters and "...".
std::string printable(std::string_view text, std::size_t max = 40);

// Whether all tables and all JSON can hold a name as it is: not empty, UTF-8, without commas, quotes and what
// printable() makes an escape.
bool is_plain_name(std::string_view name);

// `text` with its line ends kept.
std::string printable_lines(std::string_view text);

}  // namespace swivel::formats

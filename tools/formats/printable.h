#pragma once
// SPDX-License-Identifier: MIT
// What of a text from anywhere may reach a terminal: the one rule of it. A terminal obeys control characters, and it
// draws a line in another order where the line has Unicode's marks and overrides of direction. Here they become
// escapes, as \x1b and \u202e. All else stays; of bytes that are no UTF-8, those
// from 0x80 to 0x9f become escapes, too.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace swivel::formats {

// The most characters of a file that a message quotes: about two lines.
constexpr std::size_t kMaxQuoted = 200;

// Takes the next character off the front of `rest`, which is not empty, and returns what a terminal may have of it: the
// character, or its escape in `room`. Takes no memory.
using EscapeRoom = std::array<char, 8>;
std::string_view take_printable(std::string_view& rest, EscapeRoom& room) noexcept;

// `text` as a part of a message's one line, cut to `most` characters with "..." after them.
std::string printable(std::string_view text, std::size_t max = 40);

// `text` as lines: their ends stay.
std::string printable_lines(std::string_view text);

}  // namespace swivel::formats

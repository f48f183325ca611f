#pragma once
// SPDX-License-Identifier: MIT
// What was meant by a word that nobody knows: one rule for keys of files, options, commands and values.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace swivel::formats {

// The word nearest to the wrong one, if it is near enough to be meant. It may have one wrong letter for every three of
// its own, and a word of 3 n - 1 letters may have n. A letter too many, one missing, one changed and two neighbours
// exchanged count 1 each.
std::optional<std::string> nearest_word(std::string_view wrong, std::span<const std::string> words);

// "did you mean WORD?", or, where no word is near enough, "known are WORD, WORD".
std::string suggestion(std::string_view wrong, std::span<const std::string> words);

}  // namespace swivel::formats

#pragma once
// SPDX-License-Identifier: MIT
// Guesses the word meant by an unknown one: one rule for keys of files, options, commands and values.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace swivel::formats {

// The word nearest to the wrong one, if it is near enough: a word of 3 n - 1 letters or more may have n errors. A
// letter too many, a missing letter, a changed letter and two exchanged neighbours are one error each.
std::optional<std::string> nearest_word(std::string_view wrong, std::span<const std::string> words);

// "did you mean WORD?", or, where no word is near enough, "known are WORD, WORD".
std::string suggestion(std::string_view wrong, std::span<const std::string> words);

}  // namespace swivel::formats

// SPDX-License-Identifier: MIT
#include "tools/formats/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

// The number of letters to insert, remove, change or exchange with a neighbour to make one word of the other.
std::size_t edit_distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        next[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            next[j + 1] = std::min({row[j] + (a[i] != b[j]), row[j + 1] + 1, next[j] + 1});
            if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j])
                next[j + 1] = std::min(next[j + 1], before[j - 1] + 1);
        }
        before.swap(row);
        row.swap(next);
    }
    return row.back();
}

}  // namespace

std::optional<std::string> nearest_word(std::string_view wrong, std::span<const std::string> words)
{
    const auto far = [&](const std::string& word) { return edit_distance(wrong, word); };
    const auto nearest = std::ranges::min_element(words, {}, far);
    if (nearest == words.end() || 3 * far(*nearest) > nearest->size() + 1) return std::nullopt;
    return *nearest;
}

std::string suggestion(std::string_view wrong, std::span<const std::string> words)
{
    if (const auto nearest = nearest_word(wrong, words)) return fmt::format("did you mean {}?", *nearest);
    return "known are " + joined(words, ", ");
}

}  // namespace swivel::formats

// SPDX-License-Identifier: MIT
//
// Crowds of ordinary, hard and bad arms, their results limb by limb whatever the rows hold, and masks.
#pragma once

#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_limb.h"

namespace swivel::test {

inline std::uint32_t mask_words(const Crowd& crowd) { return (swivel_block_count(crowd.get()) + 1) / 2; }
inline std::uint32_t lane_count(const Crowd& crowd) { return swivel_block_count(crowd.get()) * SWIVEL_LANES; }
inline bool is_set(const std::vector<std::uint32_t>& words, std::uint32_t limb)
{
    return words[limb / 32] >> limb % 32 & 1;
}
inline void set(std::vector<std::uint32_t>& words, std::uint32_t limb) { words[limb / 32] |= 1u << limb % 32; }

// One in eight out of reach or of bad input.
inline void write_arms(Crowd& crowd, swivel_features features, std::uint32_t group_count, Random& random)
{
    for (std::uint32_t group = 0; group < group_count; ++group)
        for (std::uint32_t n = 0; n < swivel_group_limb_count(crowd.get(), group); ++n) {
            const auto bone = [&] { return static_cast<float>(random.spread(0.2, 5)); };
            Limb limb = random_limb(random, features, {bone(), bone()});
            const std::uint32_t kind = random.below(16);
            if (kind == 0) limb.target[random.below(3)] *= 100;
            if (kind == 1) limb.pole[random.below(3)] = kNan;
            write_limb(crowd, group, n, limb);
        }
}

// Every lane's results as words, lane after lane.
struct Results {
    std::uint32_t row_count;
    std::vector<std::uint32_t> words;

    explicit Results(const Crowd& crowd)
    {
        // All groups have the same features.
        row_count = swivel_result_rows(crowd.get(), 0).row_count;
        for (std::uint32_t group = 0; group < swivel_group_count(crowd.get()); ++group) {
            const swivel_rows rows = swivel_result_rows(crowd.get(), group);
            const std::size_t lanes = std::size_t{rows.block_count} * SWIVEL_LANES;
            for (std::size_t limb = 0; limb < lanes; ++limb)
                for (std::uint32_t row = 0; row < row_count; ++row) {
                    const std::size_t at = (limb / 16 * row_count + row) * 16 + limb % 16;
                    std::uint32_t word = 0;
                    std::memcpy(&word, rows.base + at, sizeof word);
                    words.push_back(word);
                }
        }
    }
    bool same(const Results& other, std::uint32_t limb) const
    {
        const std::size_t at = std::size_t{limb} * row_count;
        return std::equal(&words[at], &words[at] + row_count, &other.words[at]);
    }
};

// Fills all results with what no solve leaves, a new pattern for each word.
inline void poison_results(Crowd& crowd)
{
    std::uint32_t n = 0;
    for (std::uint32_t group = 0; group < swivel_group_count(crowd.get()); ++group) {
        const swivel_rows rows = swivel_result_rows(crowd.get(), group);
        for (float& at : std::span(rows.base, float_count(rows))) {
            const std::uint32_t word = 0x7fa00000u + n++;  // a signalling NaN
            std::memcpy(&at, &word, sizeof word);
        }
    }
}

// The lanes that are limbs.
inline std::vector<std::uint32_t> all_limbs(const Crowd& crowd, std::uint32_t group_count)
{
    std::vector<std::uint32_t> limbs;
    for (std::uint32_t group = 0; group < group_count; ++group)
        for (std::uint32_t n = 0; n < swivel_group_limb_count(crowd.get(), group); ++n)
            limbs.push_back(swivel_group_first_limb(crowd.get(), group) + n);
    return limbs;
}

}  // namespace swivel::test

// SPDX-License-Identifier: MIT
//
// Calls of the C interface that solve: all, some, the most urgent.
#include <algorithm>
#include <bit>

#include "tests/fuzz/interface_session.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/strided.h"

namespace swivel::fuzz {
namespace {

struct Blocks {
    std::uint32_t first, count;
    bool is_valid;
};
Blocks take_blocks(Session& session)
{
    const std::uint32_t has = swivel_block_count(session.crowd), first = session.bytes.below(has + 1);
    if (session.bytes.one_in(16)) return {first, has - first + 1 + session.bytes.take<std::uint32_t>() / 2, false};
    return {first, session.bytes.below(has - first + 1), true};
}

std::vector<bool> lanes_of(const Session& session, const Blocks& blocks)
{
    std::vector<bool> lanes(session.lane_count());
    for (std::size_t lane = std::size_t{blocks.first} * SWIVEL_LANES;
         lane < (std::size_t{blocks.first} + blocks.count) * SWIVEL_LANES; ++lane)
        lanes[lane] = true;
    return lanes;
}

// Words of a bit for each lane, one in 16 times too few or too many.
std::vector<std::uint32_t> take_words(Session& session)
{
    const std::size_t count = (swivel_block_count(session.crowd) + 1) / 2;
    std::vector<std::uint32_t> words(session.bytes.one_in(16) ? session.bytes.below(4) : count);
    for (std::uint32_t& word : words) word = session.bytes.take<std::uint32_t>();
    return words;
}
bool are_enough(const Session& session, const std::vector<std::uint32_t>& words)
{
    return words.size() == (swivel_block_count(session.crowd) + 1) / 2;
}
bool has(const std::vector<std::uint32_t>& words, std::size_t lane) { return words[lane / 32] >> lane % 32 & 1; }

// Lanes that are limbs.
std::vector<bool> limbs_of(const Session& session)
{
    std::vector<bool> lanes(session.lane_count());
    for (std::uint32_t group = 0; group < session.group_count; ++group)
        for (std::uint32_t n = 0; n < swivel_group_limb_count(session.crowd, group); ++n)
            lanes[swivel_group_first_limb(session.crowd, group) + n] = true;
    return lanes;
}

// One entry for each group.
struct Priorities {
    std::vector<Strided> values;
    std::vector<swivel_in> in;
    bool are_valid = true;

    explicit Priorities(Session& session)
    {
        for (std::uint32_t group = 0; group < session.group_count; ++group) {
            Strided& each =
                values.emplace_back(session.bytes, swivel_group_limb_count(session.crowd, group), sizeof(float), true);
            const bool any_bits = session.bytes.one_in(2);
            each.fill([&](std::size_t, char* at) {
                const float value = any_bits ? session.bytes.any_float() : session.bytes.share();
                std::memcpy(at, &value, sizeof value);
            });
            in.push_back(each.in());
            are_valid = are_valid && each.is_valid();
        }
    }
};

// Blocks are picked whole, and no more than asked for.
void check_choice(const Session& session, const std::vector<std::uint32_t>& words, std::uint32_t most_blocks,
                  std::uint32_t count)
{
    const std::vector<bool> limbs = limbs_of(session);
    std::uint32_t bits = 0, blocks = 0;
    for (const std::uint32_t word : words) bits += static_cast<std::uint32_t>(std::popcount(word));
    for (std::size_t block = 0; block < limbs.size() / SWIVEL_LANES; ++block) {
        const bool is_picked = has(words, block * SWIVEL_LANES);
        blocks += is_picked;
        for (std::size_t lane = block * SWIVEL_LANES; lane < (block + 1) * SWIVEL_LANES; ++lane)
            SWIVEL_REQUIRE(has(words, lane) == (is_picked && limbs[lane]));
    }
    SWIVEL_REQUIRE(blocks <= most_blocks && bits == count);
}

}  // namespace

void call_solve(Session& session)
{
    check_status(session, swivel_solve(session.crowd), true);
    check_solved(session, std::vector<bool>(session.lane_count(), true));
}

void call_solve_blocks(Session& session)
{
    const Blocks blocks = take_blocks(session);
    const swivel_status status = swivel_solve_blocks(session.crowd, blocks.first, blocks.count);
    check_status(session, status, blocks.is_valid);
    if (status == SWIVEL_OK) check_solved(session, lanes_of(session, blocks));
}

void call_solve_active(Session& session)
{
    const bool whole = session.bytes.one_in(2);
    const Blocks blocks = whole ? Blocks{0, swivel_block_count(session.crowd), true} : take_blocks(session);
    const std::vector<std::uint32_t> words = take_words(session);
    const auto count = static_cast<std::uint32_t>(words.size());
    const swivel_status status =
        whole ? swivel_solve_active(session.crowd, words.data(), count)
              : swivel_solve_active_blocks(session.crowd, words.data(), count, blocks.first, blocks.count);
    check_status(session, status, blocks.is_valid && are_enough(session, words));
    if (status != SWIVEL_OK) return;
    std::vector<bool> chosen = lanes_of(session, blocks);
    for (std::size_t lane = 0; lane < chosen.size(); ++lane) chosen[lane] = chosen[lane] && has(words, lane);
    check_solved(session, chosen);
}

void call_solve_list(Session& session)
{
    const std::vector<bool> limbs = limbs_of(session);
    const bool any_lane = session.bytes.one_in(8);
    std::vector<std::uint32_t> list;
    std::vector<bool> chosen(limbs.size());
    bool is_valid = true;
    for (std::uint32_t n = session.bytes.below(20); n > 0; --n) {
        std::uint32_t lane = session.bytes.below(session.lane_count() + (any_lane ? 20 : 0));
        while (!any_lane && !limbs[lane]) --lane;  // a group's padding comes after a limb
        list.push_back(lane);
        is_valid = is_valid && lane < limbs.size() && limbs[lane];
        if (lane < chosen.size()) chosen[lane] = true;
    }
    const swivel_status status = swivel_solve_list(session.crowd, list.data(), static_cast<std::uint32_t>(list.size()));
    check_status(session, status, is_valid);
    if (status == SWIVEL_OK) check_solved(session, chosen);
}

void call_choose(Session& session)
{
    const bool solves = session.bytes.one_in(2), has_count = session.bytes.one_in(2);
    const std::uint32_t most_blocks = session.bytes.below(swivel_block_count(session.crowd) + 2);
    const Priorities priorities(session);
    std::uint32_t count = ~0u;
    if (solves) {
        const swivel_status status =
            swivel_solve_budget(session.crowd, priorities.in.data(), most_blocks, has_count ? &count : nullptr);
        check_status(session, status, (session.features & SWIVEL_BUDGET) && priorities.are_valid);
        SWIVEL_REQUIRE(!has_count || (status == SWIVEL_OK) == (count != ~0u));
        return;
    }
    std::vector<std::uint32_t> words = take_words(session);
    const std::vector<std::uint32_t> words_before = words;
    const swivel_status status = swivel_choose(session.crowd, priorities.in.data(), most_blocks, words.data(),
                                               static_cast<std::uint32_t>(words.size()), &count);
    check_status(session, status,
                 (session.features & SWIVEL_BUDGET) && priorities.are_valid && are_enough(session, words));
    if (status == SWIVEL_OK)
        check_choice(session, words, most_blocks, count);
    else
        SWIVEL_REQUIRE(words == words_before && count == ~0u);
}

}  // namespace swivel::fuzz

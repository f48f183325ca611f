// SPDX-License-Identifier: MIT
//
// Solves some limbs of a crowd.
// - If all limbs of several successive blocks are chosen, the blocks are solved where they lie.
// - Other blocks are copied aside, and the results of the chosen lanes are copied back.
// - If only one or two limbs of a block are chosen, they are gathered with others.
// Each of the three goes over the mask by itself, so that they share what stack they need.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "batch/lane_mask.h"
#include "batch/solve.h"
#include "simd/rows.h"

namespace swivel {

namespace {

// So many limbs of a block, or fewer, are gathered. For more limbs, it costs less to solve the whole block aside.
constexpr int kFewLimbs = 2;
// So many successive blocks, all chosen whole, are solved where they lie. A single block is better solved together with
// others. Alone, it leaves a core waiting for its roots.
constexpr std::uint32_t kRunBlocks = 2;

// So many blocks are solved together aside, on the stack, or fewer if they have many rows. Their rows stay in the
// nearest cache. There is room for a block of every feature.
constexpr std::uint32_t kAsideBlocks = 8;
constexpr std::uint32_t kAsideLimbs = kAsideBlocks * SWIVEL_LANES;
// A kernel puts limbs with Euler boxes aside itself, unless their block is alone. Only one of both has room on the
// stack.
constexpr FeatureSet kBoxes = feature::shoulder_box | feature::wrist_box;
constexpr std::uint32_t kAsideRows = input_row_count(kEveryFeature) + result_row_count(kEveryFeature);

// The bits of four lanes, as words of all ones or zeros. This is a table, because words made one by one can be loaded
// only after all stores before them. That took as long as half the solve.
constexpr std::uint32_t kQuad = 4;
template <class Bits>
constexpr std::array<std::array<Bits, kQuad>, 1u << kQuad> kTake = [] {
    std::array<std::array<Bits, kQuad>, 1u << kQuad> take{};
    for (std::uint32_t n = 0; n < take.size(); ++n)
        for (std::uint32_t lane = 0; lane < kQuad; ++lane)
            take[n][lane] = n >> lane & 1 ? static_cast<Bits>(~Bits{}) : Bits{};
    return take;
}();

// Copies chosen lanes of one block's rows.
template <class Bits, class Word>
void merge_lanes(LaneMask chosen, std::uint32_t row_count, const Word* from, Word* to)
{
    static_assert(sizeof(Bits) == sizeof(Word) && SWIVEL_LANES == 4 * kQuad);
    const auto take = [&](std::uint32_t quad) { return kTake<Bits>[chosen >> quad * kQuad & ((1u << kQuad) - 1)]; };
    const std::array<Bits, kQuad> takes[] = {take(0), take(1), take(2), take(3)};
    for (std::uint32_t row = 0; row < row_count; ++row) {
        for (const std::array<Bits, kQuad>& each : takes) {
            std::array<Bits, kQuad> got, kept;
            std::memcpy(&got, from, sizeof got);
            std::memcpy(&kept, to, sizeof kept);
            for (std::uint32_t lane = 0; lane < kQuad; ++lane)
                kept[lane] = static_cast<Bits>(kept[lane] ^ ((got[lane] ^ kept[lane]) & each[lane]));
            std::memcpy(to, &kept, sizeof kept);
            from += kQuad;
            to += kQuad;
        }
    }
}

// Blocks on the stack that are solved together and whose results are then copied to where they belong.
struct Aside {
    const swivel_crowd& crowd;
    const Kernels& kernels;
    const Group& group;
    const std::uint32_t input_rows, result_rows;  // of a block
    const std::uint32_t block_limit;
    alignas(64) float rows[kAsideRows * SWIVEL_LANES];  // input rows of all blocks, result rows, words

    Aside(const swivel_crowd& of, const Kernels& with, const Group& in)
        : crowd(of),
          kernels(with),
          group(in),
          input_rows(of.input_row_count),
          result_rows(of.result_row_count),
          block_limit(crowd.features & kBoxes ? 1 : std::min(kAsideBlocks, kAsideRows / rows_of_block()))
    {
    }
    std::uint32_t float_result_rows() const { return result_row_count(crowd.features & ~feature::compact); }
    std::uint32_t rows_of_block() const
    {
        return input_rows + float_result_rows() + (crowd.words ? (result_rows + 1) / 2 : 0);
    }
    float* input() { return rows; }
    float* results() { return rows + std::size_t{block_limit} * input_rows * SWIVEL_LANES; }
    std::uint16_t* words()
    {
        return reinterpret_cast<std::uint16_t*>(results() +
                                                std::size_t{block_limit} * float_result_rows() * SWIVEL_LANES);
    }
    // What is carried from solve to solve is read from the results.
    bool reads_results() const { return crowd.features & feature::most_swivel; }

    // Calls for a block's results, which are read and written once they are solved.
    void prefetch(std::uint32_t block) const
    {
        const std::size_t bytes = result_rows * result_row_bytes(crowd.features);
        const char* const base =
            crowd.words ? reinterpret_cast<const char*>(crowd.words) : reinterpret_cast<const char*>(crowd.results);
        const char* const at = base + block * bytes;
        for (std::size_t byte = 0; byte < bytes; byte += 64) __builtin_prefetch(at + byte, 1);
    }
    void solve(std::uint32_t block_count)
    {
        solve_rows(crowd, kernels, group, input(), results(), block_count);
        if (crowd.words) pack_rows(crowd, kernels, results(), words(), block_count);
    }
};

// Whole blocks, of which the chosen lanes are copied back.
struct Blocks {
    Aside& aside;
    std::uint32_t count = 0;
    std::uint32_t blocks[kAsideBlocks];
    LaneMask chosen[kAsideBlocks];

    explicit Blocks(Aside& in) : aside(in) {}

    void add(std::uint32_t block, LaneMask lanes)
    {
        const std::size_t floats = std::size_t{aside.input_rows} * SWIVEL_LANES;
        std::memcpy(aside.input() + count * floats, aside.crowd.input + block * floats, floats * sizeof(float));
        const std::size_t result_floats = std::size_t{aside.result_rows} * SWIVEL_LANES;
        if (aside.reads_results())
            std::memcpy(aside.results() + count * result_floats, aside.crowd.results + block * result_floats,
                        result_floats * sizeof(float));
        aside.prefetch(block);
        blocks[count] = block;
        chosen[count++] = lanes;
        if (count == aside.block_limit) flush();
    }
    void flush()
    {
        if (count == 0) return;
        aside.solve(count);
        const swivel_crowd& crowd = aside.crowd;
        const std::size_t size = std::size_t{aside.result_rows} * SWIVEL_LANES;
        for (std::uint32_t n = 0; n < count; ++n) {
            if (crowd.words)
                merge_lanes<std::uint16_t>(chosen[n], aside.result_rows, aside.words() + n * size,
                                           crowd.words + blocks[n] * size);
            else
                merge_lanes<std::uint32_t>(chosen[n], aside.result_rows, aside.results() + n * size,
                                           crowd.results + blocks[n] * size);
        }
        count = 0;
    }
};

// Single limbs, gathered into blocks of their own.
struct Limbs {
    Aside& aside;
    std::uint32_t count = 0;
    std::uint32_t limbs[kAsideLimbs];

    explicit Limbs(Aside& in) : aside(in) {}

    void put(std::size_t limb, std::uint32_t at)
    {
        const std::uint32_t rows = aside.input_rows, result_rows = aside.result_rows;
        copy_lane(rows, aside.crowd.input + row_offset(limb, rows, 0), aside.input() + row_offset(at, rows, 0));
        if (aside.reads_results())
            copy_lane(result_rows, aside.crowd.results + row_offset(limb, result_rows, 0),
                      aside.results() + row_offset(at, result_rows, 0));
    }
    void add(std::uint32_t block, LaneMask lanes)
    {
        aside.prefetch(block);
        for (; lanes; lanes &= lanes - 1) {
            limbs[count] = block * SWIVEL_LANES + static_cast<std::uint32_t>(std::countr_zero(lanes));
            put(limbs[count], count);
            if (++count == aside.block_limit * SWIVEL_LANES) flush();
        }
    }
    void flush()
    {
        if (count == 0) return;
        const std::uint32_t block_count = (count - 1) / SWIVEL_LANES + 1, rows = aside.result_rows;
        // The last block's free lanes take a limb that is there, and so take no longer than it does.
        for (std::uint32_t at = count; at < block_count * SWIVEL_LANES; ++at) put(limbs[0], at);
        aside.solve(block_count);
        for (std::uint32_t n = 0; n < count; ++n) {
            const std::size_t from = row_offset(n, rows, 0), to = row_offset(limbs[n], rows, 0);
            if (aside.crowd.words)
                copy_lane(rows, aside.words() + from, aside.crowd.words + to);
            else
                copy_lane(rows, aside.results() + from, aside.crowd.results + to);
        }
        count = 0;
    }
};

// The chosen blocks of a run. It calls whole(block, block_count) for successive blocks of which all limbs are chosen,
// and part(block, lanes) for another block.
template <class Whole, class Part>
void for_each_choice(const Group& group, const std::uint32_t* mask, std::uint32_t first_block,
                     std::uint32_t block_count, const Whole& whole, const Part& part)
{
    const std::uint32_t end = first_block + block_count;
    const auto is_whole = [&](std::uint32_t block) {
        const LaneMask all = lanes_of_limbs(group, block);
        return (lanes_of(mask, block) & all) == all;
    };
    for (std::uint32_t block = first_block; block < end;) {
        if (mask[block / 2] == 0) {
            block += 2 - block % 2;  // all blocks of the word
            continue;
        }
        std::uint32_t whole_count = 0;
        while (block + whole_count < end && is_whole(block + whole_count)) ++whole_count;
        if (whole_count >= kRunBlocks) {
            whole(block, whole_count);
            block += whole_count;
            continue;
        }
        // This takes one block at a time. It looks at the next blocks again, at most kRunBlocks times.
        part(block, lanes_of(mask, block) & lanes_of_limbs(group, block));
        ++block;
    }
}

// Solves blocks of which some limbs are chosen: first those with more than a few, then the others. A function of its
// own, so that the rows aside take no stack while whole blocks are solved.
[[gnu::noinline]] void solve_parts(const swivel_crowd& crowd, const Kernels& kernels, const Group& group,
                                   const std::uint32_t* mask, std::uint32_t first_block, std::uint32_t block_count)
{
    Aside aside(crowd, kernels, group);
    const auto add_to = [&](auto parts, bool few) {
        for_each_choice(
            group, mask, first_block, block_count, [](std::uint32_t, std::uint32_t) {},
            [&](std::uint32_t block, LaneMask chosen) {
                if ((std::popcount(chosen) <= kFewLimbs) == few) parts.add(block, chosen);
            });
        parts.flush();
    };
    add_to(Blocks(aside), false);
    add_to(Limbs(aside), true);
}

}  // namespace

void solve_chosen_group(const swivel_crowd& crowd, const Kernels& kernels, const Group& group,
                        const std::uint32_t* mask, std::uint32_t first_block, std::uint32_t block_count)
{
    bool has_parts = false;
    for_each_choice(
        group, mask, first_block, block_count,
        [&](std::uint32_t block, std::uint32_t count) { solve_group(crowd, kernels, group, block, count); },
        [&](std::uint32_t, LaneMask) { has_parts = true; });
    if (has_parts) solve_parts(crowd, kernels, group, mask, first_block, block_count);
}

}  // namespace swivel

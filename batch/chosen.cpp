// SPDX-License-Identifier: MIT
//
// Solves some limbs of a crowd.
// - If all limbs of several successive blocks are chosen, the blocks are solved where they lie.
// - Other blocks are copied aside, and the results of the chosen lanes are copied back.
// - If only one or two limbs of a block are chosen, they are gathered with others.
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

// So many blocks are solved together aside, on the stack. Their rows stay in the nearest cache. If blocks have many
// rows, fewer fit.
constexpr std::uint32_t kAsideBlocks = 8;
constexpr std::uint32_t kAsideLimbs = kAsideBlocks * SWIVEL_LANES;
constexpr FeatureSet kPlainFeatures = feature::world | feature::joints | feature::hand;
constexpr std::uint32_t kInputRows = kAsideBlocks * input_row_count(kPlainFeatures),
                        kResultRows = kAsideBlocks * result_row_count(kPlainFeatures);
static_assert(kInputRows >= input_row_count(kEveryFeature) && kResultRows >= result_row_count(kEveryFeature));

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
    const std::uint32_t block_limit;
    alignas(64) float input[kInputRows * SWIVEL_LANES];
    alignas(64) float results[kResultRows * SWIVEL_LANES];
    alignas(64) std::uint16_t words[kAsideLimbs * result_row_count(feature::compact | kPlainFeatures)];

    Aside(const swivel_crowd& of, const Kernels& with, const Group& in)
        : crowd(of),
          kernels(with),
          group(in),
          block_limit(std::min({kAsideBlocks, kInputRows / of.input_row_count, kResultRows / of.result_row_count}))
    {
    }
    // What is carried from solve to solve is read from the results.
    bool reads_results() const { return crowd.features & feature::most_swivel; }

    // Calls for the results of a limb's block, which are read and written once they are solved.
    void prefetch(std::size_t limb) const
    {
        const std::size_t row_bytes = result_row_bytes(crowd.features), bytes = crowd.result_row_count * row_bytes;
        const char* const base =
            crowd.words ? reinterpret_cast<const char*>(crowd.words) : reinterpret_cast<const char*>(crowd.results);
        const char* const at = base + limb / SWIVEL_LANES * bytes;
        for (std::size_t byte = 0; byte < bytes; byte += 64) __builtin_prefetch(at + byte, 1);
    }
    void solve(std::uint32_t block_count)
    {
        solve_rows(crowd, kernels, group, input, results, block_count);
        if (crowd.words) pack_rows(crowd, kernels, results, words, block_count);
    }
};

// Whole blocks, of which the chosen lanes are copied back.
struct Blocks : Aside {
    std::uint32_t count = 0;
    std::uint32_t blocks[kAsideBlocks];
    LaneMask chosen[kAsideBlocks];

    using Aside::Aside;

    void add(std::uint32_t block, LaneMask lanes)
    {
        const std::size_t floats = std::size_t{crowd.input_row_count} * SWIVEL_LANES;
        std::memcpy(input + count * floats, crowd.input + block * floats, floats * sizeof(float));
        const std::size_t result_floats = std::size_t{crowd.result_row_count} * SWIVEL_LANES;
        if (reads_results())
            std::memcpy(results + count * result_floats, crowd.results + block * result_floats,
                        result_floats * sizeof(float));
        prefetch(std::size_t{block} * SWIVEL_LANES);
        blocks[count] = block;
        chosen[count++] = lanes;
        if (count == block_limit) flush();
    }
    void flush()
    {
        if (count == 0) return;
        solve(count);
        const std::uint32_t rows = crowd.result_row_count;
        const std::size_t size = std::size_t{rows} * SWIVEL_LANES;
        for (std::uint32_t n = 0; n < count; ++n) {
            if (crowd.words)
                merge_lanes<std::uint16_t>(chosen[n], rows, words + n * size, crowd.words + blocks[n] * size);
            else
                merge_lanes<std::uint32_t>(chosen[n], rows, results + n * size, crowd.results + blocks[n] * size);
        }
        count = 0;
    }
};

// Single limbs, gathered into blocks of their own.
struct Limbs : Aside {
    std::uint32_t count = 0;
    std::size_t limbs[kAsideLimbs];

    using Aside::Aside;

    void put(std::size_t limb, std::uint32_t at)
    {
        const std::uint32_t rows = crowd.input_row_count;
        copy_lane(rows, crowd.input + row_offset(limb, rows, 0), input + row_offset(at, rows, 0));
        if (!reads_results()) return;
        const std::uint32_t result_rows = crowd.result_row_count;
        copy_lane(result_rows, crowd.results + row_offset(limb, result_rows, 0),
                  results + row_offset(at, result_rows, 0));
    }
    void add(std::uint32_t block, LaneMask lanes)
    {
        prefetch(std::size_t{block} * SWIVEL_LANES);
        for (; lanes; lanes &= lanes - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
            limbs[count] = std::size_t{block} * SWIVEL_LANES + lane;
            put(limbs[count], count);
            if (++count == block_limit * SWIVEL_LANES) flush();
        }
    }
    void flush()
    {
        if (count == 0) return;
        const std::uint32_t block_count = (count - 1) / SWIVEL_LANES + 1, rows = crowd.result_row_count;
        // The last block's free lanes take a limb that is there, and so take no longer than it does.
        for (std::uint32_t at = count; at < block_count * SWIVEL_LANES; ++at) put(limbs[0], at);
        solve(block_count);
        for (std::uint32_t n = 0; n < count; ++n) {
            const std::size_t from = row_offset(n, rows, 0), to = row_offset(limbs[n], rows, 0);
            if (crowd.words)
                copy_lane(rows, words + from, crowd.words + to);
            else
                copy_lane(rows, results + from, crowd.results + to);
        }
        count = 0;
    }
};

}  // namespace

void solve_chosen_group(const swivel_crowd& crowd, const Kernels& kernels, const Group& group,
                        const std::uint32_t* mask, std::uint32_t first_block, std::uint32_t block_count)
{
    Blocks blocks(crowd, kernels, group);
    Limbs limbs(crowd, kernels, group);
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
        std::uint32_t whole = 0;
        while (block + whole < end && is_whole(block + whole)) ++whole;
        if (whole >= kRunBlocks) {
            solve_group(crowd, kernels, group, block, whole);
            block += whole;
            continue;
        }
        // This takes one block at a time. It looks at the next blocks again, at most kRunBlocks times.
        const LaneMask chosen = lanes_of(mask, block) & lanes_of_limbs(group, block);
        if (std::popcount(chosen) > kFewLimbs)
            blocks.add(block, chosen);
        else
            limbs.add(block, chosen);
        ++block;
    }
    blocks.flush();
    limbs.flush();
}

}  // namespace swivel

// SPDX-License-Identifier: MIT
//
// Any bits in the rows give the same bits on every instruction set that runs here: solved whole, block by block, and
// some limbs before the others. Twice in a row, since swivels are carried on.
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "tests/fuzz/crowd_of_bytes.h"
#include "tests/fuzz/require.h"

using namespace swivel::fuzz;

namespace {

constexpr std::uint32_t kMostLimbs = 24;

struct Destroy {
    void operator()(swivel_crowd* crowd) const { swivel_crowd_destroy(crowd); }
};
using Crowd = std::unique_ptr<swivel_crowd, Destroy>;

// Everything but numbers that an input says, to make the same crowd several times.
using Shape = std::vector<swivel_group_def>;

Crowd make(const Shape& shape)
{
    swivel_crowd_def def = swivel_default_crowd_def();
    def.groups = shape.data();
    def.group_count = static_cast<std::uint32_t>(shape.size());
    swivel_crowd* crowd = nullptr;
    SWIVEL_REQUIRE(swivel_crowd_create(&def, &crowd) == SWIVEL_OK);
    return Crowd(crowd);
}

using Inputs = std::vector<std::vector<float>>;  // of each group
Inputs inputs_of(swivel_crowd& crowd)
{
    Inputs inputs;
    for (std::uint32_t group = 0; group < swivel_group_count(&crowd); ++group) {
        const swivel_rows rows = swivel_input_rows(&crowd, group);
        inputs.emplace_back(rows.base, rows.base + std::size_t{rows.block_count} * rows.row_count * SWIVEL_LANES);
    }
    return inputs;
}
void put_inputs(swivel_crowd& crowd, const Inputs& inputs)
{
    for (std::uint32_t group = 0; group < inputs.size(); ++group)
        std::memcpy(swivel_input_rows(&crowd, group).base, inputs[group].data(), inputs[group].size() * sizeof(float));
}

// All results of all limbs, without padding.
std::vector<std::uint32_t> results_of(swivel_crowd& crowd, const Shape& shape)
{
    std::vector<std::uint32_t> words;
    for (int f = SWIVEL_SHOULDER; f < SWIVEL_RESULT_END; ++f) {
        const auto field = static_cast<swivel_field>(f);
        for (std::uint32_t group = 0; group < shape.size(); ++group) {
            if (swivel_field_row_count(&crowd, group, field) == 0) continue;
            const std::uint32_t count = shape[group].limb_count;
            constexpr std::size_t kMostComponents = 28;  // of seven twist bones
            const std::size_t at = words.size();
            words.resize(at + kMostComponents * count);
            SWIVEL_REQUIRE(swivel_read(&crowd, field, group, 0, count,
                                       {words.data() + at, kMostComponents * sizeof(std::uint32_t)}) == SWIVEL_OK);
        }
    }
    return words;
}

using Solve = void (*)(swivel_crowd& crowd);

void solve_whole(swivel_crowd& crowd) { SWIVEL_REQUIRE(swivel_solve(&crowd, nullptr) == SWIVEL_OK); }
void solve_blocks(swivel_crowd& crowd)
{
    swivel_job job = swivel_default_job();
    swivel_blocks one{swivel_block_count(&crowd), 1};
    job.blocks = &one;
    job.on_this_thread = 1;
    while (one.first-- > 0) SWIVEL_REQUIRE(swivel_solve(&crowd, &job) == SWIVEL_OK);
}
void solve_some_then_others(swivel_crowd& crowd)
{
    std::vector<std::uint32_t> words((swivel_block_count(&crowd) + 1) / 2, 0xa5c31f02u);
    swivel_job job = swivel_default_job();
    job.mask = words.data();
    job.mask_word_count = static_cast<std::uint32_t>(words.size());
    SWIVEL_REQUIRE(swivel_solve(&crowd, &job) == SWIVEL_OK);
    for (std::uint32_t& word : words) word = ~word;
    SWIVEL_REQUIRE(swivel_solve(&crowd, &job) == SWIVEL_OK);
}

// The results after each set of inputs, one after the other.
std::vector<std::vector<std::uint32_t>> solve_all(const Shape& shape, const std::vector<Inputs>& inputs, Solve solve)
{
    const Crowd crowd = make(shape);
    std::vector<std::vector<std::uint32_t>> results;
    for (const Inputs& each : inputs) {
        put_inputs(*crowd, each);
        solve(*crowd);
        results.push_back(results_of(*crowd, shape));
    }
    return results;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Bytes bytes(data, size);
    const Shape shape = groups_of(bytes, kMostLimbs);
    const bool solves_parts = bytes.one_in(8);  // on all, not on the best alone
    std::vector<Inputs> inputs;
    const Crowd crowd = make(shape);
    for (int frame = 0; frame < 2; ++frame) {
        fill_inputs(bytes, *crowd);
        inputs.push_back(inputs_of(*crowd));
    }
    SWIVEL_REQUIRE(swivel_use_isa("scalar") == SWIVEL_OK);
    const auto expected = solve_all(shape, inputs, solve_whole);
    for (std::uint32_t n = 0; const char* isa = swivel_isa_at(n); ++n) {
        if (!swivel_isa_runs(isa)) continue;
        SWIVEL_REQUIRE(swivel_use_isa(isa) == SWIVEL_OK);
        SWIVEL_REQUIRE(solve_all(shape, inputs, solve_whole) == expected);
        if (!solves_parts && n != 0) continue;  // these two take as long again
        SWIVEL_REQUIRE(solve_all(shape, inputs, solve_blocks) == expected);
        SWIVEL_REQUIRE(solve_all(shape, inputs, solve_some_then_others) == expected);
    }
    return 0;
}

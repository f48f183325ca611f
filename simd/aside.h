// SPDX-License-Identifier: MIT
//
// Limbs of a run that are gathered from their blocks into one block, solved together there, and written back. A step
// takes as long as its slowest lane, so slow limbs are solved in steps of their own.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/isa.h"
#include "simd/kernels.h"
#include "simd/rows.h"

namespace swivel::inline SWIVEL_ISA {

// A run's blocks from `block` on.
inline SolveRun blocks_of(SolveRun run, std::uint32_t block, std::uint32_t block_count)
{
    const std::size_t limb = std::size_t{block} * kLanes;
    run.input += row_offset(limb, run.input_row_count, 0);
    run.results += row_offset(limb, run.result_row_count, 0);
    run.limb_count = std::size_t{block_count} * kLanes;
    return run;
}

struct LimbsAside {
    alignas(64) float input[input_row_count(kEveryFeature) * kLanes];
    alignas(64) float results[result_row_count(kEveryFeature) * kLanes];
    std::size_t limb[kLanes];  // where each lane belongs in the run
    std::size_t count = 0;

    void take(const SolveRun& run, std::size_t from)
    {
        copy_lane(run.input_row_count, run.input + row_offset(from, run.input_row_count, 0), input + count);
        if (run.features & feature::most_swivel)  // what is carried from solve to solve is read from the results
            copy_lane(run.result_row_count, run.results + row_offset(from, run.result_row_count, 0), results + count);
        limb[count++] = from;
    }
    // The gathered limbs as a run. Lanes that none is put into get the first limb, and so hold numbers.
    SolveRun block_of(SolveRun run)
    {
        for (std::size_t lane = count; lane < kLanes; ++lane) {
            copy_lane(run.input_row_count, input, input + lane);
            if (run.features & feature::most_swivel) copy_lane(run.result_row_count, results, results + lane);
        }
        run.input = input;
        run.results = results;
        run.limb_count = count;
        return run;
    }
    void give_back(const SolveRun& run)
    {
        for (std::size_t n = 0; n < count; ++n)
            copy_lane(run.result_row_count, results + n, run.results + row_offset(limb[n], run.result_row_count, 0));
        count = 0;
    }
};

}  // namespace swivel::inline SWIVEL_ISA

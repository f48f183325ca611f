// SPDX-License-Identifier: MIT
//
// Limbs of a run that are gathered from their blocks into one block, solved together there, and written back. A slice
// takes as long as its slowest lane, so slow limbs are solved in slices of their own. They only wait while a kernel
// runs, because the frames of two kernels would take too much of a small stack.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/isa.h"
#include "simd/kernels.h"
#include "simd/rows.h"

namespace swivel::inline SWIVEL_ISA {

// A run of one of a run's blocks.
inline SolveRun block_of(SolveRun run, std::uint32_t block)
{
    const std::size_t limb = std::size_t{block} * kLanes;
    run.input += row_offset(limb, run.input_row_count, 0);
    run.results += row_offset(limb, run.result_row_count, 0);
    run.limb_count = kLanes;
    run.first_lane += limb;
    run.first_padding -= limb;
    return run;
}

// The limbs of a run that wait to be solved in a block of their own. A list is full with a block of them, and can hold
// those of one slice more, which are two blocks at most.
struct WaitingLimbs {
    std::uint32_t limb[3 * kLanes];  // where each belongs in the run
    std::uint32_t count = 0;

    bool is_full() const { return count >= kLanes; }
    bool starts_with_block() const  // in the order in which they lie
    {
        return is_full() && limb[0] % kLanes == 0 && limb[kLanes - 1] == limb[0] + kLanes - 1;
    }
    void add(std::size_t first, std::uint32_t lanes)
    {
        for (; lanes != 0; lanes &= lanes - 1)
            limb[count++] = static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(std::countr_zero(lanes));
    }
    std::uint32_t first_count() const { return is_full() ? kLanes : count; }
    // Takes the first limbs out, as many as a block has.
    void drop_first()
    {
        const std::uint32_t gone = first_count();
        std::copy(limb + gone, limb + count, limb);
        count -= gone;
    }
};

// The rows of a block of limbs that have these features.
template <swivel_features Features>
struct BlockAside {
    alignas(64) float input[input_row_count(Features) * kLanes];
    alignas(64) float results[result_row_count(Features) * kLanes];

    // Gathers a list's first limbs, up to a block, as a run. Lanes that none is put into get the first limb, and so
    // hold numbers.
    SolveRun gather(const SolveRun& run, const WaitingLimbs& list)
    {
        const std::uint32_t rows = run.input_row_count, result_rows = run.result_row_count;
        const std::uint32_t count = list.first_count();
        for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
            const std::size_t from = list.limb[lane < count ? lane : 0];
            copy_lane(rows, run.input + row_offset(from, rows, 0), input + lane);
            // Bad input keeps values of the results.
            if (run.keeps_pose) copy_lane(result_rows, run.results + row_offset(from, result_rows, 0), results + lane);
        }
        SolveRun aside = run;
        aside.input = input;
        aside.results = results;
        aside.limb_count = aside.first_padding = count;
        aside.mask = nullptr;
        return aside;
    }
    void give_back(const SolveRun& run, const WaitingLimbs& list) const
    {
        for (std::uint32_t n = 0; n < list.first_count(); ++n)
            copy_lane(run.result_row_count, results + n,
                      run.results + row_offset(list.limb[n], run.result_row_count, 0));
    }
};

}  // namespace swivel::inline SWIVEL_ISA

// SPDX-License-Identifier: MIT
//
// swivel_solve() with one thing of a job at a time, for checks of statuses.
#pragma once

#include <cstdint>

#include "swivel/swivel.h"

namespace swivel::test {

inline swivel_status solve_frame_blocks(swivel_crowd* crowd, const swivel_frame* frames, std::uint32_t first,
                                        std::uint32_t count)
{
    const swivel_blocks blocks{first, count};
    swivel_job job = swivel_default_job();
    job.blocks = &blocks;
    job.frames = frames;
    job.on_this_thread = 1;
    return swivel_solve(crowd, &job);
}
inline swivel_status solve_blocks(swivel_crowd* crowd, std::uint32_t first, std::uint32_t count)
{
    return solve_frame_blocks(crowd, nullptr, first, count);
}
inline swivel_status solve_frame(swivel_crowd* crowd, const swivel_frame* frames)
{
    swivel_job job = swivel_default_job();
    job.frames = frames;
    return swivel_solve(crowd, &job);
}
inline swivel_status solve_budget(swivel_crowd* crowd, const swivel_in* priorities, std::uint32_t most_blocks,
                                  std::uint32_t* solved_count)
{
    swivel_job job = swivel_default_job();
    job.priorities = priorities;
    job.most_blocks = most_blocks;
    job.solved_count = solved_count;
    return swivel_solve(crowd, &job);
}

}  // namespace swivel::test

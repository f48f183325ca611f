// SPDX-License-Identifier: MIT
//
// Which part of a cache a process fills, by hand or from the environment that a scheduler sets.
#pragma once

#include <cstdint>
#include <string>

namespace swivel::tools {

struct Shard {
    std::uint32_t index = 0, count = 1;  // index < count
    std::string source;                  // where it was read from: "--shard", or variables with their values

    std::string words() const;  // "2/8", counted from 1 as on the command line
};

// text: "i/n" with 1 <= i <= n, or "auto". Auto reads the first of these that is set: an array job of Slurm
// (SLURM_ARRAY_TASK_ID), Open MPI (OMPI_COMM_WORLD_RANK), other MPIs (PMI_RANK), tasks of Slurm's srun (SLURM_PROCID).
// An array must number its tasks evenly, in steps of any size. In each task of an array, srun's tasks are not told
// apart. Throws std::invalid_argument with what is wrong and what to do.
Shard shard_of(const std::string& text);

}  // namespace swivel::tools

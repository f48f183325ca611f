// SPDX-License-Identifier: MIT
#include "tools/cache/shard.h"

#include <fmt/format.h>

#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::tools {

namespace {

// The variables of one scheduler. Arrays number their tasks from least to most, in steps; null: from 0 on.
struct Scheduler {
    const char *index, *count;
    const char *least = nullptr, *most = nullptr, *step = nullptr;
};
// The script of a batch job has SLURM_PROCID, too, and is alone; srun alone sets the tasks of a step.
constexpr Scheduler kSchedulers[] = {{"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_MIN",
                                      "SLURM_ARRAY_TASK_MAX", "SLURM_ARRAY_TASK_STEP"},
                                     {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                     {"PMI_RANK", "PMI_SIZE"},
                                     {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}};

// source: gets the variable and its value.
std::uint32_t number_of(const char* name, std::string& source)
{
    const char* const text = std::getenv(name);
    if (!text)
        throw std::invalid_argument(
            fmt::format("{} and no {}: start it by srun or mpirun, or give --shard i/n", source, name));
    const std::optional<std::int64_t> number = formats::parse_integer(text);
    if (!number || *number < 0 || *number > UINT32_MAX)
        throw std::invalid_argument(
            fmt::format("{} is {}, not a whole number; give --shard i/n", name, formats::printable(text)));
    source += fmt::format("{}{}={}", source.empty() ? "" : " ", name, *number);
    return static_cast<std::uint32_t>(*number);
}

Shard shard_of(const Scheduler& scheduler)
{
    Shard shard;
    shard.index = number_of(scheduler.index, shard.source);
    shard.count = number_of(scheduler.count, shard.source);
    const auto refuse = [&](const char* why) {
        throw std::invalid_argument(fmt::format("{}: {}; give --shard i/n", shard.source, why));
    };
    if (scheduler.least) {
        const std::uint64_t least = number_of(scheduler.least, shard.source);
        const std::uint64_t most = number_of(scheduler.most, shard.source);
        const std::uint64_t step = number_of(scheduler.step, shard.source);
        if (shard.count == 0 || step == 0 || least + step * (shard.count - 1) != most)
            refuse("the array's tasks have gaps; number them evenly, such as --array=0-7");
        if (shard.index < least || (shard.index - least) % step != 0) refuse("the index is not among that many");
        shard.index = static_cast<std::uint32_t>((shard.index - least) / step);
    }
    if (shard.index >= shard.count) refuse("the index is not among that many");
    return shard;
}

}  // namespace

std::string Shard::words() const { return fmt::format("{}/{}", index + 1, count); }

Shard shard_of(const std::string& text)
{
    if (text == "auto") {
        for (const Scheduler& scheduler : kSchedulers)
            if (std::getenv(scheduler.index)) return shard_of(scheduler);
        throw std::invalid_argument("no variables of Slurm or MPI are set; start it by srun or mpirun, or give i/n");
    }
    const std::size_t slash = text.find('/');
    const auto index = formats::parse_integer(text.substr(0, slash));
    const auto count = formats::parse_integer(slash == std::string::npos ? "" : text.substr(slash + 1));
    if (!index || !count || *index < 1 || *index > *count || *count > UINT32_MAX)
        throw std::invalid_argument("write i/n with i from 1 to n, such as 1/4, or auto");
    return {static_cast<std::uint32_t>(*index - 1), static_cast<std::uint32_t>(*count), "--shard"};
}

}  // namespace swivel::tools

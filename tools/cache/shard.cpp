// SPDX-License-Identifier: MIT
#include "tools/cache/shard.h"

#include <fmt/format.h>

#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "tools/formats/text.h"

namespace swivel::tools {

namespace {

// The variables of one scheduler. least: of the first index; null: 0.
struct Scheduler {
    const char *index, *count, *least;
};
constexpr Scheduler kSchedulers[] = {{"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_MIN"},
                                     {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", nullptr},
                                     {"PMI_RANK", "PMI_SIZE", nullptr},
                                     {"SLURM_PROCID", "SLURM_NTASKS", nullptr}};

std::uint32_t number_of(const char* name)
{
    const char* const text = std::getenv(name);
    const std::optional<std::int64_t> number = text ? formats::parse_integer(text) : std::nullopt;
    if (!number || *number < 0 || *number > UINT32_MAX)
        throw std::invalid_argument(fmt::format("{} is {}, not a whole number; give --shard i/n", name,
                                                text ? formats::printable(text) : "not set"));
    return static_cast<std::uint32_t>(*number);
}

Shard shard_of(const Scheduler& scheduler)
{
    Shard shard;
    const std::uint32_t index = number_of(scheduler.index), least = scheduler.least ? number_of(scheduler.least) : 0;
    shard.count = number_of(scheduler.count);
    shard.source = fmt::format("{}={} {}={}", scheduler.index, index, scheduler.count, shard.count);
    if (scheduler.least) shard.source += fmt::format(" {}={}", scheduler.least, least);
    if (index < least || index - least >= shard.count)
        throw std::invalid_argument(
            fmt::format("{}: the index is not among that many; give --shard i/n", shard.source));
    shard.index = index - least;
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

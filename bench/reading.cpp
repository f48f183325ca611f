// SPDX-License-Identifier: MIT
//
// Results read right after the solve, as callers read them. In each level of memory:
// - read/: problem P, then a reader that copies the result rows.
// - read_fields/: P, then swivel_read() of rotations, flexions and flags, into arrays of the caller.
// - read_resident/: a resident crowd, then the same reader.
#include "bench/rivals/probe.h"
#include "bench/suite.h"

namespace bench {

namespace {

struct Fields {
    std::vector<float> shoulders, elbows;
    std::vector<std::uint32_t> flags;

    explicit Fields(std::size_t count) : shoulders(4 * count), elbows(2 * count), flags(count) {}
    void read(const swivel::Crowd& crowd)
    {
        const auto count = static_cast<std::uint32_t>(flags.size());
        const auto get = [&](swivel_field field, void* to, std::size_t stride) {
            swivel::check(swivel_read(crowd.get(), field, 0, 0, count, {to, stride}));
        };
        get(SWIVEL_SHOULDER, shoulders.data(), 4 * sizeof(float));
        get(SWIVEL_ELBOW, elbows.data(), 2 * sizeof(float));
        get(SWIVEL_FLAGS, flags.data(), sizeof(std::uint32_t));
    }
};

void solve(swivel::Crowd& crowd)
{
    crowd.solve({.blocks = swivel_blocks{0, swivel_block_count(crowd.get())}, .on_this_thread = true});
}

Work reader(const swivel::Crowd& crowd, const Probe& probe)
{
    const swivel_rows rows = swivel_result_rows(crowd.get(), 0);
    return [&probe, rows] { probe.read_rows(rows.base, rows.row_count, rows.block_count); };
}

// In a level of memory; make(crowd) gives what is timed.
template <class Make>
void add_row(Suite& suite, const std::string& family, const std::string& isa, std::size_t level,
             swivel_features features, Make make)
{
    const std::size_t arm_count = arms_within(level, features);
    add(family + "/" + isa + "/" + kMemoryLevels[level], arm_count, Clock::cpu,
        [&suite, isa, features, arm_count, make]() -> Work {
            swivel::check(swivel_use_isa(isa.c_str()));
            return make(suite.crowds.get(features, arm_count));
        });
}

void add_level(Suite& suite, const std::string& isa, std::size_t level)
{
    const Probe& probe = probe_of(isa.c_str());
    const auto solve_and_read = [&probe](swivel::Crowd& crowd) -> Work {
        return [&crowd, read = reader(crowd, probe)] { solve(crowd), read(); };
    };
    add_row(suite, "read", isa, level, 0, solve_and_read);
    if (isa != suite.best_isa()) return;
    add_row(suite, "read_resident", isa, level, kResident, solve_and_read);
    add_row(suite, "read_fields", isa, level, 0, [](swivel::Crowd& crowd) -> Work {
        const auto fields = std::make_shared<Fields>(swivel_group_limb_count(crowd.get(), 0));
        return [&crowd, fields] { solve(crowd), fields->read(crowd); };
    });
}

}  // namespace

void add_reading(Suite& suite)
{
    for (const std::string& isa : suite.isas)
        if (isa != "scalar" || suite.isas.size() == 1)
            for (std::size_t level = 0; level < kMemoryLevels.size(); ++level) add_level(suite, isa, level);
}

}  // namespace bench

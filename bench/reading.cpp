// SPDX-License-Identifier: MIT
//
// Problem P with its results read right after the solve. A solve that writes past the caches looks fast until someone
// reads what it wrote. So each level of memory has three rows:
// - read/: swivel, then a reader that copies the result rows.
// - read_hand/: the kernel by hand, which writes by ordinary stores, then the same reader.
// - read_fields/: swivel, then swivel_read() of rotations, flexions and flags, into arrays of the caller.
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

// make(crowd): what is timed.
template <class Make>
void add_row(Suite& suite, const std::string& name, const std::string& isa, std::size_t arm_count, Make make)
{
    add(name, arm_count, Clock::cpu, [&suite, isa, arm_count, make]() -> Work {
        swivel::check(swivel_use_isa(isa.c_str()));
        return make(suite.crowds.get(0, arm_count));
    });
}

void add_level(Suite& suite, const std::string& isa, std::size_t level)
{
    const Probe& probe = probe_of(isa.c_str());
    const std::string place = "/" + isa + "/" + kMemoryLevels[level];
    const std::size_t arm_count = arms_within(level, 0);
    add_row(suite, "read" + place, isa, arm_count, [&probe](swivel::Crowd& crowd) -> Work {
        const swivel_rows out = swivel_result_rows(crowd.get());
        return [&crowd, &probe, out] {
            crowd.solve({.blocks = swivel_blocks{0, out.block_count}, .on_this_thread = true});
            probe.read_rows(out.base, out.row_count, out.block_count);
        };
    });
    add_row(suite, "read_hand" + place, isa, arm_count, [&probe](swivel::Crowd& crowd) -> Work {
        const swivel_rows in = swivel_input_rows(crowd.get()), out = swivel_result_rows(crowd.get());
        return [&probe, in, out] {
            probe.solve_by_stages(in.base, out.base, in.block_count);
            probe.read_rows(out.base, out.row_count, out.block_count);
        };
    });
    if (isa != suite.best_isa()) return;
    add_row(suite, "read_fields" + place, isa, arm_count, [arm_count](swivel::Crowd& crowd) -> Work {
        const auto fields = std::make_shared<Fields>(arm_count);
        return [&crowd, fields] {
            crowd.solve({.blocks = swivel_blocks{0, swivel_block_count(crowd.get())}, .on_this_thread = true});
            fields->read(crowd);
        };
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

// SPDX-License-Identifier: MIT
//
// A crowd and the engine's structures that it reads and writes, one frame a group: in three steps (inputs into rows,
// solve, results out of rows) or in one. All of it runs on this thread.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "swivel/swivel.hpp"

namespace bench {

class FramedCrowd {
public:
    FramedCrowd(swivel::Crowd crowd, std::vector<swivel::Streams> views)
        : crowd_(std::move(crowd)),
          views_(std::move(views)),
          in_one_{.blocks = all_blocks(), .streams = {views_.begin(), views_.end()}, .on_this_thread = true}
    {
    }

    swivel::Crowd& crowd() { return crowd_; }
    const std::vector<swivel_streams>& frames() const { return in_one_.streams; }

    void write()
    {
        for_each_field([&](std::uint32_t group, std::uint32_t count, const swivel_stream& f) {
            if (f.field < SWIVEL_INPUT_END)
                swivel::check(swivel_write(crowd_.get(), f.field, group, 0, count, {f.data, f.stride}));
        });
    }
    void solve() { crowd_.solve({.blocks = all_blocks(), .on_this_thread = true}); }
    void read()
    {
        for_each_field([&](std::uint32_t group, std::uint32_t count, const swivel_stream& f) {
            if (f.field > SWIVEL_INPUT_END)
                swivel::check(swivel_read(crowd_.get(), f.field, group, 0, count, {f.data, f.stride}));
        });
    }
    void solve_in_one() { crowd_.solve(in_one_); }

private:
    swivel_blocks all_blocks() const { return {0, swivel_block_count(crowd_.get())}; }
    template <class Take>
    void for_each_field(const Take& take) const
    {
        for (std::uint32_t group = 0; group < frames().size(); ++group)
            for (std::uint32_t n = 0; n < frames()[group].field_count && frames()[group].fields[n].data; ++n)
                take(group, swivel_group_limb_count(crowd_.get(), group), frames()[group].fields[n]);
    }

    swivel::Crowd crowd_;
    std::vector<swivel::Streams> views_;  // what in_one_ views
    swivel::Job in_one_;
};

}  // namespace bench

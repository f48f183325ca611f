// SPDX-License-Identifier: MIT
//
// The workspace of one call of swivel_solve(): the job's own, or one of the crowd's that no other call is using.
#pragma once

#include <bit>

#include "batch/crowd/crowd.h"
#include "batch/refusal/status.h"

namespace swivel {

class Workspace {
public:
    Workspace(swivel_crowd& crowd, void* of_job)
        : status(SWIVEL_OK), strip(strip_memory(crowd, static_cast<float*>(of_job))), crowd_(crowd)
    {
        if (reinterpret_cast<std::uintptr_t>(of_job) % kArenaAlignment != 0)
            status = refuse("job.workspace is not aligned to %zu", kArenaAlignment);
        else if (!of_job && crowd.strip_blocks > 0)
            take_one();
    }
    ~Workspace()
    {
        if (taken_ != 0) crowd_.busy &= ~taken_;
    }
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;

    swivel_status status;
    StripMemory strip;

private:
    void take_one()
    {
        std::uint64_t busy = crowd_.busy;
        for (;;) {
            const auto free = static_cast<std::uint32_t>(std::countr_one(busy));
            if (free >= crowd_.workspace_count) break;
            const std::uint64_t bit = std::uint64_t{1} << free;
            if (!crowd_.busy.compare_exchange_weak(busy, busy | bit)) continue;
            taken_ = bit;
            const std::size_t floats = workspace_floats(crowd_.strip_blocks, crowd_.body_row_count);
            strip = strip_memory(crowd_, crowd_.workspaces + free * floats);
            return;
        }
        const std::uint32_t count = crowd_.workspace_count;
        status =
            count == 0
                ? refuse("this crowd has no workspace; create it with some (workspace_count), or give job.workspace")
                : refuse(
                      "other calls use all workspaces of this crowd, %u; create it with more (workspace_count), or "
                      "give job.workspace",
                      count);
    }

    swivel_crowd& crowd_;
    std::uint64_t taken_ = 0;  // its bit among the crowd's
};

}  // namespace swivel

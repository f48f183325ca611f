// SPDX-License-Identifier: MIT
//
// Finds crowds that are used wrongly, in builds with SWIVEL_CHECK_USE: destroyed ones, and those that two threads use
// against the rules of swivel.h. In other builds it costs nothing and finds nothing.
#pragma once

#include "batch/api/check.h"
#include "batch/refusal/status.h"

namespace swivel {

#ifdef SWIVEL_CHECK_USE
inline constexpr bool kChecksUse = true;
#else
inline constexpr bool kChecksUse = false;
#endif

// Calls that may run beside others of their kind, and calls that may not.
enum class Sharing { shared, alone };

// One call's use of a crowd. status: whether the call may go on.
class Use {
public:
    Use(const swivel_crowd* crowd, Sharing sharing) : crowd_(crowd), weight_(sharing == Sharing::alone ? kAlone : 1)
    {
        status = crowd ? enter() : refuse("crowd is null");
    }
    ~Use()
    {
        if (kChecksUse && status == SWIVEL_OK) crowd_->users -= weight_;
    }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

    // Whether it may go on with these limbs of a group.
    swivel_status for_limbs(std::uint32_t group, std::uint32_t first, std::uint32_t limb_count) const
    {
        return status == SWIVEL_OK ? check(*crowd_, group, first, limb_count) : status;
    }

    swivel_status status;

private:
    static constexpr std::int32_t kAlone = 1 << 20;

    swivel_status enter() const
    {
        if constexpr (!kChecksUse) return SWIVEL_OK;
        if (crowd_->alive != swivel_crowd::kAlive) return refuse("this crowd is destroyed, or is none");
        const std::int32_t others = crowd_->users.fetch_add(weight_);
        if (others == 0 || (weight_ == 1 && others < kAlone)) return SWIVEL_OK;
        crowd_->users -= weight_;
        return refuse("another thread uses this crowd; use it on one thread at a time, but for jobs on_this_thread");
    }

    const swivel_crowd* crowd_;
    std::int32_t weight_;
};

}  // namespace swivel

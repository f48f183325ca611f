// SPDX-License-Identifier: MIT
#include "tools/crowd/parallel.h"

#include <utility>

#ifdef SWIVEL_WITH_TBB
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#endif

namespace swivel::tools {

namespace {

thread_local unsigned thread_limit = 0;  // what the ThreadLimit on this thread allows; 0: all that the machine has

}  // namespace

#ifdef SWIVEL_WITH_TBB
using Control = oneapi::tbb::global_control;

struct ThreadControl {
    Control control;
};

unsigned thread_count()
{
    if (thread_limit == 1) return 1;
    const auto max = static_cast<unsigned>(Control::active_value(Control::max_allowed_parallelism));
    const auto has = static_cast<unsigned>(oneapi::tbb::info::default_concurrency());
    return max < has ? max : has;
}

void for_ranges(std::uint32_t count, void (*call)(const void*, std::uint32_t, std::uint32_t), const void* work)
{
    using Range = oneapi::tbb::blocked_range<std::uint32_t>;
    constexpr std::uint32_t piece = 256;
    const auto on_range = [&](const Range& range) { call(work, range.begin(), range.end()); };
    if (count > piece && !is_one_thread())
        oneapi::tbb::parallel_for(Range(0, count, piece), on_range);
    else if (count > 0)
        call(work, 0, count);
}
#else
struct ThreadControl {};

unsigned thread_count() { return 1; }

void for_ranges(std::uint32_t count, void (*call)(const void*, std::uint32_t, std::uint32_t), const void* work)
{
    if (count > 0) call(work, 0, count);
}
#endif

ThreadLimit::ThreadLimit(unsigned max) : before_(std::exchange(thread_limit, max > 0 ? max : thread_limit))
{
#ifdef SWIVEL_WITH_TBB
    if (max > 1) control_.reset(new ThreadControl{Control(Control::max_allowed_parallelism, max)});
#endif
}

ThreadLimit::~ThreadLimit() { thread_limit = before_; }

}  // namespace swivel::tools

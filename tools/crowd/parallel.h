// SPDX-License-Identifier: MIT
//
// Threads of the command: oneTBB where the library was built with it, otherwise one.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#ifdef SWIVEL_WITH_TBB
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#endif

namespace swivel::tools {

inline thread_local unsigned thread_limit =
    0;  // what the ThreadLimit on this thread allows; 0: all that the machine has

// With a limit of one, this and all that ask it call no function of oneTBB, whose start takes memory and threads.
inline unsigned thread_count()
{
#ifdef SWIVEL_WITH_TBB
    if (thread_limit == 1) return 1;
    using Control = oneapi::tbb::global_control;
    const auto most = static_cast<unsigned>(Control::active_value(Control::max_allowed_parallelism));
    const auto has = static_cast<unsigned>(oneapi::tbb::info::default_concurrency());
    return most < has ? most : has;
#else
    return 1;
#endif
}

inline bool is_one_thread() { return thread_count() == 1; }

// Calls work(begin, end) for pieces of 0 ... count-1, on several threads at once. A single piece takes no oneTBB.
template <class Work>
void for_ranges(std::uint32_t count, Work work)
{
#ifdef SWIVEL_WITH_TBB
    using Range = oneapi::tbb::blocked_range<std::uint32_t>;
    constexpr std::uint32_t piece = 256;
    const auto on_range = [&](const Range& range) { work(range.begin(), range.end()); };
    if (count > piece && !is_one_thread()) return oneapi::tbb::parallel_for(Range(0, count, piece), on_range);
#endif
    if (count > 0) work(std::uint32_t{0}, count);
}

// At most this many threads solve while it lives; 0: as many as before.
class ThreadLimit {
public:
    explicit ThreadLimit(unsigned most) : before_(std::exchange(thread_limit, most > 0 ? most : thread_limit))
    {
#ifdef SWIVEL_WITH_TBB
        if (most > 1) control_.emplace(oneapi::tbb::global_control::max_allowed_parallelism, most);
#endif
    }
    ~ThreadLimit() { thread_limit = before_; }
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    unsigned before_;
#ifdef SWIVEL_WITH_TBB
    std::optional<oneapi::tbb::global_control> control_;
#endif
};

}  // namespace swivel::tools

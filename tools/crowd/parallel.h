// SPDX-License-Identifier: MIT
//
// Threads of the command: oneTBB where the library was built with it, otherwise one.
#pragma once

#include <cstdint>
#include <memory>

namespace swivel::tools {

// With a limit of one, neither this nor its callers call oneTBB, whose start takes memory and threads.
unsigned thread_count();

inline bool is_one_thread() { return thread_count() == 1; }

// Calls work(begin, end) for pieces of 0 ... count-1, on several threads at once. A single piece takes no oneTBB, and
// no memory.
void for_ranges(std::uint32_t count, void (*call)(const void* work, std::uint32_t begin, std::uint32_t end),
                const void* work);
template <class Work>
void for_ranges(std::uint32_t count, const Work& work)
{
    const auto call = [](const void* any, std::uint32_t begin, std::uint32_t end) {
        (*static_cast<const Work*>(any))(begin, end);
    };
    for_ranges(count, call, &work);
}

struct ThreadControl;  // oneTBB's

// While it lives, at most this many threads solve; 0: as many as before.
class ThreadLimit {
public:
    explicit ThreadLimit(unsigned max);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    unsigned before_;
    std::unique_ptr<ThreadControl> control_;
};

}  // namespace swivel::tools

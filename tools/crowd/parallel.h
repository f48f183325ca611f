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

// A function of a range, such as a lambda, which must outlive this. It takes no memory.
class RangeWork {
public:
    template <class Work>
    RangeWork(const Work& work)
        : work_(&work), call_([](const void* closure, std::uint32_t begin, std::uint32_t end) {
              (*static_cast<const Work*>(closure))(begin, end);
          })
    {
    }
    void operator()(std::uint32_t begin, std::uint32_t end) const { call_(work_, begin, end); }

private:
    const void* work_;
    void (*call_)(const void*, std::uint32_t, std::uint32_t);
};

// Calls work(begin, end) for pieces of 0 ... count-1, on several threads at once. A single piece takes no oneTBB.
void for_ranges(std::uint32_t count, RangeWork work);

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

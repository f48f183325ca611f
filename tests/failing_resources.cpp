// SPDX-License-Identifier: MIT
//
// Replaces mmap, pthread_create and dlopen in the program it is linked into, and lets allocations fail
// (allocation_count.h).
#include "tests/failing_resources.h"

#include <dlfcn.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "tests/allocation_count.h"

namespace {

using swivel::test::Resource;

Resource wanted;
std::uint32_t first, request_count;
bool is_lasting;
thread_local bool is_armed = false;   // for memory
std::atomic<bool> is_limited{false};  // for threads
std::atomic<std::uint32_t> thread_count, failure_count;
std::atomic<const volatile float*> watched{nullptr};
float watched_before;
thread_local bool is_watcher = false;
std::atomic<bool> is_hidden{false};  // oneTBB's own memory

bool fails_elsewhere(Resource resource)
{
    const volatile float* const word = watched;
    if (!word || is_watcher || resource != Resource::allocation) return false;
    for (int n = 0; n < 100000 && std::memcmp(&watched_before, const_cast<const float*>(word), sizeof(float)) == 0; ++n)
        sched_yield();
    if (!watched.exchange(nullptr)) return false;
    ++failure_count;
    errno = ENOMEM;
    return true;
}
bool fails(Resource resource)
{
    if (fails_elsewhere(resource)) return true;
    if (!is_armed || resource != wanted) return false;
    const std::uint32_t n = ++request_count;
    if (n < first || (n > first && !is_lasting)) return false;
    ++failure_count;
    errno = ENOMEM;
    return true;
}

// A thread that is counted while it runs.
struct Counted {
    void* (*run)(void*);
    void* argument;
};
void* run_counted(void* data)
{
    const Counted thread = *static_cast<Counted*>(data);
    std::free(data);
    void* const result = thread.run(thread.argument);
    --thread_count;
    return result;
}

template <class Function>
Function* next(const char* name)
{
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

namespace swivel::test {

void let_fail(Resource resource, std::uint32_t nth, bool later_too, const volatile float* word)
{
    wanted = resource;
    first = nth;
    is_lasting = later_too;
    request_count = thread_count = failure_count = 0;
    allocation_fails = [] { return fails(Resource::allocation); };
    is_limited = resource == Resource::thread;
    is_watcher = resource == Resource::allocation_elsewhere;
    is_armed = !is_limited && !is_watcher;
    if (!is_watcher) return;
    watched_before = *word;
    watched = word;
}
void hide_own_memory() { is_hidden = true; }
std::uint32_t stop_failing()
{
    watched = nullptr;
    is_armed = is_limited = false;
    return failure_count;
}

}  // namespace swivel::test

// Visible, so that libraries take these, too.
#pragma GCC visibility push(default)
extern "C" {
void* mmap(void* address, std::size_t bytes, int protection, int flags, int file, off_t offset) noexcept
{
    static auto* const real = next<decltype(mmap)>("mmap");
    return fails(Resource::mapping) ? MAP_FAILED : real(address, bytes, protection, flags, file, offset);
}
int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*), void* argument) noexcept
{
    static auto* const real = next<decltype(pthread_create)>("pthread_create");
    if (!is_limited) return real(thread, attributes, run, argument);
    if (++thread_count >= first) {
        --thread_count;
        ++failure_count;
        return EAGAIN;
    }
    void* const data = std::malloc(sizeof(Counted));
    std::memcpy(data, &static_cast<const Counted&>(Counted{run, argument}), sizeof(Counted));
    return real(thread, attributes, run_counted, data);
}
void* dlopen(const char* file, int mode) noexcept
{
    static auto* const real = next<decltype(dlopen)>("dlopen");
    return is_hidden && file && std::strstr(file, "tbbmalloc") ? nullptr : real(file, mode);
}
}
#pragma GCC visibility pop

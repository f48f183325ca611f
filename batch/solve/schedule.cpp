// SPDX-License-Identifier: MIT
//
// Cuts a crowd's blocks into chunks and runs them on oneTBB. A chunk runs on the thread that had it before, if that
// thread is free. So its rows are in the cache of that core. This is the only file that knows oneTBB.
//
// oneTBB throws where it finds no memory or cannot start a thread. So this file is compiled with exceptions, unlike the
// rest of the library, and lets none out. The calling thread then solves what oneTBB left.
#include <algorithm>

#include "batch/solve/solve.h"
#include "simd/float_env.h"

#ifdef SWIVEL_WITH_TBB
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <atomic>
#include <latch>
#include <limits>
#include <new>
#include <thread>
#include <vector>
#endif

namespace swivel {

namespace {

#ifdef SWIVEL_WITH_TBB
using Partitioner = oneapi::tbb::affinity_partitioner;
static_assert(sizeof(Partitioner) <= sizeof(swivel_crowd::schedule) && alignof(Partitioner) <= 16);
Partitioner& partitioner_of(swivel_crowd& crowd)
{
    return *std::launder(reinterpret_cast<Partitioner*>(crowd.schedule));
}

// How many blocks have something to do, or a few more.
std::uint32_t busy_block_count(const Work& work)
{
    if (!work.mask) return block_count_of(work.crowd, work.groups, work.blocks);
    std::uint32_t busy = 0;
    for_each_group(work.crowd, work.groups, work.blocks, [&](const Group& group, GroupBlocks part, std::uint32_t n) {
        if (work.pose && n > 0) return;  // the same blocks
        const std::uint32_t block = group.first_block + part.first;
        const std::uint32_t *const first = work.mask + block / 2, *const end =
                                                                      work.mask + (block + part.count - 1) / 2 + 1;
        busy += 2 * static_cast<std::uint32_t>(std::count_if(first, end, [](std::uint32_t word) { return word > 0; }));
    });
    return busy;
}

// A job whose parts threads take. A part must be solved once, because a solve may read what it wrote: the last normal,
// or a pose that is read and written in place. So each part's byte in the crowd says whether it is done.
struct SharedJob {
    const Work& work;
    const JobParts parts;
    std::uint8_t* const done;
    const std::thread::id caller = std::this_thread::get_id();

    explicit SharedJob(const Work& todo) : work(todo), parts(parts_of(todo)), done(todo.crowd.done)
    {
        std::fill_n(done, parts.count, std::uint8_t{0});
    }
    // The workspace is the calling thread's. Other threads have a smaller one on their stack.
    void solve(std::uint32_t first, std::uint32_t end) const
    {
        if (std::this_thread::get_id() == caller || work.strip.block_count == 0)
            solve_in(work.strip, first, end);
        else if (!work.pose)
            solve_on_stack(first, end);
        else if (!solve_on_heap(first, end))
            return;
        std::fill(done + first, done + end, std::uint8_t{1});
    }
    // A workspace with bodies may be too large for a stack. Where there is no memory, the parts are left.
    bool solve_on_heap(std::uint32_t first, std::uint32_t end) const
    {
        constexpr std::align_val_t alignment{kArenaAlignment};
        const std::uint32_t blocks = work.crowd.strip_blocks, rows = work.crowd.body_row_count;
        void* const workspace = ::operator new(workspace_floats(blocks, rows) * sizeof(float), alignment, std::nothrow);
        if (!workspace) return false;
        solve_in(strip_memory(work.crowd, static_cast<float*>(workspace)), first, end);
        ::operator delete(workspace, alignment);
        return true;
    }
    void solve_in(StripMemory strip, std::uint32_t first, std::uint32_t end) const
    {
        Work with_strip = work;
        with_strip.strip = strip;
        parts.solve(with_strip, first, end);
    }
    [[gnu::noinline]] void solve_on_stack(std::uint32_t first, std::uint32_t end) const
    {
        alignas(64) float rows[kStackBlocks * kStripBlockFloats];
        solve_in({rows, kStackBlocks}, first, end);
    }
    // Solves the parts that threads have left.
    void solve_left() const
    {
        for (std::uint32_t first = 0; first < parts.count;) {
            const auto* const end = std::find(done + first, done + parts.count, done[first] ? 0 : 1);
            const auto next = static_cast<std::uint32_t>(end - done);
            if (!done[first]) solve(first, next);
            first = next;
        }
    }
};

// Whether the system gives so many threads at once.
bool can_start(std::size_t thread_count)
{
    std::vector<std::thread> threads;
    std::latch all_started(1);
    bool can = true;
    try {
        threads.reserve(thread_count);
        while (threads.size() < thread_count) threads.emplace_back([&] { all_started.wait(); });
    } catch (...) {
        can = false;
    }
    all_started.count_down();
    for (std::thread& thread : threads) thread.join();
    return can;
}

// oneTBB's state is the process's, and so is what is known of it.
std::atomic<int> max_threads{0};  // that could be started, the calling thread among them; 0: nothing has used oneTBB
// The fewest that could not be started. They are not tried again, because trying takes threads from the host.
std::atomic<int> too_many_threads{std::numeric_limits<int>::max()};
std::atomic<bool> has_failed{false};  // it has thrown: what it left unfinished then, its later calls may await for ever

// Whether all threads of the caller's arena can be started. oneTBB's threads start each other, and one that cannot
// start ends the process. So a limit of the system, such as a container's, is found before.
bool has_threads()
{
    const int wanted = oneapi::tbb::this_task_arena::max_concurrency();
    if (wanted <= max_threads) return true;
    if (wanted >= too_many_threads) return false;
    if (!can_start(static_cast<std::size_t>(wanted - 1))) {
        too_many_threads = wanted;
        return false;
    }
    max_threads = wanted;
    return true;
}

void solve_by_tasks(const SharedJob& job, std::uint32_t grain)
{
    using Range = oneapi::tbb::blocked_range<std::uint32_t>;
    // This context is isolated, because a cancelled context of the caller must not leave blocks out.
    oneapi::tbb::task_group_context context(oneapi::tbb::task_group_context::isolated);
    const auto on_range = [&](const Range& range) { job.solve(range.begin(), range.end()); };
    // While this thread waits for the others, it runs none of the caller's other tasks, which may be long.
    oneapi::tbb::this_task_arena::isolate([&] {
        oneapi::tbb::parallel_for(Range(0, job.parts.count, grain), on_range, partitioner_of(job.work.crowd), context);
    });
}

// Lets oneTBB solve as many parts as it can.
void try_tasks(const SharedJob& job, std::uint32_t grain)
{
    if (has_failed) return;
    try {
        if (!has_threads()) return;
        solve_by_tasks(job, grain);
    } catch (...) {
        has_failed = true;
    }
}
#endif

}  // namespace

bool solve_on_threads([[maybe_unused]] const Work& work)
{
#ifdef SWIVEL_WITH_TBB
    // The rows of a chunk fill a quarter of a level 2 cache of 512 KiB, which is some microseconds of work. A crowd of
    // one chunk stays on one thread. Up to 2,000 arms, two threads were no faster than one, with chunks of any size.
    constexpr std::size_t kChunkBytes = 128 * 1024;
    const auto chunk = static_cast<std::uint32_t>(kChunkBytes / work.crowd.block_bytes);
    if (busy_block_count(work) > chunk) {
        const FloatEnv env;  // oneTBB sets the caller's control word anew, and clears its flags
        const SharedJob job(work);
        const auto grain = static_cast<std::uint32_t>(std::uint64_t{chunk} * job.parts.count / work.blocks.count);
        try_tasks(job, std::max(1u, grain));
        job.solve_left();
        return true;
    }
#endif
    return false;
}

void begin_schedule([[maybe_unused]] swivel_crowd& crowd)
{
#ifdef SWIVEL_WITH_TBB
    new (crowd.schedule) Partitioner;
#endif
}
void end_schedule([[maybe_unused]] swivel_crowd& crowd)
{
#ifdef SWIVEL_WITH_TBB
    // The destructor asks how many threads there are, which may fail or wait for ever as well. Without it, at most the
    // partitioner's few numbers stay behind.
    if (max_threads > 0 && !has_failed) partitioner_of(crowd).~Partitioner();
#endif
}

}  // namespace swivel

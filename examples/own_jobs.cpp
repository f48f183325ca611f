// SPDX-License-Identifier: MIT
// A host with a job system of its own. The host's threads solve ranges of blocks, and swivel starts no thread. The
// results have the bits of one swivel_solve(), whatever the ranges are and whichever thread solves them.
#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdio>
#include <cstring>
#include <exception>
#include <functional>
#include <mutex>
#include <span>
#include <swivel/swivel.hpp>
#include <thread>
#include <vector>

namespace {

constexpr std::uint32_t kArmCount = 20'000;
constexpr std::uint32_t kBlocksAJob = 64;  // a thousand arms: some microseconds, so that starting a job costs little

// The host's job system, as small as it gets: threads that wait for a job with parts, and take the parts in turns.
class JobSystem {
public:
    explicit JobSystem(unsigned thread_count)
    {
        for (unsigned n = 0; n < thread_count; ++n) threads_.emplace_back([this] { work(); });
    }
    ~JobSystem()
    {
        {
            const std::scoped_lock lock(mutex_);
            stop_ = true;
        }
        wake_.notify_all();
        for (std::thread& thread : threads_) thread.join();
    }
    std::size_t thread_count() const { return threads_.size(); }

    // Runs job(0) to job(part_count - 1) on the threads; returns when all are done. The first failure is thrown here.
    void run(std::uint32_t part_count, const std::function<void(std::uint32_t)>& job)
    {
        std::unique_lock lock(mutex_);
        job_ = &job;
        part_count_ = part_count;
        next_part_ = 0;
        failure_ = nullptr;
        busy_ = threads_.size();
        ++round_;
        wake_.notify_all();
        done_.wait(lock, [this] { return busy_ == 0; });
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    void work()
    {
        std::unique_lock lock(mutex_);
        for (std::uint64_t seen = 0;;) {
            wake_.wait(lock, [&] { return stop_ || round_ != seen; });
            if (stop_) return;
            seen = round_;
            lock.unlock();
            std::exception_ptr failure;
            try {
                for (std::uint32_t part; (part = next_part_++) < part_count_;) (*job_)(part);
            } catch (...) {
                failure = std::current_exception();
            }
            lock.lock();
            if (failure && !failure_) failure_ = failure;
            if (--busy_ == 0) done_.notify_one();
        }
    }

    std::mutex mutex_;
    std::condition_variable wake_, done_;
    const std::function<void(std::uint32_t)>* job_ = nullptr;
    std::uint32_t part_count_ = 0;
    std::atomic<std::uint32_t> next_part_ = 0;
    std::exception_ptr failure_;
    std::size_t busy_ = 0;
    std::uint64_t round_ = 0;
    bool stop_ = false;
    std::vector<std::thread> threads_;
};

// Cuts all blocks of a crowd into jobs. solve(first block, number of blocks) may run on several threads at once, as the
// ranges do not overlap.
template <class Solve>
void on_all_blocks(JobSystem& jobs, const swivel::Crowd& crowd, const Solve& solve)
{
    const std::uint32_t block_count = swivel_block_count(crowd.get());
    jobs.run((block_count + kBlocksAJob - 1) / kBlocksAJob, [&](std::uint32_t job) {
        const std::uint32_t first = job * kBlocksAJob;
        solve(first, std::min(kBlocksAJob, block_count - first));
    });
}

struct Character {  // as the host keeps it: what goes in and what comes out, side by side
    std::array<float, 3> grip;
    std::array<float, 4> shoulder;
    std::array<float, 2> elbow;
    bool operator==(const Character& other) const { return std::memcmp(this, &other, sizeof other) == 0; }  // the bits
};

std::vector<Character> make_characters()
{
    std::vector<Character> characters(kArmCount);
    std::uint32_t random = 1;
    for (Character& character : characters)
        for (float& component : character.grip) {  // -1 to 1: some within reach of the arms, some not
            random = random * 1664525u + 1013904223u;
            component = static_cast<float>(random >> 8) / 8388608.0f - 1.0f;
        }
    return characters;
}

swivel::Streams streams_of(std::span<Character> characters)
{
    swivel::Streams streams;
    streams.in(SWIVEL_TARGET, swivel::stream(characters, &Character::grip));
    streams.out(SWIVEL_SHOULDER, swivel::stream(characters, &Character::shoulder));
    streams.out(SWIVEL_ELBOW, swivel::stream(characters, &Character::elbow));
    return streams;
}

bool equal_results(swivel::Crowd& a, swivel::Crowd& b)
{
    std::vector<std::array<float, 4>> of_a(kArmCount), of_b(kArmCount);
    a.read(SWIVEL_SHOULDER, 0, of_a);
    b.read(SWIVEL_SHOULDER, 0, of_b);
    return std::memcmp(of_a.data(), of_b.data(), kArmCount * sizeof of_a[0]) == 0;
}

int compare()
{
    const swivel_limb_def arms = swivel::limbs(kArmCount);
    swivel::Crowd ours({arms}), theirs({arms});
    JobSystem jobs(std::clamp(std::thread::hardware_concurrency(), 2u, 8u));

    // Rows in, rows out: the host writes inputs, its threads solve.
    std::vector<Character> characters = make_characters(), as_well = characters;
    for (swivel::Crowd* crowd : {&ours, &theirs}) {
        std::vector<std::array<float, 3>> grips;
        for (const Character& character : characters) grips.push_back(character.grip);
        crowd->write(SWIVEL_TARGET, 0, grips);
        crowd->write_all(SWIVEL_LENGTHS, 0, std::array{0.5f, 0.5f});
    }
    on_all_blocks(jobs, ours, [&](std::uint32_t first, std::uint32_t count) {
        ours.solve({.blocks = swivel_blocks{first, count}, .on_this_thread = true});
    });
    theirs.solve();
    const bool rows_equal = equal_results(ours, theirs);
    std::printf("%u arms on %zu threads of our own: %s bits as swivel_solve\n", kArmCount, jobs.thread_count(),
                rows_equal ? "the same" : "OTHER");

    // The host's own structures in and out, in the same way: each job copies in, solves and copies out its own blocks.
    const swivel::Streams streams = streams_of(characters), other_streams = streams_of(as_well);
    on_all_blocks(jobs, ours, [&](std::uint32_t first, std::uint32_t count) {
        ours.solve({.blocks = swivel_blocks{first, count}, .streams = {streams}, .on_this_thread = true});
    });
    theirs.solve({.streams = {other_streams}});
    const bool streams_equal = characters == as_well;
    std::printf("streams: %s bits as swivel_solve\n", streams_equal ? "the same" : "OTHER");
    return rows_equal && streams_equal ? 0 : 1;
}

}  // namespace

int main()
{
    try {
        return compare();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}

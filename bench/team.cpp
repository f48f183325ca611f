// SPDX-License-Identifier: MIT
#include "bench/team.h"

namespace bench {

namespace {

// Waits for some microseconds before it sleeps: waking takes longer than small jobs do.
template <class Value>
void wait_while(std::atomic<Value>& value, Value old)
{
    for (int spin = 0; spin < 20000; ++spin)
        if (value.load(std::memory_order_acquire) != old) return;
    value.wait(old, std::memory_order_acquire);
}

}  // namespace

Team::Team(int thread_count)
{
    for (int part = 1; part < thread_count; ++part) workers_.emplace_back([this, part] { wait_for_work(part); });
}

Team::~Team()
{
    work_ = nullptr;
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
    for (std::thread& worker : workers_) worker.join();
}

void Team::run(const std::function<void(int part)>& work)
{
    work_ = &work;
    busy_.store(size() - 1, std::memory_order_relaxed);
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
    work(0);
    for (int left; (left = busy_.load(std::memory_order_acquire)) != 0;) wait_while(busy_, left);
}

void Team::wait_for_work(int part)
{
    for (unsigned round = 0;; ++round) {
        wait_while(round_, round);
        if (!work_) return;
        (*work_)(part);
        busy_.fetch_sub(1, std::memory_order_release);
        busy_.notify_one();
    }
}

}  // namespace bench

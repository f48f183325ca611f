// SPDX-License-Identifier: MIT
//
// Threads that wait for work. Suites that are built without oneTBB solve on them.
#pragma once

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace bench {

class Team {
public:
    explicit Team(int thread_count);  // the caller's thread is one of them
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    int size() const { return static_cast<int>(workers_.size()) + 1; }
    // Calls work(part) for each part below size(), each on its own thread; part 0 on the caller's.
    void run(const std::function<void(int part)>& work);

private:
    void wait_for_work(int part);

    const std::function<void(int)>* work_ = nullptr;  // null: end
    std::atomic<unsigned> round_ = 0;
    std::atomic<int> busy_ = 0;
    std::vector<std::thread> workers_;
};

// The share of a part: from first to end of count things, equal but for one.
struct Share {
    std::size_t first, end;
};
inline Share share_of(std::size_t count, int part, int parts)
{
    const auto n = static_cast<std::size_t>(part), all = static_cast<std::size_t>(parts);
    return {count * n / all, count * (n + 1) / all};
}

}  // namespace bench

// SPDX-License-Identifier: MIT
//
// A clock of work that several threads share: the time during which at least one of them was at it.
#pragma once

#include <chrono>
#include <mutex>

namespace swivel::tools {

class BusyClock {
public:
    // A thread's part of the work, from its making to its end. Any thread may make one at any time.
    class Turn {
    public:
        explicit Turn(BusyClock& clock) : clock_(clock)
        {
            const std::lock_guard lock(clock_.mutex_);
            if (clock_.count_++ == 0) clock_.begin_ = Clock::now();
        }
        ~Turn()
        {
            const std::lock_guard lock(clock_.mutex_);
            if (--clock_.count_ == 0) clock_.busy_ += Clock::now() - clock_.begin_;
        }
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;

    private:
        BusyClock& clock_;
    };

    // While no turn is under way.
    double seconds() const { return std::chrono::duration<double>(busy_).count(); }

private:
    using Clock = std::chrono::steady_clock;

    std::mutex mutex_;
    int count_ = 0;  // of turns under way
    Clock::time_point begin_;
    Clock::duration busy_{};
};

}  // namespace swivel::tools

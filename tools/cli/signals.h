// SPDX-License-Identifier: MIT
//
// What signals do to a run. Those that ask the process to end are noted while a file is half written, so that it is
// removed on the way out. Those about a write become an error of that write. Faults get last words. Nothing else here
// knows signals.
#pragma once

#include <array>
#include <csignal>

namespace swivel::tools {

constexpr const char* kInterrupted = "interrupted; unfinished files are removed";

// While it lives, SIGHUP, SIGINT, SIGQUIT, SIGTERM and SIGXCPU leave a note. A second one ends the process at once.
// One that was ignored before stays so, as nohup wants it.
class StopSignals {
public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    // Throws CommandError if one came. To be called between frames, and before a file is made to appear.
    void check() const;

private:
    std::array<struct sigaction, 5> before_;
};

// The signal that was noted since the last call of forget_stop_signal(); 0: none.
int noted_stop_signal();
void forget_stop_signal();

// While it lives, a write that SIGPIPE or SIGXFSZ would end the process for fails with EPIPE or EFBIG.
class WriteSignals {
public:
    WriteSignals();
    ~WriteSignals();
    WriteSignals(const WriteSignals&) = delete;
    WriteSignals& operator=(const WriteSignals&) = delete;

private:
    std::array<struct sigaction, 2> before_;
};

// From now on last_words() runs before a fault ends the process: SIGSEGV, SIGBUS, SIGFPE, SIGILL or SIGABRT. It runs
// within the signal. A fault that something else waits for, such as a sanitizer, is left to that.
void set_last_words(void (*last_words)());

// The exit code by which shells name a process that a signal ended.
constexpr int exit_code_of_signal(int signal) { return 128 + signal; }

// Ends the process by the signal that an exit code names, so that its parent sees a signal. Returns the exit code if it
// names none, or one that is ignored.
int end_as(int exit_code);

}  // namespace swivel::tools

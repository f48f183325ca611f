// SPDX-License-Identifier: MIT
#include "tools/cli/signals.h"

#include "tools/cli/command_error.h"

namespace swivel::tools {

namespace {

constexpr std::array kStops = {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU};
constexpr std::array kWrites = {SIGPIPE, SIGXFSZ};
constexpr std::array kFaults = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

volatile std::sig_atomic_t noted = 0;
void (*say_last_words)() = nullptr;

template <std::size_t count>
void set_all(const std::array<int, count>& signals, const struct sigaction& wanted,
             std::array<struct sigaction, count>& before)
{
    for (std::size_t n = 0; n < count; ++n) {
        ::sigaction(signals[n], nullptr, &before[n]);
        if (before[n].sa_handler != SIG_IGN) ::sigaction(signals[n], &wanted, nullptr);
    }
}

template <std::size_t count>
void restore_all(const std::array<int, count>& signals, const std::array<struct sigaction, count>& before)
{
    for (std::size_t n = 0; n < count; ++n) ::sigaction(signals[n], &before[n], nullptr);
}

}  // namespace

StopSignals::StopSignals()
{
    struct sigaction note = {};
    note.sa_handler = [](int signal) { noted = signal; };
    note.sa_flags = static_cast<int>(SA_RESETHAND);  // without SA_RESTART: a read or write that waits ends with it
    set_all(kStops, note, before_);
}

StopSignals::~StopSignals() { restore_all(kStops, before_); }

void StopSignals::check() const
{
    if (noted) throw CommandError(exit_code_of_signal(noted), kInterrupted);
}

int noted_stop_signal() { return noted; }
void forget_stop_signal() { noted = 0; }

WriteSignals::WriteSignals()
{
    struct sigaction ignore = {};
    ignore.sa_handler = SIG_IGN;
    set_all(kWrites, ignore, before_);
}

WriteSignals::~WriteSignals() { restore_all(kWrites, before_); }

void set_last_words(void (*last_words)())
{
    say_last_words = last_words;
    struct sigaction once = {}, before = {};
    once.sa_handler = [](int fault) {
        say_last_words();
        ::raise(fault);  // ends the process when this returns
    };
    once.sa_flags = static_cast<int>(SA_RESETHAND);
    for (const int fault : kFaults)
        if (::sigaction(fault, nullptr, &before) == 0 && before.sa_handler == SIG_DFL)
            ::sigaction(fault, &once, nullptr);
}

int end_as(int exit_code)
{
    if (exit_code > exit_code_of_signal(0)) ::raise(exit_code - exit_code_of_signal(0));
    return exit_code;
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
//
// The command as a whole process. sigdescr_np() takes no memory; it needs glibc 2.32.
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "tools/cli/command_error.h"
#include "tools/cli/streams.h"
#include "tools/formats/partial.h"
#include "tools/swivel/commands.h"

namespace swivel::tools {

namespace {

// Those that ask a process to end, those about a write, and faults.
constexpr int kEnds[] = {SIGHUP,  SIGINT,  SIGQUIT, SIGTERM, SIGXCPU, SIGPIPE,
                         SIGXFSZ, SIGSEGV, SIGBUS,  SIGFPE,  SIGILL,  SIGABRT};

// One line on stderr, without memory. A progress bar may stand in the terminal's line.
void write_line(const char* cause, const char* rest)
{
    std::array<char, 200> line;
    const int size = std::snprintf(line.data(), line.size(), "%sswivel: %s%s\n",
                                   ::isatty(STDERR_FILENO) ? "\r\x1b[K" : "", cause, rest);
    static_cast<void>(!::write(STDERR_FILENO, line.data(), static_cast<std::size_t>(size)));
}

// Raises the signal again, which ends the process when the handler returns.
void end_by(int signal)
{
    formats::Partial::remove_all();
    // A run whose output nobody reads any more ends silently, as other tools do.
    if (signal != SIGPIPE) write_line(::sigdescr_np(signal), "; unfinished files are removed");
    ::raise(signal);
}

void end_by_signals()
{
    struct sigaction once = {}, before = {};
    once.sa_handler = end_by;
    once.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigfillset(&once.sa_mask);
    for (const int signal : kEnds)
        if (::sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_DFL)
            ::sigaction(signal, &once, nullptr);
}

// Without memory the process ends instead of throwing. Unwinding would run destructors that allocate, or that meet
// half-made objects: those of nlohmann's JSON do both.
[[noreturn]] void end_without_memory()
{
    formats::Partial::remove_all();
    write_line(kNotEnoughMemory, "");
    ::_exit(1);
}

// For exceptions that nobody can catch, as in oneTBB's threads. It asks malloc().
[[noreturn]] void end_by_exception() noexcept
{
    try {
        if (std::current_exception()) throw;
    } catch (const std::bad_alloc&) {
        end_without_memory();
    } catch (...) {
    }
    std::abort();
}

// CLI11 has variables that ask for memory before main() begins, so this one comes before all others.
struct Readiness {
    Readiness()
    {
        std::set_new_handler(end_without_memory);
        std::set_terminate(end_by_exception);
    }
};
[[gnu::init_priority(101)]] const Readiness ready;

}  // namespace
}  // namespace swivel::tools

// Whatever ends the process from now on, a signal, a fault or a lack of memory, first removes unfinished files and says
// one line. A signal that is ignored, or that something else waits for, such as a sanitizer, is left to that. Closed
// standard streams are no file's.
int main(int argc, char** argv)
{
    swivel::tools::end_by_signals();
    return swivel::tools::open_closed_streams() ? swivel::tools::run_swivel(argc, argv) : 1;
}

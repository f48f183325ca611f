// SPDX-License-Identifier: MIT
#include "tools/cli/command_error.h"

#include <array>
#include <new>
#include <system_error>

#include "tools/cli/signals.h"
#include "tools/cli/streams.h"

namespace swivel::tools {

namespace {

// To be called where an exception is caught: says it.
int tell()
{
    if (const int signal = noted_stop_signal())  // whatever else it has brought about
        return fail(exit_code_of_signal(signal), kInterrupted);
    try {
        throw;
    } catch (const CommandError& error) {
        return fail(error.exit_code, error.what());
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::broken_pipe) return exit_code_of_signal(SIGPIPE);
        return fail(1, error.what());
    } catch (const std::bad_alloc&) {
        return fail(1, kNotEnoughMemory);
    } catch (const std::exception& error) {
        return fail(1, error.what());
    }
}

// To be called where nothing was thrown. A signal may have come too late to throw.
int tell_of_end()
{
    const bool is_whole = is_output_whole();
    if (const int signal = noted_stop_signal()) return fail(exit_code_of_signal(signal), kInterrupted);
    if (is_whole) return 0;
    if (has_lost_its_reader()) return exit_code_of_signal(SIGPIPE);
    return fail(1, "standard output could not be written in full");
}

}  // namespace

int fail(int code, std::string_view line) noexcept
{
    constexpr std::string_view start = "swivel: ";
    std::array<char, 8192> text;  // one write for one line: those of several processes do not mix
    std::size_t size = start.copy(text.data(), start.size());
    for (const char c : line) {
        text[size++] = c == '\n' ? ' ' : c;
        if (size < text.size()) continue;
        say_text(stderr, {text.data(), size});
        size = 0;
    }
    text[size++] = '\n';
    say_text(stderr, {text.data(), size});
    return code;
}

int run_to_end(const std::function<void()>& work) noexcept
{
    const WriteSignals become_errors;
    forget_stop_signal();
    try {
        work();
    } catch (...) {
        std::fflush(stdout);  // what was said before comes first
        const int code = tell();
        is_output_whole();
        return code;
    }
    return tell_of_end();
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
#include "tools/cli/process.h"

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "tools/cli/command_error.h"
#include "tools/cli/signals.h"
#include "tools/cli/streams.h"
#include "tools/formats/partial.h"

namespace swivel::tools {

namespace {

std::atomic_flag is_ending;

// One line, whichever threads fail. What is unfinished is removed without memory, and nothing else needs an owner.
[[noreturn]] void end(std::string_view cause, std::string_view advice) noexcept
{
    while (is_ending.test_and_set()) ::pause();  // another thread ends the process
    formats::Partial::remove_all();
    std::fflush(stdout);
    ::_exit(fail(1, cause, advice));
}

// Where memory lacks, no exception is thrown. Unwinding would run destructors that ask for memory, or that find an
// object half made: those of nlohmann's JSON do both.
[[noreturn]] void end_without_memory() { end(kNotEnoughMemory, memory_advice()); }

[[noreturn]] void end_in_one_line() noexcept
{
    if (std::current_exception()) {
        try {
            throw;
        } catch (const std::bad_alloc&) {  // of those who ask malloc(), such as oneTBB
            end_without_memory();
        } catch (const std::exception& error) {
            end(error.what(), "");
        } catch (...) {
        }
    }
    std::fflush(stdout);
    std::abort();
}

void end_by_fault()
{
    formats::Partial::remove_all();
    fail(1, "a fault in swivel or in a library ends this run; unfinished files are removed; please report it");
}

// Before the constructors of variables in the program's own libraries, some of which take memory.
[[gnu::constructor(101)]] void expect_the_worst()
{
    set_last_words(end_by_fault);
    std::set_new_handler(end_without_memory);
    std::set_terminate(end_in_one_line);
}

}  // namespace

int run_process(const std::function<int()>& run) { return open_closed_streams() ? end_as(run()) : 1; }

}  // namespace swivel::tools

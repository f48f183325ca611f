// SPDX-License-Identifier: MIT
#include "tools/cli/process.h"

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "tools/cli/command_error.h"
#include "tools/cli/signals.h"
#include "tools/cli/streams.h"
#include "tools/formats/output_file.h"

namespace swivel::tools {

namespace {

std::atomic<bool> memory_has_run_out = false;  // set from any thread

// As without it, and leaves a note: with no memory at all there is no exception either, see __cxa_allocate_exception().
void note_lack_of_memory()
{
    memory_has_run_out = true;
    throw std::bad_alloc();
}

[[noreturn]] void end_in_one_line() noexcept
{
    formats::OutputFile::discard_all();
    std::fflush(stdout);
    if (memory_has_run_out) ::_exit(fail(1, kNotEnoughMemory));
    if (std::current_exception()) {
        try {
            throw;
        } catch (const std::exception& error) {
            ::_exit(fail(1, error.what()));
        } catch (...) {
        }
    }
    std::abort();
}

// Before the constructors of variables in the program's own libraries, some of which take memory.
[[gnu::constructor(101)]] void expect_lack_of_memory()
{
    std::set_new_handler(note_lack_of_memory);
    std::set_terminate(end_in_one_line);
}

}  // namespace

int run_process(const std::function<int()>& run) { return open_closed_streams() ? end_as(run()) : 1; }

}  // namespace swivel::tools

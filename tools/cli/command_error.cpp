// SPDX-License-Identifier: MIT
#include "tools/cli/command_error.h"

#include <algorithm>
#include <new>
#include <system_error>

#include "tools/cli/streams.h"

namespace swivel::tools {

namespace {

// To be called where an exception is caught: says it.
int tell()
{
    try {
        throw;
    } catch (const CommandError& error) {
        return fail(error.exit_code, error.what());
    } catch (const std::bad_alloc&) {
        return fail(1, kNotEnoughMemory);
    } catch (const std::system_error& error) {
        return fail(1, error.code() == std::errc::not_enough_memory ? kNotEnoughMemory : error.what());
    } catch (const std::exception& error) {
        return fail(1, error.what());
    }
}

}  // namespace

int fail(int code, std::string line)
{
    std::ranges::replace(line, '\n', ' ');
    say(stderr, "swivel: {}\n", line);
    return code;
}

int run_to_end(const std::function<void()>& work) noexcept
{
    try {
        work();
    } catch (...) {
        is_output_whole();  // what was said before comes first
        return tell();
    }
    return is_output_whole() ? 0 : fail(1, "standard output could not be written in full");
}

}  // namespace swivel::tools

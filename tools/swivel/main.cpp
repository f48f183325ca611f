// SPDX-License-Identifier: MIT
//
// The swivel command: reads the command line, runs one subcommand, turns what went wrong into one line and an exit code
// (0 done, 1 failed, 2 bad usage).
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "swivel/swivel.hpp"
#include "tools/swivel/command_error.h"
#include "tools/swivel/commands.h"

namespace {

int fail(int code, std::string line)
{
    std::replace(line.begin(), line.end(), '\n', ' ');
    fmt::print(stderr, "swivel: {}\n", line);
    return code;
}

// Of the subcommand, once there is one.
std::string help_command(const CLI::App& app)
{
    const std::vector<CLI::App*> used = app.get_subcommands();
    return used.empty() ? "swivel --help" : fmt::format("swivel {} --help", used.front()->get_name());
}

}  // namespace

int main(int argc, char** argv)
{
    using namespace swivel::tools;
    CLI::App app{"Solves the arms of crowds: wrist targets in, joint rotations out, the same bits on every CPU."};
    app.name("swivel");
    app.set_version_flag(
        "--version", fmt::format("swivel {}.{}.{}", SWIVEL_VERSION_MAJOR, SWIVEL_VERSION_MINOR, SWIVEL_VERSION_PATCH));
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 done, 1 failed, 2 bad usage. SWIVEL_FORCE_ISA=NAME forces an instruction set (swivel info).");
    add_demo(app);
    add_solve(app);
    add_rig(app);
    add_verify(app);
    add_bench(app);
    add_info(app);
    try {
        app.parse(argc, argv);
        if (std::fflush(stdout) != 0 || std::ferror(stdout))
            return fail(1, "standard output could not be written in full");
        return 0;
    } catch (const CLI::Success& done) {  // --help, --version
        return app.exit(done);
    } catch (const CLI::RequiredError& error) {
        const std::vector<std::string> unknown = app.remaining();
        const std::string cause =
            unknown.empty() ? error.what() : fmt::format("'{}' is no command or option", unknown[0]);
        return fail(2, fmt::format("{}; see {}", cause, help_command(app)));
    } catch (const CLI::ParseError& error) {
        return fail(2, fmt::format("{}; see {}", error.what(), help_command(app)));
    } catch (const CommandError& error) {
        return fail(error.exit_code, error.what());
    } catch (const std::bad_alloc&) {
        const auto commands = app.get_subcommands();
        const auto* option = commands.empty() ? nullptr : commands[0]->get_option_no_throw("--characters");
        return fail(1, option && option->count() > 0 ? "out of memory; try fewer --characters" : "out of memory");
    } catch (const std::exception& error) {
        return fail(1, error.what());
    }
}

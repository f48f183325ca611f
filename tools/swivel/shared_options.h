// SPDX-License-Identifier: MIT
//
// Options that several subcommands have: one name, one wording and one range for each.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tools/cli/option_checks.h"
#include "tools/swivel/commands.h"

namespace swivel::tools {

// A new subcommand and its options, which `run` takes when the command line has been read.
template <class Options>
std::pair<CLI::App&, Options&> add_command(CLI::App& app, const std::string& name, const std::string& meaning,
                                           void (*run)(const Options&))
{
    CLI::App& command = *app.add_subcommand(name, meaning);
    const auto options = std::make_shared<Options>();
    command.callback([options, run] { run(*options); });
    return {command, *options};
}

// An option, or a positional, with the values that it takes.
template <class Variable>
CLI::Option* add_value(CLI::App& command, const std::string& name, Variable& variable, const OptionValue& value,
                       const std::string& meaning)
{
    return takes(command.add_option(name, variable, meaning), value);
}
// One that names a file, or some.
template <class Files>
CLI::Option* add_file_option(CLI::App& command, const std::string& name, Files& files, const std::string& meaning)
{
    return add_value(command, name, files, file_name(), meaning);
}
// One about a body's joints or axes, which may be given more than once. type: of its value, for the help.
CLI::Option* add_of_body(CLI::App& command, const std::string& name, const std::string& type,
                         std::vector<std::string>& texts, const std::string& meaning);

// Value: std::uint32_t, or an optional of it.
template <class Value>
CLI::Option* add_characters(CLI::App& command, Value& characters, const std::string& meaning)
{
    return add_value(command, "--characters", characters, whole_number(1, 10'000'000),
                     "Characters, 1 to 10 million" + meaning);
}

// Value: std::uint64_t, or an optional of it; 1 where it is not given.
template <class Value>
CLI::Option* add_seed(CLI::App& command, Value& seed, const std::string& subject)
{
    return add_value(command, "--seed", seed, whole_number(0, UINT64_MAX), "Seed of " + subject)->default_str("1");
}

CLI::Option* add_threads(CLI::App& command, unsigned& threads,
                         const std::string& meaning = "Threads at most, up to 1024; 0 for all");
CLI::Option* add_json(CLI::App& command, bool& json);
CLI::Option* add_quiet(CLI::App& command, bool& quiet, const std::string& meaning = "Show no progress");
// Both, for a command whose report is quiet, too.
void add_quiet_and_json(CLI::App& command, bool& quiet, bool& json);
// The positional FILE, of one motion file or of some.
CLI::Option* add_file(CLI::App& command, std::string& file, const std::string& meaning);
void add_files(CLI::App& command, std::vector<std::string>& files, const std::string& more = {});
CLI::Option* add_kinds(CLI::App& command, std::string& kinds, const std::string& meaning);
// --clip and --fps, for MotionChoice; use: the animation's purpose, for the help.
void add_animation(CLI::App& command, std::string& clip, double& rate, const std::string& use);
// The same, and --rest and --up.
void add_motion(CLI::App& command, MotionChoice& motion, const std::string& use);
void add_root_motion(CLI::App& command, bool& root_motion);
// --arm and --leg; other_side: the fate of a side that is not named, for the help.
inline constexpr const char* kOtherSide = "The other side is still looked for";
void add_named_limbs(CLI::App& command, std::vector<std::string>& arms, std::vector<std::string>& legs,
                     const std::string& other_side);
void add_view(CLI::App& command, std::string& view);
void add_frames(CLI::App& command, std::uint32_t& frames);
// Options of the clip, its crowd and their goals. Returns the positional FILE, which is required.
CLI::Option* add_crowd_of_clip(CLI::App& command, SolveOptions& options);

}  // namespace swivel::tools

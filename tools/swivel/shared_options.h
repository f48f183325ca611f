// SPDX-License-Identifier: MIT
//
// Options that several subcommands have: one name, one wording and one range for each.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "tools/cli/option_checks.h"
#include "tools/swivel/commands.h"

namespace swivel::tools {

// Value: std::uint32_t, or an optional of it.
template <class Value>
CLI::Option* add_characters(CLI::App& command, Value& characters, const std::string& meaning)
{
    return takes(command.add_option("--characters", characters, "Characters, 1 to 10 million" + meaning),
                 whole_number(1, 10'000'000));
}

// Value: std::uint64_t, or an optional of it; 1 where it is not given.
template <class Value>
CLI::Option* add_seed(CLI::App& command, Value& seed, const std::string& subject)
{
    return takes(command.add_option("--seed", seed, "Seed of " + subject)->default_str("1"),
                 whole_number(0, UINT64_MAX));
}

CLI::Option* add_threads(CLI::App& command, unsigned& threads,
                         const char* meaning = "Threads at most, up to 1024; 0 for all");
CLI::Option* add_json(CLI::App& command, bool& json);
CLI::Option* add_quiet(CLI::App& command, bool& quiet, const std::string& meaning = "Show no progress");
// An option that names a file, or some.
template <class Files>
CLI::Option* add_file_option(CLI::App& command, const char* name, Files& files, const std::string& meaning)
{
    return takes(command.add_option(name, files, meaning), file_name());
}
// The positional FILE.
CLI::Option* add_file(CLI::App& command, std::string& file, const std::string& meaning);
CLI::Option* add_kinds(CLI::App& command, std::string& kinds, const std::string& meaning);
// --clip and --fps, for MotionChoice; use: the animation's purpose, for the help.
void add_animation(CLI::App& command, std::string& clip, double& rate, const std::string& use);
// The same, and --rest and --up.
void add_motion(CLI::App& command, MotionChoice& motion, const std::string& use);
CLI::Option* add_root_motion(CLI::App& command, bool& root_motion);
// --leg alone.
CLI::Option* add_named_legs(CLI::App& command, std::vector<std::string>& legs, const std::string& meaning);
// --arm and --leg; other_side: the fate of a side that is not named, for the help.
void add_named_limbs(CLI::App& command, std::vector<std::string>& arms, std::vector<std::string>& legs,
                     const std::string& other_side);
void add_view(CLI::App& command, std::string& view);
void add_frames(CLI::App& command, std::uint32_t& frames);
// Options of the clip, its crowd and their goals. Returns the positional FILE, which is required.
CLI::Option* add_crowd_of_clip(CLI::App& command, SolveOptions& options);

// store, fill, check and replay.
void add_cache_commands(CLI::App& app);

}  // namespace swivel::tools

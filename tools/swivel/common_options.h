// SPDX-License-Identifier: MIT
//
// Options that several subcommands have: one name, one wording and one range for each.
#pragma once

#include <string>
#include <vector>

#include "tools/swivel/motion_file.h"
#include "tools/swivel/validators.h"

namespace swivel::tools {

// Value: std::uint32_t, or an optional of it.
template <class Value>
CLI::Option* add_characters(CLI::App& command, Value& characters, const std::string& meaning)
{
    return command.add_option("--characters", characters, meaning)->check(whole_number(1, 10'000'000));
}

// Value: std::uint64_t, or an optional of it; 1 where it is not given.
template <class Value>
CLI::Option* add_seed(CLI::App& command, Value& seed, const std::string& of)
{
    return command.add_option("--seed", seed, "Seed of " + of)->default_str("1")->check(whole_number(0, UINT64_MAX));
}

inline CLI::Option* add_threads(CLI::App& command, unsigned& threads)
{
    return command.add_option("--threads", threads, "Threads at most; 0 for all")
        ->capture_default_str()
        ->check(whole_number(0, 1024));
}

inline CLI::Option* add_json(CLI::App& command, bool& json) { return command.add_flag("--json", json, "Print JSON"); }

// --clip and --fps; use: what the animation is there for.
inline void add_motion(CLI::App& command, MotionChoice& motion, const std::string& use)
{
    command.add_option(
        "--clip", motion.clip,
        "Animation of a glTF, FBX or DAE file, by name or, counted from 0, index; else the first; " + use);
    command
        .add_option("--fps", motion.rate,
                    "Samples a second of a glTF, FBX or DAE animation; without it its keys, or finer where they are "
                    "coarse or uneven (docs/rigs.md)")
        ->check(number(0.001, 10'000));
}

// --arm and --leg; other_side: what becomes of the one that is not named.
inline void add_named_limbs(CLI::App& command, std::vector<std::string>& arms, std::vector<std::string>& legs,
                            const std::string& other_side)
{
    command
        .add_option("--arm", arms,
                    "Joints of an arm, SHOULDER,ELBOW,WRIST, by name, path or number (#12), where their names do not "
                    "tell; up to twice; left: or right: in front sets the side; " +
                        other_side)
        ->allow_extra_args(false);
    command.add_option("--leg", legs, "Joints of a leg, HIP,KNEE,ANKLE, in the same way")->allow_extra_args(false);
}

}  // namespace swivel::tools

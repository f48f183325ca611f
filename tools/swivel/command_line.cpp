// SPDX-License-Identifier: MIT
//
// Reads the command line: the one file that knows its parser. Options that several subcommands have come first: one
// name, one wording and one range for each.
#include "tools/swivel/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <exception>
#include <memory>

#include "swivel/swivel.hpp"
#include "tools/swivel/command_error.h"
#include "tools/swivel/commands.h"

namespace swivel::tools {

namespace {

// ---- values, checked more strictly than by the parser: it wraps negative numbers, saturates large ones and reads a
// leading zero as octal

// Decimal digits, least to most.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most)
{
    const auto check = [least, most](const std::string& text) -> std::string {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool plain =
            error == std::errc() && end == text.data() + text.size() && (text.size() == 1 || text[0] != '0');
        if (plain && value >= least && value <= most) return {};
        return fmt::format("'{}' is not a whole number from {} to {}", text, least, most);
    };
    return CLI::Validator(check, fmt::format("{}..{}", least, most));
}

// A finite number, least to most.
CLI::Validator number(double least, double most)
{
    const auto check = [least, most](const std::string& text) -> std::string {
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc() && end == text.data() + text.size() && value >= least && value <= most) return {};
        return fmt::format("'{}' is not a number from {} to {}", text, least, most);
    };
    return CLI::Validator(check, fmt::format("{}..{}", least, most));
}

CLI::Validator file_name()
{
    const auto check = [](const std::string& text) -> std::string {
        return text.empty() ? "the file name is empty" : "";
    };
    return CLI::Validator(check, "FILE");
}

// ---- options of several subcommands

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

CLI::Option* add_threads(CLI::App& command, unsigned& threads)
{
    return command.add_option("--threads", threads, "Threads at most; 0 for all")
        ->capture_default_str()
        ->check(whole_number(0, 1024));
}

CLI::Option* add_json(CLI::App& command, bool& json) { return command.add_flag("--json", json, "Print JSON"); }

// --clip and --fps; use: what the animation is there for.
void add_motion(CLI::App& command, MotionChoice& motion, const std::string& use)
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
void add_named_limbs(CLI::App& command, std::vector<std::string>& arms, std::vector<std::string>& legs,
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

// ---- the subcommands

void add_demo(CLI::App& app)
{
    CLI::App* command = app.add_subcommand("demo", "Solve a made-up crowd and report throughput, errors and flags");
    auto options = std::make_shared<DemoOptions>();
    add_characters(*command, options->characters, "Characters, two arms each")->capture_default_str();
    command->add_option("--frames", options->frames, "Frames")
        ->capture_default_str()
        ->check(whole_number(1, 1'000'000));
    add_seed(*command, options->seed, "the characters' differences");
    add_threads(*command, options->threads);
    add_json(*command, options->json);
    command->callback([options] { run_demo(*options); });
}

void add_solve(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "solve", "Solve the arms and legs of a BVH, glTF, FBX or DAE clip, or of a crowd that performs it");
    auto options = std::make_shared<SolveOptions>();
    command
        ->add_option(
            "clip", options->clip,
            "Motion file: .bvh, .glb, .gltf or .vrm; .fbx and .dae where swivel is built with assimp (swivel info)")
        ->required()
        ->check(file_name());
    add_motion(*command, options->motion, "a file without animations is solved in its rest pose");
    command
        ->add_option("--targets", options->targets,
                     "Where wrists, elbows and hands (ankles, knees and feet) must be: 'clip' for the clip's own "
                     "motion, or a CSV "
                     "file with the columns\nframe,character,limb,x,y,z[,pole_x,pole_y,pole_z][,qx,qy,qz,qw], in the "
                     "world; limb is "
                     "left_arm, right_arm, left_leg or right_leg; docs/tables.md says more")
        ->default_str("clip");
    command
        ->add_option(
            "--between", options->between,
            "In frames between a limb's rows: hold the last row, or go on to the next in a linear way; without "
            "it the limb follows the clip there")
        ->check(CLI::IsMember({"hold", "linear"}));
    command
        ->add_option("--export-targets", options->export_targets,
                     "Write the clip's wrists, poles and hands, or those given, as a table to edit and to give back by "
                     "--targets")
        ->check(file_name());
    command
        ->add_option(
            "--crowd", options->crowd,
            "TOML file that says what the crowd is and what is asked of its limbs: goals, weights, reach, limits, "
            "budget; docs/crowd_file.md has every key. Options given here override it")
        ->check(file_name());
    command
        ->add_option("--out", options->out,
                     "Write the poses: as the clip's own format, .bvh or .glb and .gltf (one character; all "
                     "else of the asset is kept), of an FBX or DAE clip .glb and .gltf, or .csv; without it "
                     "statistics only")
        ->check(file_name());
    command
        ->add_option("--limbs", options->kinds,
                     "Which limbs to solve: arms, legs or all, each by --arm and --leg or else by the names in use; "
                     "without it those named alone, or else the arms")
        ->check(CLI::IsMember({"arms", "legs", "all"}));
    add_named_limbs(*command, options->arms, options->legs, "the side that is not named is looked for with --limbs");
    add_characters(*command, options->characters,
                   "Characters, differing in arm lengths, place and start; the first is the clip's own")
        ->default_str("1");
    add_seed(*command, options->seed, "the characters' differences");
    add_threads(*command, options->threads);
    add_json(*command, options->json);
    command->callback([options] { run_solve(*options); });
}

void add_rig(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "rig", "Show what a skeleton is to the solver: its arms and legs, lengths, axes, bends, and what is missing");
    auto options = std::make_shared<RigOptions>();
    command
        ->add_option("file", options->file,
                     "Skeleton, with or without motion: .bvh, .glb, .gltf or .vrm; .fbx and .dae where swivel is built "
                     "with assimp")
        ->required()
        ->check(file_name());
    command->add_option("--limbs", options->kinds, "Which limbs to look for: arms, legs or all")
        ->capture_default_str()
        ->check(CLI::IsMember({"arms", "legs", "all"}));
    add_named_limbs(*command, options->arms, options->legs, "the other side is still looked for");
    add_motion(*command, options->motion,
               "it decides the limits that are printed and, where the rest pose is straight or bends otherwise, bends "
               "and axes");
    command->add_flag("--joints", options->joints, "List every joint, too: number, place at rest in the world, path");
    add_json(*command, options->json);
    command->callback([options] { run_rig(*options); });
}

void add_verify(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("verify", "Check oracle, double, float and every instruction set against each other");
    auto options = std::make_shared<VerifyOptions>();
    command->add_option("--arms", options->arms, "Random arms in each reach band")
        ->capture_default_str()
        ->check(whole_number(1, 1'000'000'000));
    add_seed(*command, options->seed, "the random arms");
    add_json(*command, options->json);
    command->callback([options] { run_verify(*options); });
}

void add_bench(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("bench", "Time solves on this machine beside rivals, copies and the machine's limits");
    auto options = std::make_shared<BenchOptions>();
    command->add_option("--seconds", options->seconds, "Seconds to share among all that is timed")
        ->capture_default_str()
        ->check(number(0.1, 3600));
    add_json(*command, options->json);
    command->footer(
        "Takes about two seconds more, and some 500 MB. For figures to keep, leave the machine alone meanwhile.");
    command->callback([options] { run_bench(*options); });
}

void add_info(CLI::App& app)
{
    CLI::App* command = app.add_subcommand("info", "CPU, instruction set in use, version, build");
    auto options = std::make_shared<InfoOptions>();
    add_json(*command, options->json);
    command->callback([options] { run_info(*options); });
}

// ---- failures

// Of the subcommand, once there is one.
std::string help_command(const CLI::App& app)
{
    const std::vector<CLI::App*> used = app.get_subcommands();
    return used.empty() ? "swivel --help" : fmt::format("swivel {} --help", used.front()->get_name());
}

}  // namespace

int run_swivel(int argc, const char* const* argv)
{
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

}  // namespace swivel::tools

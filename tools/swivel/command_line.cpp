// SPDX-License-Identifier: MIT
//
// The command line: the options of each subcommand, and running one.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <string_view>
#include <vector>

#include "swivel/swivel.hpp"
#include "tools/cli/command_error.h"
#include "tools/cli/command_help.h"
#include "tools/cli/option_checks.h"
#include "tools/cli/streams.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/shared_options.h"

namespace swivel::tools {

namespace {

// ---- the subcommands

void add_demo(CLI::App& app)
{
    const auto [command, options] =
        add_command(app, "demo", "Solve a made-up crowd and report throughput, errors and flags", run_demo);
    add_characters(command, options.characters, ", two arms each")->capture_default_str();
    add_value(command, "--frames", options.frames, whole_number(1, 1'000'000), "Frames, 1 to 1 million")
        ->capture_default_str();
    add_seed(command, options.seed, "the characters' differences");
    add_view(command, options.view);
    add_threads(command, options.threads);
    add_quiet(command, options.quiet);
    add_json(command, options.json);
}

void add_solve(CLI::App& app)
{
    const auto [command, options] = add_command(
        app, "solve", "Solve the arms and legs of a BVH or glTF clip, or of a crowd that performs it", run_solve);
    add_crowd_of_clip(command, options);
    add_file_option(command, "--export-targets", options.export_targets,
                    "Write the clip's wrists and hands, or the goals that are given, as a table to edit and to "
                    "give back by --targets");
    add_file_option(command, "-o,--out", options.out,
                    "Write the poses to .csv, or to the clip's own format, .bvh or .glb, .gltf and .vrm. A .bvh holds "
                    "one character, a glTF file up to 200; all else of the asset is kept. - is standard output, as "
                    "CSV, and the report then goes to standard error. Without it there are statistics only");
    add_view(command, options.view);
    add_frames(command, options.frames);
    add_quiet(command, options.quiet, "Print errors, and what --json and --out - ask for, and nothing else");
    add_json(command, options.json);
}

// The first given option that describes a clip's crowd; empty: none.
std::string option_about_clip(const CLI::App& command)
{
    constexpr std::string_view kOfPages[] = {"FILE", "--out", "--characters", "--threads", "--quiet"};
    for (const CLI::Option* option : command.get_options())
        if (option->count() > 0 && std::ranges::find(kOfPages, option->get_name()) == std::end(kOfPages))
            return option->get_name();
    return {};
}

void add_view_command(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "view", "Write a page that shows the crowd of a clip or a cache, solves it live and lets you drag its limbs");
    auto options = std::make_shared<SolveOptions>();
    add_crowd_of_clip(*command, *options)->required(false);
    add_file_option(*command, "-o,--out", options->view,
                    "The page, to open in a browser; it needs no network and no other file. Without it it is "
                    "named as FILE, with .html, in this folder. - is standard output");
    add_frames(*command, options->frames);
    add_quiet(*command, options->quiet, "Print errors and nothing else");
    command->footer(
        "FILE may also be a cache that swivel store made. Without FILE the page shows 300 figures that walk "
        "over hills.");
    command->callback([options, command] { run_view(*options, option_about_clip(*command)); });
}

void add_feet(CLI::App& app)
{
    const auto [command, options] =
        add_command(app, "feet",
                    "Make the feet of clips stand: find when they are on the ground, and remove their skate", run_feet);
    add_files(command, options.files);
    add_file_option(command, "-o,--out", options.out,
                    "Write the clip with its new legs and its body's new way, in its own format; all else of "
                    "it is kept. For several FILEs, or if it is one already, a folder, where each keeps its "
                    "name and manifest.json has the verdicts. Without it there is a report only");
    command.add_flag("--travel", options.travel,
                     "Move the root of a clip that walks in place, at an even speed, against the slide of its feet");
    add_root_motion(command, options.root_motion);
    command.add_flag("--force", options.force,
                     "Write a clip that is judged to be garbage, too. Without it such a clip is not written, and the "
                     "command fails");
    add_file_option(command, "--contacts", options.contacts,
                    "When feet are on the ground, instead of finding it: a CSV file with the columns "
                    "frame,limb,contact. limb is left_leg or right_leg, contact is on or off from that frame on");
    add_file_option(command, "--export-contacts", options.export_contacts,
                    "Write the contacts that count as such a table, to edit and to give back");
    add_value(command, "--speed", options.speed, number(0.01, 100),
              "A foot is on the ground while its toe is slower than this many leg lengths a second, 0.01 to 100")
        ->capture_default_str();
    add_value(command, "--height", options.height, number(0.001, 10),
              "And while it is lower than this many leg lengths over its floor, 0.001 to 10")
        ->capture_default_str();
    add_file_option(command, "--ground", options.ground,
                    "Hills to put the clip on: a picture of heights, a PNG of 8 or 16 bits. Its middle is at "
                    "the origin, and its upper edge is behind");
    add_value(command, "--ground-size", options.ground_size, numbers(3, 0),
              "How wide the picture is, how high its white, and how deep it is, X,Y,Z, in the clip's unit");
    add_of_body(command, "--leg", "JOINTS", options.legs,
                "Joints of a leg, HIP,KNEE,ANKLE, where their names do not tell. Each is a name, a path or a number "
                "(#12). left: or right: in front sets the side. May be given twice. The other side is still looked "
                "for");
    add_motion(command, options.motion, "It needs even frames, so glTF mostly needs --fps");
    add_quiet_and_json(command, options.quiet, options.json);
}

// The positional CACHE.
void add_cache(CLI::App& command, std::string& folder, const std::string& meaning)
{
    add_value(command, "CACHE", folder, name("name the cache's folder"), meaning)->required()->option_text(" ");
}

void add_store(CLI::App& app)
{
    const auto [command, options] = add_command(
        app, "store", "Make a cache of a clip's crowd: a Zarr folder that any number of machines fill", run_store);
    add_crowd_of_clip(command, options.crowd);
    add_cache(command, options.folder, "The folder to make");
    add_value(command, "--frames", options.crowd.frames, whole_number(1, 1'000'000),
              "Frames of the crowd, 1 to 1 million. Without it those of the clip. More than the clip has play it again "
              "and again");
    add_value(command, "--chunk", options.chunk, name("write FRAMES,CHARACTERS"),
              "Frames and characters in a file, such as 8,4096. Without it by the crowd's size; fewer characters where "
              "a frame depends on those before it, as then a shard has all frames of its characters");
    command.add_flag("--no-poses", options.no_poses,
                     "Keep goals and digests alone, which give the same poses on any machine");
    add_quiet_and_json(command, options.crowd.quiet, options.crowd.json);
    command.footer("Then swivel fill CACHE solves it, here or on many machines, and swivel check CACHE proves it.");
}

// A command that solves chunks.
void add_solver(CLI::App& app, bool proves, const std::string& name, const std::string& meaning, const char* footer)
{
    const auto [command, options] = add_command(app, name, meaning, run_fill);
    options.proves = proves;
    add_cache(command, options.folder, "The folder that swivel store made");
    command.add_option("--shard", options.shard, "The i-th of n parts of the cache alone, as i/n. Without it all")
        ->type_name("i/n");
    add_threads(
        command, options.threads,
        "Threads that solve, up to 1024; 0 for all. Two more wait for the disk, but with 1 no thread is started");
    add_quiet_and_json(command, options.quiet, options.json);
    command.footer(footer);
}

void add_solvers(CLI::App& app)
{
    add_solver(app, false, "fill", "Solve the chunks of a cache, or a shard of them",
               "Chunks that are done are left as they are, so an interrupted run goes on.");
    add_solver(
        app, true, "check", "Prove that every chunk of a cache is right, and mend those that are damaged",
        "All chunks are solved again and compared. Those that are missing or damaged are named and written again, "
        "with exit code 1; run check again then. Where both the digest and the poses are others than the goals "
        "give, nothing is written.");
}

void add_replay(CLI::App& app)
{
    const auto [command, options] =
        add_command(app, "replay", "Compute a part of a cached crowd again, and prove it by digests", run_replay);
    add_cache(command, options.folder, "The cache");
    command
        .add_option("--frames", options.frames,
                    "Frames A to B - 1, as A:B; A: and :B go to the ends, A alone is one frame")
        ->type_name("A:B")
        ->default_str("all");
    command.add_option("--characters", options.characters, "Characters C to D - 1, in the same way")
        ->type_name("C:D")
        ->default_str("all");
    add_file_option(command, "-o,--out", options.out,
                    "Write the poses to this CSV file, - for standard output. The table is that of swivel solve "
                    "without its columns of clavicles; docs/cache.md says more. Without it the poses are proved alone");
    add_threads(command, options.threads);
    add_quiet_and_json(command, options.quiet, options.json);
}

void add_retarget(CLI::App& app)
{
    const auto [command, options] = add_command(
        app, "retarget",
        "Put a clip's motion on another skeleton: joints turn alike, hands and feet reach their places", run_retarget);
    add_file_option(command, "SOURCE", options.files,
                    "Motion files, and as the last file TARGET, the figure that is to move. All are BVH or glTF. "
                    "TARGET's own motion only tells how its feet stand. - is standard input")
        ->required()
        ->option_text("... TARGET");
    add_animation(command, options.clip, options.rate, "Here FILE is SOURCE");
    add_of_body(command, "--rest", "FRAME", options.rests,
                "The frame that is taken as the rest pose, counted from 0, with source: or target: in front. Without "
                "it the file's own, or the most upright frame where that cannot stand");
    add_of_body(command, "--up", "AXIS", options.ups,
                "The axis that is up, x, y, z, -x, -y or -z, with source: or target: in front. The rest pose is then a "
                "frame that stands along it");
    add_file_option(command, "-o,--out", options.out,
                    "TARGET with the motion, in its own format: .bvh, or .glb, .gltf and .vrm. The motion "
                    "replaces that of a BVH file and the first animation of a glTF file, and all else is "
                    "kept. For several SOURCEs, or if it is one already, a folder, where each keeps its name and "
                    "manifest.json has the verdicts. Without it there is the report alone");
    add_root_motion(command, options.root_motion);
    add_named_limbs(command, options.arms, options.legs,
                    "Before that, source: or target: says whose it is, as in source:left:#16,#17,#18");
    add_of_body(command, "--head", "JOINT", options.heads,
                "Joint that is the head, where its name does not tell, with source: or target: in front");
    add_file_option(command, "--map", options.map,
                    "Table of the joints that stand for one another, with the columns part,source,target. "
                    "Without it they are found by their names. - is standard input");
    add_file_option(command, "--export-map", options.export_map,
                    "Write that table as it was found, to edit and to give back by --map, if the command does not "
                    "fail");
    command.add_flag("--force", options.force,
                     "Write a motion that is judged to be garbage, too. Without it such a motion is not written, and "
                     "the command fails");
    add_quiet_and_json(command, options.quiet, options.json);
}

void add_rig(CLI::App& app)
{
    const auto [command, options] = add_command(
        app, "rig",
        "Show what a skeleton is to the solver: its arms and legs, lengths, axes, bends, and what is missing", run_rig);
    options.clip.kinds = "all";
    add_file(command, options.clip.file, "Skeleton, with or without motion");
    add_kinds(command, options.clip.kinds, "Which limbs to look for: arms, legs or all")->capture_default_str();
    add_named_limbs(command, options.clip.arms, options.clip.legs, kOtherSide);
    add_motion(command, options.clip.motion,
               "It decides the limits that are printed. Where the rest pose is straight or bends otherwise, it decides "
               "bends and axes, too");
    command.add_flag("--joints", options.joints, "List every joint, too: number, place at rest in the world, path");
    add_json(command, options.json);
}

void add_inspect(CLI::App& app)
{
    const auto [command, options] = add_command(
        app, "inspect",
        "Say how good clips are, and where not: feet, knees, jumps, axes, unit, loops. Fails for garbage", run_inspect);
    options.clip.kinds = "all";
    add_files(command, options.files, "Several have a line each. ");
    add_named_limbs(command, options.clip.arms, options.clip.legs, kOtherSide);
    add_motion(command, options.clip.motion, "Its feet and loops need even frames, so glTF mostly needs --fps");
    add_quiet_and_json(command, options.quiet, options.json);
}

void add_steps(CLI::App& app)
{
    const auto [command, options] = add_command(
        app, "steps", "Print the lecture's five steps for one arm, entity by entity, as multivectors", run_steps);
    const OptionValue vector = numbers(3, -HUGE_VAL);
    add_value(command, "--target", options.target, vector, "Where the wrist goes, in the arm frame")
        ->capture_default_str();
    add_value(command, "--pole", options.pole, vector, "A point on the elbow's side, in the arm frame")
        ->capture_default_str();
    add_value(command, "--lengths", options.lengths, numbers(2, 0), "Upper arm and forearm")->capture_default_str();
    add_json(command, options.json);
    command.footer(
        "The arm frame has the shoulder at its origin; a straight arm at rest lies along e3. Without any option\n"
        "the arm is the example of docs/mathematics.md. The page of swivel view shows the steps of a clip's limbs.");
}

void add_verify(CLI::App& app)
{
    const auto [command, options] = add_command(
        app, "verify", "Check oracle, double, float and every instruction set against each other", run_verify);
    add_value(command, "--arms", options.arms, whole_number(1, 1'000'000'000),
              "Random arms in each reach band, 1 to 1000 million")
        ->capture_default_str();
    add_seed(command, options.seed, "the random arms");
    add_quiet(command, options.quiet);
    add_json(command, options.json);
}

void add_bench(CLI::App& app)
{
    const auto [command, options] = add_command(app, "bench", "Time solves on this machine beside rivals", run_bench);
    add_value(command, "--seconds", options.seconds, number(0.1, 3600),
              "Seconds to share among all that is timed, 0.1 to 3600")
        ->capture_default_str();
    add_json(command, options.json);
    command.footer(
        "Prints nanoseconds an arm: medians, on one thread but for the rows of threads. Takes some seconds more, and\n"
        "some 500 MB. docs/speed.md says what the rows are. For figures to keep, leave the machine alone meanwhile.");
}

void add_lab(CLI::App& app)
{
    CLI::App& lab = *app.add_subcommand("lab", "For those who work on swivel: the lecture's steps, checks, benchmarks");
    lab.require_subcommand(1);
    add_steps(lab);
    add_verify(lab);
    add_bench(lab);
}

void add_info(CLI::App& app)
{
    const auto [command, options] = add_command(app, "info", "CPU, instruction set in use, version, build", run_info);
    add_json(command, options.json);
}

// ---- the run

// The words of the command line. Those of the lab were commands of their own in 0.2: they still are, with a line that
// says the new way.
std::vector<const char*> words_of(int argc, const char* const* argv)
{
    std::vector<const char*> words(argv, argv + argc);
    const int at = argc > 2 && std::string_view(argv[1]) == "help" ? 2 : 1;
    const std::string_view word = argc > at ? argv[at] : "";
    if (word == "steps" || word == "verify" || word == "bench") {
        say(stderr, "swivel: swivel {0} is now swivel lab {0}; the next version no longer knows the old word\n", word);
        words.insert(words.begin() + at, "lab");
    }
    return words;
}

// Parses and runs the command line. Throws if it fails.
void parse(CLI::App& app, int argc, const char* const* argv)
{
    const std::vector<const char*> words = words_of(argc, argv);
    try {
        app.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::Success& done) {  // --help, --version
        std::ostringstream text;
        app.exit(done, text, text);
        say_text(stdout, text.str());
    } catch (const CLI::ParseError& error) {
        throw CommandError(2, cause_of(app, error));
    } catch (const Error& error) {
        throw CommandError(1, error.status == SWIVEL_OUT_OF_MEMORY ? kNotEnoughMemory : error.what());
    } catch (const std::runtime_error& error) {
        if (!std::string_view(error.what()).starts_with("pthread_create ")) throw;  // so oneTBB begins
        throw CommandError(1, kNotEnoughMemory);
    }
}

void run(int argc, const char* const* argv)
{
    CLI::App app{
        "Solves the arms and legs of crowds: wrist and ankle targets in, joint rotations out, the same bits on every "
        "CPU."};
    app.name("swivel");
    app.set_version_flag(
        "--version", fmt::format("swivel {}.{}.{}", SWIVEL_VERSION_MAJOR, SWIVEL_VERSION_MINOR, SWIVEL_VERSION_PATCH));
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 done, 1 failed, 2 bad usage, above 128: ended by a signal. SWIVEL_FORCE_ISA=NAME forces an "
        "instruction set (swivel info).");
    add_demo(app);
    add_solve(app);
    add_view_command(app);
    add_store(app);
    add_solvers(app);
    add_replay(app);
    add_retarget(app);
    add_rig(app);
    add_inspect(app);
    add_feet(app);
    add_lab(app);
    add_info(app);
    add_help(app);
    parse(app, argc, argv);
}

}  // namespace

int run_swivel(int argc, const char* const* argv)
{
    return run_to_end([&] { run(argc, argv); });
}

}  // namespace swivel::tools

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
    CLI::App* command = app.add_subcommand("demo", "Solve a made-up crowd and report throughput, errors and flags");
    auto options = std::make_shared<DemoOptions>();
    add_characters(*command, options->characters, ", two arms each")->capture_default_str();
    takes(command->add_option("--frames", options->frames, "Frames, 1 to 1 million")->capture_default_str(),
          whole_number(1, 1'000'000));
    add_seed(*command, options->seed, "the characters' differences");
    add_view(*command, options->view);
    add_threads(*command, options->threads);
    add_quiet(*command, options->quiet);
    add_json(*command, options->json);
    command->callback([options] { run_demo(*options); });
}

void add_solve(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("solve", "Solve the arms and legs of a BVH or glTF clip, or of a crowd that performs it");
    auto options = std::make_shared<SolveOptions>();
    add_crowd_of_clip(*command, *options);
    add_file_option(*command, "--export-targets", options->export_targets,
                    "Write the clip's wrists and hands, or the goals that are given, as a table to edit and to "
                    "give back by --targets");
    add_file_option(*command, "-o,--out", options->out,
                    "Write the poses to .csv, or to the clip's own format, .bvh or .glb, .gltf and .vrm. A .bvh "
                    "holds one character, a glTF file up to 200; all else of the asset is kept. - is "
                    "standard output, as CSV, and the report then goes to standard error. Without it there "
                    "are statistics only");
    add_view(*command, options->view);
    add_frames(*command, options->frames);
    add_quiet(*command, options->quiet, "Print errors, and what --json and --out - ask for, and nothing else");
    add_json(*command, options->json);
    command->callback([options] { run_solve(*options); });
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
    CLI::App* command = app.add_subcommand(
        "feet", "Make the feet of clips stand: find when they are on the ground, and remove their skate");
    auto options = std::make_shared<FeetOptions>();
    add_file_option(*command, "FILE", options->files,
                    "Motion files: BVH or glTF (.glb, .gltf, .vrm, .vrma), as their first bytes say. - is "
                    "standard input")
        ->required()
        ->option_text("...");
    add_file_option(*command, "-o,--out", options->out,
                    "Write the clip with its new legs and its body's new way, in its own format; all else of "
                    "it is kept. For several FILEs, or if it is one already, a folder, where each keeps its "
                    "name and manifest.json has the verdicts. Without it there is a report only");
    command->add_flag("--travel", options->travel,
                      "Move the root of a clip that walks in place, at an even speed, against the slide of its feet");
    add_root_motion(*command, options->root_motion);
    command->add_flag("--force", options->force,
                      "Write a clip of a folder that is judged to be garbage, too. Without it such a clip is not "
                      "written, and the command fails");
    add_file_option(*command, "--contacts", options->contacts,
                    "When feet are on the ground, instead of finding it: a CSV file with the columns "
                    "frame,limb,contact. limb is left_leg or right_leg, contact is on or off from that frame "
                    "on");
    add_file_option(*command, "--export-contacts", options->export_contacts,
                    "Write the contacts that count as such a table, to edit and to give back");
    takes(command
              ->add_option("--speed", options->speed,
                           "A foot is on the ground while its toe is slower than this many leg lengths a second, "
                           "0.01 to 100")
              ->capture_default_str(),
          number(0.01, 100));
    takes(command
              ->add_option("--height", options->height,
                           "And while it is lower than this many leg lengths over its floor, 0.001 to 10")
              ->capture_default_str(),
          number(0.001, 10));
    add_file_option(*command, "--ground", options->ground,
                    "Hills to put the clip on: a picture of heights, a PNG of 8 or 16 bits. Its middle is at "
                    "the origin, and its upper edge is behind");
    takes(command->add_option("--ground-size", options->ground_size,
                              "How wide the picture is, how high its white, and how deep it is, X,Y,Z, in the "
                              "clip's unit"),
          numbers(3, 0));
    add_named_legs(*command, options->legs,
                   "Joints of a leg, HIP,KNEE,ANKLE, where their names do not tell. Each is a name, a path or a number "
                   "(#12). left: or right: in front sets the side. May be given twice. The other side is still looked "
                   "for");
    add_motion(*command, options->motion, "It needs even frames, so glTF mostly needs --fps");
    add_quiet(*command, options->quiet, "Print errors, and what --json asks for, and nothing else");
    add_json(*command, options->json);
    command->callback([options] { run_feet(*options); });
}

void add_retarget(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "retarget", "Put a clip's motion on another skeleton: joints turn alike, hands and feet reach their places");
    auto options = std::make_shared<RetargetOptions>();
    add_file_option(*command, "SOURCE", options->files,
                    "Motion files, and as the last file TARGET, the figure that is to move. All are BVH or glTF. "
                    "TARGET's own motion only tells how its feet stand. - is standard input")
        ->required()
        ->option_text("... TARGET");
    add_animation(*command, options->clip, options->rate, "Here FILE is SOURCE");
    const auto add_of_body = [&](const char* name, const char* type, std::vector<std::string>& texts,
                                 const char* meaning) {
        command->add_option(name, texts, meaning)->type_name(type)->allow_extra_args(false);
    };
    add_of_body("--rest", "FRAME", options->rests,
                "The frame that is taken as the rest pose, counted from 0, with source: or target: in front. Without "
                "it the file's own, or the most upright frame where that cannot stand");
    add_of_body("--up", "AXIS", options->ups,
                "The axis that is up, x, y, z, -x, -y or -z, with source: or target: in front. The rest pose is then a "
                "frame that stands along it");
    add_file_option(*command, "-o,--out", options->out,
                    "TARGET with the motion, in its own format: .bvh, or .glb, .gltf and .vrm. The motion "
                    "replaces that of a BVH file and the first animation of a glTF file, and all else is "
                    "kept. For several SOURCEs, or if it is one already, a folder, where each keeps its name and "
                    "manifest.json has the verdicts. Without it there is the report alone");
    add_root_motion(*command, options->root_motion);
    add_named_limbs(*command, options->arms, options->legs,
                    "Before that, source: or target: says whose it is, as in source:left:#16,#17,#18");
    add_of_body("--head", "JOINT", options->heads,
                "Joint that is the head, where its name does not tell, with source: or target: in front");
    add_file_option(*command, "--map", options->map,
                    "Table of the joints that stand for one another, with the columns part,source,target. "
                    "Without it they are found by their names. - is standard input");
    add_file_option(*command, "--export-map", options->export_map,
                    "Write that table as it was found, to edit and to give back by --map, if the command does not "
                    "fail");
    command->add_flag("--force", options->force,
                      "Write a motion that is judged to be garbage, too. Without it such a motion is not written, and "
                      "the command fails");
    add_quiet(*command, options->quiet, "Print errors, and what --json asks for, and nothing else");
    add_json(*command, options->json);
    command->callback([options] { run_retarget(*options); });
}

void add_rig(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "rig", "Show what a skeleton is to the solver: its arms and legs, lengths, axes, bends, and what is missing");
    auto options = std::make_shared<RigOptions>();
    options->clip.kinds = "all";
    add_file(*command, options->clip.file, "Skeleton, with or without motion");
    add_kinds(*command, options->clip.kinds, "Which limbs to look for: arms, legs or all")->capture_default_str();
    add_named_limbs(*command, options->clip.arms, options->clip.legs, "The other side is still looked for");
    add_motion(*command, options->clip.motion,
               "It decides the limits that are printed. Where the rest pose is straight or bends otherwise, it decides "
               "bends and axes, too");
    command->add_flag("--joints", options->joints, "List every joint, too: number, place at rest in the world, path");
    add_json(*command, options->json);
    command->callback([options] { run_rig(*options); });
}

void add_inspect(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "inspect", "Say how good clips are, and where not: feet, knees, jumps, axes, unit, loops. Fails for garbage");
    auto options = std::make_shared<InspectOptions>();
    options->clip.kinds = "all";
    add_file_option(*command, "FILE", options->files,
                    "Motion files: BVH or glTF (.glb, .gltf, .vrm, .vrma), as their first bytes say. Several have a "
                    "line each. - is standard input")
        ->required()
        ->option_text("...");
    add_named_limbs(*command, options->clip.arms, options->clip.legs, "The other side is still looked for");
    add_motion(*command, options->clip.motion, "Its feet and loops need even frames, so glTF mostly needs --fps");
    add_quiet(*command, options->quiet, "Print errors, and what --json asks for, and nothing else");
    add_json(*command, options->json);
    command->callback([options] { run_inspect(*options); });
}

void add_steps(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("steps", "Print the lecture's five steps for one arm, entity by entity, as multivectors");
    auto options = std::make_shared<StepsOptions>();
    const auto add = [&](const char* name, std::string& text, const OptionValue& value, const char* meaning) {
        takes(command->add_option(name, text, meaning)->capture_default_str(), value);
    };
    const OptionValue vector = numbers(3, -HUGE_VAL);
    add("--target", options->target, vector, "Where the wrist goes, in the arm frame");
    add("--pole", options->pole, vector, "A point on the elbow's side, in the arm frame");
    add("--lengths", options->lengths, numbers(2, 0), "Upper arm and forearm");
    add_json(*command, options->json);
    command->footer(
        "The arm frame has the shoulder at its origin; a straight arm at rest lies along e3. Without any option\n"
        "the arm is the example of docs/mathematics.md. The page of swivel view shows the steps of a clip's limbs.");
    command->callback([options] { run_steps(*options); });
}

void add_verify(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("verify", "Check oracle, double, float and every instruction set against each other");
    auto options = std::make_shared<VerifyOptions>();
    takes(command->add_option("--arms", options->arms, "Random arms in each reach band, 1 to 1000 million")
              ->capture_default_str(),
          whole_number(1, 1'000'000'000));
    add_seed(*command, options->seed, "the random arms");
    add_quiet(*command, options->quiet);
    add_json(*command, options->json);
    command->callback([options] { run_verify(*options); });
}

void add_bench(CLI::App& app)
{
    CLI::App* command = app.add_subcommand("bench", "Time solves on this machine beside rivals");
    auto options = std::make_shared<BenchOptions>();
    takes(command->add_option("--seconds", options->seconds, "Seconds to share among all that is timed, 0.1 to 3600")
              ->capture_default_str(),
          number(0.1, 3600));
    add_json(*command, options->json);
    command->footer(
        "Prints nanoseconds an arm: medians, on one thread but for the rows of threads. Takes some seconds more, and\n"
        "some 500 MB. docs/speed.md says what the rows are. For figures to keep, leave the machine alone meanwhile.");
    command->callback([options] { run_bench(*options); });
}

void add_info(CLI::App& app)
{
    CLI::App* command = app.add_subcommand("info", "CPU, instruction set in use, version, build");
    auto options = std::make_shared<InfoOptions>();
    add_json(*command, options->json);
    command->callback([options] { run_info(*options); });
}

void add_lab(CLI::App& app)
{
    CLI::App* lab = app.add_subcommand("lab", "For those who work on swivel: the lecture's steps, checks, benchmarks");
    lab->require_subcommand(1);
    add_steps(*lab);
    add_verify(*lab);
    add_bench(*lab);
}

// ---- the run

// The words of the command line. Those of the lab were commands of their own in 0.2: they still are, with a line that
// says the new way.
std::vector<const char*> words_of(int argc, const char* const* argv)
{
    std::vector<const char*> words(argv, argv + argc);
    const std::string_view word = argc > 1 ? argv[1] : "";
    if (word == "steps" || word == "verify" || word == "bench") {
        say(stderr, "swivel: swivel {0} is now swivel lab {0}; the next version no longer knows the old word\n", word);
        words.insert(words.begin() + 1, "lab");
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
    add_cache_commands(app);
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

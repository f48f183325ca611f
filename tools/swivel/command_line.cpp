// SPDX-License-Identifier: MIT
//
// Reads the command line. Options that several subcommands have come first: one name, one wording and one range for
// each.
#include "tools/swivel/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <sstream>
#include <string_view>

#include "swivel/swivel.hpp"
#include "tools/cli/command_error.h"
#include "tools/cli/command_help.h"
#include "tools/cli/option_checks.h"
#include "tools/cli/streams.h"
#include "tools/swivel/commands.h"

namespace swivel::tools {

namespace {

// ---- options of several subcommands

// Value: std::uint32_t, or an optional of it.
template <class Value>
CLI::Option* add_characters(CLI::App& command, Value& characters, const std::string& meaning)
{
    return takes(command.add_option("--characters", characters, "Characters, 1 to 10 million" + meaning),
                 whole_number(1, 10'000'000));
}

// Value: std::uint64_t, or an optional of it; 1 where it is not given.
template <class Value>
CLI::Option* add_seed(CLI::App& command, Value& seed, const std::string& of)
{
    return takes(command.add_option("--seed", seed, "Seed of " + of)->default_str("1"), whole_number(0, UINT64_MAX));
}

CLI::Option* add_threads(CLI::App& command, unsigned& threads,
                         const char* meaning = "Threads at most, up to 1024; 0 for all")
{
    return takes(command.add_option("--threads", threads, meaning)->capture_default_str(), whole_number(0, 1024));
}

CLI::Option* add_json(CLI::App& command, bool& json) { return command.add_flag("--json", json, "Print JSON"); }

CLI::Option* add_quiet(CLI::App& command, bool& quiet, const std::string& meaning = "Show no progress")
{
    return command.add_flag("--quiet", quiet, meaning);
}

// The positional FILE.
void add_file(CLI::App& command, std::string& file, const std::string& meaning)
{
    takes(command.add_option(
              "FILE", file,
              meaning + ": .bvh, .glb, .gltf or .vrm. - is standard input, BVH or glTF as its first bytes say"),
          file_name())
        ->required()
        ->option_text(" ");
}

CLI::Option* add_kinds(CLI::App& command, std::string& kinds, const std::string& meaning)
{
    return takes(command.add_option("--limbs", kinds, meaning), one_of({"arms", "legs", "all"}));
}

// --clip and --fps; use: what the animation is there for.
void add_motion(CLI::App& command, MotionChoice& motion, const std::string& use)
{
    takes(command.add_option("--clip", motion.clip,
                             "Which animation of a glTF FILE, by name or, counted from 0, by index. "
                             "Without it the first. " +
                                 use),
          name("name an animation, or leave the option out for the first"));
    takes(command.add_option("--fps", motion.rate,
                             "Even frames a second of a glTF animation, 0.001 to 10000. Without it the limbs' own keys "
                             "(docs/motion_files.md)"),
          number(0.001, 10'000));
}

// --arm and --leg; other_side: what becomes of the one that is not named.
void add_named_limbs(CLI::App& command, std::vector<std::string>& arms, std::vector<std::string>& legs,
                     const std::string& other_side)
{
    command
        .add_option("--arm", arms,
                    "Joints of an arm, SHOULDER,ELBOW,WRIST, where their names do not tell. Each is a name, a path or "
                    "a number (#12). left: or right: in front sets the side. May be given twice. " +
                        other_side)
        ->type_name("JOINTS")
        ->allow_extra_args(false);
    command.add_option("--leg", legs, "Joints of a leg, HIP,KNEE,ANKLE, in the same way")
        ->type_name("JOINTS")
        ->allow_extra_args(false);
}

void add_view(CLI::App& command, std::string& view)
{
    takes(command.add_option("--view", view,
                             "Also write a page that shows the crowd in a browser and solves it live: swivel help "
                             "view. - is standard output"),
          file_name());
}

void add_report(CLI::App& command, std::string& report, const std::string& what)
{
    takes(command.add_option("--report", report, "Also write a report as one HTML file: " + what), file_name());
}

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

// The clip, its crowd and what is asked of it.
void add_crowd_of_clip(CLI::App& command, SolveOptions& options)
{
    add_file(command, options.file, "Motion file");
    add_motion(command, options.motion, "A file without animations is solved in its rest pose");
    takes(command
              .add_option("--targets", options.targets,
                          "Where wrists, elbows and hands (ankles, knees and feet) must be. 'clip' is the clip's own "
                          "motion. A CSV file has the columns\nframe,character,limb,x,y,z[,pole_x,pole_y,pole_z]"
                          "[,qx,qy,qz,qw], in the world. limb is left_arm, right_arm, left_leg or right_leg. - is "
                          "standard input. docs/tables.md says more")
              ->default_str("clip"),
          file_name());
    takes(command.add_option("--between", options.between,
                             "In frames between a limb's rows, hold the last row, or go on to the next in a linear "
                             "way. Without it the limb follows the clip there"),
          one_of({"hold", "linear"}));
    takes(command.add_option("--crowd", options.crowd,
                             "TOML file that says what the crowd is and what is asked of its limbs: goals, weights, "
                             "reach, limits, budget. docs/crowd_file.md has every key. Options given here override "
                             "it. - is standard input"),
          file_name());
    add_kinds(command, options.kinds,
              "Which limbs to solve: arms, legs or all. Each is named by --arm or --leg, or found by the names in use. "
              "Without it those named alone, or else the arms");
    add_named_limbs(command, options.arms, options.legs, "With --limbs the side that is not named is looked for");
    add_characters(command, options.characters,
                   ", differing in arm lengths, place and start; the first is the clip's own")
        ->default_str("1");
    add_seed(command, options.seed, "the characters' differences");
    add_threads(command, options.threads);
}

void add_solve(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("solve", "Solve the arms and legs of a BVH or glTF clip, or of a crowd that performs it");
    auto options = std::make_shared<SolveOptions>();
    add_crowd_of_clip(*command, *options);
    takes(command->add_option("--export-targets", options->export_targets,
                              "Write the clip's wrists, poles and hands, or those given, as a table to edit and to "
                              "give back by --targets"),
          file_name());
    CLI::Option* out =
        takes(command->add_option(
                  "-o,--out", options->out,
                  "Write the poses to .csv, or to the clip's own format, .bvh or .glb, .gltf and .vrm. A motion "
                  "file holds one character and keeps all else of the asset. - is standard output, and the "
                  "report then goes to standard error. Without it "
                  "there are statistics only"),
              file_name());
    takes(command->add_option("--format", options->format,
                              "Format of --out. Without it the suffix says it; standard output is CSV"),
          one_of({"csv", "bvh", "glb", "gltf"}))
        ->needs(out);
    add_view(*command, options->view);
    add_report(*command, options->report,
               "errors, flags over time and the worst limbs, which link into the page of --view. - is standard output");
    command->add_flag("--strict", options->strict,
                      "Fail with exit code 1, after writing --out, if most limbs are out of reach or have bad input. "
                      "Without it a note says so");
    add_quiet(*command, options->quiet, "Print errors, and what --json and --out - ask for, and nothing else");
    add_json(*command, options->json);
    command->callback([options] { run_solve(*options); });
}

// The first option given that says what a clip's crowd is. Empty: none is.
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
    options->view_option = "--out";
    add_crowd_of_clip(*command, *options);
    takes(command->add_option("-o,--out", options->view,
                              "The page, to open in a browser; it needs no network and no other file. Without it it is "
                              "named as FILE, with .html, in this folder. - is standard output"),
          file_name());
    takes(command->add_option("--frames", options->frames,
                              "Frames of the clip at most, from the first, 1 to 1 million. Without it all. Fewer make "
                              "a smaller page"),
          whole_number(1, 1'000'000));
    add_quiet(*command, options->quiet, "Print errors and nothing else");
    command->footer("FILE may also be a cache that swivel store made.");
    command->callback([options, command] { run_view(*options, option_about_clip(*command)); });
}

void add_memory(CLI::App& command, std::string& memory)
{
    takes(command.add_option("--memory", memory, "Memory at most, such as 512M or 4G, whatever the crowd's size")
              ->capture_default_str(),
          bytes());
}

// Of a cache that is filled.
CLI::Option* add_solving_threads(CLI::App& command, unsigned& threads)
{
    return add_threads(command, threads, "Threads that solve, up to 1024; 0 for all. Two more wait for the disk");
}

// The positional CACHE.
void add_cache(CLI::App& command, std::string& folder, const std::string& meaning)
{
    takes(command.add_option("CACHE", folder, meaning), name("name the cache's folder"))->required()->option_text(" ");
}

void add_store(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("store", "Make a cache of a clip's crowd: a Zarr folder that any number of machines fill");
    auto options = std::make_shared<StoreOptions>();
    add_crowd_of_clip(*command, options->crowd);
    add_cache(*command, options->folder, "The folder to make");
    takes(command->add_option("--frames", options->crowd.frames,
                              "Frames of the crowd, 1 to 1 million. Without it those of the clip. More than the clip "
                              "has play it again and again"),
          whole_number(1, 1'000'000));
    takes(command
              ->add_option("--store", options->keep,
                           "What the cache keeps once it is closed: goals, which give the same poses on any machine, "
                           "poses, or both")
              ->capture_default_str(),
          one_of({"goals", "poses", "both"}));
    takes(command->add_option("--chunk", options->chunk,
                              "Frames and characters in a file, such as 8,4096. Without it by the crowd's size"),
          name("write FRAMES,CHARACTERS"));
    command->add_flag("--compress", options->compressed, "Pack chunks by Blosc");
    add_quiet(*command, options->crowd.quiet, "Print errors, and what --json asks for, and nothing else");
    add_json(*command, options->crowd.json);
    command->footer("Then swivel fill CACHE solves it, here or on many machines, and swivel check CACHE proves it.");
    command->callback([options] { run_store(*options); });
}

void add_fill(CLI::App& app)
{
    CLI::App* command = app.add_subcommand("fill", "Solve the chunks of a cache, or a shard of them");
    auto options = std::make_shared<FillCommand>();
    add_cache(*command, options->folder, "The folder that swivel store made");
    command
        ->add_option("--shard", options->shard,
                     "Which part this process fills: i/n for the i-th of n, or auto, which reads the variables that "
                     "Slurm and MPI set. Without it all")
        ->type_name("i/n|auto");
    command->add_flag("--resume", options->resumes, "Go on: leave chunks that are done");
    command->add_flag("--verify", options->verifies,
                      "Go on: solve chunks that are done, too, and write those again that differ. They are named, "
                      "unless it is quiet, and are no error");
    add_memory(*command, options->memory);
    add_solving_threads(*command, options->threads);
    add_quiet(*command, options->quiet, "Print errors, and what --json asks for, and nothing else");
    add_json(*command, options->json);
    command->callback([options] { run_fill(*options); });
}

void add_check(CLI::App& app)
{
    CLI::App* command = app.add_subcommand("check", "Prove that every chunk of a cache is right, and close it");
    auto options = std::make_shared<CheckOptions>();
    add_cache(*command, options->folder, "The folder that swivel store made");
    add_memory(*command, options->memory);
    add_solving_threads(*command, options->threads);
    add_quiet(*command, options->quiet, "Print errors, and what --json asks for, and nothing else");
    add_json(*command, options->json);
    command->footer("All chunks are solved again and compared. A chunk that differs is named and written again.");
    command->callback([options] { run_check(*options); });
}

void add_replay(CLI::App& app)
{
    CLI::App* command = app.add_subcommand("replay", "Compute a part of a cached crowd again, and prove it by digests");
    auto options = std::make_shared<ReplayOptions>();
    add_cache(*command, options->folder, "The cache");
    command->add_option("--frames", options->frames, "Frames A:B, from A on, up to B without it")
        ->type_name("A:B")
        ->default_str("all");
    command->add_option("--characters", options->characters, "Characters C:D, in the same way")
        ->type_name("C:D")
        ->default_str("all");
    takes(command->add_option("-o,--out", options->out,
                              "Write the poses to this CSV file, - for standard output. The table is that of swivel "
                              "solve without its columns of clavicles; docs/cache.md says more. Without it the poses "
                              "are proved alone"),
          file_name());
    add_threads(*command, options->threads);
    add_quiet(*command, options->quiet, "Print errors, and what --json asks for, and nothing else");
    add_json(*command, options->json);
    command->callback([options] { run_replay(*options); });
}

void add_rig(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "rig", "Show what a skeleton is to the solver: its arms and legs, lengths, axes, bends, and what is missing");
    auto options = std::make_shared<RigOptions>();
    add_file(*command, options->file, "Skeleton, with or without motion");
    add_kinds(*command, options->kinds, "Which limbs to look for: arms, legs or all")->capture_default_str();
    add_named_limbs(*command, options->arms, options->legs, "The other side is still looked for");
    add_motion(*command, options->motion,
               "It decides the limits that are printed. Where the rest pose is straight or bends otherwise, it decides "
               "bends and axes, too");
    command->add_flag("--joints", options->joints, "List every joint, too: number, place at rest in the world, path");
    command->add_flag("--toml", options->toml,
                      "Print the limbs that bind as a crowd file, their joints and bends, for swivel solve --crowd");
    add_json(*command, options->json);
    command->callback([options] { run_rig(*options); });
}

void add_steps(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("steps", "Print the lecture's five steps for one arm, entity by entity, as multivectors");
    auto options = std::make_shared<StepsOptions>();
    const auto vector = [] { return numbers(3, -HUGE_VAL); };
    CLI::Option* file =
        takes(command->add_option("FILE", options->file,
                                  "A clip, instead of an arm by its numbers: .bvh, .glb, .gltf or .vrm. "
                                  "- is standard input"),
              file_name())
            ->option_text(" ");
    takes(command->add_option("--target", options->target, "Where the wrist goes, in the arm frame")
              ->capture_default_str(),
          vector())
        ->excludes(file);
    takes(command->add_option("--pole", options->pole, "A point on the elbow's side, in the arm frame")
              ->capture_default_str(),
          vector())
        ->excludes(file);
    takes(command->add_option("--lengths", options->lengths, "Upper arm and forearm")->capture_default_str(),
          numbers(2, 0))
        ->excludes(file);
    takes(command->add_option("--limb", options->limb, "Which limb of the clip")->capture_default_str(),
          one_of({"left_arm", "right_arm", "left_leg", "right_leg"}))
        ->needs(file);
    takes(command->add_option("--frame", options->frame, "Which frame of the clip, counted from 0")
              ->capture_default_str(),
          whole_number(0, 1'000'000'000))
        ->needs(file);
    add_named_limbs(*command, options->arms, options->legs, "Without it names in use tell the joints");
    add_motion(*command, options->motion, "A file without animations has its rest pose alone");
    for (const char* about_file : {"--arm", "--leg", "--clip", "--fps"}) command->get_option(about_file)->needs(file);
    add_json(*command, options->json);
    command->footer(
        "The arm frame has the shoulder at its origin; a straight arm at rest lies along e3. Without any option\n"
        "the arm is the example of docs/mathematics.md.");
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
    add_report(*command, options->report, "checks, errors by band of reach, digests");
    add_quiet(*command, options->quiet);
    add_json(*command, options->json);
    command->callback([options] { run_verify(*options); });
}

void add_bench(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("bench", "Time solves on this machine beside rivals, copies and the machine's limits");
    auto options = std::make_shared<BenchOptions>();
    takes(command->add_option("--seconds", options->seconds, "Seconds to share among all that is timed, 0.1 to 3600")
              ->capture_default_str(),
          number(0.1, 3600));
    add_report(*command, options->report, "rivals, speed by size of the crowd, roofline");
    add_quiet(*command, options->quiet);
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

// ---- the run

// What takes less memory, by the options that the command has.
std::string memory_advice(const CLI::App& app, bool is_thread)
{
    const std::vector<CLI::App*> commands = app.get_subcommands();
    const auto has = [&](const char* option) {
        return !commands.empty() && commands[0]->get_option_no_throw(option) != nullptr;
    };
    std::vector<std::string> ways;
    if (is_thread && has("--threads")) ways.push_back("--threads 1");
    if (has("--characters")) ways.push_back("fewer --characters");
    if (has("FILE")) ways.push_back("a shorter clip");
    return fmt::format("{}{}{}{}", kNotEnoughMemory, is_thread ? " to start a thread" : "",
                       ways.empty() ? "" : "; try ", fmt::join(ways, " or "));
}

// Lets the words do what they say. Throws whatever fails.
void parse(CLI::App& app, int argc, const char* const* argv)
{
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& done) {  // --help, --version
        std::ostringstream text;
        app.exit(done, text, text);
        say_text(stdout, text.str());
    } catch (const CLI::ParseError& error) {
        throw CommandError(2, cause_of(app, error));
    } catch (const std::bad_alloc&) {
        throw CommandError(1, memory_advice(app, false));
    } catch (const Error& error) {
        if (error.status != SWIVEL_OUT_OF_MEMORY) throw;
        throw CommandError(1, memory_advice(app, false));
    } catch (const std::runtime_error& error) {
        if (!std::string_view(error.what()).starts_with("pthread_create ")) throw;  // so oneTBB begins
        throw CommandError(1, memory_advice(app, true));
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
    add_fill(app);
    add_check(app);
    add_replay(app);
    add_rig(app);
    add_steps(app);
    add_verify(app);
    add_bench(app);
    add_info(app);
    add_completion(app);
    add_help(app);
    parse(app, argc, argv);
}

}  // namespace

int run_swivel(int argc, const char* const* argv)
{
    return run_to_end([&] { run(argc, argv); });
}

}  // namespace swivel::tools

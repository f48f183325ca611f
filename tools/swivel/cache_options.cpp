// SPDX-License-Identifier: MIT
//
// The command line of caches: store, fill, check, replay.
#include <memory>

#include "tools/swivel/commands.h"
#include "tools/swivel/shared_options.h"

namespace swivel::tools {

namespace {

constexpr const char* kQuiet = "Print errors, and what --json asks for, and nothing else";

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
    takes(command->add_option("--chunk", options->chunk,
                              "Frames and characters in a file, such as 8,4096. Without it by the crowd's size; fewer "
                              "characters where a frame depends on those before it, as then a shard has all frames "
                              "of its characters"),
          name("write FRAMES,CHARACTERS"));
    command->add_flag("--no-poses", options->no_poses,
                      "Keep goals and digests alone, which give the same poses on any machine");
    add_quiet(*command, options->crowd.quiet, kQuiet);
    add_json(*command, options->crowd.json);
    command->footer("Then swivel fill CACHE solves it, here or on many machines, and swivel check CACHE proves it.");
    command->callback([options] { run_store(*options); });
}

// A command that solves chunks.
void add_solver(CLI::App& app, bool proves, const std::string& name, const std::string& meaning, const char* footer)
{
    CLI::App* command = app.add_subcommand(name, meaning);
    auto options = std::make_shared<FillCommand>();
    options->proves = proves;
    add_cache(*command, options->folder, "The folder that swivel store made");
    command->add_option("--shard", options->shard, "The i-th of n parts of the cache alone, as i/n. Without it all")
        ->type_name("i/n");
    add_threads(
        *command, options->threads,
        "Threads that solve, up to 1024; 0 for all. Two more wait for the disk, but with 1 no thread is started");
    add_quiet(*command, options->quiet, kQuiet);
    add_json(*command, options->json);
    command->footer(footer);
    command->callback([options] { run_fill(*options); });
}

void add_replay(CLI::App& app)
{
    CLI::App* command = app.add_subcommand("replay", "Compute a part of a cached crowd again, and prove it by digests");
    auto options = std::make_shared<ReplayOptions>();
    add_cache(*command, options->folder, "The cache");
    command
        ->add_option("--frames", options->frames,
                     "Frames A to B - 1, as A:B; A: and :B go to the ends, A alone is one frame")
        ->type_name("A:B")
        ->default_str("all");
    command->add_option("--characters", options->characters, "Characters C to D - 1, in the same way")
        ->type_name("C:D")
        ->default_str("all");
    add_file_option(*command, "-o,--out", options->out,
                    "Write the poses to this CSV file, - for standard output. The table is that of swivel "
                    "solve without its columns of clavicles; docs/cache.md says more. Without it the poses "
                    "are proved alone");
    add_threads(*command, options->threads);
    add_quiet(*command, options->quiet, kQuiet);
    add_json(*command, options->json);
    command->callback([options] { run_replay(*options); });
}

}  // namespace

void add_cache_commands(CLI::App& app)
{
    add_store(app);
    add_solver(app, false, "fill", "Solve the chunks of a cache, or a shard of them",
               "Chunks that are done are left as they are, so an interrupted run goes on.");
    add_solver(
        app, true, "check", "Prove that every chunk of a cache is right, and mend those that are damaged",
        "All chunks are solved again and compared. Those that are missing or damaged are named and written again, "
        "with exit code 1; run check again then. Where both the digest and the poses are others than the goals "
        "give, nothing is written.");
    add_replay(app);
}

}  // namespace swivel::tools

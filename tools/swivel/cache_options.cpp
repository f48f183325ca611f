// SPDX-License-Identifier: MIT
#include "tools/swivel/cache_options.h"

#include <memory>

#include "tools/swivel/commands.h"
#include "tools/swivel/shared_options.h"

namespace swivel::tools {

namespace {

void add_memory(CLI::App& command, std::string& memory)
{
    takes(command.add_option("--memory", memory, "Memory at most, such as 512M or 4G, whatever the crowd's size")
              ->capture_default_str(),
          bytes());
}

// Of a cache that is filled.
CLI::Option* add_solving_threads(CLI::App& command, unsigned& threads)
{
    return add_threads(
        command, threads,
        "Threads that solve, up to 1024; 0 for all. Two more wait for the disk, but with 1 no thread is started");
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
    command->footer(
        "All chunks are solved again and compared. Those that differ are named and written again, with exit code 1; "
        "run check again then. If more than half of them differ, the goals are suspected, and nothing is written. A "
        "closed cache of poses is compared with its digests.");
    command->callback([options] { run_check(*options); });
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
    takes(command->add_option("-o,--out", options->out,
                              "Write the poses to this CSV file, - for standard output. The table is that of swivel "
                              "solve without its columns of clavicles; docs/cache.md says more. Without it the poses "
                              "are proved alone"),
          file_name());
    add_memory(*command, options->memory);
    add_threads(*command, options->threads);
    add_quiet(*command, options->quiet, "Print errors, and what --json asks for, and nothing else");
    add_json(*command, options->json);
    command->callback([options] { run_replay(*options); });
}

}  // namespace

void add_cache_commands(CLI::App& app)
{
    add_store(app);
    add_fill(app);
    add_check(app);
    add_replay(app);
}

}  // namespace swivel::tools

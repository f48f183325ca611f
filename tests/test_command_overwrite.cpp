// SPDX-License-Identifier: MIT
//
// The promise: no output of `solve` replaces a file that it reads. The exit code is 2, one line says why, and every
// file keeps its bytes.
#include <fcntl.h>
#include <unistd.h>
#include <catch2/catch.hpp>

#include <nlohmann/json.hpp>
#include <random>

#include "tests/plain_motion.h"
#include "tests/random_figure.h"
#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Catch::Matchers::Contains;

TEST_CASE("overwrite: what is read is never written over")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    spill(folder / "t.csv", kColumns + kGoodRow);
    spill(folder / "c.csv", "[crowd]\n");
    fs::create_hard_link(folder / "t.csv", folder / "same.csv");
    const auto before = contents(folder.path);
    for (const auto& [out, what] : {std::pair("clip.bvh", "the clip"),
                                    {"./clip.bvh", "the clip"},
                                    {"t.csv", "the table of targets"},
                                    {"same.csv", "the table of targets"},
                                    {"c.csv", "the crowd file"}})
        for (const char* const option : {"--out", "--export-targets", "--view"}) {
            const Outcome outcome =
                run_command(folder.path, {"solve", "clip.bvh", "--targets", "t.csv", "--crowd", "c.csv", option, out});
            CHECK(outcome.exit_code == 2);
            CHECK(outcome.err ==
                  "swivel: " + std::string(out) + ": is " + what + ", too; name another file to write\n");
            CHECK(contents(folder.path) == before);
        }
}

TEST_CASE("overwrite: a file that stands on standard input is never written over")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    spill(folder / "t.csv", kColumns + kGoodRow);
    spill(folder / "c.csv", "[crowd]\n");
    spill(folder / "reads.toml", "[crowd]\ntargets = \"-\"\n");
    fs::create_hard_link(folder / "t.csv", folder / "same.csv");
    const auto before = contents(folder.path);
    const auto run = [&](const char* input, Words words) {
        Surroundings piped;
        piped.before = [input] { ::dup2(::open(input, O_RDONLY | O_CLOEXEC), STDIN_FILENO); };
        words.insert(words.begin(), {"solve", "--quiet"});
        return spawn_command(folder.path, words, piped);
    };
    const auto refused = [&](const char* input, const Words& words, const std::string& said) {
        const Outcome outcome = run(input, words);
        INFO(said << ": " << outcome.err);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err == "swivel: " + said + ", too; name another file to write\n");
        CHECK(contents(folder.path) == before);
    };
    refused("clip.bvh", {"-", "--out", "clip.bvh"}, "clip.bvh: is the clip");
    refused("clip.bvh", {"-", "--export-targets", "clip.bvh"}, "clip.bvh: is the clip");
    refused("t.csv", {"clip.bvh", "--targets", "-", "--out", "same.csv"}, "same.csv: is the table of targets");
    refused("t.csv", {"clip.bvh", "--targets", "-", "--export-targets", "./t.csv"}, "./t.csv: is the table of targets");
    refused("t.csv", {"clip.bvh", "--crowd", "reads.toml", "--out", "t.csv"}, "t.csv: is the table of targets");
    refused("c.csv", {"clip.bvh", "--crowd", "-", "--out", "c.csv"}, "c.csv: is the crowd file");
    // What is not read, and another file, may be written.
    CHECK(run("clip.bvh", {"-", "--out", "-", "--export-targets", "new.csv"}).exit_code == 0);
    CHECK(run("c.csv", {"clip.bvh", "--out", "c.csv"}).exit_code == 0);
}

TEST_CASE("overwrite: the buffers and images that a clip uses are never written over")
{
    const TempFolder folder;
    fs::create_directory(folder / "art");
    std::mt19937 random(7);
    Figure figure = random_figure(random, {}, figure_names()[0]);
    figure.rig.json["images"] = {{{"uri", "art/s%20kin.png"}}, {{"uri", "gone.csv"}}};
    figure.rig.write(folder / "f.gltf");
    spill(folder / "art/s kin.png", "a picture");
    const std::string buffer = nlohmann::json::parse(slurp(folder / "f.gltf")).at("buffers")[0].at("uri");
    fs::create_symlink(buffer, folder / "link");
    const auto before = contents(folder.path);
    for (const std::string& file : Words{buffer, "./link", "art/../art/s kin.png", "gone.csv"}) {
        const Outcome outcome = run_command(folder.path, {"solve", "f.gltf", "--export-targets", file});
        CHECK(outcome.exit_code == 2);
        CHECK_THAT(outcome.err, Contains(file + ": is a buffer or image of the clip, too"));
        CHECK(contents(folder.path) == before);
    }
    CHECK(run_command(folder.path, {"solve", "f.gltf", "--out", "art/out.csv"}).exit_code == 0);
}

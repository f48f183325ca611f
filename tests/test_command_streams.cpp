// SPDX-License-Identifier: MIT
//
// The command in a pipe. Clips, tables and crowd files come from standard input, poses go to standard output with
// nothing between them. Runs may say nothing.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <random>

#include "tests/pipe_stage.h"
#include "tests/random_figure.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("streams: a BVH clip, a table and a crowd file may come from standard input")
{
    const PipeStage stage;
    const std::string plain = stage.written({"clip.bvh", "--out", "a.csv"}),
                      table = stage.written({"clip.bvh", "--targets", "t.csv", "--out", "b.csv"}),
                      crowd = stage.written({"clip.bvh", "--crowd", "c.toml", "--out", "c.csv"});
    CHECK(plain != table);
    CHECK(stage.run({"-", "--out", "x.csv"}, kTwoArms).exit_code == 0);
    CHECK(slurp(stage.folder / "x.csv") == plain);
    CHECK(stage.run({"-", "--out", "x.csv"}, "\xEF\xBB\xBF\n" + kTwoArms).exit_code == 0);
    CHECK(slurp(stage.folder / "x.csv") == plain);
    CHECK(stage.run({"clip.bvh", "--targets", "-", "--out", "x.csv"}, kPipeTable).exit_code == 0);
    CHECK(slurp(stage.folder / "x.csv") == table);
    CHECK(stage.run({"clip.bvh", "--crowd", "-", "--out", "x.csv"}, "[limb.arms]\nhand = false\n").exit_code == 0);
    CHECK(slurp(stage.folder / "x.csv") == crowd);
    spill(stage.folder / "in.toml", "[crowd]\ntargets = \"-\"\n");
    CHECK(stage.run({"clip.bvh", "--crowd", "in.toml", "--out", "x.csv"}, kPipeTable).exit_code == 0);
    CHECK(slurp(stage.folder / "x.csv") == table);
    CHECK_THAT(run_command(stage.folder.path, {"rig", "-"}, kTwoArms).out, Contains("LeftForeArm"));
}

TEST_CASE("streams: a glTF clip may come from standard input, and goes to a file of each of its suffixes")
{
    const PipeStage stage;
    std::mt19937 random(7);
    const Figure figure = random_figure(random, {}, figure_names()[0]);
    figure.rig.write(stage.folder / "f.glb");
    const std::string glb = slurp(stage.folder / "f.glb"), csv = stage.written({"f.glb", "--out", "own.csv"});
    CHECK((stage.run({"-", "-o", "-"}, glb).out == csv));
    for (const std::string suffix : {"glb", "vrm", "gltf"}) {
        const std::string file = stage.written({"f.glb", "--out", "own." + suffix});
        CHECK(file.starts_with("glTF") == (suffix != "gltf"));
        const std::string again = stage.written({"own." + suffix, "--out", "again.csv"});
        CHECK((stage.run({"-", "-o", "-"}, file).out == again));
    }
}

TEST_CASE("streams: with poses on standard output reports are on standard error, and --quiet leaves none")
{
    const PipeStage stage;
    const std::string csv = stage.written({"clip.bvh", "--out", "a.csv"});
    const Outcome text = stage.run({"clip.bvh", "--out", "-"});
    CHECK(text.out == csv);
    CHECK_THAT(text.err, StartsWith("clip ") && Contains("solved ") && Contains("written  to standard output"));
    const Outcome json = stage.run({"clip.bvh", "--out", "-", "--json"});
    CHECK(json.out == csv);
    CHECK(nlohmann::json::parse(json.err).at("out") == "-");
    const Outcome quiet = stage.run({"clip.bvh", "--out", "-", "--quiet"});
    CHECK(quiet.out == csv);
    CHECK(quiet.err.empty());
    const Outcome silent = stage.run({"clip.bvh", "--out", "b.csv", "--quiet"});
    CHECK(silent.out + silent.err == "");
    CHECK(slurp(stage.folder / "b.csv") == csv);
    CHECK(nlohmann::json::parse(stage.run({"clip.bvh", "--quiet", "--json"}).out).at("frames") == 2);
    CHECK_THAT(stage.run({"no.bvh", "--quiet"}).err, StartsWith("swivel: no.bvh: "));
    const std::string table = stage.written({"clip.bvh", "--export-targets", "t2.csv"});
    const Outcome exported = stage.run({"clip.bvh", "--export-targets", "-", "--out", "b.csv"});
    CHECK(exported.out == table);
    CHECK_THAT(exported.err, Contains("written  b.csv") && Contains("written  to standard output"));
    CHECK_FALSE(fs::exists(stage.folder / "-"));
}

TEST_CASE("streams: what cannot be read or written is refused in one line")
{
    const PipeStage stage;
    const auto refused = [&](const Words& words, int code, const std::string& said, const std::string& input = {}) {
        const Outcome outcome = stage.run(words, input);
        INFO(outcome.err);
        CHECK(outcome.exit_code == code);
        CHECK(outcome.out.empty());
        CHECK_THAT(outcome.err, StartsWith("swivel: ") && Contains(said));
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    };
    for (const Words& words : std::vector<Words>{
             {"-", "--targets", "-"}, {"-", "--crowd", "-"}, {"clip.bvh", "--crowd", "-", "--targets", "-"}})
        refused(words, 2, "more than one of FILE, --crowd and --targets", kTwoArms);
    spill(stage.folder / "in.toml", "[crowd]\ntargets = \"-\"\n");
    refused({"-", "--crowd", "in.toml"}, 2, "more than one of FILE", kTwoArms);
    refused({"-"}, 1, "standard input: is empty");
    refused({"-"}, 1, "standard input: begins with 'a,b,c\\x0a'; swivel reads BVH", "a,b,c\n");
    refused({"-"}, 1, "standard input:", "HIERARCHY\nROOT");
    refused({"clip.bvh", "--crowd", "clip.bvh"}, 1,
            "clip.bvh: is a BVH file, and a TOML file is needed here; give the clip as FILE");
    refused({"-", "--fps", "30"}, 2, "--fps samples", kTwoArms);
    refused({"clip.bvh", "--targets", "-", "--json"}, 1, "standard input:3: column x is empty",
            kPipeTable + "0,0,right_arm,,8,3,4,8,9\n");
    refused({"clip.bvh", "--out", "x.glb"}, 2, "this clip is a BVH file");
    refused({"clip.bvh", "--out", "-", "--export-targets", "-"}, 2, "-: is another output, too");
    refused({"clip.bvh", "--out", "x.fbx"}, 2, "no writer for this suffix; use .bvh, .glb, .gltf, .vrm or .csv");
}

TEST_CASE("streams: tables from spreadsheets are read where they can be, and else told what to change")
{
    const PipeStage stage;
    const std::string csv = stage.written({"clip.bvh", "--targets", "t.csv", "--out", "a.csv"});
    spill(stage.folder / "quoted.csv",
          "\"frame\",\"character\",limb,x,y,z,\"pole_x\",pole_y,pole_z\r\n0,0,\"left_arm\",\"6\",8,3,4,8,9\r\n");
    CHECK(stage.written({"clip.bvh", "--targets", "quoted.csv", "--out", "b.csv"}) == csv);
    const auto refused = [&](const std::string& text, const std::string& said) {
        const Outcome outcome = stage.run({"clip.bvh", "--targets", "-", "--json"}, text);
        CHECK(outcome.exit_code == 1);
        CHECK_THAT(outcome.err, Contains(said));
    };
    refused("frame;character;limb;x;y;z;pole_x;pole_y;pole_z\n0;0;left_arm;6;8;3;4;8;9\n",
            "standard input:1: its columns are separated by semicolons or tabs; write commas");
    refused("frame\tcharacter\tlimb\tx\n", "separated by semicolons or tabs");
    refused(kPipeTable + "1,0,\"left_arm,6,8,3,4,8,9\n", "standard input:3: a quote is opened and not closed");
    refused("\"frame,character\n", "standard input:1: a quote is opened and not closed");
}

TEST_CASE("streams: a note says so where most limbs are out of reach or have bad input, with numbers")
{
    const PipeStage stage;
    const auto rows = [](int far, const std::string& more) {
        std::string text = "frame,character,limb,x,y,z\n";
        for (int n = 0; n < far; ++n)
            text += std::to_string(n / 2) + ",0," + (n % 2 ? "right_arm" : "left_arm") + ",1000,0,0\n";
        return text + more;
    };
    const std::string beyond_floats = "1,0,left_arm,1e300,0,0\n",
                      head = "note     most arms are not where they should be";
    const Words words = {"clip.bvh", "--targets", "-"}, json = {"clip.bvh", "--targets", "-", "--json"};
    CHECK_THAT(stage.run(words, rows(2, "")).out,
               Contains("flag     clamped far 2, first in frame 0, character 0, left_arm\n"));
    for (const int far : {1, 2, 3, 4}) {  // of four
        const Outcome outcome = stage.run(words, rows(far, ""));
        CHECK(outcome.exit_code == 0);
        CHECK((outcome.out.find(head) != std::string::npos) == (far > 2));
        const auto told = nlohmann::json::parse(stage.run(json, rows(far, "")).out);
        CHECK(told.at("went_wrong") == (far > 2));
        CHECK(told.at("out_of_reach") == far);
    }
    CHECK_THAT(stage.run(words, rows(2, beyond_floats)).out,
               Contains(head + ": of 4 arms, 2 are out of reach; are the targets in the right place and unit? 1 has "
                               "bad input;"));
    CHECK(nlohmann::json::parse(stage.run(json, rows(2, beyond_floats)).out).at("bad_input") == 1);
}

// SPDX-License-Identifier: MIT
//
// The command as people and scripts meet it: usage errors, reports for both, the exit code. Bad files are in
// test_command_input.cpp, solved crowds in test_command_crowd.cpp.
#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>

#include "swivel/swivel.h"
#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
using Json = nlohmann::json;

namespace {

// Runs it where nothing is but clip.bvh, a small file with two arms; `folder` is left to look at.
Outcome run_beside_clip(const TempFolder& folder, const Words& arguments)
{
    spill(folder / "clip.bvh", kTwoArms);
    return run_command(folder.path, arguments);
}

// Bad usage: exit code 2, one line on stderr that says `said`, nothing on stdout, no file.
void require_bad_usage(const Words& arguments, const std::string& said)
{
    const TempFolder folder;
    const Outcome outcome = run_beside_clip(folder, arguments);
    INFO("swivel " << fmt::format("{}", fmt::join(arguments, " ")));
    INFO("stderr: " << outcome.err);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, StartsWith("swivel: ") && EndsWith("\n") && Contains(said));
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(outcome.err.size() < 300);  // a line to read
    CHECK(folder.file_count() == 1);
}

// What a run that must succeed prints as JSON.
Json json_of(const TempFolder& folder, const Words& arguments)
{
    const Outcome outcome = run_beside_clip(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    REQUIRE(outcome.err.empty());
    return Json::parse(outcome.out);
}

void require_keys(const Json& object, const Words& keys)
{
    for (const std::string& key : keys) {
        INFO(key);
        CHECK(object.contains(key));
    }
}

void require_error(const Json& error, double limit)
{
    require_keys(error, {"worst", "rms", "count", "unit"});
    CHECK(error.at("worst").get<double>() >= error.at("rms").get<double>());
    CHECK(error.at("worst").get<double>() > 0);
    CHECK(error.at("worst").get<double>() <= limit);
}

// What demo and solve both report.
void require_statistics(const Json& out, std::uint64_t arms)
{
    require_keys(out, {"solve_seconds", "arms_per_second", "isa", "threads", "errors", "flags"});
    CHECK(out.at("arms") == arms);
    CHECK(out.at("arms_per_second").get<double>() > 0);
    require_keys(out.at("flags"), {"reached", "clamped far", "clamped near", "swivel undefined", "bad input"});
    require_error(out.at("errors").at("wrist"), 2e-6);
}

}  // namespace

TEST_CASE("command: its version")
{
    const TempFolder folder;
    const Outcome version = run_command(folder.path, {"--version"});
    CHECK(version.exit_code == 0);
    CHECK(version.out == "swivel " + std::to_string(SWIVEL_VERSION_MAJOR) + "." + std::to_string(SWIVEL_VERSION_MINOR) +
                             "." + std::to_string(SWIVEL_VERSION_PATCH) + "\n");
}

TEST_CASE("command: bad usage is refused in one line before anything happens")
{
    require_bad_usage({}, "subcommand");
    require_bad_usage({"bogus"}, "bogus");
    require_bad_usage({"info", "demo"}, "demo");
    require_bad_usage({"--bogus"}, "--bogus");
    require_bad_usage({"info", "--bogus"}, "--bogus");
    require_bad_usage({"solve"}, "FILE is required");
    require_bad_usage({"rig"}, "FILE is required");
    require_bad_usage({"solve", "clip.bvh", "clip.bvh"}, "clip.bvh");
    require_bad_usage({"solve", "clip.bvh", "--bogus\nline"}, "--bogus line");
    for (const std::string characters : {"0", "-1", "abc", "2x", "1.5", "", "99999999999999999999"}) {
        require_bad_usage({"solve", "clip.bvh", "--characters", characters, "--out", "x.csv"}, "--characters");
        require_bad_usage({"demo", "--characters", characters}, "--characters");
    }
    for (const std::string number : {"abc", "1.5", "-1", "99999999999999999999999"}) {
        require_bad_usage({"solve", "clip.bvh", "--seed", number}, "--seed");
        require_bad_usage({"solve", "clip.bvh", "--threads", number}, "--threads");
        require_bad_usage({"demo", "--frames", number}, "--frames");
        require_bad_usage({"verify", "--arms", number}, "--arms");
    }
    require_bad_usage({"verify", "--arms", "0"}, "--arms");
    require_bad_usage({"demo", "--frames", "0"}, "--frames");
    for (const std::string number : {"0", "-1", "nan", "inf", "1e9", "1s", ""})
        require_bad_usage({"bench", "--seconds", number}, "--seconds");
    require_bad_usage({"solve", "clip.bvh", "--threads", "1", "--threads", "2"}, "--threads");
    require_bad_usage({"solve", "clip.bvh", "--out"}, "--out");
    require_bad_usage({"solve", "clip.bvh", "--limbs", "wings"}, "--limbs");
    require_bad_usage({"solve", "clip.bvh", "--limbs", "arms", "--leg", "a,b,c"}, "--limbs all");
    require_bad_usage({"solve", "clip.bvh", "--limbs", "legs", "--arm", "a,b,c"}, "--limbs all");
}

TEST_CASE("command: options that do not go together are refused")
{
    require_bad_usage({"solve", "clip.bvh", "--out", "x.bvh", "--characters", "2"}, "one character");
    require_bad_usage({"solve", "no such.bvh", "--out", "x.bvh", "--characters", "2"},
                      "one character");  // before any file
    for (const std::string out : {"x.fbx", "x", "x.", ".csv", "x.csv.gz"})
        require_bad_usage({"solve", "clip.bvh", "--out", out}, "--out " + out);
    require_bad_usage({"solve", "clip.bvh", "--out", ""}, "--out");
    require_bad_usage({"solve", "clip.bvh", "--between", "hold"},
                      "--between hold: is about the rows of a table; give one with --targets FILE");
    require_bad_usage({"solve", "clip.bvh", "--between", "cubic"}, "--between");
    require_bad_usage({"solve", "clip.bvh", "--export-targets", ""}, "--export-targets");
    require_bad_usage({"solve", "clip.bvh", "--export-targets", "./x.csv", "--out", "x.csv"}, "is another output, too");
}

TEST_CASE("command: solve without --out writes no file, with it that one")
{
    const TempFolder folder;
    const Outcome outcome = run_beside_clip(folder, {"solve", "clip.bvh"});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    CHECK_THAT(outcome.out,
               Contains("2 frames") && Contains("reached 4") && Contains("LeftForeArm") && !Contains("written"));
    CHECK(folder.file_count() == 1);
    CHECK_THAT(run_beside_clip(folder, {"solve", "clip.bvh", "--out", "own.bvh"}).out, Contains("written  own.bvh"));
    CHECK(folder.file_count() == 2);
}

TEST_CASE("command: solve --json")
{
    const TempFolder folder;
    const Json out =
        json_of(folder, {"solve", "clip.bvh", "--json", "--characters", "3", "--seed", "7", "--out", "x.csv"});
    CHECK(out.at("clip") == "clip.bvh");
    CHECK(out.at("joints") == 7);
    CHECK(out.at("frames") == 2);
    CHECK(out.at("frame_time") == 0.01);
    CHECK(out.at("characters") == 3);
    CHECK(out.at("seed") == 7);
    CHECK(out.at("targets") == "clip");
    CHECK(out.at("out") == "x.csv");
    CHECK(out.at("seconds") >= out.at("solve_seconds"));
    require_statistics(out, 2 * 2 * 3);
    require_error(out.at("errors").at("hand"), 2e-6);
    require_error(out.at("differences_from_clip").at("elbow_bent"), 1e-5);
    CHECK(out.at("each_character").size() == 3);
    const Json& left = out.at("arms_bound").at(0);
    CHECK(left.at("side") == "left");
    CHECK(left.at("shoulder") == "LeftArm");
    CHECK(left.at("elbow") == "LeftForeArm");
    CHECK(left.at("wrist") == "LeftHand");
    CHECK(left.at("lengths") == Json({5, 3}));
    require_keys(left, {"bend", "bend_source"});
    CHECK(out.at("arms_bound").at(1).at("side") == "right");
    CHECK_FALSE(json_of(folder, {"solve", "clip.bvh", "--json"}).contains("out"));
}

TEST_CASE("command: names that are not UTF-8 do not break --json")
{
    const TempFolder folder;
    spill(folder / "caf\xe9.bvh", edited(kTwoArms, "LeftForeArm",
                                         "Left\xe9"
                                         "ForeArm"));
    const std::string left =
        "LeftArm,Left\xe9"
        "ForeArm,LeftHand";
    const Json out = json_of(folder, {"solve", "caf\xe9.bvh", "--json", "--out", "caf\xe9.csv", "--arm", left});
    CHECK(out.at("frames") == 2);
    CHECK(fs::exists(folder / "caf\xe9.csv"));
}

TEST_CASE("command: info")
{
    const TempFolder folder;
    const Json info = json_of(folder, {"info", "--json"});
    require_keys(info, {"swivel", "cpu", "cores", "isa", "built", "compiler", "build_type", "flags", "threads"});
    CHECK(info.at("built").at("scalar") == "runs here");
    CHECK(info.at("built").at(info.at("isa").get<std::string>()) == "runs here");
    const char* forced = std::getenv("SWIVEL_FORCE_ISA");
    if (forced && *forced) CHECK(info.at("isa") == forced);
    CHECK_THAT(run_command(folder.path, {"info"}).out,
               Contains(info.at("isa").get<std::string>()) && Contains("built for"));
}

TEST_CASE("command: demo prints arms per second, the worst wrist error and the instruction set")
{
    const TempFolder folder;
    const std::string isa = json_of(folder, {"info", "--json"}).at("isa");
    const Outcome outcome = run_command(folder.path, {"demo", "--characters", "100", "--frames", "5"});
    REQUIRE(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, Contains("100 characters, 200 arms, 5 frames") && Contains("\nsolved   1000 arms, ") &&
                                Contains(" million arms/s (" + isa + ",") && Contains("\nerror    wrist to target "));
    const Json out = json_of(folder, {"demo", "--json", "--characters", "100", "--frames", "5", "--seed", "3"});
    require_statistics(out, 1000);
    for (const auto& [key, value] : {std::pair("characters", 100), {"frames", 5}, {"seed", 3}})
        CHECK(out.at(key) == value);
}

TEST_CASE("command: verify --json")
{
    const TempFolder folder;
    const Json out = json_of(folder, {"verify", "--json", "--arms", "2000"});
    CHECK(out.at("passed") == true);
    CHECK(out.at("equal_digests") == true);
    REQUIRE(out.at("checks").size() > 5);
    for (const Json& check : out.at("checks")) {
        require_keys(check, {"name", "set", "arms", "max", "rms", "max_limit", "rms_limit", "passed"});
        CHECK(check.at("passed") == true);
        CHECK(check.at("max") <= check.at("max_limit"));
    }
    REQUIRE(out.at("digests").size() >= 8);
    std::map<bool, Json> first;
    for (const Json& digest : out.at("digests")) {
        require_keys(digest, {"isa", "how", "ordinary", "hard", "limbs", "golden", "passed"});
        CHECK(digest.at("passed") == true);
        const Json& same = first.emplace(digest.at("golden"), digest).first->second;
        for (const char* part : {"ordinary", "hard", "limbs"}) CHECK(digest.at(part) == same.at(part));
    }
    CHECK(first.size() == 2);
}

#ifdef SWIVEL_WITH_BENCH
TEST_CASE("command: bench has rows for swivel on every instruction set, and for rivals")
{
    const TempFolder folder;
    const Json info = json_of(folder, {"info", "--json"});
    const Outcome measured = spawn_command(folder.path, {"bench", "--json", "--seconds", "0.1"});
    REQUIRE(measured.exit_code == 0);
    const Json out = Json::parse(measured.out);
    CHECK(out.at("context").at("cpu") == info.at("cpu"));
    std::map<std::string, double> median;
    for (const Json& row : out.at("benchmarks"))
        if (row.at("aggregate_name") == "median") median[row.at("run_name")] = row.at("time/arm");
    for (const auto& [isa, state] : info.at("built").items())
        for (const char* row : {"P/{}/L2", "resident/{}/L2", "frame/{}/in_one"})
            if (state == "runs here") CHECK(median.at(fmt::format(fmt::runtime(row), isa)) > 0);
    for (const char* rival : {"loop_trig/", "single_glm/", "frame_glm/"})
        CHECK(std::ranges::any_of(median, [&](const auto& row) { return row.first.starts_with(rival); }));
    const Outcome text = spawn_command(folder.path, {"bench", "--seconds", "0.1"});
    CHECK(text.exit_code == 0);
    CHECK_THAT(text.out, StartsWith("cpu ") && Contains(info.at("cpu").get<std::string>()) && Contains(" ns an arm"));
    for (const auto& [row, ns] : median)
        CHECK_THAT(text.out, Contains("\n" + row.substr(0, row.find("/real_time")) + " "));
}
#endif

TEST_CASE("command: an instruction set that does not exist")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    const Surroundings forced{{"SWIVEL_FORCE_ISA=nonsense"}};
    for (const Words& arguments : std::vector<Words>{
             {"info"}, {"demo"}, {"verify"}, {"rig", "clip.bvh"}, {"solve", "clip.bvh", "--out", "x.bvh"}}) {
        const Outcome outcome = spawn_command(folder.path, arguments, forced);
        INFO(arguments.front());
        CHECK(outcome.exit_code == 1);
        CHECK(outcome.out.empty());
        CHECK_THAT(outcome.err, Contains("SWIVEL_FORCE_ISA=nonsense"));
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
        CHECK(folder.file_count() == 1);
    }
    CHECK(spawn_command(folder.path, {"--help"}, forced).exit_code == 0);
}

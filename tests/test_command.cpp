// SPDX-License-Identifier: MIT
//
// The command as people and scripts meet it: help, usage errors, reports for both, the exit code. Bad files are in
// test_command_input.cpp, solved crowds in test_command_crowd.cpp.
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

using Words = std::vector<std::string>;

// Runs it where nothing is but clip.bvh, a small file with two arms; `folder` is left to look at.
Outcome run_beside_clip(const TempFolder& folder, const Words& arguments)
{
    spill(folder / "clip.bvh", kTwoArms);
    return run_command(folder.path, arguments);
}
Outcome spawn_beside_clip(const TempFolder& folder, const Words& arguments, const Surroundings& surroundings)
{
    spill(folder / "clip.bvh", kTwoArms);
    return spawn_command(folder.path, arguments, surroundings);
}

std::string quoted(const Words& words)
{
    std::string line;
    for (const std::string& word : words) line += " '" + word + "'";
    return line;
}

// Bad usage: exit code 2, one line on stderr that says `said`, nothing on stdout, no file.
void require_bad_usage(const Words& arguments, const std::string& said)
{
    const TempFolder folder;
    const Outcome outcome = run_beside_clip(folder, arguments);
    INFO("swivel" << quoted(arguments));
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

// The number that follows `label` in a text.
double number_after(const std::string& text, const std::string& label)
{
    const std::size_t at = text.find(label);
    REQUIRE(at != std::string::npos);
    return std::strtod(text.c_str() + at + label.size(), nullptr);
}

}  // namespace

TEST_CASE("command: help and version")
{
    const TempFolder folder;
    for (const Words& help : std::vector<Words>{{"--help"},
                                                {"-h"},
                                                {"demo", "--help"},
                                                {"solve", "--help"},
                                                {"verify", "--help"},
                                                {"bench", "--help"},
                                                {"info", "--help"}}) {
        const Outcome outcome = run_command(folder.path, help);
        INFO(help.front());
        CHECK(outcome.exit_code == 0);
        CHECK(outcome.err.empty());
        CHECK_THAT(outcome.out, Contains("--help") && EndsWith("\n"));
        if (help.size() == 2)
            CHECK_THAT(outcome.out, Contains("--json"));
        else
            CHECK_THAT(outcome.out, Contains("demo") && Contains("solve") && Contains("verify") && Contains("bench") &&
                                        Contains("info"));
    }
    CHECK_THAT(run_command(folder.path, {"solve", "--help"}).out,
               Contains("--targets") && Contains("--out") && Contains("--characters"));
    const Outcome version = run_command(folder.path, {"--version"});
    CHECK(version.exit_code == 0);
    CHECK(version.out == "swivel " + std::to_string(SWIVEL_VERSION_MAJOR) + "." + std::to_string(SWIVEL_VERSION_MINOR) +
                             "." + std::to_string(SWIVEL_VERSION_PATCH) + "\n");
    CHECK(folder.file_count() == 0);
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
    require_bad_usage({"solve", "clip.bvh", "--export-targets", "clip.bvh"}, "clip.bvh: is the clip itself");
    require_bad_usage({"solve", "clip.bvh", "--export-targets", "./x.csv", "--out", "x.csv"}, "is the file of --out");
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
    // Not onto the file read; test_command_input has the other files.
    CHECK(run_beside_clip(folder, {"solve", "clip.bvh", "--out", "clip.bvh"}).exit_code == 2);
    CHECK(slurp(folder / "clip.bvh") == kTwoArms);
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

TEST_CASE("command: a clip that bends nothing has elbows that bend forwards and knees that bend backwards")
{
    const TempFolder folder;
    const std::string straight =
        edited(edited(kTwoArms, " 20 0 0 -30 0 5 0 0 0 20 0 0 30 0 5 0 0", " 20 0 0 0 0 0 0 0 0 20 0 0 0 0 0 0 0"),
               " 21 0 0 -31 0 6 0 0 0 21 0 0 31 0 6 0 0", " 21 0 0 0 0 0 0 0 0 21 0 0 0 0 0 0 0");
    std::string standing = straight;  // its arms hang down, so that they can pass for legs
    for (const auto& [out, down] : {std::pair("OFFSET 5 0 0", "OFFSET 0 -5 0"),
                                    {"OFFSET -5 0 0", "OFFSET 0 -5 0"},
                                    {"OFFSET 3 0 0", "OFFSET 0 -3 0"},
                                    {"OFFSET -3 0 0", "OFFSET 0 -3 0"}})
        standing = edited(standing, out, down);
    const auto bound = [&](const std::string& bvh, const std::string& option) {
        spill(folder / "t.bvh", bvh);
        const Outcome outcome =
            run_command(folder.path, {"solve", "t.bvh", "--json", option, "LeftArm,LeftForeArm,LeftHand"});
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        const Json out = Json::parse(outcome.out);
        return out.at(option == "--arm" ? "arms_bound" : "legs_bound").at(0);
    };
    CHECK(bound(straight, "--arm").at("bend") == Json({0.0, 0.0, 1.0}));
    const Json leg = bound(standing, "--leg");
    CHECK(leg.at("bend") == Json({0.0, 0.0, -1.0}));
    CHECK(leg.at("bend_source").get<std::string>().starts_with("knees bend backwards; "));
    require_keys(leg, {"side", "hip", "knee", "ankle", "lengths"});
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
    CHECK(outcome.err.empty());
    CHECK_THAT(outcome.out, Contains("100 characters, 200 arms, 5 frames") && Contains("(" + isa + ","));
    CHECK(number_after(outcome.out, "solved   ") == 1000);
    CHECK(number_after(outcome.out, "solved   1000 arms, ") > 0);
    CHECK_THAT(outcome.out, Contains("million arms/s"));
    const double worst = number_after(outcome.out.substr(outcome.out.find("wrist to target")), "worst ");
    CHECK(worst > 0);
    CHECK(worst < 1e-6);

    const Json out = json_of(folder, {"demo", "--json", "--characters", "100", "--frames", "5", "--seed", "3"});
    require_statistics(out, 1000);
    CHECK(out.at("characters") == 100);
    CHECK(out.at("frames") == 5);
    CHECK(out.at("seed") == 3);
    CHECK(out.at("isa") == isa);
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

TEST_CASE("command: bench has a row for everyone on every instruction set")
{
    const TempFolder folder;
    const Json info = json_of(folder, {"info", "--json"});
    const Outcome measured = spawn_command(folder.path, {"bench", "--json", "--seconds", "0.2"});
    REQUIRE(measured.exit_code == 0);
    const Json out = Json::parse(measured.out);
    CHECK(out.at("isa") == info.at("isa"));
    CHECK(out.at("machine").at("cpu") == info.at("cpu"));
    require_keys(out, {"library_build", "rivals_build", "row_bytes", "memory_ns"});
    require_keys(out.at("ops"), {"roots", "divisions", "multiplications", "additions", "comparisons", "selects"});
    CHECK(out.at("ops").at("roots") > 0);
    require_keys(out.at("machine").at("copy_bytes_per_ns"), {"L1", "L2", "L3", "memory"});
    for (const Json& pair : out.at("pairs")) {
        INFO(pair.dump());
        CHECK(pair.at("own_ns") > 0);
        CHECK(pair.at("other_ns") > 0);
        CHECK(pair.at("ratio") > 0);
        CHECK(pair.at("note") != "");
    }
    const auto has_pair = [&](const std::string& work, const std::string& isa) {
        return std::any_of(out.at("pairs").begin(), out.at("pairs").end(),
                           [&](const Json& pair) { return pair.at("work") == work && pair.at("isa") == isa; });
    };
    for (const auto& [isa, state] : info.at("built").items()) {
        if (state != "runs here") continue;
        INFO(isa);
        CHECK(has_pair("P in cache", isa));
        require_keys(out.at("machine").at("limits").at(isa),
                     {"lanes", "flops_per_ns", "division_ns", "root_ns", "divide_root_ns"});
    }
    for (const std::string work : {"P out of cache", "resident", "whole frame"}) CHECK(has_pair(work, info.at("isa")));
    for (const Json& bound : out.at("bounds"))
        CHECK(bound.at("bound_ns") == std::max(bound.at("divider_ns"), bound.at("arithmetic_ns")));
    CHECK_FALSE(out.contains("sizes"));  // they take time from the others, and only a report shows them

    const Outcome reported =
        spawn_command(folder.path, {"bench", "--json", "--seconds", "0.2", "--quiet", "--report", "r.html"});
    REQUIRE(reported.exit_code == 0);
    const Json sizes = Json::parse(reported.out).at("sizes");
    CHECK(sizes.size() == 8);
    for (const Json& size : sizes) {
        CHECK(size.at("plain_ns") > 0);
        CHECK(size.at("resident_ns") > 0);
        CHECK_THAT(slurp(folder / "r.html"), Contains(">" + size.at("arms").dump() + "<"));
    }

    const Outcome text = spawn_command(folder.path, {"bench", "--seconds", "0.2", "--quiet"}, {{"TERM=xterm"}, true});
    CHECK(text.exit_code == 0);
    CHECK(text.err.empty());
    CHECK_THAT(text.out, Contains(info.at("cpu").get<std::string>()) &&
                             Contains(info.at("compiler").get<std::string>().substr(0, 3)));
    CHECK_THAT(text.out, Contains("P in cache") && Contains("single_glm") && Contains("loop_roots") &&
                             Contains("P out of cache") && Contains("resident") && Contains("whole frame") &&
                             Contains("divider") && Contains("Roofline") && Contains("past the caches"));
}

TEST_CASE("command: an instruction set that does not exist")
{
    const Surroundings forced{{"SWIVEL_FORCE_ISA=nonsense"}};
    for (const Words& arguments : std::vector<Words>{
             {"info"}, {"info", "--json"}, {"demo"}, {"verify"}, {"bench"}, {"solve", "clip.bvh", "--out", "x.bvh"}}) {
        const TempFolder folder;
        const Outcome outcome = spawn_beside_clip(folder, arguments, forced);
        INFO(arguments.front());
        CHECK(outcome.exit_code == 1);
        CHECK(outcome.out.empty());
        CHECK_THAT(outcome.err, Contains("SWIVEL_FORCE_ISA=nonsense"));
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
        CHECK(folder.file_count() == 1);
    }
    const TempFolder folder;
    CHECK(spawn_command(folder.path, {"--help"}, forced).exit_code == 0);
}

TEST_CASE("command: a report that cannot be written is a failure")
{
    const TempFolder folder;
    Surroundings full;
    full.stdout_file = "/dev/full";
    for (const Words& arguments : std::vector<Words>{{"info"}, {"info", "--json"}, {"solve", "clip.bvh", "--json"}}) {
        const Outcome outcome = spawn_beside_clip(folder, arguments, full);
        INFO(arguments.front());
        CHECK(outcome.exit_code == 1);
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    }
}

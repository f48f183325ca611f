// SPDX-License-Identifier: MIT
//
// Bad input of every kind: the exit code is 1, and one line on stderr names file, line and cause. No new file appears,
// whole or partial, and a file that was there keeps its bytes. The readers' own tests, such as test_bvh.cpp, have each
// way of being wrong.
#include <catch2/catch.hpp>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;

namespace {

void require_one_line(const Outcome& outcome, const Words& said)
{
    INFO("stderr: " << outcome.err);
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.err, StartsWith("swivel: ") && EndsWith("\n"));
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    for (const std::string& words : said) CHECK_THAT(outcome.err, Contains(words));
}

// Runs `solve arguments... --out OUT` in `folder` for both suffixes, with no such file and with an old one.
void require_refused(const TempFolder& folder, Words arguments, const Words& said,
                     const Words& outs = {"out.bvh", "out.csv"})
{
    arguments.insert(arguments.begin(), {"solve", "--json"});
    for (const std::string& out : outs)
        for (const bool is_there : {false, true}) {
            if (is_there) spill(folder / out, "old bytes");
            const auto before = contents(folder.path);
            Words all = arguments;
            all.insert(all.end(), {"--out", out});
            INFO(out << (is_there ? ", there already" : ""));
            const Outcome outcome = run_command(folder.path, all);
            require_one_line(outcome, said);
            CHECK(outcome.out.empty());
            CHECK(contents(folder.path) == before);
        }
}

void require_clip_refused(std::string_view text, const Words& said)
{
    const TempFolder folder;
    spill(folder / "clip.bvh", text);
    require_refused(folder, {"clip.bvh"}, said);
}

void require_table_refused(const std::string& text, const Words& said, const Words& more = {})
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    spill(folder / "t.csv", text);
    INFO(text);
    Words arguments = {"clip.bvh", "--targets", "t.csv"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    require_refused(folder, arguments, said);
}

void require_arms_refused(const Words& arms, const Words& said)
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    Words arguments = {"clip.bvh"};
    for (const std::string& arm : arms) arguments.insert(arguments.end(), {"--arm", arm});
    require_refused(folder, arguments, said);
}

}  // namespace

TEST_CASE("input: the files that the others here are broken from are good")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    spill(folder / "t.csv", kColumns + kGoodRow);
    for (const std::string out : {"out.bvh", "out.csv"}) {
        const Outcome outcome = run_command(folder.path, {"solve", "clip.bvh", "--targets", "t.csv", "--out", out});
        INFO(outcome.err);
        CHECK(outcome.exit_code == 0);
        CHECK(fs::file_size(folder / out) > 100);
    }
    CHECK(folder.file_count() == 4);
}

TEST_CASE("input: clips that are not there or not text")
{
    const TempFolder folder;
    fs::create_directory(folder / "dir.bvh");
    require_refused(folder, {"no.bvh"}, {"no.bvh: ", "No such file"});
    require_refused(folder, {"dir.bvh"}, {"dir.bvh: ", "directory"});
    require_clip_refused("", {"clip.bvh: ", "empty"});
    require_clip_refused("\x89PNG\r\n\x1a\n", {"clip.bvh: begins with '", "PNG", "HIERARCHY"});
    require_clip_refused(kTwoArms + std::string(5, '\0'), {"clip.bvh: ", "binary"});
}

TEST_CASE("input: clips that are cut short")
{
    require_clip_refused(kTwoArms.substr(0, kTwoArms.find("RightForeArm")), {"clip.bvh:29: "});
    require_clip_refused(kTwoArms.substr(0, kTwoArms.find("1 2 4")), {"clip.bvh:48: ", "1 of the 2 frames"});
}

TEST_CASE("input: skeletons without arms, and --arm that names none")
{
    std::string legs = kTwoArms;
    for (std::size_t at; (at = legs.find("ForeArm")) != std::string::npos;) legs.replace(at, 7, "Shin");
    require_clip_refused(legs, {"clip.bvh: no limb binds: the left arm: ", "--arm SHOULDER,ELBOW,WRIST"});
    require_arms_refused({"LeftArm,LeftForeArm,Nope"}, {"clip.bvh: ", "'Nope'"});
    require_arms_refused({"LeftArm,LeftForeArm"}, {"clip.bvh: ", "'LeftArm,LeftForeArm'", "SHOULDER,ELBOW,WRIST"});
    require_arms_refused({"LeftHand,LeftForeArm,LeftArm"}, {"clip.bvh: ", "'LeftHand,LeftForeArm,LeftArm'"});
    require_arms_refused({"LeftArm,LeftForeArm,LeftHand", "left:RightArm,RightForeArm,RightHand"},
                         {"clip.bvh: ", "two arms are taken as left"});
    require_arms_refused({"left:LeftArm,LeftForeArm,LeftHand", "right:Hips,LeftArm,LeftForeArm"}, {"clip.bvh: "});
}

TEST_CASE("input: a limb that cannot be bound refuses no other, unless it was named")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", edited(kTwoArms, "OFFSET 5 0 0", "OFFSET 0 0 0"));  // the left upper arm
    const Outcome others = run_command(folder.path, {"solve", "clip.bvh", "--json"});
    REQUIRE(others.exit_code == 0);
    const auto report = nlohmann::json::parse(others.out);
    REQUIRE(report.at("arms_bound").size() == 1);
    CHECK(report.at("arms_bound")[0].at("side") == "right");
    REQUIRE(report.at("missing").size() == 1);
    CHECK_THAT(report.at("missing")[0].at("problem").get<std::string>(), Contains("has no length"));
    const Words named = {"clip.bvh: the left arm cannot be bound: ", "has no length"};
    require_refused(folder, {"clip.bvh", "--arm", "LeftArm,LeftForeArm,LeftHand"}, named);
    spill(folder / "c.toml", "[limb.left_arm]\nbend = [0, 0, 1]\n");
    require_refused(folder, {"clip.bvh", "--crowd", "c.toml"}, named);
}

TEST_CASE("input: skeletons without legs, and --leg that names none")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    require_refused(folder, {"clip.bvh", "--limbs", "legs"},
                    {"clip.bvh: no limb binds: the left leg: no joints have names", "--leg HIP,KNEE,ANKLE"});
    require_refused(folder, {"clip.bvh", "--leg", "LeftArm,LeftForeArm"},
                    {"'LeftArm,LeftForeArm' does not name three joints (--leg); write HIP,KNEE,ANKLE"});
    require_refused(folder, {"clip.bvh", "--leg", "Nope,LeftForeArm,LeftHand"}, {"'Nope' (--leg)"});
    spill(folder / "t.csv", edited(kColumns, "side", "limb") + "0,0,left_leg,6,8,3,4,8,9\n");
    require_refused(folder, {"clip.bvh", "--targets", "t.csv"},
                    {"t.csv:2: all rows are of legs, which are not solved; take them in with --limbs"});
}

TEST_CASE("input: what a crowd file names wrongly is said with file, line and key")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    const auto refused = [&](const std::string& toml, const std::string& said, const Words& more = {}) {
        spill(folder / "c.toml", toml);
        Words arguments = {"clip.bvh", "--crowd", "c.toml"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        INFO(toml);
        require_refused(folder, arguments, {said});
    };
    const std::string left = "[limb.left_arm]\njoints = ";
    const std::string good = left + "[\"LeftArm\", \"LeftForeArm\", \"LeftHand\"]\n";
    refused(left + "[\"LeftArm\", \"LeftForeArm\", \"Nope\"]\n",
            "c.toml:2: limb.left_arm.joints: no joint is called 'Nope' in clip.bvh; swivel rig --joints lists them");
    refused(left + "[\"LeftHand\", \"LeftForeArm\", \"LeftArm\"]\n",
            "c.toml:2: limb.left_arm.joints: 'LeftHand,LeftForeArm,LeftArm' does not name a joint, one below it and "
            "one below that in clip.bvh; write SHOULDER,ELBOW,WRIST, from the body outwards");
    refused(left + "[\"Left\\nArm\", \"LeftForeArm\", \"LeftHand\"]\n", "no joint is called 'Left\\x0aArm' in");
    refused("[crowd]\nlimbs = \"legs\"\n" + good,
            "c.toml:4: limb.left_arm.joints: crowd.limbs = \"legs\" in line 2 of c.toml solves no arms");
    refused(good, "c.toml:2: limb.left_arm.joints: --limbs legs solves no arms", {"--limbs", "legs"});
    for (const std::string kind : {"direction", "normal"})
        refused(
            "[limb.arms.pole]\nkind = \"" + kind + "\"\n[limb.left_arm.pole]\nfixed = [0, 0, 0]\n",
            "c.toml:4: limb.left_arm.pole.fixed: has no length, so no direction, and limb.arms.pole.kind in line 2");

    spill(folder / "clip.bvh", edited(kTwoArms, "JOINT LeftArm", "JOINT Arm,L"));  // commas may be in names
    spill(folder / "c.toml", "[limb.left_arm]\njoints = [\"Arm,L\", \"LeftForeArm\", \"LeftHand\"]\n");
    CHECK(run_command(folder.path, {"solve", "clip.bvh", "--crowd", "c.toml"}).exit_code == 0);
    spill(folder / "clip.bvh", kTwoArms);
    spill(folder / "c.toml", "[limb.left_arm.pole]\nfixed = [0, 0, 0]\n");  // of a point: the shoulder
    CHECK(run_command(folder.path, {"solve", "clip.bvh", "--crowd", "c.toml"}).exit_code == 0);
    spill(folder / "c.toml", "[crowd]\nlimbs = \"legs\"\n");
    const Outcome clash =
        run_command(folder.path, {"solve", "clip.bvh", "--crowd", "c.toml", "--arm", "LeftArm,LeftForeArm,LeftHand"});
    CHECK(clash.exit_code == 2);
    CHECK_THAT(clash.err, Contains("--arm names an arm, but crowd.limbs = \"legs\" in line 2 of c.toml solves none"));
}

TEST_CASE("input: arms whose channels cannot take a rotation")
{
    const TempFolder folder;
    const std::string one_channel =
        edited(kTwoArms, "LeftForeArm\n{\nOFFSET 5 0 0\nCHANNELS 3 Zrotation Yrotation Xrotation",
               "LeftForeArm\n{\nOFFSET 5 0 0\nCHANNELS 1 Yrotation");
    spill(folder / "clip.bvh", edited(edited(one_channel, "0 0 -30 0", "0 -30"), "0 0 -31 0", "0 -31"));
    require_refused(folder, {"clip.bvh"}, {"clip.bvh:13: ", "LeftForeArm", "three rotation channels"}, {"out.bvh"});
    fs::remove(folder / "out.bvh");
    CHECK(run_command(folder.path, {"solve", "clip.bvh", "--out", "out.csv"}).exit_code == 0);  // a table can
}

TEST_CASE("input: tables of targets")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    fs::create_directory(folder / "dir.csv");
    require_refused(folder, {"clip.bvh", "--targets", "no.csv"}, {"no.csv: ", "No such file"});
    require_refused(folder, {"clip.bvh", "--targets", "dir.csv"}, {"dir.csv: ", "directory"});
    require_table_refused("", {"t.csv: ", "empty"});
    require_table_refused(kColumns + kGoodRow + "1,0,left,6,eight,3,4,8,9\n", {"t.csv:3: ", "column y", "'eight'"});
    require_table_refused(kColumns + kGoodRow + "2,0,left,6,8,3,4,8,9\n", {"t.csv:3: ", "frame 2", "0 to 1"});
    require_table_refused(kColumns + kGoodRow + "1,1,left,6,8,3,4,8,9\n", {"t.csv:3: ", "character 1"});
    require_table_refused(kColumns + "1,0,right,6,8,3,4,8,9\n", {"t.csv:2: ", "right arm"},
                          {"--arm", "LeftArm,LeftForeArm,LeftHand"});
}

TEST_CASE("input: output that cannot be written")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    for (const std::string suffix : {".bvh", ".csv"}) {
        fs::create_symlink("/dev/full", folder / ("full" + suffix));
        const auto before = contents(folder.path);
        for (const auto& [out, said] :
             {std::pair("no/out" + suffix, "No such file"), {"full" + suffix, "No space left"}}) {
            require_one_line(run_command(folder.path, {"solve", "clip.bvh", "--out", out}), {out + ": ", said});
            CHECK(contents(folder.path) == before);
        }
    }
}

TEST_CASE("input: a file's name is one line, on standard output too")
{
    const TempFolder folder;
    spill(folder / "a\nb.bvh", kTwoArms);
    spill(folder / "t\n.csv", "frame,character,limb,x,y,z\n0,0,left_arm,1,2,3\n");
    const Outcome outcome = run_command(folder.path, {"solve", "a\nb.bvh", "--targets", "t\n.csv", "--out", "o\n.csv"});
    INFO(outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, StartsWith("clip     a\\x0ab.bvh: BVH") && Contains("targets from t\\x0a.csv\n") &&
                                Contains("written  o\\x0a.csv\n"));
}

// SPDX-License-Identifier: MIT
//
// What a skeleton is refused for is said in one line, where the user said what is wrong. Joints that the user names are
// taken, and no limb is left out in silence.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <functional>
#include <string>
#include <thread>

#include "tests/rig_body.h"

using namespace swivel::test;
using Eigen::Vector3d;
using nlohmann::json;

namespace {

// Arms are bent at rest, so that this tells where they bend to.
int add_bone(GltfRig& rig, const std::string& name, int parent, const Vector3d& step = {1, 0, 0})
{
    const double bend = name.ends_with("ForeArm") ? 0.5 : 0;
    return rig.add(name, parent, step, Eigen::Quaterniond(Eigen::AngleAxisd(bend, Vector3d::UnitY())));
}

}  // namespace

TEST_CASE("rigs: joint names with line ends stay in their line")
{
    const TempFolder folder;
    const auto solve = [&](int chains, const Vector3d& step, const Vector3d& scale) {
        GltfRig rig;
        const int root = rig.add("ro\not", -1, {0, 0, 0}, Eigen::Quaterniond::Identity(), scale);
        for (int n = 0; n < chains; ++n)
            for (int parent = root; const char* name : {"Left\nArm", "Left\nForeArm", "Left\nHand"})
                parent = add_bone(rig, name, parent, step);
        rig.write(folder / "rig.glb");
        return run_command(folder.path, {"solve", "rig.glb"});
    };
    const auto refused = [&](const Outcome& outcome, const std::string& part) {
        INFO(outcome.err);
        CHECK(outcome.exit_code == 1);
        CHECK(outcome.err.find(part) != std::string::npos);
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    };
    const Vector3d step = {1, 0, 0}, even = {1, 1, 1};
    refused(solve(1, {0, 0, 0}, even), R"(from 'Left\x0aArm' to 'Left\x0aForeArm' has no length)");
    refused(solve(1, step, {1, 2, 1}), R"('ro\x0aot')");
    refused(solve(2, step, even), R"(Left\x0aArm)");
    CHECK(solve(1, step, even).out.find(R"(Left\x0aArm > Left\x0aForeArm > Left\x0aHand)") != std::string::npos);
}

TEST_CASE("rigs: a limb that does not bind is in the report of those that do")
{
    const TempFolder folder;
    const auto missing = [&](const std::vector<std::string>& right) {
        GltfRig rig;
        const int root = rig.add("root", -1, {0, 0, 0});
        for (const auto& names : {std::vector<std::string>{"LeftArm", "LeftForeArm", "LeftHand"}, right})
            for (int parent = root; const std::string& name : names) parent = add_bone(rig, name, parent);
        rig.write(folder / "rig.glb");
        const Outcome said = run_command(folder.path, {"solve", "rig.glb"});
        INFO(said.err);
        REQUIRE(said.exit_code == 0);
        const Outcome outcome = run_command(folder.path, {"solve", "rig.glb", "--json"});
        const json limb = json::parse(outcome.out).at("missing").at(0);
        CHECK(limb.at("limb") == "right_arm");
        const std::string problem = limb.at("problem");
        CHECK_FALSE(problem.empty());
        CHECK(said.out.find(problem) != std::string::npos);
        return problem;
    };
    missing({});
    missing({"RightForeArm"});
    CHECK(missing({"RightArm", "RightHand", "RightForeArm"}) != missing({}));
}

TEST_CASE("rigs: sheared matrices and scales of nothing are refused")
{
    const TempFolder folder;
    const auto problem = [&](const std::function<void(json&, GltfRig&)>& spoil) {
        GltfRig rig;
        const int root = rig.add("root", -1, {0, 0, 0});
        for (int parent = root; const char* name : {"LeftArm", "LeftForeArm", "LeftHand"})
            parent = add_bone(rig, name, parent);
        spoil(rig.json["nodes"][0], rig);
        rig.write(folder / "rig.glb");
        const Outcome outcome = run_command(folder.path, {"rig", "rig.glb", "--json"});
        CHECK(outcome.exit_code == 1);
        return json::parse(outcome.out).at("limbs")[0].at("problem").get<std::string>();
    };
    const auto has = [](const std::string& text, const char* part) {
        INFO(text);
        CHECK(text.find(part) != std::string::npos);
    };
    has(problem([](json& root, GltfRig&) {
            root.erase("translation");
            root.erase("rotation");
            root["matrix"] = {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        }),
        "the matrix of 'root' is sheared");
    has(problem([](json& root, GltfRig&) { root["scale"] = {0, 0, 0}; }), "'root' is scaled to nothing at rest");
    has(problem([](json&, GltfRig& rig) {
            rig.add_keys(rig.add_animation("hide"), 0, "scale", {0, 1}, {1, 1, 1, 0, 0, 0}, "STEP");
        }),
        "'root' is scaled to nothing in frame");
}

namespace {

// Arms of these sides, as joints in a row: LeftArm, LeftForeArm, LeftHand.
void write_arms(const fs::path& path, const std::vector<std::string>& sides)
{
    GltfRig rig;
    const int root = rig.add("root", -1, {0, 0, 0});
    for (const std::string& side : sides)
        for (int parent = root; const std::string name : {"Arm", "ForeArm", "Hand"})
            parent = add_bone(rig, side + name, parent);
    rig.write(path);
}

std::string joints_of(const std::string& side) { return side + "Arm," + side + "ForeArm," + side + "Hand"; }

std::string table_of(const std::string& limb, const std::string& side)
{
    return "[limb." + limb + "]\njoints = [\"" + side + "Arm\", \"" + side + "ForeArm\", \"" + side + "Hand\"]\n";
}

}  // namespace

TEST_CASE("rigs: naming one side leaves the other to the names in use, where the kind is asked for")
{
    const TempFolder folder;
    write_arms(folder / "rig.glb", {"Left", "Right", "Third"});
    const auto bound = [&](const char* command, std::vector<std::string> options) {
        options.insert(options.begin(), {command, "rig.glb", "--json"});
        const Outcome outcome = run_command(folder.path, options);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        const json report = json::parse(outcome.out);
        std::vector<std::string> found;
        if (report.contains("arms_bound"))
            for (const json& limb : report["arms_bound"]) found.push_back(limb.at("shoulder"));
        else
            for (const json& limb : report["limbs"])
                if (limb.at("bound") == true) found.push_back(limb.at("joints")[0]);
        return found;
    };
    using Found = std::vector<std::string>;
    const std::string left = "left:" + joints_of("Third"), right = "right:" + joints_of("Third");
    CHECK(bound("solve", {"--limbs", "arms", "--arm", left}) == Found{"ThirdArm", "RightArm"});
    CHECK(bound("solve", {"--limbs", "arms", "--arm", right}) == Found{"LeftArm", "ThirdArm"});
    CHECK(bound("rig", {"--arm", right}) == Found{"LeftArm", "ThirdArm"});
    CHECK(bound("solve", {"--arm", right}) == Found{"ThirdArm"});
    spill(folder / "crowd.toml",
          "[crowd]\nlimbs = \"arms\"\n[limb.right_arm]\njoints = [\"ThirdArm\", \"ThirdForeArm\", \"ThirdHand\"]\n");
    CHECK(bound("solve", {"--crowd", "crowd.toml"}) == Found{"LeftArm", "ThirdArm"});
}

TEST_CASE("rigs: an option replaces a crowd file's joints of its own side alone")
{
    const TempFolder folder;
    write_arms(folder / "rig.glb", {"Left", "Right", "Third", "Fourth"});
    const auto bound = [&](const std::string& toml, std::vector<std::string> options) {
        spill(folder / "crowd.toml", toml);
        options.insert(options.begin(), {"solve", "rig.glb", "--crowd", "crowd.toml", "--json"});
        const Outcome outcome = run_command(folder.path, options);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        std::vector<std::string> found;
        const json report = json::parse(outcome.out);
        for (const json& limb : report.at("arms_bound"))
            found.push_back(limb.at("side").get<std::string>() + " " + limb.at("shoulder").get<std::string>());
        return found;
    };
    using Found = std::vector<std::string>;
    const std::string arms = "[crowd]\nlimbs = \"arms\"\n", third = table_of("right_arm", "Third");
    CHECK(bound(arms + third, {}) == Found{"left LeftArm", "right ThirdArm"});
    CHECK(bound(arms + third, {"--arm", "left:" + joints_of("Fourth")}) == Found{"left FourthArm", "right ThirdArm"});
    CHECK(bound(arms + third, {"--arm", "right:" + joints_of("Fourth")}) == Found{"left LeftArm", "right FourthArm"});
    // Which side an option without one is for, its names tell.
    CHECK(bound(arms + third, {"--arm", joints_of("Left")}) == Found{"left LeftArm", "right ThirdArm"});
    CHECK(bound(arms + third, {"--arm", joints_of("Right")}) == Found{"left LeftArm", "right RightArm"});
    CHECK(bound(third, {"--arm", "left:" + joints_of("Fourth")}) == Found{"left FourthArm", "right ThirdArm"});
    CHECK(bound(table_of("left_arm", "Third"), {"--arm", "right:" + joints_of("Fourth")}) ==
          Found{"left ThirdArm", "right FourthArm"});
}

TEST_CASE("rigs: a joint that is named for one limb is no other's")
{
    const TempFolder folder;
    write_arms(folder / "rig.glb", {"Left", "Right"});
    const std::string left = "left:" + joints_of("Right"), right = "right:" + joints_of("Right");
    const Outcome rig = run_command(folder.path, {"rig", "rig.glb", "--json", "--arm", left});
    INFO(rig.err);
    REQUIRE(rig.exit_code == 0);
    const json report = json::parse(rig.out);
    CHECK(report["limbs"][0]["joints"][0] == "RightArm");
    CHECK(report["limbs"][1]["problem"] == "'RightArm' is named for the left arm");
    const Outcome half = run_command(folder.path, {"solve", "rig.glb", "--json", "--limbs", "arms", "--arm", left});
    INFO(half.err);
    REQUIRE(half.exit_code == 0);
    CHECK(json::parse(half.out)["missing"][0]["problem"] == "'RightArm' is named for the left arm");
    const auto refused = [&](std::vector<std::string> options, const std::string& message) {
        options.insert(options.begin(), {"solve", "rig.glb"});
        const Outcome outcome = run_command(folder.path, options);
        CHECK(outcome.exit_code == 1);
        CHECK(outcome.err == "swivel: " + message + "\n");
    };
    refused({"--arm", left, "--arm", right},
            "rig.glb: the left arm and the right arm share the joint 'RightArm' (--arm); each needs three of its own");
    spill(folder / "crowd.toml", table_of("right_arm", "Right"));
    refused(
        {"--arm", left, "--crowd", "crowd.toml"},
        "crowd.toml:2: limb.right_arm.joints: the left arm and the right arm share the joint 'RightArm' in rig.glb; "
        "each needs three of its own");
}

TEST_CASE("rigs: rig and solve see the same figure, of which one limb alone is named")
{
    const TempFolder folder;
    GltfRig rig;  // its left is at -X, so that it faces -Z
    const int root = rig.add("root", -1, {0, 0, 0});
    for (const double side : {-1.0, 1.0}) {
        const std::string word = side < 0 ? "Left" : "Right";
        for (int at = root; const std::string name : {"Arm", "ForeArm", "Hand"})
            at = rig.add(word + name, at, {side, at == root ? 2.0 : 0, 0});
        for (int at = root; const std::string name : {"UpLeg", "Leg", "Foot"})
            at = rig.add(word + name, at, {at == root ? side : 0, at == root ? 0 : -1.0, 0});
    }
    rig.write(folder / "rig.glb");
    const auto right_arm = [&](const char* command, const char* limbs) {
        const Outcome outcome =
            run_command(folder.path, {command, "rig.glb", "--json", "--arm", "right:" + joints_of("Left")});
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        const json report = json::parse(outcome.out);
        for (const json& limb : report.at(limbs))
            if (limb.contains("bend")) return limb;
        return json();
    };
    const json in_rig = right_arm("rig", "limbs"), solved = right_arm("solve", "arms_bound");
    CHECK(in_rig.at("limb") == "right_arm");
    CHECK(in_rig.at("bend") == solved.at("bend"));
    CHECK(solved.at("bend_source").get<std::string>().find("left and right hip") != std::string::npos);
}

TEST_CASE("rigs: what a crowd file asks for and is not there is said with file, line and key")
{
    const TempFolder folder;
    GltfRig rig;
    int parent = rig.add("root", -1, {0, 0, 0});
    for (const char* name : {"LeftArm", "LeftForeArm", "LeftHand"}) parent = add_bone(rig, name, parent);
    rig.write(folder / "rig.glb");
    const auto refused = [&](const char* toml, const std::string& message) {
        spill(folder / "crowd.toml", toml);
        const Outcome outcome = run_command(folder.path, {"solve", "rig.glb", "--crowd", "crowd.toml"});
        CHECK(outcome.exit_code == 1);
        CHECK(outcome.err == message);
    };
    spill(folder / "crowd.toml", "[crowd]\nlimbs = \"legs\"\n");
    const Outcome legs = run_command(folder.path, {"solve", "rig.glb", "--crowd", "crowd.toml"});
    INFO(legs.err);
    CHECK(legs.exit_code == 1);
    CHECK(legs.err.find("no limb binds: the left leg") != std::string::npos);
    refused(
        "[crowd]\n\ntargets = \"no.csv\"\n",
        "swivel: crowd.toml:3: crowd.targets: no.csv: cannot be opened: No such file or directory; check the path\n");
    spill(folder / "crowd.toml", "[crowd]\ntargets = \"no.csv\"\n");
    CHECK(run_command(folder.path, {"solve", "rig.glb", "--crowd", "crowd.toml", "--targets", "clip"}).exit_code == 0);
    fs::create_directory(folder / "folder");
    refused("[crowd]\ntargets = \"folder\"\n",
            "swivel: crowd.toml:2: crowd.targets: folder: is a directory; name a file in it\n");
}

// A pipe that is opened twice loses what its writer has to say.
TEST_CASE("rigs: a crowd file's targets may come from a pipe")
{
    const TempFolder folder;
    write_arms(folder / "rig.glb", {"Left", "Right"});
    spill(folder / "crowd.toml", "[crowd]\ntargets = \"pipe\"\n");
    const fs::path pipe = folder / "pipe";
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    const auto before = std::signal(SIGPIPE, SIG_IGN);
    std::thread writer(
        [&] { spill(pipe, "frame,character,limb,x,y,z,pole_x,pole_y,pole_z\n0,0,left_arm,2,1,0,1,2,0\n"); });
    const Outcome outcome =
        spawn_command(folder.path, {"solve", "rig.glb", "--crowd", "crowd.toml", "--json"}, {.max_seconds = 10});
    const int nobody_else = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);  // lets the writer go if the command did not
    writer.join();
    close(nobody_else);
    std::signal(SIGPIPE, before);
    INFO(outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    CHECK(outcome.out.find("\"pipe\"") != std::string::npos);
}

TEST_CASE("rigs: a mirror that comes or goes in the clip is refused, one that stays is followed")
{
    const TempFolder folder;
    const auto solve = [&](double rest, const std::vector<float>& x) {
        GltfRig rig;
        const int root = rig.add("root", -1, {0, 0, 0}, Eigen::Quaterniond::Identity(), {rest, 1, 1});
        int parent = root;
        for (const char* name : {"LeftArm", "LeftForeArm", "LeftHand"}) parent = add_bone(rig, name, parent);
        std::vector<float> scales;
        for (const float each : x) scales.insert(scales.end(), {each, 1, 1});
        rig.add_keys(rig.add_animation("motion"), root, "scale", {0, 1, 2}, scales, "STEP");
        rig.write(folder / "rig.glb");
        return run_command(folder.path, {"solve", "rig.glb", "--out", "out.csv"});
    };
    const auto refused = [](const Outcome& outcome, const char* part) {
        INFO(outcome.err);
        CHECK(outcome.exit_code == 1);
        CHECK(outcome.err.find(part) != std::string::npos);
    };
    refused(solve(1, {1, -1, 1}), "'root' is mirrored in frame 1 and not at rest, and");
    refused(solve(-1, {-1, -1, 1}), "'root' is mirrored at rest and not in frame 2, and a limb");
    CHECK(folder.file_count() == 1);
    CHECK(solve(-1, {-1, -1, -1}).exit_code == 0);
}

TEST_CASE("rigs: nodes moved by KHR_animation_pointer are not taken to rest")
{
    const TempFolder folder;
    GltfRig rig = rig_of({.clip = {{0, 0, 0, 0}, {0, 0, 40, 40}}});
    auto& channel = rig.json["animations"][0]["channels"][0];
    rig.json["extensionsUsed"] = {"KHR_animation_pointer"};
    const auto solve = [&](const std::string& pointer) {
        channel["target"] = {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
        rig.write(folder / "rig.glb");
        return run_command(folder.path, {"solve", "rig.glb", "--limbs", "legs"});
    };
    const Outcome refused = solve("/nodes/2/rotation");
    CHECK(refused.exit_code == 1);
    CHECK(refused.err.find("animation 0 moves /nodes/2/rotation by KHR_animation_pointer") != std::string::npos);
    CHECK(solve("/materials/0/emissiveFactor").exit_code == 0);
    CHECK(solve("/nodes/2/extensions/KHR_lights_punctual/intensity").exit_code == 0);
}

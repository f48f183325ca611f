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

#include "tests/random_figure.h"

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

// Its bones below each other. The last one.
int add_bones(GltfRig& rig, int parent, const Words& names, const Vector3d& step = {1, 0, 0})
{
    for (const std::string& name : names) parent = add_bone(rig, name, parent, step);
    return parent;
}

const Words kLeftArm = {"LeftArm", "LeftForeArm", "LeftHand"};

// Refused in one line that has this part.
void require_refused(const Outcome& outcome, const std::string& part)
{
    INFO(outcome.err);
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.err, Catch::Contains(part));
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
}

// Arms of these sides, as joints in a row: LeftArm, LeftForeArm, LeftHand.
void write_arms(const fs::path& path, const Words& sides)
{
    GltfRig rig;
    const int root = rig.add("root", -1, {0, 0, 0});
    for (const std::string& side : sides) add_bones(rig, root, {side + "Arm", side + "ForeArm", side + "Hand"});
    rig.write(path);
}

std::string joints_of(const std::string& side) { return side + "Arm," + side + "ForeArm," + side + "Hand"; }

std::string table_of(const std::string& limb, const std::string& side)
{
    return "[limb." + limb + "]\njoints = [\"" + side + "Arm\", \"" + side + "ForeArm\", \"" + side + "Hand\"]\n";
}

}  // namespace

TEST_CASE("rigs: joint names with line ends stay in their line")
{
    const TempFolder folder;
    const auto solve = [&](int chains, const Vector3d& step, const Vector3d& scale) {
        GltfRig rig;
        const int root = rig.add("ro\not", -1, {0, 0, 0}, Eigen::Quaterniond::Identity(), scale);
        for (int n = 0; n < chains; ++n) add_bones(rig, root, {"Left\nArm", "Left\nForeArm", "Left\nHand"}, step);
        rig.write(folder / "rig.glb");
        return run_command(folder.path, {"solve", "rig.glb"});
    };
    const Vector3d step = {1, 0, 0}, even = {1, 1, 1};
    require_refused(solve(1, {0, 0, 0}, even), R"(from 'Left\x0aArm' to 'Left\x0aForeArm' has no length)");
    require_refused(solve(1, step, {1, 2, 1}), R"('ro\x0aot')");
    require_refused(solve(2, step, even), R"(Left\x0aArm)");
    CHECK(solve(1, step, even).out.find(R"(Left\x0aArm > Left\x0aForeArm > Left\x0aHand)") != std::string::npos);
}

TEST_CASE("rigs: sheared matrices and scales of nothing are refused")
{
    const TempFolder folder;
    const auto problem = [&](const std::function<void(json&, GltfRig&)>& spoil) {
        GltfRig rig;
        const int root = rig.add("root", -1, {0, 0, 0});
        add_bones(rig, root, kLeftArm);
        spoil(rig.json["nodes"][0], rig);
        rig.write(folder / "rig.glb");
        const Outcome outcome = run_command(folder.path, {"rig", "rig.glb", "--json"});
        CHECK(outcome.exit_code == 1);
        return json::parse(outcome.out).at("limbs")[0].at("problem").get<std::string>();
    };
    const auto has = [](const std::string& text, const char* part) { CHECK_THAT(text, Catch::Contains(part)); };
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

TEST_CASE("rigs: an option names a limb of its own side alone, and the other is the crowd file's or the names' in use")
{
    const TempFolder folder;
    write_arms(folder / "rig.glb", {"Left", "Right", "Third", "Fourth"});
    const auto bound = [&](const std::string& toml, Words options) {
        spill(folder / "crowd.toml", toml);
        options.insert(options.begin(), {"solve", "rig.glb", "--crowd", "crowd.toml"});
        Words found;
        const json report = report_of(folder.path, options);
        for (const json& limb : report.at("arms_bound"))
            found.push_back(limb.at("side").get<std::string>() + " " + limb.at("shoulder").get<std::string>());
        return found;
    };
    const std::string arms = "[crowd]\nlimbs = \"arms\"\n", third = table_of("right_arm", "Third");
    const Words fourth_left = {"--arm", "left:" + joints_of("Fourth")};
    CHECK(bound(arms, {}) == Words{"left LeftArm", "right RightArm"});
    CHECK(bound(arms, fourth_left) == Words{"left FourthArm", "right RightArm"});
    CHECK(bound("[crowd]\n", fourth_left) == Words{"left FourthArm"});  // no kind is asked for
    CHECK(bound(arms + third, {}) == Words{"left LeftArm", "right ThirdArm"});
    CHECK(bound(arms + third, fourth_left) == Words{"left FourthArm", "right ThirdArm"});
    CHECK(bound(arms + third, {"--arm", "right:" + joints_of("Fourth")}) == Words{"left LeftArm", "right FourthArm"});
    // Which side an option without one is for, its names tell.
    CHECK(bound(arms + third, {"--arm", joints_of("Left")}) == Words{"left LeftArm", "right ThirdArm"});
    CHECK(bound(arms + third, {"--arm", joints_of("Right")}) == Words{"left LeftArm", "right RightArm"});
    CHECK(bound(third, fourth_left) == Words{"left FourthArm", "right ThirdArm"});
    const json rig = report_of(folder.path, {"rig", "rig.glb", "--arm", "right:" + joints_of("Third")});
    CHECK(limb_of(rig, "left_arm").at("joints")[0] == "LeftArm");
    CHECK(limb_of(rig, "right_arm").at("joints")[0] == "ThirdArm");
}

TEST_CASE("rigs: a joint that is named for one limb is no other's")
{
    const TempFolder folder;
    write_arms(folder / "rig.glb", {"Left", "Right"});
    const std::string left = "left:" + joints_of("Right"), right = "right:" + joints_of("Right");
    const json report = report_of(folder.path, {"rig", "rig.glb", "--arm", left});
    CHECK(report["limbs"][0]["joints"][0] == "RightArm");
    CHECK(report["limbs"][1]["problem"] == "'RightArm' is named for the left arm");
    CHECK(report_of(folder.path, {"solve", "rig.glb", "--limbs", "arms", "--arm", left})["missing"][0]["problem"] ==
          "'RightArm' is named for the left arm");
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
    rig_of({.left_at = -1, .toe_step = {}}).write(folder / "rig.glb");  // it faces -z
    const auto right_arm = [&](const char* command, const char* limbs) {
        const json report = report_of(folder.path, {command, "rig.glb", "--arm", "right:" + joints_of("Left")});
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
    add_bones(rig, rig.add("root", -1, {0, 0, 0}), kLeftArm);
    rig.write(folder / "rig.glb");
    const auto refused = [&](const char* toml, const std::string& message) {
        spill(folder / "crowd.toml", toml);
        const Outcome outcome = run_command(folder.path, {"solve", "rig.glb", "--crowd", "crowd.toml"});
        CHECK(outcome.exit_code == 1);
        CHECK(outcome.err == message);
    };
    spill(folder / "crowd.toml", "[crowd]\nlimbs = \"legs\"\n");
    require_refused(run_command(folder.path, {"solve", "rig.glb", "--crowd", "crowd.toml"}),
                    "no limb binds: the left leg");
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
        add_bones(rig, root, kLeftArm);
        std::vector<float> scales;
        for (const float each : x) scales.insert(scales.end(), {each, 1, 1});
        rig.add_keys(rig.add_animation("motion"), root, "scale", {0, 1, 2}, scales, "STEP");
        rig.write(folder / "rig.glb");
        return run_command(folder.path, {"solve", "rig.glb", "--out", "out.csv"});
    };
    require_refused(solve(1, {1, -1, 1}), "'root' is mirrored in frame 1 and not at rest, and");
    require_refused(solve(-1, {-1, -1, 1}), "'root' is mirrored at rest and not in frame 2, and a limb");
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
    require_refused(solve("/nodes/2/rotation"), "animation 0 moves /nodes/2/rotation by KHR_animation_pointer");
    CHECK(solve("/materials/0/emissiveFactor").exit_code == 0);
    CHECK(solve("/nodes/2/extensions/KHR_lights_punctual/intensity").exit_code == 0);
}

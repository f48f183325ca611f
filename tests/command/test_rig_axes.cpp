// SPDX-License-Identifier: MIT
//
// What `swivel rig` says to people who write limits. The figure's nodes judge where a limb's own axes point. Solving
// under the printed limits judges whether the clip fits into them.
#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <string>

#include "tests/plain_gltf.h"
#include "tests/random_figure.h"
#include "tests/run_command.h"
#include "tests/three_joints.h"

using namespace swivel::test;
using Eigen::Vector3d;
using nlohmann::json;

namespace {

json rig_report(const TempFolder& folder) { return report_of(folder.path, {"rig", "rig.glb"}); }

// Of a figure with its limbs along these directions on its left: the words for the axes of each limb.
std::vector<std::array<std::string, 3>> words_of(const Vector3d& arm, const Vector3d& leg,
                                                 const Eigen::Quaterniond& turn)
{
    const json report = swivel::test::rig_report(rig_of({.arm_bone = arm, .leg_bone = leg, .turn = turn}));
    CHECK(report.at("faces_by") == "the toes");
    CHECK(vector_of(report.at("faces")).isApprox(turn * Vector3d::UnitZ(), 1e-6));
    std::vector<std::array<std::string, 3>> words;
    for (const json& limb : report.at("limbs")) {
        const json& axes = limb.at("axes");
        words.push_back({axes["x"]["points"], axes["y"]["points"], axes["z"]["points"]});
    }
    return words;
}

// What the library makes of a limb's skeleton and bend as the report has them.
swivel_binding bound_as_printed(const json& limb)
{
    const json& skeleton = limb.at("skeleton");
    CHECK(skeleton.at("parents") == json(ThreeJoints::kParents));
    ThreeJoints joints;
    skeleton.at("rotations").get_to(joints.rotations);
    skeleton.at("translations").get_to(joints.translations);
    limb.at("bend").get_to(joints.bend);
    return joints.bound();
}

// The lines for a crowd file that the report for people has of one limb; empty without any.
std::string lines_of(const std::string& report, const std::string& limb)
{
    const std::size_t from = report.find("           [limb." + limb + "]\n");
    if (from == std::string::npos) return {};
    const std::size_t last = report.find("           flexion_deg", from);
    REQUIRE(last != std::string::npos);
    return report.substr(from, report.find('\n', last) + 1 - from);
}

// How many limbs a crowd file's limits hold back in a solve of all limbs.
int limited(const TempFolder& folder, const std::string& toml, std::vector<std::string> options = {})
{
    spill(folder / "crowd.toml", toml);
    INFO(toml);
    options.insert(options.begin(), {"solve", "rig.glb", "--crowd", "crowd.toml"});
    const json flags = report_of(folder.path, options).at("flags");
    return flags.at("limited shoulder cone").get<int>() + flags.at("limited flexion").get<int>();
}

// The lines with a number of theirs, the last before `end`, less by 0.2.
std::string narrower(std::string lines, const std::string& key, const std::string& end)
{
    const std::size_t to = lines.find(end, lines.find(key)), from = lines.rfind(' ', to - 1) + 1;
    return lines.replace(from, to - from, fmt::format("{:.1f}", std::stod(lines.substr(from, to - from)) - 0.2));
}

// A turn about an axis, a key each half second in degrees, as a node's animation.
void add_turn(GltfRig& rig, int animation, int node, const Vector3d& axis, const std::vector<double>& degrees)
{
    std::vector<float> times;
    for (std::size_t n = 0; n < degrees.size(); ++n) times.push_back(0.5f * static_cast<float>(n));
    rig.add_keys(animation, node, "rotation", times, turns(axis, degrees));
}

}  // namespace

TEST_CASE("rig axes: a limb's joints, lengths and bones are the figure's, z runs along it at rest, y where it bends to")
{
    const TempFolder folder;
    std::mt19937 random(11);
    for (int round = 0; round < 24; ++round) {
        FigureWish wish;
        wish.moves = false;
        wish.bent = round % 2 == 0;
        wish.toes = round % 3 == 0;
        wish.scales = wish.mirrors = round % 3 == 0 ? 0 : 0.4;
        const Figure figure = random_figure(random, wish);
        figure.rig.write(folder / "rig.glb");
        const PlainGltf plain = plain_gltf_of(folder / "rig.glb");
        const json report = rig_report(folder);
        for (std::size_t n = 0; n < 4; ++n) {
            const json& limb = report.at("limbs")[n];
            INFO("round " << round << ": " << limb.dump());
            const auto place = [&](std::size_t part) {
                return Vector3d(plain_world(plain, -1, figure.limbs[n][part], 0).translation());
            };
            const auto axis = [&](const char* name) { return vector_of(limb.at("axes").at(name).at("world")); };
            const Vector3d x = axis("x"), y = axis("y"), z = axis("z");
            const swivel_binding bound = bound_as_printed(limb);
            const double lengths[] = {figure.upper[n], figure.lower[n]}, scale = limb.at("scale");
            CHECK(limb.at("numbers") == json(figure.limbs[n]));
            for (std::size_t bone = 0; bone < 2; ++bone) {
                CHECK(limb["lengths"][bone].get<double>() == Approx(lengths[bone]).epsilon(1e-5));
                CHECK(scale * static_cast<double>(bound.lengths[bone]) == Approx(lengths[bone]).epsilon(1e-5));
            }
            CHECK((z - (place(1) - place(0)).normalized()).norm() < 1e-5);
            CHECK(y.dot(n < 2 ? figure.front : Vector3d(-figure.front)) > 0.9);
            CHECK((x - y.cross(z)).norm() < 1e-6);
        }
    }
}

TEST_CASE("rig axes: directions are said as the figure would")
{
    using AxisWords = std::vector<std::array<std::string, 3>>;
    const AxisWords t_pose = {{"up", "forwards", "left"},
                              {"down", "forwards", "right"},
                              {"right", "backwards", "down"},
                              {"right", "backwards", "down"}};
    CHECK(words_of({1, 0, 0}, {0, -1, 0}, Eigen::Quaterniond::Identity()) == t_pose);
    CHECK(words_of({1, 0, 0}, {0, -1, 0}, Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5)) == t_pose);
    const AxisWords a_pose = words_of({0.8, -0.6, 0}, {0.1, -1, 0}, Eigen::Quaterniond::Identity());
    CHECK(a_pose[0] == std::array<std::string, 3>{"up and left", "forwards", "left and down"});
    CHECK(a_pose[1] == std::array<std::string, 3>{"down and left", "forwards", "right and down"});
    CHECK(a_pose[2][2] == "down");
}

TEST_CASE("rig axes: a clip fits into the limits that are printed, and into none much narrower")
{
    const TempFolder folder;
    std::mt19937 random(12);
    for (int round = 0; round < 4; ++round) {
        FigureWish wish;
        wish.scales = wish.mirrors = round == 0 ? 0 : 0.4;
        random_figure(random, wish).rig.write(folder / "rig.glb");
        const std::string out = run_command(folder.path, {"rig", "rig.glb"}).out;
        std::string all;
        for (const char* limb : {"left_arm", "right_arm", "left_leg", "right_leg"}) {
            const std::string lines = lines_of(out, limb);
            INFO("round " << round << ": " << lines);
            REQUIRE_FALSE(lines.empty());
            CHECK(limited(folder, narrower(lines, "opening_deg", " }")) > 0);
            CHECK(limited(folder, narrower(lines, "flexion_deg", "]")) > 0);
            all += lines;
        }
        CHECK(limited(folder, all) == 0);
    }
    FigureWish still;
    still.moves = false;
    random_figure(random, still).rig.write(folder / "rig.glb");
    CHECK(lines_of(run_command(folder.path, {"rig", "rig.glb"}).out, "left_arm").empty());
}

TEST_CASE("rig axes: the printed lines hold for another clip, which shows another bend")
{
    const TempFolder folder;
    GltfRig rig;
    const int root = rig.add("root", -1, {0, 0, 0});
    const int arm = rig.add("LeftArm", root, {0.1, 1, 0}), fore_arm = rig.add("LeftForeArm", arm, {1, 0, 0});
    rig.add("LeftHand", fore_arm, {1, 0, 0});
    const int leg = rig.add("LeftUpLeg", root, {0.1, 0, 0});
    rig.add("Left \"Foot\"", rig.add("LeftLeg", leg, {0, -1, 0}), {0, -1, 0});
    const std::vector<double> raised = {50, 55, 60};
    for (const Vector3d& elbow : {Vector3d(0, -1, 0), Vector3d(0, 0, 1)}) {
        const int animation = rig.add_animation(elbow.z() > 0 ? "up" : "forwards");
        add_turn(rig, animation, arm, {0, -1, 0}, raised);
        add_turn(rig, animation, fore_arm, elbow, {40, 30, 40});
        add_turn(rig, animation, leg, {-1, 0, 0}, raised);
    }
    rig.write(folder / "rig.glb");
    const Outcome printed =
        run_command(folder.path, {"rig", "rig.glb", "--clip", "forwards", "--leg", "LeftUpLeg,LeftLeg,Left \"Foot\""});
    INFO(printed.err << printed.out);
    const std::string arm_lines = lines_of(printed.out, "left_arm"), leg_lines = lines_of(printed.out, "left_leg");
    REQUIRE_FALSE(arm_lines.empty());
    REQUIRE_FALSE(leg_lines.empty());
    CHECK(limited(folder, arm_lines + leg_lines, {"--clip", "up"}) == 0);
    std::string own_bend = arm_lines;
    own_bend.erase(own_bend.find("bend"), own_bend.find('\n', own_bend.find("bend")) - own_bend.find("bend"));
    CHECK(limited(folder, own_bend, {"--clip", "up"}) > 0);
}

TEST_CASE("rig axes: what tells which way is up")
{
    const TempFolder folder;
    const auto told_by = [&](const std::vector<std::size_t>& limbs) {
        rig_of({.limbs = limbs}).write(folder / "rig.glb");
        const json report = rig_report(folder);
        CHECK(vector_of(report.at("up")).isApprox(Vector3d::UnitY(), 1e-6));
        const std::string by = report.at("up_by");
        CHECK_THAT(run_command(folder.path, {"rig", "rig.glb"}).out,
                   Catch::Contains("up is (0.000 1.000 0.000), told by " + by + "\n"));
        return by;
    };
    CHECK(told_by({0, 1, 2, 3}) == "hips to shoulders");
    CHECK(told_by({2, 3}) == "the file's +Y");
    CHECK(told_by({0, 1}) == "the file's +Y");
}

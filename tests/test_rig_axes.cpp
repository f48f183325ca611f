// SPDX-License-Identifier: MIT
//
// What `swivel rig` says to people who write limits. The figure's nodes judge where a limb's own axes point. Solving
// under the printed limits judges whether the clip fits into them.
#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>

#include "swivel/swivel.hpp"
#include "tests/plain_gltf.h"
#include "tests/random_figure.h"
#include "tests/rig_report.h"
#include "tests/run_command.h"

using namespace swivel::test;
using Eigen::Vector3d;
using nlohmann::json;

namespace {

json rig_report(const TempFolder& folder)
{
    const Outcome outcome = run_command(folder.path, {"rig", "rig.glb", "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return json::parse(outcome.out);
}

// Of a figure with its limbs along these directions: the words for the axes of each limb.
std::vector<std::array<std::string, 3>> words_of(const std::array<Vector3d, 4>& along, const Eigen::Quaterniond& turn)
{
    const TempFolder folder;
    GltfRig rig;
    const int hips = rig.add("Hips", -1, {0, 0, 0}, turn), chest = rig.add("Chest", hips, {0, 1, 0});
    const std::array<std::array<std::string, 3>, 2> names = {{{"Arm", "ForeArm", "Hand"}, {"UpLeg", "Leg", "Foot"}}};
    for (std::size_t limb = 0; limb < 4; ++limb) {
        const std::string side = limb % 2 == 0 ? "Left" : "Right";
        int parent = limb < 2 ? chest : hips;
        Vector3d step = {limb % 2 == 0 ? 0.1 : -0.1, 0, 0};
        for (const std::string& name : names[limb / 2]) {
            parent = rig.add(side + name, parent, step);
            step = along[limb];
        }
        if (limb >= 2) rig.add(side + "Toe", parent, {0, 0, 0.1});
    }
    rig.write(folder / "rig.glb");
    const json report = rig_report(folder);
    CHECK(report.at("faces_by") == "the toes");
    CHECK(vector_of(report.at("faces")).isApprox(turn * Vector3d::UnitZ(), 1e-6));
    std::vector<std::array<std::string, 3>> words;
    for (const json& limb : report.at("limbs")) {
        const json& axes = limb.at("axes");
        words.push_back({axes["x"]["points"], axes["y"]["points"], axes["z"]["points"]});
    }
    return words;
}

int limited(const TempFolder& folder, const std::string& toml, const char* flag)
{
    spill(folder / "crowd.toml", toml);
    const Outcome outcome =
        run_command(folder.path, {"solve", "rig.glb", "--limbs", "all", "--crowd", "crowd.toml", "--json"});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return json::parse(outcome.out).at("flags").at(flag).get<int>();
}

std::string cone_of(const json& limb, double less)
{
    const json& cone = limb.at("clip_range").at("shoulder_cone");
    return fmt::format(
        "[limb.{0}]\nbend = {1}\n[limb.{0}.limits]\nshoulder_cone = {{ axis = {2}, opening_deg = {3} }}\n",
        limb.at("limb").get<std::string>(), limb.at("clip_range").at("bend").dump(), cone.at("axis").dump(),
        cone.at("opening_deg").get<double>() - less);
}

std::string flexion_of(const json& limb, double less)
{
    const json& range = limb.at("clip_range").at("flexion_deg");
    return fmt::format("[limb.{}.limits]\nflexion_deg = [{}, {}]\n", limb.at("limb").get<std::string>(),
                       range[0].get<double>(), range[1].get<double>() - less);
}

}  // namespace

TEST_CASE("rig axes: z runs along the resting limb, y where it bends to, whatever the joints' axes")
{
    const TempFolder folder;
    std::mt19937 random(11);
    for (int round = 0; round < 12; ++round) {
        FigureWish wish;
        wish.moves = false;
        wish.bent = round % 2 == 0;
        wish.scales = wish.mirrors = round % 3 == 0 ? 0 : 0.4;
        const Figure figure =
            random_figure(random, wish, figure_names()[static_cast<std::size_t>(round) % figure_names().size()]);
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
            CHECK((z - (place(1) - place(0)).normalized()).norm() < 1e-5);
            CHECK(y.dot(n < 2 ? figure.front : Vector3d(-figure.front)) > 0.9);
            CHECK((x - y.cross(z) * (limb.at("mirrored") == true ? -1 : 1)).norm() < 1e-6);
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
    const std::array<Vector3d, 4> along = {Vector3d(1, 0, 0), {-1, 0, 0}, {0, -1, 0}, {0, -1, 0}};
    CHECK(words_of(along, Eigen::Quaterniond::Identity()) == t_pose);
    CHECK(words_of(along, Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5)) == t_pose);
    const std::array<Vector3d, 4> a_pose = {Vector3d(0.8, -0.6, 0), {-0.6, -0.8, 0}, {0.1, -1, 0}, {-0.1, -1, 0}};
    const AxisWords words = words_of(a_pose, Eigen::Quaterniond::Identity());
    CHECK(words[0] == std::array<std::string, 3>{"up and left", "forwards", "left and down"});
    CHECK(words[1] == std::array<std::string, 3>{"left and down", "forwards", "down and right"});
    CHECK(words[2][2] == "down");
}

TEST_CASE("rig axes: a clip fits into the limits that are printed, and into none much narrower")
{
    const TempFolder folder;
    std::mt19937 random(12);
    for (int round = 0; round < 4; ++round) {
        FigureWish wish;
        wish.scales = wish.mirrors = round == 0 ? 0 : 0.4;
        random_figure(random, wish, figure_names()[0]).rig.write(folder / "rig.glb");
        const json report = rig_report(folder);
        REQUIRE(report.at("limbs").size() == 4);
        for (const json& limb : report.at("limbs")) {
            INFO("round " << round << ": " << limb.dump());
            CHECK(limited(folder, cone_of(limb, 0), "limited shoulder cone") == 0);
            CHECK(limited(folder, cone_of(limb, 0.2), "limited shoulder cone") > 0);
            CHECK(limited(folder, flexion_of(limb, 0), "limited flexion") == 0);
            CHECK(limited(folder, flexion_of(limb, 0.2), "limited flexion") > 0);
        }
    }
}

namespace {

// The lines for a crowd file that the report for people has of one limb; empty without any.
std::string lines_of(const std::string& report, const std::string& limb)
{
    const std::size_t from = report.find("           [limb." + limb + "]\n");
    if (from == std::string::npos) return {};
    const std::size_t last = report.find("           flexion_deg", from);
    REQUIRE(last != std::string::npos);
    return report.substr(from, report.find('\n', last) + 1 - from);
}

Outcome solved_under(const TempFolder& folder, const std::string& toml, std::vector<std::string> options = {})
{
    spill(folder / "crowd.toml", toml);
    options.insert(options.begin(), {"solve", "rig.glb", "--crowd", "crowd.toml", "--json"});
    return run_command(folder.path, options);
}

// A turn about an axis, key by key in degrees, as a node's animation.
void add_turn(GltfRig& rig, int animation, int node, const Vector3d& axis, const std::vector<double>& degrees)
{
    std::vector<float> times, keys;
    for (const double each : degrees) {
        times.push_back(0.5f * static_cast<float>(times.size()));
        const Eigen::Quaterniond turn(Eigen::AngleAxisd(each * 3.14159265358979 / 180, axis));
        for (const double part : turn.coeffs()) keys.push_back(static_cast<float>(part));
    }
    rig.add_keys(animation, node, "rotation", times, keys);
}

}  // namespace

TEST_CASE("rig axes: the lines for people are a crowd file's, and say what JSON says")
{
    const TempFolder folder;
    std::mt19937 random(13);
    random_figure(random, {}, figure_names()[0]).rig.write(folder / "rig.glb");
    const std::string out = run_command(folder.path, {"rig", "rig.glb"}).out;
    const json report = rig_report(folder);
    std::string all;
    for (const json& limb : report.at("limbs")) {
        const std::string lines = lines_of(out, limb.at("limb"));
        all += lines;
        INFO(lines << limb.dump());
        double bend[3], axis[3], opening, flexion[2];
        char joints[3][80], word[80], limits[80];
        REQUIRE(std::sscanf(lines.c_str(),
                            " [limb.%79[^]]] joints = [\"%79[^\"]\", \"%79[^\"]\", \"%79[^\"]\"] bend = [%lf, %lf, %lf]"
                            " [limb.%79[^]]] shoulder_cone = { axis = [%lf, %lf, %lf], opening_deg = %lf }"
                            " flexion_deg = [%lf, %lf]",
                            word, joints[0], joints[1], joints[2], &bend[0], &bend[1], &bend[2], limits, &axis[0],
                            &axis[1], &axis[2], &opening, &flexion[0], &flexion[1]) == 14);
        const json& range = limb.at("clip_range");
        CHECK(word == limb.at("limb").get<std::string>());
        CHECK(limits == limb.at("limb").get<std::string>() + ".limits");
        for (std::size_t n = 0; n < 3; ++n) {
            CHECK(joints[n] == limb.at("joints")[n].get<std::string>());
            CHECK(bend[n] == range.at("bend")[n].get<double>());
            CHECK(std::abs(bend[n] - limb.at("bend")[n].get<double>()) <= 0.5001e-3);
            CHECK(axis[n] == range.at("shoulder_cone").at("axis")[n].get<double>());
        }
        CHECK(opening == range.at("shoulder_cone").at("opening_deg").get<double>());
        for (std::size_t n = 0; n < 2; ++n) CHECK(flexion[n] == range.at("flexion_deg")[n].get<double>());
    }
    const Outcome outcome = solved_under(folder, all);  // the legs, too, by their joints
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const json solved = json::parse(outcome.out);
    CHECK(solved.at("legs_bound").size() == 2);
    CHECK(solved.at("flags").at("limited shoulder cone") == 0);
    CHECK(solved.at("flags").at("limited flexion") == 0);
    FigureWish still;
    still.moves = false;
    random_figure(random, still, figure_names()[0]).rig.write(folder / "rig.glb");
    CHECK_FALSE(rig_report(folder).at("limbs")[0].contains("clip_range"));
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
    const auto limited = [&](const std::string& toml) {
        const Outcome outcome = solved_under(folder, toml, {"--clip", "up"});
        INFO(toml << outcome.err);
        REQUIRE(outcome.exit_code == 0);
        const json flags = json::parse(outcome.out).at("flags");
        return flags.at("limited shoulder cone").get<int>() + flags.at("limited flexion").get<int>();
    };
    CHECK(limited(arm_lines + leg_lines) == 0);
    std::string own_bend = arm_lines;
    own_bend.erase(own_bend.find("bend"), own_bend.find('\n', own_bend.find("bend")) - own_bend.find("bend"));
    CHECK(limited(own_bend) > 0);
}

TEST_CASE("rig axes: limits are of the frames that --fps gives")
{
    const TempFolder folder;
    GltfRig rig;
    const int arm = rig.add("LeftArm", -1, {0, 0, 0}), fore_arm = rig.add("LeftForeArm", arm, {1, 0, 0});
    rig.add("LeftHand", fore_arm, {1, 0, 0});
    add_turn(rig, rig.add_animation("wave"), fore_arm, {0, -1, 0}, {10, 80, 10});  // a key each half second
    rig.write(folder / "rig.glb");
    const auto report = [&](const char* fps) {
        const Outcome outcome = run_command(folder.path, {"rig", "rig.glb", "--json", "--fps", fps});
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return json::parse(outcome.out);
    };
    const auto widest = [](const json& of) { return of["limbs"][0]["clip_range"]["flexion_deg"][1].get<double>(); };
    CHECK(report("1").at("frames") == 2);
    CHECK(widest(report("1")) == Approx(10.1).margin(0.11));
    CHECK(report("2").at("frames") == 3);
    CHECK(widest(report("2")) == Approx(80.1).margin(0.11));
}

TEST_CASE("rig axes: what tells which way is up")
{
    const TempFolder folder;
    const auto told_by = [&](bool arms, bool legs) {
        GltfRig rig;
        const int root = rig.add("root", -1, {0, 0, 0});
        for (const double side : {1.0, -1.0}) {
            const std::string word = side > 0 ? "Left" : "Right";
            if (arms)
                for (int at = root; const std::string name : {"Arm", "ForeArm", "Hand"})
                    at = rig.add(word + name, at, {side, at == root ? 2.0 : 0, 0});
            if (legs)
                for (int at = root; const std::string name : {"UpLeg", "Leg", "Foot"})
                    at = rig.add(word + name, at, {at == root ? side : 0, at == root ? 0 : -1.0, 0});
        }
        rig.write(folder / "rig.glb");
        const json report = rig_report(folder);
        CHECK(vector_of(report.at("up")).isApprox(Vector3d::UnitY(), 1e-6));
        const std::string said = run_command(folder.path, {"rig", "rig.glb"}).out;
        CHECK(said.find("up is (0.000 1.000 0.000), told by " + report.at("up_by").get<std::string>() + "\n") !=
              std::string::npos);
        return report.at("up_by").get<std::string>();
    };
    CHECK(told_by(true, true) == "hips to shoulders");
    CHECK(told_by(false, true) == "the file's +Y");
    CHECK(told_by(true, false) == "the file's +Y");
}

TEST_CASE("rig axes: solve's report has no sign of a zero either")
{
    const TempFolder folder;
    GltfRig rig;
    int parent = -1;
    for (const char* name : {"LeftArm", "LeftForeArm", "LeftHand"}) parent = rig.add(name, parent, {1, 0, 0});
    rig.write(folder / "rig.glb");
    spill(folder / "crowd.toml", "[limb.left_arm]\nbend = [-0.0001, 1, -0.0]\n");
    const Outcome outcome = run_command(folder.path, {"solve", "rig.glb", "--crowd", "crowd.toml"});
    INFO(outcome.err << outcome.out);
    CHECK(outcome.out.find("[0.000, 1.000, 0.000]: limb.left_arm.bend of crowd.toml") != std::string::npos);
}

TEST_CASE("rig axes: a limb's chain is what bind() takes")
{
    const TempFolder folder;
    std::mt19937 random(14);
    FigureWish wish;
    wish.scales = 0.4;
    random_figure(random, wish, figure_names()[0]).rig.write(folder / "rig.glb");
    const json report = rig_report(folder);
    for (const json& limb : report.at("limbs")) {
        const json& from = limb.at("chain");
        const auto numbers = [&](const char* key, auto& to) {
            REQUIRE(from.at(key).size() == std::size(to));
            for (std::size_t n = 0; n < std::size(to); ++n) to[n] = from.at(key)[n].get<float>();
        };
        swivel_chain chain = swivel_default_chain();
        numbers("shoulder_rotation", chain.shoulder_rotation);
        numbers("elbow_rotation", chain.elbow_rotation);
        numbers("wrist_rotation", chain.wrist_rotation);
        numbers("elbow_offset", chain.elbow_offset);
        numbers("wrist_offset", chain.wrist_offset);
        numbers("bend", chain.bend);
        const swivel_binding bound = swivel::bind(chain);
        const double scale = limb.at("scale");
        for (std::size_t n = 0; n < 2; ++n)
            CHECK(scale * static_cast<double>(bound.lengths[n]) ==
                  Approx(limb.at("lengths")[n].get<double>()).epsilon(1e-6));
        CHECK(from.at("bend")[0].get<double>() == Approx(limb.at("bend")[0].get<double>()).margin(1e-6));
    }
}

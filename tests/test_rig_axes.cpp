// SPDX-License-Identifier: MIT
//
// What `swivel rig` says for those who write limits: where a limb's own axes point, judged by the figure's nodes, and
// the limits that a clip fits into, judged by solving under them.
#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <string>

#include "tests/plain_gltf.h"
#include "tests/random_figure.h"
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

Vector3d vector_of(const json& numbers) { return Vector3d(numbers[0], numbers[1], numbers[2]); }

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
    return fmt::format("[limb.{}.limits]\nshoulder_cone = {{ axis = {}, opening_deg = {} }}\n",
                       limb.at("limb").get<std::string>(), cone.at("axis").dump(),
                       cone.at("opening_deg").get<double>() - less);
}

std::string flexion_of(const json& limb, double less)
{
    const json& range = limb.at("clip_range").at("flexion_deg");
    return fmt::format("[limb.{}.limits]\nflexion_deg = [{}, {}]\n", limb.at("limb").get<std::string>(),
                       range[0].get<double>(), range[1].get<double>() - less);
}

}  // namespace

TEST_CASE("rig axes: z runs along the resting limb, y where it bends to, x is the hinge, whatever the joints' axes")
{
    const TempFolder folder;
    std::mt19937 random(11);
    for (int round = 0; round < 12; ++round) {
        FigureWish wish;
        wish.moves = false;
        wish.bent = round % 2 == 0;
        wish.scales = wish.mirrors = round % 3 == 0 ? 0 : 0.4;
        const Figure figure =
            FigureMaker(random, wish).make(figure_names()[static_cast<std::size_t>(round) % figure_names().size()]);
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
    using Words = std::vector<std::array<std::string, 3>>;
    const Words t_pose = {{"up", "forwards", "left"},
                          {"down", "forwards", "right"},
                          {"right", "backwards", "down"},
                          {"right", "backwards", "down"}};
    const std::array<Vector3d, 4> along = {Vector3d(1, 0, 0), {-1, 0, 0}, {0, -1, 0}, {0, -1, 0}};
    CHECK(words_of(along, Eigen::Quaterniond::Identity()) == t_pose);
    CHECK(words_of(along, Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5)) == t_pose);
    const std::array<Vector3d, 4> a_pose = {Vector3d(0.8, -0.6, 0), {-0.6, -0.8, 0}, {0.1, -1, 0}, {-0.1, -1, 0}};
    const Words words = words_of(a_pose, Eigen::Quaterniond::Identity());
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
        FigureMaker(random, wish).make(figure_names()[0]).rig.write(folder / "rig.glb");
        const json report = rig_report(folder);
        REQUIRE(report.at("limbs").size() == 4);
        for (const json& limb : report.at("limbs")) {
            INFO("round " << round << ": " << limb.dump());
            CHECK(limited(folder, cone_of(limb, 0), "limited by shoulder cone") == 0);
            CHECK(limited(folder, cone_of(limb, 0.2), "limited by shoulder cone") > 0);
            CHECK(limited(folder, flexion_of(limb, 0), "limited by flexion") == 0);
            CHECK(limited(folder, flexion_of(limb, 0.2), "limited by flexion") > 0);
        }
    }
}

TEST_CASE("rig axes: the lines for people are a crowd file's")
{
    const TempFolder folder;
    std::mt19937 random(13);
    FigureMaker(random, {}).make(figure_names()[0]).rig.write(folder / "rig.glb");
    const std::string out = run_command(folder.path, {"rig", "rig.glb"}).out;
    const std::size_t from = out.find("[limb.left_arm.limits]\n");
    REQUIRE(from != std::string::npos);
    const std::size_t flexion = out.find("flexion_deg", from);
    const std::string toml = out.substr(from, out.find('\n', flexion) + 1 - from);
    CHECK(limited(folder, toml, "limited by shoulder cone") == 0);
    FigureWish still;
    still.moves = false;
    FigureMaker(random, still).make(figure_names()[0]).rig.write(folder / "rig.glb");
    CHECK_FALSE(rig_report(folder).at("limbs")[0].contains("clip_range"));
}

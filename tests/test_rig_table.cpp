// SPDX-License-Identifier: MIT
//
// The rules of docs/rigs.md, as a table of made-up figures. Of each limb, the figure knows whether it binds, which way
// it bends and what tells so.
#include <catch2/catch.hpp>

#include <algorithm>
#include <regex>
#include <string>

#include "tests/rig_body.h"
#include "tests/test_random.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using nlohmann::json;

namespace {

// What must come out of a limb. With a way it binds and bends that way, and the report's reason has this text. Without
// one it does not bind, and the problem has this text.
struct Want {
    Vector3d way = Vector3d::Zero();
    std::string text = {};

    bool binds() const { return !way.isZero(); }
};

struct Row {
    std::string name;
    Body body;
    std::array<Want, 4> wants;
    double unevenness = 0;
    std::vector<std::size_t> noted = {};  // limbs whose clip bends them against what was taken
};

// All arms as one, and all legs.
std::array<Want, 4> pairs(const Want& arms, const Want& legs) { return {arms, arms, legs, legs}; }
// As elbows and knees bend in the figure, told by this.
std::array<Want, 4> anatomy(const std::string& told_by) { return pairs({kZ, told_by}, {-kZ, told_by}); }
std::array<Want, 4> with(std::array<Want, 4> wants, std::size_t limb, const Want& want)
{
    wants[limb] = want;
    return wants;
}

const Want kMissing = {};
const std::vector<Bends> kWalk = {{20, 20, 10, 10}, {40, 40, 40, 40}, {60, 60, 60, 60}, {40, 40, 40, 40}};
const std::vector<Bends> kNoise = {{-1.2, -1.2, -1.2, -1.2}, {-2, -2, -2, -2}, {-1.6, -1.6, -1.6, -1.6}};

std::vector<Bends> steady(const Bends& bends) { return {bends, bends}; }

Body named(const std::array<std::string, 3>& arm, const std::array<std::string, 3>& leg, const std::string& left,
           const std::string& right)
{
    return {.arm = arm, .leg = leg, .left = left, .right = right};
}

Body vrm_body(double version)  // its names say nothing, or the wrong; files of 0.x face -z
{
    return {.arm = {"*a", "*b", "*c"},
            .left = "Right",
            .right = "Left",
            .toe = "*d",
            .turn = Quaterniond(AngleAxisd(version < 1 ? 180 * kDegree : 0, kY)),
            .vrm = version};
}

Vector3d swung(double degrees, const Vector3d& from, const Vector3d& to)
{
    return 0.3 * (std::cos(degrees * kDegree) * from + std::sin(degrees * kDegree) * to);
}

std::vector<Row> bend_rows()
{
    const Want from_rest_back = {kZ, "rest pose"}, knee_clip = {-kZ, "clip"};
    const Bends through3 = {0, 0, -3, -3}, through15 = {0, 0, -15, -15}, through25 = {0, 0, -25, -25};
    return {
        {"straight, no clip", {}, anatomy("toes")},
        {"straight, with noise backwards", {.clip = kNoise}, anatomy("toes")},
        {"noise that cancels", {.clip = {{40, 40, 40, 40}, {-38, -38, -38, -38}}}, anatomy("toes")},
        {"straight, and bent by the clip", {.clip = kWalk}, anatomy("clip")},
        {"a clip against elbows and knees", {.clip = steady({-25, -25, -25, -25})}, pairs({-kZ, "clip"}, {kZ, "clip"})},
        {"9.5 degrees in the clip", {.clip = steady({-9.5, -9.5, -9.5, -9.5})}, anatomy("toes")},
        {"10.5 degrees in the clip",
         {.clip = steady({-10.5, -10.5, -10.5, -10.5})},
         pairs({-kZ, "clip"}, {kZ, "clip"})},
        {"9.5 degrees at rest", {.rest = {-9.5, -9.5, -9.5, -9.5}}, anatomy("toes")},
        {"10.5 degrees at rest", {.rest = {-10.5, -10.5, -10.5, -10.5}}, pairs({-kZ, "10.5"}, {kZ, "10.5"})},
        {"folded at rest", {.rest = {165, 165, 165, 165}}, anatomy("rest pose")},
        {"knees pressed through by 3, a walk", {.rest = through3, .clip = kWalk}, anatomy("clip")},
        {"knees pressed through by 3, no clip", {.rest = through3}, anatomy("toes")},
        {"knees pressed through by 15, no clip", {.rest = through15}, pairs({kZ, "toes"}, from_rest_back)},
        {"knees pressed through by 15, a walk", {.rest = through15, .clip = kWalk}, pairs({kZ, "clip"}, knee_clip)},
        {"knees pressed through by 25, a walk",
         {.rest = through25, .clip = kWalk},
         pairs({kZ, "clip"}, from_rest_back),
         0,
         {2, 3}},
        {"knees pressed through by 15, a clip that bends them by 25",
         {.rest = through15, .clip = steady({25, 25, 25, 25})},
         pairs({kZ, "clip"}, from_rest_back)},
        {"rest and clip agree", {.rest = {25, 25, 25, 25}, .clip = kWalk}, anatomy("rest pose")},
        {"one knee noisy, one bent",
         {.clip = {{0, 0, -1.2, 20}, {0, 0, -2, 40}}},
         with(anatomy("toes"), 3, {-kZ, "clip"})},
    };
}

std::vector<Row> front_rows()
{
    const Quaterniond half(AngleAxisd(180 * kDegree, kY)), tilted(AngleAxisd(90 * kDegree, kX));
    const std::vector<std::size_t> arms = {0, 1}, legs = {2, 3};
    const Body toeless = {.toe_step = {}};
    const std::string hint = "bend = [";
    const auto ahead = [](double degrees_off, const Vector3d& start, const Vector3d& to = kZ) {
        return Body{.arm_bone = swung(90 - degrees_off, start, to)};
    };
    const auto walked = [](double degrees_off, const Vector3d& to) {
        return Body{.leg_bone = swung(90 - degrees_off, -kY, to)};
    };
    return {
        {"toes against left and right", {.left_at = -1}, anatomy("toes")},
        {"no toes", toeless, anatomy("shoulder")},
        {"a lone joint below the foot that is no toe by name",
         {.toe = "*End", .left_at = -1},
         pairs({-kZ, "shoulder"}, {kZ, "shoulder"})},
        {"the ball of the foot", {.toe = "*Ball", .left_at = -1}, anatomy("toes")},
        {"legs alone, no toes", {.limbs = legs, .toe_step = {}}, pairs(kMissing, {-kZ, "hip"})},
        {"one leg with a toe", {.limbs = {0, 1, 2}, .left_at = -1}, with(anatomy("toes"), 3, kMissing)},
        {"arms alone", {.limbs = arms}, pairs({kZ, "shoulder"}, kMissing)},
        {"one arm alone", {.limbs = {0}, .turn = half}, {Want{-kZ, "+Z"}, kMissing, kMissing, kMissing}},
        {"turned about", {.toe_step = {}, .turn = half}, anatomy("shoulder")},
        {"z up", {.toe_step = {}, .turn = tilted}, anatomy("shoulder")},
        {"mirrored", {.scale = {-1, 1, 1}}, anatomy("toes")},
        {"mirrored, no toes", {.toe_step = {}, .scale = {-1, 1, 1}}, anatomy("shoulder")},
        {"A-pose", {.arm_bone = swung(-50, kX, kY)}, anatomy("toes")},
        {"hanging", {.arm_bone = {0, -0.3, 0}}, anatomy("toes")},
        {"31 degrees off ahead, out of a T-pose", ahead(31, kX), anatomy("toes")},
        {"29 degrees off ahead, out of a T-pose", ahead(29, kX), pairs({{0, 0, 0}, hint}, {-kZ, "toes"})},
        {"31 degrees off ahead, from hanging", ahead(31, -kY), anatomy("toes")},
        {"29 degrees off ahead, from hanging", ahead(29, -kY), pairs({{0, 0, 0}, hint}, {-kZ, "toes"})},
        {"29 degrees off behind", ahead(29, -kY, -kZ), pairs({{0, 0, 0}, hint}, {-kZ, "toes"})},
        {"a leg 31 degrees off ahead", walked(31, kZ), anatomy("toes")},
        {"a leg 29 degrees off ahead", walked(29, kZ), pairs({kZ, "toes"}, {{0, 0, 0}, hint})},
        {"ahead, and bent by the clip",
         {.arm_bone = {0, 0, 0.3}, .clip = {{30, 30, 0, 0}, {40, 40, 0, 0}}},
         pairs({-kY, "clip"}, {-kZ, "toes"})},
    };
}

std::vector<Row> name_rows()  // of other names: tests/test_limb_joints.cpp
{
    return {
        {"a figure's name before all",
         named({"Bob_*_shoulder", "Bob_*_elbow", "Bob_*_wrist"}, {"Bob_*_hip", "Bob_*_knee", "Bob_*_ankle"}, "L", "R"),
         anatomy("toes")},
        {"VRM 0.x", vrm_body(0.1), anatomy("toes")},
        {"VRM 1.0", vrm_body(1), anatomy("toes")},
    };
}

std::vector<Row> joint_rows()
{
    const auto between = [](const std::string& name, const Vector3d& axis, double degrees) {
        return Body{.between = Between{name, axis, degrees}};
    };
    const auto without = [](const std::string& text) { return with(anatomy("toes"), 0, {{0, 0, 0}, text}); };
    const auto uneven = [](double by) { return Body{.clip = kWalk, .scale = {1, 1, 1 + by}}; };
    const auto refused = pairs({{0, 0, 0}, "uneven"}, {{0, 0, 0}, "uneven"});
    return {
        {"what twists", between("Bob", kX, 80), anatomy("toes")},
        {"what swings", between("LeftArmTwist", kZ, 20), without("LeftArmTwist")},
        {"by how much", between("Bob", kZ, 20), without("17")},  // half the bone by 20 degrees
        {"in which frame", between("Bob", kZ, -20), without("frame 1")},
        {"by 0.9 thousandths", between("Bob", kZ, 0.9e-3 * 2 / kDegree), anatomy("toes")},
        {"by 1.1 thousandths", between("Bob", kZ, 1.1e-3 * 2 / kDegree), without("Bob")},
        {"a joint of the table", between("LeftCollar", kX, 0), with(anatomy("toes"), 0, kMissing)},
        {"uneven by 4e-5", uneven(4e-5), anatomy("clip"), 4e-5},
        {"uneven by 9e-4", uneven(9e-4), anatomy("clip"), 9e-4},
        {"uneven by 1.1e-3", uneven(1.1e-3), refused},
    };
}

// Whether a note offers another bend for the limb.
bool offers_bend(const json& limb)
{
    const std::vector<std::string> notes = limb.value("notes", std::vector<std::string>());
    return std::any_of(notes.begin(), notes.end(),
                       [](const std::string& note) { return note.find("to the other side") != std::string::npos; });
}

// Holds what the report says of one limb against what must come out.
void judge(const Row& row, std::size_t n, const json& limb, const PlainGltf& plain, const LimbNodes& nodes)
{
    const Want& want = row.wants[n];
    const std::string said = limb.value(limb.at("bound") == true ? "bend_source" : "problem", "");
    INFO(row.name << ", " << kLimbs[n] << ": " << said);
    CHECK(limb.at("bound") == want.binds());
    CHECK_THAT(said, Contains(want.text));
    if (limb.at("bound") == false || !want.binds()) return;
    CHECK(limb.at("numbers").get<LimbNodes>() == nodes);
    const auto place = [&](std::size_t part) { return Vector3d(plain_world(plain, -1, nodes[part], 0).translation()); };
    const Vector3d bone = (place(1) - place(0)).normalized(), way = row.body.turn * want.way;
    const Vector3d bend = plain_world(plain, -1, nodes[0], 0).linear() * vector_of(limb.at("bend"));
    const auto across = [&](const Vector3d& v) { return Vector3d(v - v.dot(bone) * bone); };
    CHECK(degrees_between(across(bend), across(way)) < 1);
    CHECK(offers_bend(limb) == (std::count(row.noted.begin(), row.noted.end(), n) > 0));
    const double unevenness = limb.value("unevenness", 0.0);
    CHECK(unevenness >= 0.3 * row.unevenness);
    CHECK(unevenness <= 3 * row.unevenness + 1e-6);
}

void judge(const std::vector<Row>& rows)
{
    const TempFolder folder;
    for (const Row& row : rows) {
        GltfRig rig;
        const BodyNodes nodes = add_body(rig, row.body);
        rig.write(folder / "rig.glb");
        const PlainGltf plain = plain_gltf_of(folder / "rig.glb");
        const json report = rig_report(rig);
        for (std::size_t n = 0; n < 4; ++n) judge(row, n, limb_of(report, kLimbs[n]), plain, nodes[n]);
    }
}

// The line for a crowd file that a message offers.
std::string offered_line(const std::string& text)
{
    static const std::regex pattern(R"(bend = \[-?[0-9.]+, -?[0-9.]+, -?[0-9.]+\])");
    std::smatch found;
    INFO(text);
    REQUIRE(std::regex_search(text, found, pattern));
    return found[0];
}

Vector3d bend_of(const std::string& line) { return vector_of(json::parse(line.substr(line.find('[')))); }

json solved_with(const TempFolder& folder, const std::string& toml)
{
    spill(folder / "crowd.toml", toml);
    return report_of(folder.path, {"solve", "rig.glb", "--limbs", "all", "--crowd", "crowd.toml"});
}

std::string limb_table(const std::string& limb, const std::string& line)
{
    return "[limb." + limb + "]\n" + line + "\n";
}

}  // namespace

TEST_CASE("rig table: bends") { judge(bend_rows()); }
TEST_CASE("rig table: bends are the same however a figure stands")
{
    Random random{17};
    std::vector<Row> rows = bend_rows();
    for (Row& row : rows) row.body.turn = random.rotation();
    judge(rows);
}
TEST_CASE("rig table: which way a figure faces") { judge(front_rows()); }
TEST_CASE("rig table: names") { judge(name_rows()); }
TEST_CASE("rig table: joints in between and scales") { judge(joint_rows()); }

TEST_CASE("rig table: the bend that a refusal offers is a hanging limb's swung there, and binds")
{
    const TempFolder folder;
    const Body ahead = {.arm_bone = {0, 0, 0.3}, .leg_bone = {0, 0, 0.45}};
    rig_of(ahead).write(folder / "rig.glb");
    const json report = rig_report(rig_of(ahead));
    std::string toml;
    for (const char* limb : kLimbs) {
        const std::string line = offered_line(problem_of(report, limb));
        // Swung forwards by 90 degrees, forwards points up, and backwards down.
        CHECK(degrees_between(bend_of(line), std::string(limb).ends_with("arm") ? kY : Vector3d(-kY)) < 1);
        toml += limb_table(limb, line);
    }
    const json solved = solved_with(folder, toml);
    CHECK(solved.at("arms_bound").size() == 2);
    CHECK(solved.at("legs_bound").size() == 2);
}

TEST_CASE("rig table: a note offers the clip's mean bend")
{
    const TempFolder folder;
    const Body body = {.rest = {0, 0, -25, -25}, .clip = kWalk};
    rig_of(body).write(folder / "rig.glb");
    const json report = rig_report(rig_of(body));
    const std::string line = offered_line(limb_of(report, "left_leg").at("notes")[0]);
    CHECK(degrees_between(bend_of(line), -kZ) < 1);
    CHECK_THAT(run_command(folder.path, {"rig", "rig.glb"}).out, Contains(line));
    CHECK_THAT(run_command(folder.path, {"solve", "rig.glb", "--limbs", "legs"}).out, Contains(line));
    CHECK_THAT(solved_with(folder, limb_table("left_leg", line)).dump(), Contains("limb.left_leg.bend"));
}

// SPDX-License-Identifier: MIT
//
// The rules of docs/rigs.md, as a table of made-up figures. Names are for test_limb_joints.cpp. A figure knows of each
// limb whether it binds, which way it bends and what tells so.
#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <regex>
#include <string>

#include "tests/random_figure.h"
#include "tests/test_random.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using nlohmann::json;

namespace {

// The report of a limb. With a way it binds and bends that way, and the report's reason has this text. Without
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

Vector3d swung(double degrees, const Vector3d& from, const Vector3d& to)
{
    return 0.3 * (std::cos(degrees * kDegree) * from + std::sin(degrees * kDegree) * to);
}

// The witness that the rule of docs/rigs.md takes of a limb. clip: degrees of its frames.
enum class Witness { rest, clip, toes };
struct Told {
    Witness by;
    std::string text;
    double mean = 0;  // the clip's, a sine

    Told(double rest, const std::vector<double>& clip)
    {
        std::ptrdiff_t one_way = 0;
        for (const double degrees : clip) mean += std::sin(degrees * kDegree) / static_cast<double>(clip.size());
        for (const double degrees : clip) one_way += degrees * mean > 0;
        const auto bends = [](double sine, double degrees) { return std::abs(sine) > std::sin(degrees * kDegree); };
        const double sine = std::sin(rest * kDegree);
        const bool is_clear = bends(mean, 30) && 10 * one_way >= 9 * std::ssize(clip);
        by = bends(sine, 20)   ? Witness::rest
             : is_clear        ? Witness::clip
             : bends(sine, 10) ? Witness::rest
             : bends(mean, 10) ? Witness::clip
                               : Witness::toes;
        const std::string of_rest = fmt::format("the rest pose, bent by {:.1f} degrees", std::abs(rest));
        text = by == Witness::toes ? "toes"
               : by == Witness::rest
                   ? of_rest
                   : fmt::format("the clip, bent by {:.1f} degrees in the mean", std::asin(std::abs(mean)) / kDegree);
        if (by == Witness::clip && bends(sine, 10)) text += "; it is clearer than " + of_rest;
    }
};

// A figure whose limbs are bent by degrees on both sides of each bound, at rest and in a clip.
Row bent_row(Random& random)
{
    const auto any_of = [&](std::initializer_list<double> of) {
        return of.begin()[random.below(static_cast<std::uint32_t>(of.size()))] * (random.below(2) ? 1 : -1);
    };
    Row row{.name = {}, .body = {.turn = random.rotation()}, .wants = {}};
    do row.body.arm_bone = 0.3 * random.direction();
    while (std::abs(row.body.arm_bone.z()) > 0.24);  // which would point ahead or behind
    row.body.clip.resize(random.below(8) == 0 ? 0 : 10);
    for (std::size_t n = 0; n < 4; ++n) {
        double& rest = row.body.rest[n];
        rest = any_of({0, 3, 9.5, 10.5, 15, 19.5, 20.5, 60, 159.5, 160.5, 169.5, 170.5});
        if (n == 3) rest = row.body.rest[2];  // legs that differ are taken for a step
        row.body.aside[n] = any_of({0, 77, 103});
        const double degrees = any_of({1.6, 9.5, 10.5, 15, 29.5, 30.5, 80, 140}),
                     other = random.below(2) ? 0 : -degrees;
        std::vector<double> clip(row.body.clip.size(), degrees);
        if (!clip.empty()) std::fill_n(clip.begin(), random.below(3), other);
        for (std::size_t frame = 0; frame < clip.size(); ++frame) row.body.clip[frame][n] = clip[frame];
        if (clip.empty()) clip = {rest}, row.body.aside[n] = 0;  // the rest pose is the only frame

        const Told told(rest, clip);
        row.name += fmt::format("[{} at rest, {} in the clip] ", rest, fmt::join(clip, " "));
        Vector3d bone = n < 2 ? row.body.arm_bone : row.body.leg_bone;
        if (n % 2) bone.x() *= -1;
        const Vector3d along = bone.normalized(), flexed = n < 2 ? kZ : Vector3d(-kZ);
        const Vector3d across = (flexed - flexed.dot(along) * along).normalized();
        const auto side = [](double x) { return x < 0 ? -1.0 : 1.0; };
        const Vector3d by_clip = side(told.mean) * (AngleAxisd(row.body.aside[n] * kDegree, along) * across);
        const Vector3d way = told.by == Witness::rest   ? side(rest) * across
                             : told.by == Witness::clip ? by_clip
                                                        : across;
        row.wants[n] = {way, told.text};
        const bool is_far =
            std::ranges::any_of(clip, [&](double each) { return each * told.mean > 0 && std::abs(each) > 30; });
        if (by_clip.dot(way) < -1e-9 && told.mean != 0 && is_far) row.noted.push_back(n);
    }
    return row;
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
         {.toe = "End", .left_at = -1},
         pairs({-kZ, "shoulder"}, {kZ, "shoulder"})},
        {"the ball of the foot", {.toe = "Ball", .left_at = -1}, anatomy("toes")},
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
        const Figure figure = figure_of(row.body);
        figure.rig.write(folder / "rig.glb");
        const PlainGltf plain = plain_gltf_of(folder / "rig.glb");
        const json report = rig_report(figure.rig);
        for (std::size_t n = 0; n < 4; ++n) judge(row, n, limb_of(report, kLimbs[n]), plain, figure.limbs[n]);
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

TEST_CASE("rig table: the first of the page's rules that holds tells a bend, whatever the axes")
{
    Random random{17};
    std::vector<Row> rows(100);
    for (Row& row : rows) row = bent_row(random);
    judge(rows);
    // In a mean, noise cancels.
    judge({{"noise", {.clip = {{40, 40, 40, 40}, {-38, -38, -38, -38}}}, anatomy("toes")}});
}
TEST_CASE("rig table: which way a figure faces") { judge(front_rows()); }
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

// SPDX-License-Identifier: MIT
//
// The promise of `swivel feet` on recorded motion: feet that it finds in contact stand, on the ground, and neither
// knees nor velocities pay for it. Tests' own readers and formulas judge. What is refused is in
// tests/transcripts/feet.txt.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "tests/feet_motion.h"
#include "tests/made_body.h"
#include "tests/plain_gltf.h"
#include "tests/run_command.h"
#include "tests/test_data.h"
#include "tools/feet/treads.h"
#include "tools/feet/turn_legs.h"

using namespace swivel::test;
namespace formats = swivel::formats;
namespace tools = swivel::tools;
using Catch::Matchers::Contains;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using nlohmann::json;

namespace {

Outcome feet(const TempFolder& folder, Words words)
{
    words.insert(words.begin(), "feet");
    return run_command(folder.path, words);
}

void feet_done(const TempFolder& folder, const Words& words) { done(feet(folder, words)); }

json feet_report(const TempFolder& folder, Words words)
{
    words.push_back("--json");
    return json::parse(done(feet(folder, words)).out).at("clips").at(0);
}

Hills along_z(const std::function<double(double)>& height) { return ground_along(53 * Vector3d::UnitZ(), height); }

// As the command is told it.
std::string size_of(const Hills& ground)
{
    return fmt::format("{},{},{}", ground.size.x(), ground.size.y(), ground.size.z());
}

PlainLegs legs_in(const fs::path& path) { return legs_path(plain_motion_of(path), kCarriedTime); }

double agreement(const PlainContacts& a, const PlainContacts& b)
{
    double same = 0, all = 0;
    for (std::size_t side = 0; side < 2; ++side)
        for (std::size_t n = 0; n < a[side].size(); ++n, ++all) same += a[side][n] == b[side][n] ? 1 : 0;
    return same / all;
}

// The prototype's least squares leave so much of each of kSkatingClips. 0 in its table is less than half of the last
// digit.
constexpr Skates kAfter[] = {
    {.020, .334, 12, 13.1}, {.0005, .0005, 0.5, 10.2}, {.0005, .009, 0.5, 17.3}, {.030, .454, 18, 15.4}};

// The first jump of the clip that every machine has.
std::string first_jump(const Carried& to)
{
    PlainMotion jump = plain_motion_of(must_find_jump());
    jump.lines.resize(500), jump.values.resize(500);
    return carried(jump, to);
}

// Where the End Site right below a joint is, in the joint's axes.
Vector3d end_site(const PlainMotion& motion, const std::string& joint)
{
    const std::string& text = motion.header;
    const std::size_t end = text.find("End Site", text.find("JOINT " + joint));
    std::istringstream in(text.substr(text.find("OFFSET", end) + 6));
    Vector3d offset;
    in >> offset.x() >> offset.y() >> offset.z();
    return offset;
}

double angle_deg(const Vector3d& a, const Vector3d& b)
{
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

}  // namespace

TEST_CASE("feet: recorded feet stand where legs or way do not fit the clip")
{
    for (std::size_t clip = 0; clip < std::size(kSkatingClips); ++clip) {
        const SkatingClip& each = kSkatingClips[clip];
        const fs::path path = find_or_warn(each.file);
        if (path.empty()) continue;
        INFO(each.words);
        const TempFolder folder;
        const PlainMotion recorded = plain_motion_of(path);
        spill(folder / "source.bvh", carried(recorded, {}));
        spill(folder / "skates.bvh", carried(recorded, each.to));
        const PlainLegs source = legs_in(folder / "source.bvh"), skates = legs_in(folder / "skates.bvh");
        // The source says when feet stand; a detector of the test's own must agree, frame by frame.
        feet_done(folder, {"source.bvh", "--export-contacts", "c.csv", "--quiet"});
        CHECK(agreement(contacts_in_table(slurp(folder / "c.csv"), source.frame_count()), plain_contacts(source)) == 1);
        const PlainContacts contacts = prototypes_contacts(source);
        const json report = feet_report(folder, {"skates.bvh", "--contacts", "c.csv", "--out", "stands.bvh"});
        const PlainLegs stands = legs_in(folder / "stands.bvh");
        const PlainSkating before = plain_skating(skates, contacts), after = plain_skating(stands, contacts);
        const Skates skates_after = in_metres(after), &wanted = kAfter[clip];
        CHECK(skates_after.mean <= wanted.mean);
        CHECK(skates_after.max <= wanted.max);
        CHECK(skates_after.step <= wanted.step);
        CHECK(skates_after.knee <= wanted.knee + 0.05);  // half of the last digit
        CHECK(after.jump <= before.jump);
        CHECK(after.body_jump <= before.body_jump);
        // On the ground, which is level.
        const double floor = report.at("floor");
        for (std::size_t side = 0; side < 2; ++side)
            for (std::size_t n = 0; n < stands.frame_count(); ++n)
                if (contacts[side][n]) CHECK(std::abs(stands.legs[side].toe[n].y() - floor) * kMetre < 0.003);
        // The report is true.
        const double leg = (skates.leg_length(0) + skates.leg_length(1)) / 2;
        const PlainSkating told = plain_skating(skates, plain_contacts(source));
        CHECK(report.at("before").at("contact_speed_mean") == Approx(told.mean / leg).epsilon(1e-3));
        CHECK(report.at("before").at("skate_a_step") == Approx(told.begun_step / leg).epsilon(1e-3));
        CHECK(report.at("after").at("knee_degrees_a_frame_max") == Approx(after.knee).epsilon(1e-3));
        CHECK(report.at("after").at("velocity_jump_max") == Approx(after.jump / leg).epsilon(1e-3));
        CHECK(report.at("after").at("body_velocity_jump_max") == Approx(after.body_jump / leg).epsilon(1e-3));
    }
}

TEST_CASE("feet: a clip that skates tells its own contacts, and all else of its file stays")
{
    const fs::path path = find_or_warn("cmu_02_01_walk.bvh");
    if (path.empty()) return;
    const TempFolder folder;
    const PlainMotion recorded = plain_motion_of(path);
    spill(folder / "skates.bvh", carried(recorded, {.legs = 0.8}));
    feet_done(folder, {"skates.bvh", "--out", "stands.bvh", "--export-contacts", "c.csv"});
    const PlainMotion before = plain_motion_of(folder / "skates.bvh"), after = plain_motion_of(folder / "stands.bvh");
    const PlainContacts found = contacts_in_table(slurp(folder / "c.csv"), before.lines.size());
    CHECK(agreement(found, plain_contacts(legs_path(before, kCarriedTime))) == 1);
    CHECK(kMetre * plain_skating(legs_path(after, kCarriedTime), found).max < 1e-3);
    const PlainContacts true_ones = prototypes_contacts(legs_path(plain_motion(carried(recorded, {})), kCarriedTime));
    CHECK(agreement(found, true_ones) > 0.95);
    CHECK(in_metres(plain_skating(legs_path(after, kCarriedTime), true_ones)).step < 12);
    CHECK(after.header == before.header);
    std::vector<std::size_t> may_change;
    for (const PlainJoint& joint : before.joints)
        for (std::size_t n = 0; n < joint.channels.size(); ++n)
            for (const char* const turned : {"Hips", "UpLeg", "Leg", "Foot", "ToeBase"})
                if (joint.name.ends_with(turned) && (joint.name != "Hips" || joint.channels[n].ends_with("position")))
                    may_change.push_back(joint.first_channel + n);
    for (std::size_t frame = 0; frame < before.lines.size(); ++frame)
        REQUIRE(rest_of(before.lines[frame], may_change) == rest_of(after.lines[frame], may_change));
}

TEST_CASE("feet: toes bend where a foot presses their tips into the ground, and no faster than 360 degrees a second")
{
    const TempFolder folder;
    const std::string text = first_jump({});
    const PlainMotion clip = plain_motion(text);
    spill(folder / "clip.bvh", text);
    feet_done(folder, {"clip.bvh", "--out", "out.bvh"});
    const PlainMotion out = plain_motion_of(folder / "out.bvh");
    double pressed = 0;
    for (const std::string side : {"Left", "Right"}) {
        const auto toe = static_cast<std::size_t>(joint_named(clip, side + "ToeBase"));
        const Vector3d end = end_site(clip, side + "ToeBase");
        std::vector<double> heights;  // of the toe
        for (std::size_t frame = 0; frame < out.lines.size(); ++frame)
            heights.push_back(pose_of(out, frame)[toe].position.y());
        const double level = *std::ranges::min_element(heights);
        double before_deg = 0;
        for (std::size_t frame = 0; frame < out.lines.size(); ++frame) {
            const PlainPose own = pose_of(clip, frame)[toe], bent = pose_of(out, frame)[toe];
            const double rest = end.y();  // BVH rests without rotation
            pressed = std::max(pressed, level + rest - (heights[frame] + (own.rotation * end).y()));
            CHECK((bent.position + bent.rotation * end).y() > level + rest - 1e-3 * end.norm());
            const double bent_deg = angle_deg(own.rotation * end, bent.rotation * end);
            CHECK(std::abs(bent_deg - before_deg) < 360 * kCarriedTime + 0.1);
            before_deg = bent_deg;
        }
    }
    CHECK(pressed > 0.2);  // a centimetre: there was something to do
}

TEST_CASE("feet: toes that turn through the vertical near the ground bend about one axis, and do not snap")
{
    const double end = 0.07;
    formats::Clip clip;
    clip.joints = {{"Foot"}, {"Toe", 0}};
    clip.frame_time = 1.0 / 60;
    clip.frame_count = 120;
    tools::LegMotion motion;
    motion.frame_time = clip.frame_time;
    tools::LegPath& leg = motion.legs.emplace_back();
    tools::PlacedFeet placed;
    placed.legs.resize(1);
    leg.toe = 1;
    const auto foot = [&](std::size_t frame) {  // from flat to kneeling: toes point down, and then back
        return Quaterniond(
            Eigen::AngleAxisd(1.5 * static_cast<double>(frame) * std::numbers::pi / 180, Vector3d::UnitX()));
    };
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        clip.rotation.insert(clip.rotation.end(), {foot(frame), Quaterniond::Identity()});
        motion.carrier_w.push_back(Vector3d::Zero());
        leg.toe_w.push_back(Vector3d::Zero());
        leg.tip_w.push_back(foot(frame) * Vector3d(0, 0, end));
        leg.across_w.push_back(-Vector3d::UnitX());
        placed.legs[0].turn_w.push_back(Quaterniond::Identity());
    }
    const std::vector<tools::TurnedJoint> bent = tools::bend_toes(clip, motion, placed, {});
    REQUIRE(bent.size() == 1);
    for (std::size_t frame = 1; frame < clip.frame_count; ++frame) {
        INFO(frame);
        const Quaterniond& toe = bent[0].rotation[frame];
        CHECK(toe.vec().cross(Vector3d::UnitX()).norm() < 1e-12);
        CHECK(toe.angularDistance(bent[0].rotation[frame - 1]) < 2 * std::numbers::pi * clip.frame_time + 1e-9);
        if (frame <= 60) CHECK((foot(frame) * toe * Vector3d(0, 0, end)).y() > -1e-9);
    }
}

TEST_CASE("feet: toes stand, whatever they are called")
{
    const TempFolder folder;
    std::string text = first_jump({.legs = 0.9});
    spill(folder / "named.bvh", text);
    for (const std::string side : {"Left", "Right"})  // as SMPL has them
        for (const auto& [name, other] :
             {std::pair("UpLeg", "Hip"), {"Leg", "Knee"}, {"Foot", "Ankle"}, {"ToeBase", "Foot"}})
            text = edited(text, "JOINT " + side + name, "JOINT " + side + other);
    spill(folder / "smpl.bvh", text);
    feet_done(folder, {"named.bvh", "--out", "named_out.bvh"});
    const json report = feet_report(folder, {"smpl.bvh", "--out", "smpl_out.bvh"});
    CHECK(report.at("legs").at(0).at("stands_on") == "LeftFoot");
    CHECK(report.at("legs").at(1).at("has_toe") == true);
    CHECK(plain_motion_of(folder / "smpl_out.bvh").lines == plain_motion_of(folder / "named_out.bvh").lines);
}

TEST_CASE("feet: who stands still on one leg has the other in the air")
{
    const MadeBody body;
    const PlainMotion rest = plain_motion(body.text());
    std::vector<double> row = body.rest_row();
    row[rest.joint(joint_named(rest, "LeftUpLeg")).first_channel + 1] = -40;
    row[rest.joint(joint_named(rest, "LeftLeg")).first_channel + 1] = 40;
    const TempFolder folder;
    spill(folder / "still.bvh", body.text({60, row}));
    feet_done(folder, {"still.bvh", "--export-contacts", "c.csv"});
    const PlainContacts found = contacts_in_table(slurp(folder / "c.csv"), 60);
    CHECK(found[0] == std::vector<bool>(60, false));
    CHECK(found[1] == std::vector<bool>(60, true));
}

TEST_CASE("feet: --travel moves a clip that walks in place by the way of its feet, and no other")
{
    const fs::path path = find_or_warn("cmu_02_01_walk.bvh");
    if (path.empty()) return;
    const TempFolder folder;
    const PlainMotion recorded = plain_motion_of(path);
    spill(folder / "walk.bvh", carried(recorded, {}));
    spill(folder / "in_place.bvh", carried(recorded, {.minus = 1}));
    CHECK_THAT(feet(folder, {"in_place.bvh"}).err, Contains("it walks in place") && Contains("give --travel"));
    const json report =
        feet_report(folder, {"in_place.bvh", "--travel", "--out", "out.bvh", "--export-contacts", "c.csv"});
    const PlainLegs walk = legs_in(folder / "walk.bvh"), out = legs_in(folder / "out.bvh");
    const double seconds = static_cast<double>(walk.frame_count() - 1) * kCarriedTime;
    const Vector3d way = walk.body.back() - walk.body.front();
    for (int axis : {0, 2}) {
        CHECK(report.at("travel").at(static_cast<std::size_t>(axis)).get<double>() * seconds ==
              Approx(way[axis]).margin(0.15 * way.norm()));
        CHECK((out.body.back() - out.body.front())[axis] == Approx(way[axis]).margin(0.15 * way.norm()));
    }
    const PlainContacts contacts = contacts_in_table(slurp(folder / "c.csv"), out.frame_count());
    CHECK(kMetre * plain_skating(out, contacts).max < 1e-3);
    // Before is the clip as it was read, with feet that slide under the body.
    const PlainLegs in_place = legs_in(folder / "in_place.bvh");
    const double leg = (in_place.leg_length(0) + in_place.leg_length(1)) / 2;
    CHECK(report.at("before").at("contact_speed_mean") ==
          Approx(plain_skating(in_place, contacts).mean / leg).epsilon(1e-3));
    CHECK(feet_report(folder, {"walk.bvh", "--travel"}).at("travel").is_null());
    CHECK_FALSE(feet_report(folder, {"walk.bvh"}).contains("travel"));
}

TEST_CASE("feet: on hills they stand on the ground as it lies, and on one side of edges, which they step over")
{
    const fs::path path = find_or_warn("cmu_02_01_walk.bvh");
    if (path.empty()) return;
    const TempFolder folder;
    spill(folder / "walk.bvh", carried(plain_motion_of(path), {}));
    const PlainLegs flat = legs_in(folder / "walk.bvh");
    const PlainContacts contacts = plain_contacts(flat);
    const Hills hills = random_hills({300, 8, 200});  // of 17 x 0.45 x 11 m: slopes of 10 degrees
    Hills coarse = hills;                             // as 8 bits have them
    for (std::uint16_t& sample : coarse.samples) sample = static_cast<std::uint16_t>((sample >> 8) * 257);
    const std::pair<Hills, int> grounds[] = {
        {hills, 16},
        {coarse, 8},
        {along_z([](double z) { return z > 0.8 ? 2.7 : 0; }), 16},                 // a curb of 15 cm
        {along_z([](double z) { return z > -9 ? 0 : 2.7; }), 16},                  // down from it
        {along_z([](double z) { return 1.8 * std::floor((z + 80) / 5.2); }), 16},  // stairs of 10 cm
        {along_z([](double z) { return z > -0.3 && z < 1.8 ? 0 : 6.0; }), 16},     // a gap of 34 cm
    };
    for (const auto& [ground, bits] : grounds) {
        write_png(folder / "g.png", ground, bits);
        const std::string size = size_of(ground);
        const json report =
            feet_report(folder, {"walk.bvh", "--ground", "g.png", "--ground-size", size, "--out", "out.bvh"});
        INFO(size << ' ' << report.value("look", json()).dump());
        const PlainLegs stands = legs_in(folder / "out.bvh");
        const auto over = [&report, &hill = ground](const Vector3d& toe) {
            return kMetre * (toe.y() - report.at("floor").get<double>() - hill.height(toe.x(), toe.z()));
        };
        double off = 0, lowest = 0, slope = 0;
        for (std::size_t side = 0; side < 2; ++side)
            for (std::size_t n = 0; n < stands.frame_count(); ++n) {
                const Vector3d& toe = stands.legs[side].toe[n];
                lowest = std::min(lowest, over(toe));
                if (!contacts[side][n]) continue;
                off = std::max(off, std::abs(over(toe)));
                slope = std::max(
                    slope,
                    std::abs(ground.height(toe.x(), toe.z() + 0.1) - ground.height(toe.x(), toe.z() - 0.1)) / 0.2);
            }
        CHECK(off < 0.003);
        CHECK(lowest > -0.01);
        CHECK(slope < 1);
        const PlainSkating before = plain_skating(flat, contacts), after = plain_skating(stands, contacts);
        CHECK(kMetre * after.max < 1e-3);
        CHECK(after.knee < 13.1);
        CHECK(after.jump < 1.5 * before.jump);
        CHECK(after.body_jump < 1.5 * before.body_jump);
    }
}

TEST_CASE("feet: a swing clears what lies below it, and lifts the foot by no more than twice that")
{
    // One leg that stands, swings along z on the level for 31 frames, and stands again.
    tools::LegMotion motion{Vector3d::UnitY(), 1.0 / 60, 0, {}, {{}}};
    std::vector<bool> contact;
    for (int frame = 0; frame < 41; ++frame) {
        const double z = 0.5 * std::clamp(frame - 4, 0, 32);
        motion.carrier_w.push_back({0, 1, z});
        motion.legs[0].toe_w.push_back({0, 0, z});
        motion.legs[0].ankle_w.push_back({0, 0, z - 0.4});
        contact.push_back(frame < 5 || frame >= 36);
    }
    for (const double ridge : {8.0, 0.5}) {  // in the middle, and where the foot leaves the ground
        tools::Ground ground{{{1, 0.3, 40}, {0, 0, 0}, 2, 401}, {}};
        for (int row = 0; row < 401; ++row)
            ground.heights.insert(ground.heights.end(), 2, std::abs(0.1 * row - 20 - ridge) < 0.15 ? 1 : 0);
        const tools::Floor floor{motion.up_w, 0, &ground};
        const std::vector<Vector3d> move_w = tools::lift_of(motion, {contact}, floor).legs[0].move_w;
        double highest = 0, lowest = 1;  // lowest: at the ridge
        for (std::size_t frame = 0; frame < move_w.size(); ++frame) {
            const Vector3d toe_w = motion.legs[0].toe_w[frame] + move_w[frame];
            highest = std::max(highest, toe_w.y());
            if (std::abs(toe_w.z() - ridge) < 0.1) lowest = std::min(lowest, floor.over(toe_w));
        }
        CHECK(highest <= 0.6 + 1e-6);
        if (ridge == 8.0) CHECK(lowest > -1e-6);
    }
}

TEST_CASE("feet: beyond the edges of a grid its outermost samples go on")
{
    // 3 columns a metre apart and 2 rows. From half a step beyond the last sample on, no other one counts.
    const tools::Ground ground{{{2, 8, 1}, {5, 1, -3}, 3, 2}, {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f}};
    for (const double off : {0.5, 1.5, 100.0})
        for (const std::size_t column : {0u, 2u})
            for (const std::size_t row : {0u, 1u}) {
                const double x = 5 + (column == 0 ? -1 - off : 1 + off), z = -3 + (row == 0 ? -0.5 - off : 0.5 + off);
                const tools::GroundPoint point = tools::ground_at(ground.grid, ground.heights.data(), x, z);
                INFO("at " << x << ", " << z);
                CHECK(point.height == Approx(1 + 8 * double{ground.heights[3 * row + column]}).epsilon(1e-12));
                CHECK((std::abs(point.slope_x) < 1e-12 && std::abs(point.slope_z) < 1e-12));
            }
}

TEST_CASE("feet: ground that legs cannot follow is told, with frames and place")
{
    const TempFolder folder;
    spill(folder / "jump.bvh", first_jump({}));
    const Hills cliff = along_z([](double z) { return z > 0.8 ? 60.0 : 0; });
    write_png(folder / "g.png", cliff, 16);
    const Words words = {"jump.bvh", "--ground", "g.png", "--ground-size", size_of(cliff)};
    Words written = words;
    written.insert(written.end(), {"--out", "out.bvh"});
    const json report = feet_report(folder, written), doubts = report.at("doubts");
    const auto of_feet = [](const json& each) { return each.at("measure") == "off_ground_max"; };
    const auto found = std::ranges::find_if(doubts, of_feet);
    REQUIRE(found != doubts.end());
    const json off = *found;
    CHECK(report.at("verdict") == "look");
    CHECK(std::ranges::count(report.at("look"), off.at("text")) == 1);
    // It is true of the foot.
    const PlainLegs legs = legs_in(folder / "out.bvh");
    const auto& toes = legs.legs[off.at("limb") == "left_leg" ? 0 : 1].toe;
    double max = 0, nearest = 1e9;
    for (std::size_t n = off.at("first_frame"); n <= off.at("last_frame").get<std::size_t>(); ++n) {
        max = std::max(
            max, std::abs(toes[n].y() - report.at("floor").get<double>() - cliff.height(toes[n].x(), toes[n].z())));
        const json& place = off.at("near");
        nearest = std::min(nearest, (toes[n] - Vector3d(place.at(0), place.at(1), place.at(2))).norm());
    }
    const double leg = (legs.leg_length(0) + legs.leg_length(1)) / 2;
    CHECK(off.at("value") > 0.012);
    CHECK(off.at("value").get<double>() * leg == Approx(max).epsilon(1e-2));
    CHECK(nearest < 1e-3);
    CHECK_THAT(off.at("text").get<std::string>(), Contains(" leg, frames ") && Contains(" off the ground, near ("));
    CHECK_THAT(feet(folder, words).out, Contains("look     " + off.at("text").get<std::string>() + "\n"));
    CHECK(!feet_report(folder, {"jump.bvh"}).contains("doubts"));  // level ground
}

TEST_CASE("feet: a glTF's feet stand, and a foot without a toe joint stands on its ankle")
{
    const fs::path path = find_or_warn("m2m_human_ymca.glb");
    if (path.empty()) return;
    const TempFolder folder;
    const json report =
        feet_report(folder, {path.string(), "--fps", "60", "--out", "out.glb", "--export-contacts", "c.csv"});
    CHECK(report.at("legs").at(0).at("stands_on") == "DEF-toe.L");
    CHECK(report.at("legs").at(0).at("has_toe") == true);
    const PlainGltf out = plain_gltf_of(folder / "out.glb");
    const std::size_t frame_count = report.at("frames");
    const std::vector<double> times = key_times(out, out.node_named("DEF-hips"), "translation");
    REQUIRE(times.size() == frame_count);
    const PlainContacts contacts = contacts_in_table(slurp(folder / "c.csv"), frame_count);
    const PlainLegs legs =
        legs_path(out, {"DEF-hips", "DEF-thigh.*", "DEF-shin.*", "DEF-foot.*", "DEF-toe.*"}, {"L", "R"}, times);
    CHECK(std::ranges::count(contacts[0], true) + std::ranges::count(contacts[1], true) > 100);
    const PlainSkating skating = plain_skating(legs, contacts);
    CHECK(skating.max / 60 < 1e-5);
    CHECK(skating.sink < 1e-5);
    const fs::path man = find_or_warn("cesium_man.gltf");
    if (man.empty()) return;
    spill(folder / "c.csv", "frame,limb,contact\n0,left_leg,on\n10,left_leg,off\n");
    const json ankles = feet_report(folder, {man.string(), "--fps", "60", "--leg", "left:#7,#8,#9", "--leg",
                                             "right:#3,#4,#5", "--contacts", "c.csv"});
    CHECK(ankles.at("legs").at(0).at("has_toe") == false);
}

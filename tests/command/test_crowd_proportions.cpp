// SPDX-License-Identifier: MIT
//
// The promise of crowd.legs, arms and spine: bones are so much longer, joints turn as they did, who walks goes as far
// as the legs are long, and feet that stand are on the same floor.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <set>

#include "tests/crowd_stage.h"
#include "tools/crowd/clip_loop.h"
#include "tools/crowd/clip_parts.h"
#include "tools/crowd/proportions.h"
#include "tools/formats/bvh.h"
#include "tools/rig/limbs.h"

using namespace swivel;
using namespace swivel::test;
using namespace swivel::tools;

namespace {

const std::string kBodies = "[crowd]\ncharacters = 60\nlimbs = \"all\"\nsize = [1, 1]\n";
const std::string kBuilds = "legs = [0.7, 1.3]\narms = [0.8, 1.2]\nspine = [0.9, 1.1]\n";

struct Bvh {
    formats::Clip clip;
    std::vector<BodyPart> body;

    explicit Bvh(const CrowdStage& stage) : clip(formats::read_bvh(stage.folder / "clip.bvh").clip)
    {
        LimbChoice choice;
        choice.kinds = "all";
        body = bind_limbs(clip, choose_joints(clip, "clip.bvh", choice), choice).body;
    }
    std::size_t joint(std::string_view name) const
    {
        return static_cast<std::size_t>(std::ranges::find(clip.joints, name, &formats::Joint::name) -
                                        clip.joints.begin());
    }
};

}  // namespace

TEST_CASE("bones have their factors, joints turn as they did, and feet that stand keep their floor")
{
    const Bvh from{CrowdStage{0, 5}};
    const Proportions builds[] = {{}, {0.75, 1.25, 1.1}};
    const formats::Clip both = proportioned(from.clip, from.body, builds);
    const std::size_t count = from.clip.frame_count, joints = from.clip.joints.size();
    REQUIRE(both.frame_count == 2 * count);
    using Places = std::vector<Eigen::Isometry3d>;
    const auto at = [&](const Places& places, std::string_view name) {
        return Vector3d(places[from.joint(name)].translation());
    };
    const auto length = [&](const Places& places, std::string_view a, std::string_view b) {
        return (at(places, a) - at(places, b)).norm();
    };
    const auto middle = [&](const Places& places) {
        return Vector3d(0.5 * (at(places, "LeftUpLeg") + at(places, "RightUpLeg")));
    };
    const Places start = joints_of(from.clip, 0), start_of_other = joints_of(both, count);
    double lowest = 1e9, lowest_of_other = 1e9;
    for (std::size_t frame = 0; frame < count; ++frame) {
        const Places was = joints_of(from.clip, frame), same = joints_of(both, frame),
                     other = joints_of(both, count + frame);
        for (std::size_t n = 0; n < joints; ++n) {
            CHECK((same[n].translation() - was[n].translation()).norm() < 1e-9);
            const Quaterniond &is = both.rotation[(count + frame) * joints + n],
                              &in_clip = from.clip.rotation[frame * joints + n];
            CHECK(is.coeffs() == in_clip.coeffs());
        }
        for (const std::string side : {"Left", "Right"}) {
            for (const auto& [a, b] : {std::pair{"UpLeg", "Leg"}, {"Leg", "Foot"}})
                CHECK(length(other, side + a, side + b) == Approx(0.75 * length(was, side + a, side + b)));
            for (const auto& [a, b] : {std::pair{"Arm", "ForeArm"}, {"ForeArm", "Hand"}})
                CHECK(length(other, side + a, side + b) == Approx(1.25 * length(was, side + a, side + b)));
            CHECK(length(other, side + "Foot", side + "ToeBase") ==
                  Approx(length(was, side + "Foot", side + "ToeBase")));
        }
        CHECK(length(other, "Spine", "Spine1") == Approx(1.1 * length(was, "Spine", "Spine1")));
        CHECK(length(other, "Hips", "LeftUpLeg") == Approx(length(was, "Hips", "LeftUpLeg")));
        const Vector3d way = middle(was) - middle(start), way_of_other = middle(other) - middle(start_of_other);
        CHECK((way_of_other - 0.75 * way).norm() < 1e-9);
        for (const char* foot : {"LeftFoot", "RightFoot"}) {
            lowest = std::min(lowest, at(was, foot).y());
            lowest_of_other = std::min(lowest_of_other, at(other, foot).y());
        }
    }
    CHECK(std::abs(lowest_of_other - lowest) < 0.02 * length(start, "LeftUpLeg", "LeftFoot"));
}

TEST_CASE("characters have one of eight builds by the seed, the first one its own, in every output")
{
    const CrowdStage stage;
    const nlohmann::json out = stage.json(kBodies + kBuilds), again = stage.json(kBodies + kBuilds, {"--seed", "2"});
    const nlohmann::json& performed = out.at("performed");
    REQUIRE(performed.size() == 8);
    CHECK(performed.at(0).at("legs") == 1);
    CHECK(again.at("performed").at(1).at("legs") != performed.at(1).at("legs"));
    std::set<std::size_t> seen;
    const std::size_t frames = performed.at(0).at("frames");
    for (const nlohmann::json& each : out.at("each_character")) {
        const std::size_t build = each.at("start").get<std::size_t>() / frames;
        seen.insert(build);
        CHECK(each.at("performs") == build);
    }
    CHECK(seen.size() == 8);
    CHECK(out.at("each_character").at(0).at("start") == 0);
    for (std::size_t n = 1; n < 8; ++n)
        for (const auto& [key, min, max] : {std::tuple{"legs", 0.7, 1.3}, {"arms", 0.8, 1.2}, {"spine", 0.9, 1.1}}) {
            CHECK(performed.at(n).at(key) > min);
            CHECK(performed.at(n).at(key) < max);
        }
    // One place is too far away for short arms alone.
    const auto shoulder = [&](std::size_t arm) { return arm_pose(stage.clip, stage.arms[arm], 0).shoulder; };
    const Vector3d above = 0.5 * (shoulder(0) + shoulder(1)) + Vector3d(0, stage.arms[0].length(), 0);
    const std::string one_place = "spacing = 0\nstagger = false\narms = [0.5, 2]\n[limb.arms]\ntarget.point = ";
    const nlohmann::json there = stage.json(kBodies + one_place + text_of(above) + "\n", {"--frames", "1"});
    CHECK(there.at("out_of_reach") > 10);
    CHECK(there.at("out_of_reach") < 110);
    CHECK(stage.json(kBodies + "arms = [0.9, 0.9]\n").at("performed").size() == 2);
    // One character alone is the clip's own, and can be written as its clip.
    CHECK(stage.motion("[crowd]\nlegs = [0.7, 1.3]\n").header == stage.clip.header);
}

TEST_CASE("builds perform at speeds of their own, and loops come round in whole frames")
{
    const CrowdStage stage;
    const auto frame_count = static_cast<double>(stage.clip.lines.size());
    const std::string speeds = kBodies + "speed = [0.7, 1.4]\n";
    std::set<double> all;
    const nlohmann::json performed = stage.json(speeds).at("performed");
    for (const nlohmann::json& part : performed) {
        const double speed = part.at("speed");
        CHECK((speed >= 0.7 && speed <= 1.4));
        CHECK(part.at("frames") == std::floor((frame_count - 1) / speed) + 1);
        CHECK(part.at("legs") == 1);
        all.insert(speed);
    }
    CHECK(all.size() == 8);
    CHECK(all.contains(1));
    const nlohmann::json loops = stage.json(speeds + "loop = \"auto\"\n", {"--frames", "90"});
    const double length = loops.at("loop").at(1).get<double>() - loops.at("loop").at(0).get<double>();
    for (const nlohmann::json& part : loops.at("performed")) {
        const double round = part.at("frames").get<double>() - 90, speed = part.at("speed");
        CHECK(speed * round == Approx(length).epsilon(1e-12));
        CHECK((speed > 0.95 * 0.7 && speed <= 1.4));
    }
    // Speeds change no build.
    const std::string legs = kBodies + "legs = [0.7, 1.3]\n";
    const nlohmann::json without = stage.json(legs).at("performed"),
                         with = stage.json(legs + "speed = [0.7, 1.4]\n").at("performed");
    REQUIRE(without.size() == with.size());
    for (std::size_t n = 0; n < with.size(); ++n) CHECK(with[n].at("legs") == without[n].at("legs"));
}

TEST_CASE("between two frames a joint is half-way, and a loop is the same in each round")
{
    const CrowdStage stage;
    const Bvh bvh(stage);
    const std::size_t joints = bvh.clip.joints.size(), frames = bvh.clip.frame_count;
    std::vector<ClipPart> parts{{0, frames, frames}};
    const formats::Clip slow = paced(bvh.clip, parts, std::array{0.5}, 0);
    REQUIRE(slow.frame_count == 2 * frames - 1);
    CHECK((parts[0].count == slow.frame_count && parts[0].pace == 0.5));
    for (std::size_t frame = 0; frame + 1 < frames; ++frame) {
        const auto was = joints_of(bvh.clip, frame), is = joints_of(slow, 2 * frame);
        for (std::size_t n = 0; n < joints; ++n) {
            CHECK((is[n].translation() - was[n].translation()).norm() == 0);
            const Quaterniond &a = bvh.clip.rotation[frame * joints + n],
                              &b = bvh.clip.rotation[(frame + 1) * joints + n],
                              &middle = slow.rotation[(2 * frame + 1) * joints + n];
            CHECK(std::abs(middle.angularDistance(a) - middle.angularDistance(b)) < 1e-7);
            CHECK(middle.angularDistance(a) == Approx(a.angularDistance(b) / 2).margin(1e-7));
        }
    }
    const ClipLoop loop{3, frames - 4};
    std::vector<ClipPart> round{{0, 260 + loop.length(), loop.length()}};
    const formats::Clip on = looped(bvh.clip, 0, loop, round[0].count), fast = paced(on, round, std::array{1.3}, 200);
    const std::size_t length = round[0].starts;
    REQUIRE(length == static_cast<std::size_t>(std::ceil(static_cast<double>(loop.length()) / 1.3)));
    REQUIRE(fast.frame_count == 200 + length);
    for (std::size_t frame = length; frame + length < fast.frame_count; ++frame)
        for (std::size_t n = 1; n < joints; ++n)  // the root goes on
            CHECK(fast.rotation[frame * joints + n].angularDistance(fast.rotation[(frame + length) * joints + n]) <
                  1e-7);
}

TEST_CASE("a figure's root on the ground stays there, and so do bodies of all sizes")
{
    const TempFolder folder;
    spill(folder / "c.toml", "[crowd]\ncharacters = 40\nlimbs = \"all\"\nsize = [0.5, 0.5]\nlegs = [0.3, 0.4]\n");
    const Outcome outcome = run_command(
        folder.path, {"solve", std::string(SWIVEL_SOURCE_DIR "/tools/view/figure.glb"), "--crowd", "c.toml", "--json"});
    REQUIRE(outcome.exit_code == 0);
    const nlohmann::json out = nlohmann::json::parse(outcome.out);
    for (const nlohmann::json& each : out.at("each_character"))
        CHECK(std::abs(each.at("place").at(1).get<double>()) < 1e-6);
}

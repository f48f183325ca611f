// SPDX-License-Identifier: MIT
//
// Of a rest pose and a clip that bend a limb in different ways, which one is believed. The test turns the lower bone
// about axes of its own, so it knows where each carries the bone, and by how much.
#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

#include "tests/plain_gltf.h"
#include "tests/rig_report.h"
#include "tests/test_random.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using nlohmann::json;

namespace {

// An elbow, and what bends it.
struct Elbow {
    double rest = 0;                  // degrees
    std::vector<double> clip = {};    // of each frame, degrees; below 0: the other way
    double between = 77;              // degrees about the upper bone, from where rest carries the lower one to
                                      // where the clip does
    Vector3d bone = {1, 0, 0};        // unit
    Vector3d rest_axis = {0, -1, 0};  // unit, across the bone
    Quaterniond turn = Quaterniond::Identity();  // of the whole arm

    Vector3d clip_axis() const { return AngleAxisd(between * kDegree, bone) * rest_axis; }
    // Where a small turn about an axis carries the lower bone, in the world.
    Vector3d way_w(const Vector3d& axis) const { return turn * axis.cross(bone); }
};

std::vector<double> steady(double degrees, std::size_t count = 10) { return std::vector<double>(count, degrees); }

// `count` frames, of which so many are bent otherwise.
std::vector<double> mixed(double degrees, double other, std::size_t others, std::size_t count = 10)
{
    std::vector<double> frames = steady(degrees, count);
    std::fill_n(frames.begin(), others, other);
    return frames;
}

struct Answer {
    Vector3d way_w;  // unit
    std::string source;
    bool is_noted;  // another bend is offered
};

// What the command says of the elbow.
Answer ask(const Elbow& elbow)
{
    const TempFolder folder;
    GltfRig rig;
    const int chest = rig.add("Chest", -1, {0, 1, 0}, elbow.turn);
    const int upper = rig.add("LeftArm", chest, {0.2, 0, 0});
    const Quaterniond bent(AngleAxisd(elbow.rest * kDegree, elbow.rest_axis));
    const int lower = rig.add("LeftForeArm", upper, 0.3 * elbow.bone, bent);
    rig.add("LeftHand", lower, 0.25 * elbow.bone);
    std::vector<float> times;
    for (std::size_t n = 0; n < elbow.clip.size(); ++n) times.push_back(static_cast<float>(n) / 30);
    rig.add_keys(rig.add_animation("clip"), lower, "rotation", times, turns(elbow.clip_axis(), elbow.clip));
    rig.write(folder / "rig.glb");
    const json limb = limb_of(rig_report(rig), "left_arm");
    REQUIRE(limb.at("bound") == true);
    const Vector3d way_w =
        plain_world(plain_gltf_of(folder / "rig.glb"), -1, upper, 0).linear() * vector_of(limb["bend"]);
    return {way_w, limb["bend_source"], limb.contains("notes")};
}

void require_rest(const Elbow& elbow)
{
    const Answer answer = ask(elbow);
    INFO(elbow.rest << " degrees at rest, " << elbow.clip.front() << " to " << elbow.clip.back()
                    << " in the clip: " << answer.source);
    CHECK(degrees_between(answer.way_w, elbow.way_w(elbow.rest_axis)) < 0.1);
    CHECK_THAT(answer.source, StartsWith("the rest pose"));
}

void require_clip(const Elbow& elbow)
{
    const Answer answer = ask(elbow);
    INFO(elbow.rest << " degrees at rest, " << elbow.clip.front() << " to " << elbow.clip.back()
                    << " in the clip: " << answer.source);
    CHECK(degrees_between(answer.way_w, elbow.way_w(elbow.clip_axis())) < 0.1);
    CHECK_THAT(answer.source, StartsWith("the clip"));
    CHECK(!answer.is_noted);
}

}  // namespace

TEST_CASE("rig bend: a clear bend of the clip overrules a rest pose that is hardly bent, and says so")
{
    const Elbow elbow{.rest = 10.5, .clip = steady(90)};
    require_clip(elbow);
    const std::string said = ask(elbow).source;
    CHECK(said == "the clip, bent by 90.0 degrees in the mean; it is clearer than the rest pose, bent by 10.5 degrees");
    CHECK(ask({.rest = 9.5, .clip = steady(90)}).source == "the clip, bent by 90.0 degrees in the mean");
}

TEST_CASE("rig bend: on both sides of each bound")
{
    require_clip({.rest = 19.5, .clip = steady(90)});
    require_rest({.rest = 20.5, .clip = steady(90)});
    require_clip({.rest = 160.5, .clip = steady(90)});  // folded: its sine is that of 19.5 degrees
    require_rest({.rest = 159.5, .clip = steady(90)});
    require_clip({.rest = 15, .clip = steady(30.5)});
    require_rest({.rest = 15, .clip = steady(29.5)});
    // One way in nine of ten frames; the mean is clear in all four.
    require_clip({.rest = 15, .clip = mixed(80, -80, 1)});
    require_rest({.rest = 15, .clip = mixed(80, -80, 2)});
    require_clip({.rest = 15, .clip = mixed(80, 0, 1)});
    require_rest({.rest = 15, .clip = mixed(80, 0, 2)});
    // A clip that is not clear still tells what a straight rest pose does not.
    require_clip({.rest = 5, .clip = mixed(80, -80, 2)});
    require_clip({.rest = 5, .clip = steady(15)});
}

TEST_CASE("rig bend: whatever the axes")
{
    Random random{23};
    std::size_t by_rest = 0, by_clip = 0;
    for (int round = 0; round < 120; ++round) {
        Elbow elbow{.rest = random.between(10.5, 40), .between = random.between(-180, 180)};
        elbow.bone = random.direction();
        elbow.rest_axis = random.across(elbow.bone);
        elbow.turn = random.rotation();
        const std::size_t count = 10 + random.below(30), others = random.below(static_cast<std::uint32_t>(count / 4));
        elbow.clip = mixed(random.between(15, 140), -random.between(5, 30), others, count);
        double mean = 0;  // all frames turn about one axis, so sines add up
        for (const double degrees : elbow.clip) mean += std::sin(degrees * kDegree) / static_cast<double>(count);
        if (std::abs(mean - 0.5) < 0.01 || std::abs(elbow.rest - 20) < 0.1) continue;  // too near to a bound
        const bool is_clear = mean > 0.5 && 10 * others <= count && elbow.rest < 20;
        is_clear ? require_clip(elbow) : require_rest(elbow);
        ++(is_clear ? by_clip : by_rest);
    }
    CHECK(by_rest > 10);
    CHECK(by_clip > 10);
}

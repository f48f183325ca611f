// SPDX-License-Identifier: MIT
//
// What is wrong in a clip, or in what came of it, is named: a clean clip is damaged in ways that files have, one at a
// time.
#include <catch2/catch.hpp>

#include <algorithm>
#include <numbers>
#include <random>

#include "tests/demo_figure.h"
#include "tools/crowd/demo_clip.h"
#include "tools/formats/limb_name.h"
#include "tools/retarget/eased.h"
#include "tools/retarget/verdict.h"
#include "tools/rig/clip_doubts.h"

using namespace swivel;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;

namespace {

constexpr std::size_t kFrames = 120;

std::size_t joint_of(const Clip& clip, const char* name)
{
    return static_cast<std::size_t>(formats::find_joints(clip, name).at(0));
}
Quaterniond& rotation_of(Clip& clip, const char* name, std::size_t frame)
{
    return clip.rotation[frame * clip.joints.size() + joint_of(clip, name)];
}
// Gives joints other rotations in all frames before `end`.
void turn(Clip& clip, std::initializer_list<const char*> joints, const auto& turned, std::size_t end = kFrames)
{
    for (std::size_t frame = 0; frame < end; ++frame)
        for (const char* const joint : joints)
            rotation_of(clip, joint, frame) = Quaterniond(turned(rotation_of(clip, joint, frame)));
}
Quaterniond about(const Vector3d& axis, double angle) { return Quaterniond(Eigen::AngleAxisd(angle, axis)); }
std::string lines_of(const std::vector<std::string>& list)
{
    std::string all;
    for (const std::string& each : list) all += each + "\n";
    return all;
}
std::string doubts(const Clip& clip) { return lines_of(tools::clip_doubts(clip, test::parts_of_demo(clip))); }

struct Damage {
    const char* name;
    std::string said;
    void (*make)(Clip& clip);
};
const Damage kDamages[] = {
    {"a longer bone", "the left thigh is 1.20 times as long as the right one",
     [](Clip& clip) { clip.joints[joint_of(clip, "LeftLeg")].offset *= 1.2; }},
    {"left and right exchanged", "the left leg is on the right of where the toes point",
     [](Clip& clip) {
         for (formats::Joint& joint : clip.joints)
             if (joint.name.starts_with("Left"))
                 joint.name.replace(0, 4, "Right");
             else if (joint.name.starts_with("Right"))
                 joint.name.replace(0, 5, "Left");
     }},
    {"a pop", "'RightForeArm' turns there and back, by 20 degrees in frame 50",
     [](Clip& clip) { rotation_of(clip, "RightForeArm", 50) *= about(Vector3d::UnitX(), 0.349); }},
    {"a knee the wrong way", "the left knee bends forwards",
     [](Clip& clip) {
         turn(clip, {"LeftUpLeg", "LeftLeg", "LeftFoot"}, [](const auto& was) { return was.conjugate(); });
     }},
    {"an elbow the wrong way", "the right elbow bends backwards",
     [](Clip& clip) { turn(clip, {"RightForeArm"}, [](const auto& was) { return was.conjugate(); }); }},
    {"a bone that grows", "the right shin is not as long as at rest in 20 of 120 frames, from frame 100",
     [](Clip& clip) {
         const std::size_t foot = joint_of(clip, "RightFoot");
         clip.joints[foot].track = static_cast<int>(clip.track_count);
         std::vector<Vector3d> translation;
         for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
             for (std::size_t n = 0; n < clip.track_count; ++n)
                 translation.push_back(clip.translation[frame * clip.track_count + n]);
             translation.push_back(clip.joints[foot].offset * (frame < 100 ? 1 : 1.2));
         }
         clip.translation = translation;
         ++clip.track_count;
     }},
    {"an arm behind", "the left upper arm points backwards",
     [](Clip& clip) { turn(clip, {"LeftArm"}, [](const auto&) { return about(Vector3d::UnitY(), 1.5708); }); }},
    {"a leg that never moves", "the left leg never moves, the other turns by up to",
     [](Clip& clip) {
         for (std::size_t frame = 1; frame < clip.frame_count; ++frame)
             for (const char* joint : {"LeftUpLeg", "LeftLeg", "LeftFoot"})
                 rotation_of(clip, joint, frame) = rotation_of(clip, joint, 0);
     }},
    {"a first frame apart", "frame 0 is a pose of its own",
     [](Clip& clip) {
         for (std::size_t n = 0; n < clip.joints.size(); ++n) clip.rotation[n] = Quaterniond::Identity();
         rotation_of(clip, "LeftArm", 0) = about(Vector3d::UnitZ(), 1.5);
     }},
    {"a body that jumps", "the body jumps by 0.3",
     [](Clip& clip) {
         for (std::size_t frame = 60; frame < clip.frame_count; ++frame)
             clip.translation[frame * clip.track_count].x() += 0.28;
     }},
    {"sunk", "its feet stand at a height of -0.1",
     [](Clip& clip) {
         for (Vector3d& place : clip.translation) place.y() -= 0.1;
     }},
    {"a rest that lies", "heads are above feet along y in its frames and along",
     [](Clip& clip) { clip.joints[0].rest_rotation = about(Vector3d::UnitX(), 1.5708); }},
};

}  // namespace

TEST_CASE("doubts: a clean clip has none, and each damage is named")
{
    const Clip clean = tools::demo_clip(kFrames);
    CHECK(doubts(clean).empty());
    for (const Damage& damage : kDamages) {
        INFO(damage.name);
        Clip clip = clean;
        damage.make(clip);
        CHECK_THAT(doubts(clip), Contains(damage.said));
    }
}

TEST_CASE("doubts: none of how a body is built, however it lies, and none of a mirrored figure")
{
    const Clip clean = tools::demo_clip(kFrames);
    CHECK(doubts(test::in_mirror(clean)).empty());
    for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 0, 1)})
        for (const double angle : {1.5708, 3.1416}) {
            Clip clip = clean;
            for (std::size_t frame = 0; frame < kFrames; ++frame)
                clip.rotation[frame * clip.joints.size()] =
                    Eigen::AngleAxisd(angle, axis) * clip.rotation[frame * clip.joints.size()];
            CHECK_THAT(doubts(clip), !Contains("bends"));
        }
}

TEST_CASE("verdicts: a motion that is the source's is good, and what is elsewhere is told by how much of it there is")
{
    const Clip source = tools::demo_clip(kFrames);
    const tools::JointPairs pairs = test::demo_pairs(source, source);
    const tools::Retargeted motion = tools::retarget(source, source, pairs);
    REQUIRE(motion.ground);
    CHECK(tools::verdict_of(source, motion, pairs).is_good());
    const auto verdict = [&](const auto& spoil) {
        tools::Retargeted wrong = motion;
        spoil(wrong);
        const tools::Verdict said = tools::verdict_of(source, wrong, pairs);
        return std::pair(lines_of(said.faults), lines_of(said.doubts));
    };
    // The spine turns over, and with it what hangs on it; limbs are turned back.
    const auto turned_over = [](tools::Retargeted& wrong) {
        turn(wrong.clip, {"Spine", "LeftArm", "RightArm"},
             [](const auto& was) { return about(Vector3d::UnitZ(), std::numbers::pi) * was; });
    };
    CHECK_THAT(verdict(turned_over).first, StartsWith("the trunk points up to 180 degrees away from the source's"));
    const auto raised = [&](std::size_t frames) {
        return verdict([&](tools::Retargeted& wrong) {
            turn(
                wrong.clip, {"LeftUpLeg"}, [](const auto&) { return about(Vector3d::UnitX(), -1.5); }, frames);
        });
    };
    CHECK_THAT(raised(kFrames / 2).first, StartsWith("the left thigh points") && Contains("in 60 of 120 frames"));
    CHECK(raised(3).first.empty());
    CHECK_THAT(raised(3).second, Contains("in 3 of 120 frames"));
    // The target's ground is over the hands, so they are in it, and so are the feet.
    CHECK_THAT(verdict([](tools::Retargeted& wrong) { wrong.ground->target = 1.5; }).second,
               Contains("the left hand goes up to") && Contains("the right foot goes up to") &&
                   Contains("leg lengths deeper into the ground than the source's: over 0.03 in 120 of 120"));
    const auto as_deep = [](tools::Retargeted& wrong) { wrong.ground->target = wrong.ground->source = 1.5; };
    CHECK(verdict(as_deep).second.empty());
}

TEST_CASE("eased: no step is above the most, slow courses stay, and none leaves what the values span")
{
    std::mt19937 random(1);
    for (int round = 0; round < 200; ++round) {
        std::vector<double> values(50);
        for (double& value : values) value = std::uniform_real_distribution(-1.0, 1.0)(random);
        const double most_step = std::uniform_real_distribution(0.01, 3.0)(random);
        const std::vector<double> course = tools::eased(values, most_step);
        for (std::size_t n = 1; n < course.size(); ++n)
            CHECK(std::abs(course[n] - course[n - 1]) <= most_step * (1 + 1e-12));
        const auto [least, most] = std::ranges::minmax(values);
        for (const double value : course) CHECK((value >= least && value <= most));
        CHECK(tools::eased(course, most_step * (1 + 1e-9)) == course);
    }
    std::vector<double> jump(100, 0);
    jump[50] = 1;
    const std::vector<double> course = tools::eased(jump, 0.1);
    CHECK(course[50] == Approx(0.55));  // between 1 and a step above 0
    CHECK(course[39] == 0);             // more than ten steps away
}

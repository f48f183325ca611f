// SPDX-License-Identifier: MIT
//
// The demo's clip, damaged in ways that files have: rest poses that are none, sizes that keys alone have, mirrors,
// bones and joints that are wrong. Where the damage can be undone, what must come out is known from the clip as it was;
// else the damage is named, and so is a motion that is not the source's.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tools/crowd/demo_clip.h"
#include "tools/formats/limb_name.h"
#include "tools/retarget/joint_pairs.h"
#include "tools/retarget/retarget.h"
#include "tools/retarget/verdict.h"
#include "tools/rig/clip_doubts.h"
#include "tools/rig/facing.h"
#include "tools/rig/limb_chain.h"
#include "tools/rig/standing_rest.h"
#include "tools/rig/vectors.h"

using namespace swivel;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;
using tools::facing_of;
using tools::KnownLimbs;
using tools::size_at_rest;
using tools::stand_at_rest;

namespace {

// The limbs and parts of the demo's figure, by the names of its joints.
tools::KnownLimbs limbs_of_demo(const formats::Clip& clip)
{
    const auto joint = [&](const char* name) { return formats::find_joints(clip, name).at(0); };
    return {tools::LimbJoints{joint("LeftArm"), joint("LeftForeArm"), joint("LeftHand")},
            tools::LimbJoints{joint("RightArm"), joint("RightForeArm"), joint("RightHand")},
            tools::LimbJoints{joint("LeftUpLeg"), joint("LeftLeg"), joint("LeftFoot")},
            tools::LimbJoints{joint("RightUpLeg"), joint("RightLeg"), joint("RightFoot")}};
}

std::vector<tools::BodyPart> parts_of_demo(const formats::Clip& clip)
{
    return tools::body_parts(clip, limbs_of_demo(clip));
}

tools::JointPairs demo_pairs(const formats::Clip& source, const formats::Clip& target)
{
    return tools::pair_joints({source, parts_of_demo(source)}, {target, parts_of_demo(target)});
}

// The motion below a joint that mirrors x.
formats::Clip in_mirror(const formats::Clip& clip)
{
    formats::Clip mirrored = clip;
    formats::Joint armature;
    armature.name = "Armature";
    armature.rest_scale = {-1, 1, 1};
    for (formats::Joint& joint : mirrored.joints) ++joint.parent;
    mirrored.joints.insert(mirrored.joints.begin(), armature);
    mirrored.rotation.clear();
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        mirrored.rotation.push_back(Eigen::Quaterniond::Identity());
        for (std::size_t n = 0; n < clip.joints.size(); ++n)
            mirrored.rotation.push_back(clip.rotation[frame * clip.joints.size() + n]);
    }
    return mirrored;
}

constexpr std::size_t kFrames = 120;

// The same motion on a skeleton whose bones lie along `along` of their joints at rest, as LAFAN1's along x.
Clip with_bones_along(const Vector3d& along, Clip clip)
{
    std::vector<Quaterniond> axes(clip.joints.size(), Quaterniond::Identity());
    for (std::size_t n = 0; n < clip.joints.size(); ++n)
        if (const std::vector<int> below = child_joints(clip, static_cast<int>(n)); !below.empty())
            axes[n] = Quaterniond::FromTwoVectors(along, joint_at(clip, below.front()).offset);
    for (std::size_t n = 0; n < clip.joints.size(); ++n) {
        const int parent = clip.joints[n].parent;
        const Quaterniond above = parent < 0 ? Quaterniond::Identity() : axes[static_cast<std::size_t>(parent)];
        clip.joints[n].offset = above.conjugate() * clip.joints[n].offset;
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
            Quaterniond& rotation = clip.rotation[frame * clip.joints.size() + n];
            rotation = above.conjugate() * rotation * axes[n];
        }
    }
    return clip;
}

// The largest distance between the joints of two clips of one skeleton, in all frames.
double apart(const Clip& a, const Clip& b)
{
    double max = 0;
    for (std::size_t frame = 0; frame < a.frame_count; ++frame) {
        const auto a_w = world_pose(a, frame), b_w = world_pose(b, frame);
        for (std::size_t n = 0; n < a_w.size(); ++n) max = std::max(max, (a_w[n].position - b_w[n].position).norm());
    }
    return max;
}

Clip on_demo(const Clip& source)
{
    const Clip target = tools::demo_clip(1);
    return tools::retarget(source, target, demo_pairs(source, target)).clip;
}

}  // namespace

TEST_CASE("standing rest: a rest pose that stands is left as it is")
{
    Clip clip = tools::demo_clip(kFrames);
    CHECK(stand_at_rest(clip, limbs_of_demo(clip), {}).empty());
    CHECK(size_at_rest(clip, limbs_of_demo(clip)).empty());
    CHECK(std::ranges::none_of(clip.joints, [](const auto& joint) { return joint.unkeyed.has_value(); }));
}

TEST_CASE("standing rest: of bones along one axis, a frame says what is up and how limbs hang")
{
    const Clip plain = tools::demo_clip(kFrames);
    for (const Vector3d& along : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1), Vector3d(0, 0, -1)}) {
        INFO(along.transpose());
        Clip clip = with_bones_along(along, plain);
        REQUIRE(apart(plain, clip) < 1e-12);
        const KnownLimbs limbs = limbs_of_demo(clip);
        CHECK_THAT(stand_at_rest(clip, limbs, {}), Contains("cannot stand") && Contains("and y is up"));
        CHECK(apart(plain, clip) < 1e-12);  // no frame changes
        const tools::Facing facing = facing_of(clip, limbs);
        CHECK(tools::degrees_between(facing.up_w, Vector3d::UnitY()) < 2);
        CHECK(tools::degrees_between(facing.forwards_w, Vector3d::UnitZ()) < 2);
        CHECK(clip.joints[0].unkeyed->rotation.isApprox(Quaterniond::Identity()));
        // On another figure, limbs point where they do from the pose that was made. A trunk's rest is a guess.
        const Clip from_plain = on_demo(plain), from_clip = on_demo(clip);
        for (std::size_t frame = 0; frame < kFrames; frame += 7) {
            const auto a_w = world_pose(from_plain, frame), b_w = world_pose(from_clip, frame);
            for (const auto& limb : limbs_of_demo(from_plain))
                for (std::size_t n = 0; n < 2; ++n) {
                    const auto bone = [&](const auto& pose_w) -> Vector3d {
                        return pose_w[static_cast<std::size_t>((*limb)[n + 1])].position -
                               pose_w[static_cast<std::size_t>((*limb)[n])].position;
                    };
                    CHECK(tools::degrees_between(bone(a_w), bone(b_w)) < 0.1);
                }
        }
    }
}

TEST_CASE("standing rest: the frame is turned to the front, feet too, whichever way it faces and whatever is up")
{
    const Quaterniond z_up(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitX()));
    for (const bool is_z_up : {false, true})
        for (const bool is_mirrored : {false, true})
            for (const double yaw : {0.0, 1.0, std::numbers::pi, -2.0}) {
                INFO(is_z_up << is_mirrored << yaw);
                Clip clip = with_bones_along(Vector3d::UnitX(), tools::demo_clip(kFrames));
                const Quaterniond turned =
                    (is_z_up ? z_up : Quaterniond::Identity()) * Eigen::AngleAxisd(yaw, Vector3d::UnitY());
                for (std::size_t frame = 0; frame < kFrames; ++frame) {
                    Quaterniond& root = clip.rotation[frame * clip.joints.size()];
                    root = turned * root;
                    // A toe that is turned out far.
                    Quaterniond& foot = clip.rotation[frame * clip.joints.size() +
                                                      static_cast<std::size_t>((*limbs_of_demo(clip)[2])[2])];
                    foot = Eigen::AngleAxisd(0.6, Vector3d::UnitX()) * foot;
                }
                if (is_mirrored) clip = in_mirror(clip);
                const KnownLimbs limbs = limbs_of_demo(clip);
                CHECK_THAT(stand_at_rest(clip, limbs, {}), Contains(is_z_up ? "and z is up" : "and y is up"));
                const tools::Facing facing = facing_of(clip, limbs);
                const Vector3d front_w = is_z_up ? Vector3d(-Vector3d::UnitY()) : Vector3d(Vector3d::UnitZ());
                CHECK(tools::degrees_between(facing.forwards_w, front_w) < 0.5);
                CHECK(tools::degrees_between(facing.up_w, is_z_up ? Vector3d::UnitZ() : Vector3d::UnitY()) < 2);
                const auto rest_w = formats::rest_pose(clip);
                const Vector3d to_left_w = position_of(rest_w, (*limbs[2])[0]) - position_of(rest_w, (*limbs[3])[0]);
                CHECK(tools::degrees_between((is_mirrored ? -1 : 1) * to_left_w, facing.up_w.cross(front_w)) < 2);
            }
}

TEST_CASE("standing rest: a rest pose in mid-step, or along an axis that no frame has, is replaced")
{
    const Clip plain = tools::demo_clip(kFrames);
    Clip stepping = plain;
    stepping.joints[static_cast<std::size_t>((*limbs_of_demo(plain)[2])[0])].rest_rotation =
        Eigen::AngleAxisd(-0.5, Vector3d::UnitX());
    CHECK_THAT(stand_at_rest(stepping, limbs_of_demo(stepping), {}), Contains("its legs differ by 29 degrees"));
    Clip lying = plain;
    lying.joints[0].rest_rotation = Eigen::AngleAxisd(-std::numbers::pi / 2, Vector3d::UnitX());
    CHECK_THAT(stand_at_rest(lying, limbs_of_demo(lying), {}),
               Contains("its trunk points along -z") && Contains("and y is up"));
    lying.joints[0].rest_rotation = Eigen::AngleAxisd(-std::numbers::pi / 2, Vector3d::UnitX());
    keep_frames(lying, 0);  // there is nothing better
    CHECK(stand_at_rest(lying, limbs_of_demo(lying), {}).empty());
}

TEST_CASE("standing rest: up is asked for, or the frame, and what cannot be is said")
{
    Clip clip = with_bones_along(Vector3d::UnitX(), tools::demo_clip(kFrames));
    const KnownLimbs limbs = limbs_of_demo(clip);
    CHECK_THROWS_WITH(stand_at_rest(clip, limbs, {{}, Vector3d::UnitX()}), Contains("no frame stands along x"));
    CHECK_THROWS_WITH(stand_at_rest(clip, limbs, {kFrames, {}}), Contains("it has 120 frames"));
    CHECK_THAT(stand_at_rest(clip, limbs, {7, {}}), Contains("frame 7 is taken as the rest pose"));
    Clip heap = clip;  // in each frame as at rest before
    for (Quaterniond& rotation : heap.rotation) rotation = Quaterniond::Identity();
    for (formats::Joint& joint : heap.joints) joint.rest_rotation = Quaterniond::Identity();
    CHECK_THROWS_WITH(stand_at_rest(heap, limbs, {}), Contains("cannot stand") && Contains("no frame stands"));
}

TEST_CASE("standing rest: bones that have their length in keys alone have it at rest, too")
{
    const Clip plain = tools::demo_clip(kFrames);
    Clip clip = plain;
    clip.scale_track_count = 1;
    clip.scale.assign(kFrames, Vector3d::Constant(100));
    clip.joints[0].scale_track = 0;
    for (formats::Joint& joint : clip.joints)
        if (joint.parent >= 0) joint.offset /= 100;
    CHECK_THAT(size_at_rest(clip, limbs_of_demo(clip)), Contains("100 times as long as at rest"));
    const Clip target = tools::demo_clip(1);
    const tools::Retargeted made = tools::retarget(clip, target, demo_pairs(clip, target));
    CHECK(made.leg_ratio == Approx(1));
    CHECK(apart(made.clip, on_demo(plain)) < 1e-9);
}

TEST_CASE("standing rest: a bone of no length, or a figure of none in the first frame, leaves the size as it is")
{
    const Clip plain = tools::demo_clip(kFrames);
    Clip clip = plain;
    clip.joints[static_cast<std::size_t>((*limbs_of_demo(clip)[2])[1])].offset.setZero();
    CHECK(size_at_rest(clip, limbs_of_demo(clip)).empty());
    clip = plain;
    clip.scale_track_count = 1;
    clip.scale.assign(kFrames, Vector3d::Ones());
    clip.scale[0].setZero();
    clip.joints[0].scale_track = 0;
    CHECK(size_at_rest(clip, limbs_of_demo(clip)).empty());
}

TEST_CASE("retarget: of a figure that is mirrored as a whole comes its mirror image")
{
    const Clip plain = tools::demo_clip(kFrames), mirrored = in_mirror(plain);
    const auto left_w = [](const Clip& clip) {
        const auto pose_w = world_pose(clip, 0);
        return pose_w[static_cast<std::size_t>(formats::find_joints(clip, "LeftHand").at(0))].position;
    };
    REQUIRE(left_w(mirrored).isApprox(left_w(plain).cwiseProduct(Vector3d(-1, 1, 1))));
    CHECK(apart(on_demo(mirrored), on_demo(plain)) < 1e-9);
}

namespace {

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
std::string doubts(const Clip& clip)
{
    return lines_of(tools::texts_of(tools::clip_doubts({clip, parts_of_demo(clip)})));
}

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

TEST_CASE("doubts: what nobody is built or bends like is garbage, and all else is worth a look")
{
    std::set<std::string> garbage;
    for (const Damage& damage : kDamages) {
        Clip clip = tools::demo_clip(kFrames);
        damage.make(clip);
        const std::vector<tools::BodyPart> parts = parts_of_demo(clip);
        if (std::ranges::any_of(tools::clip_doubts({clip, parts}), &tools::ClipDoubt::is_garbage))
            garbage.insert(damage.name);
    }
    CHECK(garbage ==
          std::set<std::string>{"left and right exchanged", "a knee the wrong way", "an elbow the wrong way"});
}

TEST_CASE("doubts: none of how a body is built, however it lies, and none of a mirrored figure")
{
    const Clip clean = tools::demo_clip(kFrames);
    CHECK(doubts(in_mirror(clean)).empty());
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
    const tools::JointPairs pairs = demo_pairs(source, source);
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
        const double max_step = std::uniform_real_distribution(0.01, 3.0)(random);
        const std::vector<double> course = tools::eased(values, max_step);
        for (std::size_t n = 1; n < course.size(); ++n)
            CHECK(std::abs(course[n] - course[n - 1]) <= max_step * (1 + 1e-12));
        const auto [min, max] = std::ranges::minmax(values);
        for (const double value : course) CHECK((value >= min && value <= max));
        CHECK(tools::eased(course, max_step * (1 + 1e-9)) == course);
    }
    std::vector<double> jump(100, 0);
    jump[50] = 1;
    const std::vector<double> course = tools::eased(jump, 0.1);
    CHECK(course[50] == Approx(0.55));  // between 1 and a step above 0
    CHECK(course[39] == 0);             // more than ten steps away
}

TEST_CASE("the least rotation from one direction to another")
{
    std::mt19937 random{7};
    const auto any = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
    for (int n = 0; n < 1000; ++n) {
        const double x = any(), y = any(), z = any();
        const Vector3d from = std::pow(10.0, 60 * any()) * Vector3d(x, y, z), aside = from.unitOrthogonal();
        const Vector3d along = from.normalized();
        for (const double angle : {0.0, 1e-7, 0.3, 1.5707963, 3.0, 3.1415925, 3.141592653589793}) {
            const Vector3d to = std::pow(10.0, 60 * any()) * (std::cos(angle) * along + std::sin(angle) * aside);
            const Eigen::Quaterniond turn = tools::aim(from, to);
            INFO(from.transpose() << " to " << to.transpose());
            CHECK(std::fabs(turn.norm() - 1) <= 1e-15);
            CHECK((turn * along - to.normalized()).norm() <= 2e-9);
            CHECK(std::fabs(turn.angularDistance(Eigen::Quaterniond::Identity()) - angle) <= 2e-8);
        }
        CHECK(tools::aim(from, Vector3d::Zero()).w() == 1);
        CHECK(tools::aim(Vector3d::Zero(), from).w() == 1);
    }
}

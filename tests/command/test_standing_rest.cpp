// SPDX-License-Identifier: MIT
//
// Rest poses that are none: all bones along x, sizes that keys alone have, whole figures that are mirrored. What must
// come out is known from the same motion on the skeleton as it was made.
#include <catch2/catch.hpp>

#include <algorithm>
#include <numbers>

#include "tests/demo_figure.h"
#include "tools/crowd/demo_clip.h"
#include "tools/retarget/retarget.h"
#include "tools/rig/facing.h"
#include "tools/rig/standing_rest.h"
#include "tools/rig/vectors.h"

using namespace swivel;
using Catch::Matchers::Contains;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;
using test::limbs_of_demo;
using tools::facing_of;
using tools::KnownLimbs;
using tools::size_at_rest;
using tools::stand_at_rest;

namespace {

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
    double most = 0;
    for (std::size_t frame = 0; frame < a.frame_count; ++frame) {
        const auto a_w = world_pose(a, frame), b_w = world_pose(b, frame);
        for (std::size_t n = 0; n < a_w.size(); ++n) most = std::max(most, (a_w[n].position - b_w[n].position).norm());
    }
    return most;
}

Clip on_demo(const Clip& source)
{
    const Clip target = tools::demo_clip(1);
    return tools::retarget(source, target, test::demo_pairs(source, target)).clip;
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
                if (is_mirrored) clip = test::in_mirror(clip);
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
    const tools::Retargeted made = tools::retarget(clip, target, test::demo_pairs(clip, target));
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
    const Clip plain = tools::demo_clip(kFrames), mirrored = test::in_mirror(plain);
    const auto left_w = [](const Clip& clip) {
        const auto pose_w = world_pose(clip, 0);
        return pose_w[static_cast<std::size_t>(formats::find_joints(clip, "LeftHand").at(0))].position;
    };
    REQUIRE(left_w(mirrored).isApprox(left_w(plain).cwiseProduct(Vector3d(-1, 1, 1))));
    CHECK(apart(on_demo(mirrored), on_demo(plain)) < 1e-9);
}

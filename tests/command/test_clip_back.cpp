// SPDX-License-Identifier: MIT
//
// A test on real motion, from end to end. Wrists and hands of a clip go in as targets, and so do ankles and feet. The
// clip must come back, with the roll of every joint. plain_motion.h alone poses both files.
//
// How far the elbow of a straight arm may be off: it lies at height h over the line from shoulder to wrist, its foot at
// a from the shoulder and b from the wrist, d = a + b. From h^2 = upper^2 - a^2 and a = (d^2 + upper^2 - fore^2) / 2d
// follows da/dd = b/d, so |dh^2/dd| = 2ab/d <= 2 upper fore / d. The solver knows d to e, so it knows h to the root of
// 2 upper fore e / d. Wrist and shoulder are floats relative to the root, each off by 2^-24 of its distance from it
// (together up to 3.5 arm lengths), bone lengths by 6e-8, d by two roundings: e is 4e-7 of the arm's length. That is
// 5e-4 of the arm's length for the height alone, and 2e-3 with the direction in which it points.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

using Limbs = std::vector<PlainArm>;  // those that were solved

double angle_of(const Matrix3d& turn)
{
    const Vector3d axis(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
    return std::atan2(axis.norm(), turn.trace() - 1);
}

// The worst of all frames and limbs, as shares of what is allowed: 1 or less passes.
struct Verdict {
    double end = 0, hand = 0, bent = 0, straight = 0, turn = 0;
};

Verdict judge(const PlainMotion& clip, const PlainMotion& written, const Limbs& limbs)
{
    const auto keep = [](double& most, double error) { most = error <= most ? most : error; };  // NaN stays
    Verdict worst;
    for (std::size_t frame = 0; frame < clip.lines.size(); ++frame) {
        const std::vector<PlainPose> clip_pose = pose_of(clip, frame), written_pose = pose_of(written, frame);
        const auto from = [&](int joint) -> const PlainPose& { return clip_pose[std::size_t(joint)]; };
        const auto to = [&](int joint) -> const PlainPose& { return written_pose[std::size_t(joint)]; };
        for (const PlainArm& limb : limbs) {
            const auto off = [&](int joint) {
                return (to(joint).position - from(joint).position).norm() / limb.length();
            };
            const Vector3d upper = from(limb.elbow).position - from(limb.shoulder).position,
                           lower = from(limb.wrist).position - from(limb.elbow).position;
            const double sine = upper.cross(lower).norm() / (limb.upper * limb.fore);
            // swivel.h has this bound, in radians, for goals that are the pose's own.
            const double allowed = 2e-6 + 4e-7 * limb.length() * limb.length() / (limb.upper * limb.fore * sine);
            keep(worst.end, off(limb.wrist) / 1e-5);
            keep(worst.hand, angle_of(from(limb.wrist).rotation.transpose() * to(limb.wrist).rotation) / 1e-4);
            sine > 0.02 ? keep(worst.bent, off(limb.elbow) / allowed) : keep(worst.straight, off(limb.elbow) / 2e-3);
            for (const int joint : {limb.shoulder, limb.elbow, limb.wrist}) {
                const int parent = clip.joint(joint).parent;
                const Matrix3d before = from(parent).rotation.transpose() * from(joint).rotation,
                               after = to(parent).rotation.transpose() * to(joint).rotation;
                keep(worst.turn, angle_of(before.transpose() * after) / allowed);
            }
        }
    }
    return worst;
}

std::vector<std::size_t> solved_channels(const PlainMotion& motion, const Limbs& limbs)
{
    std::vector<std::size_t> channels;
    for (const PlainArm& limb : limbs)
        for (const int solved : {limb.shoulder, limb.elbow, limb.wrist}) {
            const PlainJoint& joint = motion.joint(solved);
            for (std::size_t c = 0; c < joint.channels.size(); ++c)
                if (joint.channels[c].ends_with("rotation")) channels.push_back(joint.first_channel + c);
        }
    return channels;
}

void require_same_rest(const PlainMotion& clip, const PlainMotion& written, const Limbs& limbs)
{
    REQUIRE(written.header == clip.header);
    const std::vector<std::size_t> channels = solved_channels(clip, limbs);
    REQUIRE(channels.size() == 9 * limbs.size());
    std::size_t different = 0, changed = 0;
    for (std::size_t frame = 0; frame < clip.lines.size(); ++frame) {
        different += rest_of(clip.lines[frame], channels) != rest_of(written.lines[frame], channels);
        changed += clip.lines[frame] != written.lines[frame];
    }
    CHECK(different == 0);
    CHECK(changed == clip.lines.size());  // else nothing was solved
}

using FindLimbs = Limbs (*)(const PlainMotion&);
Limbs arms(const PlainMotion& motion) { return arms_of(motion); }
Limbs legs(const PlainMotion& motion) { return legs_of(motion); }
Limbs all(const PlainMotion& motion)
{
    Limbs limbs = arms_of(motion);
    for (const PlainArm& leg : legs_of(motion)) limbs.push_back(leg);
    return limbs;
}

void solve_clip_back(const fs::path& path, std::size_t frame_count, FindLimbs find = arms, const Words& options = {})
{
    const TempFolder folder;
    Words arguments = {"solve", path.string(), "--targets", "clip", "--out", "out.bvh"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_command(folder.path, arguments);
    INFO(path << ": " << outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    REQUIRE(folder.file_count() == 1);

    const PlainMotion clip = plain_motion_of(path), written = plain_motion_of(folder / "out.bvh");
    REQUIRE(clip.lines.size() == frame_count);
    REQUIRE(written.lines.size() == frame_count);
    const Limbs limbs = find(clip);
    const Verdict worst = judge(clip, written, limbs);
    INFO("shares of what is allowed: wrist " << worst.end << ", hand " << worst.hand << ", bent elbow " << worst.bent
                                             << ", straight elbow " << worst.straight << ", turns " << worst.turn);
    for (const double share : {worst.end, worst.hand, worst.bent, worst.straight, worst.turn}) CHECK(share <= 1);
    require_same_rest(clip, written, limbs);
}

void solve_if_present(const std::string& name, std::size_t frame_count, FindLimbs find = arms,
                      const Words& options = {})
{
    const fs::path path = find_data(name);
    if (path.empty())
        WARN("skipped: this machine has no " << name);
    else
        solve_clip_back(path, frame_count, find, options);
}

}  // namespace

TEST_CASE("clip back: the jump") { solve_clip_back(must_find_jump(), 2752); }
TEST_CASE("clip back: the walk, with CRLF") { solve_if_present("cmu_02_01_walk.bvh", 343); }

TEST_CASE("clip back: the jump's legs") { solve_clip_back(must_find_jump(), 2752, legs, {"--limbs", "legs"}); }
TEST_CASE("clip back: the walk's legs, named")
{
    solve_if_present("cmu_02_01_walk.bvh", 343, legs,
                     {"--leg", "RightUpLeg,RightLeg,RightFoot", "--leg", "LeftUpLeg,LeftLeg,LeftFoot"});
}
TEST_CASE("clip back: the dance, all limbs") { solve_if_present("cmu_05_06_dance.bvh", 885, all, {"--limbs", "all"}); }

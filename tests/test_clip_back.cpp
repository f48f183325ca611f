// SPDX-License-Identifier: MIT
//
// A test on real motion, from end to end. Wrists and hands of a clip go in as targets, and so do ankles and feet. The
// clip must come back, with the roll of every joint. plain_motion.h alone poses both files.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double kBent = 5 * std::numbers::pi / 180;
using Limbs = std::vector<PlainArm>;  // those that were solved

double angle_of(const Matrix3d& turn)
{
    const Vector3d axis(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
    return std::atan2(axis.norm(), turn.trace() - 1);
}

// How far a straight arm's elbow (bent by less than 5 degrees) may be off, in the file's unit.
//
// The elbow lies at height h over the line from shoulder to wrist, its foot at a from the shoulder and b from the
// wrist, d = a + b. From h^2 = upper^2 - a^2 and a = (d^2 + upper^2 - fore^2) / 2d follows da/dd = b/d, so |dh^2/dd| =
// 2ab/d <= 2 upper fore / d. The solver knows d to e. So it knows h^2 to D = 2 upper fore e / d, h to min(sqrt(D),
// D/h), and a to e.
//   e: wrist and shoulder are floats relative to the root, each off by 2^-24 of its distance from it (together up
//   to 3.5 arm lengths: 2.1e-7), bone lengths by 6e-8, d by two roundings: 4e-7 of the arm's length.
// The direction in which h points is that of the pose that comes in, known to about 3e-7 of the arm's length. The
// shoulder's rotation is rounded, too. 1e-6 of the arm's length covers both.
double elbow_allowed(const PlainArm& arm, const PlainArmPose& clip)
{
    const Vector3d line = clip.wrist - clip.shoulder;
    const double d = line.norm(), e = 4e-7 * arm.length();
    const double h = (clip.elbow - clip.shoulder).cross(line).norm() / d;
    const double h2_error = 2 * arm.upper * arm.fore * e / d;
    const double rounding = e + 1e-6 * arm.length();
    return std::min(std::sqrt(h2_error), h2_error / h) + rounding;
}

// How far a joint of a limb may be turned from the clip, in radians. Distances that are floats know the bend b to about
// 4e-7 L^2 / (L1 L2 sin b): swivel.h has this bound for goals that are the pose's own.
double turn_allowed(const PlainArm& arm, const PlainArmPose& clip)
{
    return 2e-6 + 4e-7 * arm.length() * arm.length() / (arm.upper * arm.fore * std::sin(clip.bend()));
}

// A joint's rotation relative to its parent.
Matrix3d local_turn(const PlainMotion& motion, std::size_t frame, int joint)
{
    const std::vector<PlainPose> pose = pose_of(motion, frame);
    const auto at = [&](int n) -> const Matrix3d& { return pose[static_cast<std::size_t>(n)].rotation; };
    return at(motion.joint(joint).parent).transpose() * at(joint);
}

// Measured on the three clips: wrist 4.8e-7 and bent elbow 2.4e-6 of the arm's length, hand 6e-7 rad, straight elbow
// 0.19 of what elbow_allowed() allows.

// The worst of all frames and arms. Each figure is a share of what is allowed: 1 or less passes.
struct Verdict {
    double wrist = 0, hand = 0, elbow_bent = 0, elbow_straight = 0, turn = 0;
    std::size_t arms = 0, straight = 0;
};

Verdict judge(const PlainMotion& clip, const PlainMotion& written, const Limbs& limbs)
{
    const auto keep = [](double& most, double error) { most = error <= most ? most : error; };  // NaN stays
    Verdict v;
    for (const PlainArm& arm : limbs)
        for (std::size_t frame = 0; frame < clip.lines.size(); ++frame) {
            const PlainArmPose from = arm_pose(clip, arm, frame), to = arm_pose(written, arm, frame);
            const double allowed = 1e-5 * arm.length(), elbow = (to.elbow - from.elbow).norm();
            const bool bent = from.bend() > kBent;
            keep(v.wrist, (to.wrist - from.wrist).norm() / allowed);
            keep(v.hand, angle_of(from.hand.transpose() * to.hand) / 1e-4);
            if (bent)
                keep(v.elbow_bent, elbow / allowed);
            else
                keep(v.elbow_straight, elbow / elbow_allowed(arm, from));
            for (const int joint : {arm.shoulder, arm.elbow, arm.wrist})
                keep(v.turn, angle_of(local_turn(clip, frame, joint).transpose() * local_turn(written, frame, joint)) /
                                 turn_allowed(arm, from));
            v.arms += 1;
            v.straight += !bent;
        }
    return v;
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

// A line with its words at the solved channels taken out: blanks, line end and all other words.
std::string rest_of(const std::string& line, const std::vector<std::size_t>& channels)
{
    std::string rest;
    std::size_t word = 0;
    for (std::size_t at = 0; at < line.size();) {
        const bool is_blank = std::isspace(static_cast<unsigned char>(line[at])) != 0;
        std::size_t end = at;
        while (end < line.size() && (std::isspace(static_cast<unsigned char>(line[end])) != 0) == is_blank) ++end;
        const bool is_solved = !is_blank && std::find(channels.begin(), channels.end(), word) != channels.end();
        rest += is_solved ? "*" : line.substr(at, end - at);
        word += !is_blank;
        at = end;
    }
    return rest;
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
    const Verdict v = judge(clip, written, limbs);
    INFO("shares of what is allowed: wrist " << v.wrist << ", hand " << v.hand << ", bent elbow " << v.elbow_bent
                                             << ", straight elbow " << v.elbow_straight << ", turns " << v.turn << " ("
                                             << v.straight << " of " << v.arms << " arms)");
    CHECK(v.wrist <= 1);
    CHECK(v.hand <= 1);
    CHECK(v.elbow_bent <= 1);
    CHECK(v.elbow_straight <= 1);
    CHECK(v.turn <= 1);
    CHECK(v.arms == limbs.size() * frame_count);
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

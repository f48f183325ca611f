// SPDX-License-Identifier: MIT
//
// Recorded motion on other figures and back. plain_motion.h and plain_gltf.h alone pose what is written.
#include <catch2/catch.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/feet_motion.h"
#include "tests/plain_gltf.h"
#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tests/shared_figures.h"

using namespace swivel::test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

double turn_between(const Matrix3d& a, const Matrix3d& b)
{
    const Matrix3d turn = a.transpose() * b;
    const Vector3d axis(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
    return std::atan2(axis.norm(), turn.trace() - 1);
}

// Each joint's rotation against the joint above it. CMU's LHipJoint and RHipJoint are passed over where they are left
// out: a figure whose thighs hang on its pelvis cannot bring back their turns.
std::vector<Matrix3d> local_turns(const PlainMotion& motion, std::size_t frame, bool with_hip_joints = true)
{
    const std::vector<PlainPose> pose = pose_of(motion, frame);
    std::vector<Matrix3d> turns;
    for (std::size_t n = 0; n < pose.size(); ++n) {
        int parent = motion.joints[n].parent;
        if (!with_hip_joints && parent >= 0 && motion.joint(parent).name.ends_with("HipJoint"))
            parent = motion.joint(parent).parent;
        const Matrix3d above =
            parent < 0 ? Matrix3d(Matrix3d::Identity()) : pose[static_cast<std::size_t>(parent)].rotation;
        turns.push_back(above.transpose() * pose[n].rotation);
    }
    return turns;
}

std::string retargeted(const TempFolder& folder, const fs::path& source, const fs::path& target, const char* out)
{
    const Outcome outcome = run_command(folder.path, {"retarget", source.string(), target.string(), "--out", out});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return outcome.out;
}

// The most keys that a channel of the first animation has: in these figures all others have keys at some of the same.
std::vector<double> key_times(const PlainGltf& gltf)
{
    std::vector<double> most;
    for (const auto& sampler : gltf.json["animations"][0]["samplers"])
        if (const auto& times = plain_numbers(gltf, sampler["input"]); times.size() > most.size()) most = times;
    return most;
}

}  // namespace

TEST_CASE("retarget: a motion on its own figure is the same motion")
{
    const TempFolder folder;
    for (const char* name : kSharedClips) {
        const fs::path path = find_or_warn(name);
        if (path.empty()) continue;
        INFO(name);
        retargeted(folder, path, path, "same.bvh");
        const PlainMotion before = plain_motion_of(path), after = plain_motion_of(folder / "same.bvh");
        REQUIRE(after.lines.size() == before.lines.size());
        const auto hierarchy = [](const PlainMotion& of) { return of.header.substr(0, of.header.find("MOTION")); };
        CHECK(hierarchy(after) == hierarchy(before));
        double turn = 0, place = 0;
        for (std::size_t frame = 0; frame < before.lines.size(); ++frame) {
            const auto from = local_turns(before, frame), to = local_turns(after, frame);
            for (std::size_t n = 0; n < from.size(); ++n) turn = std::max(turn, turn_between(from[n], to[n]));
            place = std::max(place, (pose_of(before, frame)[0].position - pose_of(after, frame)[0].position).norm());
        }
        CHECK(turn < 1e-5);
        CHECK(place < 1e-5);
    }
    for (const char* name : {"m2m_human_ymca.glb", "m2m_human_skeleton_tpose.glb"}) {
        const fs::path path = find_or_warn(name);
        if (path.empty()) continue;
        INFO(name);
        retargeted(folder, path, path, "same.glb");
        const PlainGltf before = plain_gltf_of(path), after = plain_gltf_of(folder / "same.glb");
        const std::vector<double> times = key_times(before), new_times = key_times(after);
        REQUIRE(new_times.size() == times.size());
        double turn = 0;
        for (std::size_t n = 0; n < times.size(); ++n)
            for (std::size_t node = 0; node < before.nodes().size(); ++node)
                turn = std::max(turn,
                                turn_between(plain_local(before, 0, static_cast<int>(node), times[n]).rotation(),
                                             plain_local(after, 0, static_cast<int>(node), new_times[n]).rotation()));
        CHECK(turn < 1e-5);
    }
}

TEST_CASE("retarget: a walk goes to a figure and comes back, and its feet slide no more than before")
{
    const fs::path walk = find_or_warn("cmu_02_01_walk.bvh"), figure = find_or_warn("m2m_human_male.glb");
    if (walk.empty() || figure.empty()) return;
    const TempFolder folder;
    retargeted(folder, walk, figure, "figure.glb");
    retargeted(folder, folder / "figure.glb", walk, "walk.bvh");
    const PlainMotion before = plain_motion_of(walk), after = plain_motion_of(folder / "walk.bvh");
    REQUIRE(after.lines.size() == before.lines.size());
    double sum = 0, most = 0;
    std::size_t count = 0;
    for (std::size_t frame = 0; frame < before.lines.size(); ++frame) {
        const auto from = local_turns(before, frame, false), to = local_turns(after, frame, false);
        for (const std::string side : {"Left", "Right"})
            for (const char* joint : {"Arm", "ForeArm", "Hand", "UpLeg", "Leg", "Foot"}) {
                const auto n = static_cast<std::size_t>(joint_named(before, side + joint));
                const double turn_deg = kDegrees * turn_between(from[n], to[n]);
                sum += turn_deg;
                most = std::max(most, turn_deg);
                ++count;
            }
    }
    CHECK(sum / static_cast<double>(count) < 3);
    CHECK(most < 10);
    const PlainLegs source = legs_path(before, 1.0 / 120), back = legs_path(after, 1.0 / 120);
    const PlainGltf figures = plain_gltf_of(folder / "figure.glb");
    const PlainLegs there =
        legs_path(figures, {"pelvis", "thigh_*", "calf_*", "foot_*", "ball_*"}, {"l", "r"}, key_times(figures));
    const PlainContacts contacts = plain_contacts(source, 0.5, 1.0 / 15);
    const auto in_legs = [&](const PlainLegs& legs) {
        const PlainSkating skating = plain_skating(legs, contacts);
        return std::array{skating.mean / legs.leg_length(0), skating.sink / legs.leg_length(0)};
    };
    const auto was = in_legs(source);
    REQUIRE(was[0] > 0.05);
    for (const PlainLegs& legs : {there, back}) {
        CHECK(in_legs(legs)[0] < 1.001 * was[0]);
        CHECK(in_legs(legs)[1] < 1.001 * was[1]);
    }
}

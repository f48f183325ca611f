// SPDX-License-Identifier: MIT
//
// A motion on another skeleton. Bodies are made up, so that what must come out is known without the code: the same body
// in another rest, of another size, in another world, or with other bones. Recorded motion goes to other figures and
// back. plain_motion.h and plain_gltf.h alone pose what is written. What is refused is in
// tests/transcripts/retarget.txt.
#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/feet_motion.h"
#include "tests/gltf_rig.h"
#include "tests/made_body.h"
#include "tests/plain_gltf.h"
#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Any pose that its legs can stand in: knees are bent by 30 to 60 degrees.
std::vector<std::vector<double>> random_rows(const MadeBody& body, int count, double min_elbow = 20,
                                             double max_elbow = 70)
{
    std::mt19937 random(4);
    const auto between = [&](double min, double max) { return std::uniform_real_distribution(min, max)(random); };
    const PlainMotion motion = plain_motion(body.text());
    std::vector<std::vector<double>> rows;
    for (int n = 0; n < count; ++n) {
        std::vector<double>& row = rows.emplace_back(body.rest_row());
        for (const PlainJoint& joint : motion.joints)
            for (std::size_t c = 0; c < joint.channels.size(); ++c) {
                double& value = row[joint.first_channel + c];
                if (joint.channels[c].ends_with("position"))
                    value = between(0, 2);
                else if (joint.name.ends_with("Leg") && !joint.name.ends_with("UpLeg"))
                    value = joint.channels[c] == "Xrotation" ? between(30, 60) : 0;
                else if (joint.name.ends_with("ForeArm"))
                    value = joint.channels[c] == "Yrotation"
                                ? between(min_elbow, max_elbow) * (joint.name[0] == 'L' ? -1 : 1)
                                : 0;
                else
                    value = between(-20, 20);
            }
    }
    return rows;
}

Outcome retarget(const TempFolder& folder, const Words& words, const Words& more = {})
{
    Words all = {"retarget"};
    all.insert(all.end(), words.begin(), words.end());
    all.insert(all.end(), more.begin(), more.end());
    return run_command(folder.path, all);
}

struct Made {
    TempFolder folder{};
    PlainMotion source{}, out{};
    std::string report{};

    Made(const std::string& from, const std::string& to, const Words& options = {})
    {
        spill(folder / "source.bvh", from);
        spill(folder / "target.bvh", to);
        const Outcome outcome = done(retarget(folder, {"source.bvh", "target.bvh", "--out", "out.bvh"}, options));
        report = outcome.out;
        source = plain_motion_of(folder / "source.bvh");
        out = plain_motion_of(folder / "out.bvh");
        REQUIRE(out.lines.size() == source.lines.size());
    }
    // How far the joint is at most from `expected` of the source's pose.
    double off(const std::string& joint, const auto& expected) const
    {
        double max = 0;
        for (std::size_t frame = 0; frame < out.lines.size(); ++frame)
            max = std::max(max, (at(out, joint, frame).position - expected(frame)).norm());
        return max;
    }
    static PlainPose at(const PlainMotion& motion, const std::string& joint, std::size_t frame)
    {
        return pose_of(motion, frame)[static_cast<std::size_t>(joint_named(motion, joint))];
    }
};

Vector3d in_middle(const PlainMotion& motion, const std::string& joint, std::size_t frame)
{
    return (Made::at(motion, "Left" + joint, frame).position + Made::at(motion, "Right" + joint, frame).position) / 2;
}

}  // namespace

TEST_CASE("retarget: the same body in another rest, size and world takes every place and direction of the source")
{
    const MadeBody source;
    MadeBody target;
    target.size = 40;
    target.arms_down_deg = 50;
    target.legs_out_deg = 15;
    target.toes_out_deg = 20;
    target.world << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // z is up, x ahead, y left
    const Made made(source.text(random_rows(source, 50)), target.text());
    for (const PlainJoint& joint : made.out.joints) {
        INFO(joint.name);
        CHECK(made.off(joint.name, [&](std::size_t frame) {
            return Vector3d(40 * (target.world * Made::at(made.source, joint.name, frame).position));
        }) < 40 * 1e-6);
    }
    CHECK_THAT(made.out.header, Contains("Frame Time: 0.02"));
    CHECK_THAT(made.report, Contains("lengths   40 of TARGET for 1 of SOURCE, by the legs\n"));
    CHECK_THAT(made.report, Contains("at rest   of TARGET: none\nunused    of SOURCE: none\n"));
}

TEST_CASE(
    "retarget: on other bones toes go where the source's are, bent arms reach from the chest, straight ones alike")
{
    const MadeBody source;
    MadeBody target;
    target.forearm = 0.32;
    target.shin = 0.36;
    target.foot = 0.17;
    const double by_leg = (0.45 + 0.36) / (0.45 + 0.42), by_arm = (0.3 + 0.32) / (0.3 + 0.26);
    for (const bool is_bent : {true, false}) {
        INFO(is_bent);
        const auto rows = is_bent ? random_rows(source, 50, 95, 120) : random_rows(source, 50, 10, 35);
        const Made made(source.text(rows), target.text());
        for (const std::string side : {"Left", "Right"}) {
            INFO(side);
            CHECK(made.off(side + "ToeBase", [&](std::size_t frame) {
                return Vector3d(by_leg * Made::at(made.source, side + "ToeBase", frame).position);
            }) < 3e-6);
            CHECK(made.off(side + "Hand", [&](std::size_t frame) {
                const auto from = [&](const PlainMotion& motion) -> Vector3d {
                    return is_bent ? in_middle(motion, "Arm", frame) : Made::at(motion, side + "Arm", frame).position;
                };
                return Vector3d(from(made.out) +
                                by_arm * (Made::at(made.source, side + "Hand", frame).position - from(made.source)));
            }) < 3e-6);
            double turn = 0;
            for (std::size_t frame = 0; frame < 50; ++frame)  // hands keep the source's orientation
                turn = std::max(turn, (Made::at(made.out, side + "Hand", frame).rotation -
                                       Made::at(made.source, side + "Hand", frame).rotation)
                                          .norm());
            CHECK(turn < 1e-5);
        }
    }
}

TEST_CASE("retarget: knees bend as the source's, whatever its bones")
{
    const MadeBody source;
    MadeBody target;
    target.shin = 0.15;  // at the source's places its knees would bend by up to 16 degrees more
    target.foot = 0.19;
    const PlainMotion motion = plain_motion(source.text());
    std::vector<std::vector<double>> rows;
    for (const double knee : {0.0, 5.0, 20.0, 45.0, 80.0}) {
        std::vector<double>& row = rows.emplace_back(source.rest_row());
        for (const std::string side : {"Left", "Right"}) {
            row[motion.joint(joint_named(motion, side + "UpLeg")).first_channel + 1] = -knee / 2;
            row[motion.joint(joint_named(motion, side + "Leg")).first_channel + 1] = knee;
            row[motion.joint(joint_named(motion, side + "Foot")).first_channel + 1] = -knee / 2;
        }
    }
    const Made made(source.text(rows), target.text());
    const PlainArm leg = legs_of(made.source)[0], other = legs_of(made.out)[0];
    for (std::size_t frame = 0; frame < rows.size(); ++frame)
        CHECK(std::abs(arm_pose(made.source, leg, frame).bend() - arm_pose(made.out, other, frame).bend()) < 3 * kRad);
}

TEST_CASE("retarget: spines of other counts divide the turns of the source's evenly")
{
    for (const int count : {1, 2, 3, 6}) {
        INFO(count);
        MadeBody source, target;
        target.spine = count;
        const PlainMotion rest = plain_motion(source.text());
        std::vector<double> row = source.rest_row();
        const double turns[] = {10, -30, 25};
        for (int n = 0; n < 3; ++n) {
            const PlainJoint& joint = rest.joint(joint_named(rest, fmt::format("Spine{}", n + 1)));
            row[joint.first_channel + 1] = turns[n];  // about x
        }
        const Made made(source.text({row}), target.text());
        for (int n = 1; n <= count; ++n) {
            const double place = 3.0 * n / count;  // of the three turns
            double turn = 0;
            for (int k = 0; k < 3; ++k) turn += turns[k] * std::clamp(place - k, 0.0, 1.0);
            CHECK((Made::at(made.out, fmt::format("Spine{}", n), 0).rotation - about(Vector3d::UnitX(), turn)).norm() <
                  1e-6);
        }
    }
}

TEST_CASE("retarget: feet that rest near height 0 stand there again, however the source counts heights")
{
    MadeBody source, target;
    target.size = 0.5;
    target.spine = 3;
    std::string text = target.text();
    const double toe = 0.5 * (0.05 + 0.45 + 0.42 + 0.06);                           // below the hips
    text = edited(text, "OFFSET 0 0 0", fmt::format("OFFSET 0 {} 0", toe + 0.01));  // toes 0.01 over the ground
    std::vector<double> row = source.rest_row();
    row[1] = 7;  // the source's ground is anywhere
    const Made made(source.text({row, row}), text);
    CHECK(std::abs(Made::at(made.out, "LeftToeBase", 1).position.y() - 0.01) < 1e-6);
}

TEST_CASE("retarget: the animation of a glTF target tells its ground")
{
    const MadeBody body;
    const PlainMotion rest = plain_motion(body.text());
    GltfRig rig;
    for (const PlainJoint& joint : rest.joints) rig.add(joint.name, joint.parent, joint.offset);
    const double toe = 0.05 + 0.45 + 0.42 + 0.06;  // below the hips
    const auto y = static_cast<float>(toe + 0.2);  // so the ground is at 0.2
    rig.add_keys(rig.add_animation("Stand"), 0, "translation", {0, 1}, {0, y, 0, 0, y, 0});
    std::vector<double> row = body.rest_row();
    row[1] = 7;  // the source's ground is elsewhere
    const TempFolder folder;
    rig.write(folder / "target.glb");
    spill(folder / "source.bvh", body.text({row, row}));
    done(retarget(folder, {"source.bvh", "target.glb", "--out", "out.glb"}));
    const PlainGltf out = plain_gltf_of(folder / "out.glb");
    CHECK(std::abs(plain_world(out, 0, out.node_named("LeftToeBase"), 0).translation().y() - 0.2) < 1e-5);
}

TEST_CASE("retarget: the table of pairs says who follows whom, and who follows nobody rests")
{
    MadeBody source, target;
    source.spine = 2;
    const Made found(source.text(random_rows(source, 5)), target.text(), {"--export-map", "map.csv"});
    const std::string map = slurp(found.folder / "map.csv");
    CHECK_THAT(map, Contains("part,source,target\nhips,Hips,Hips\nspine,Spine1,Spine1\nspine,Spine2,Spine2\n"
                             "spine,,Spine3\n"));
    spill(found.folder / "headless.csv", edited(map, "head,Head,Head\n", ""));
    const Words words = {"source.bvh", "target.bvh", "--map", "headless.csv", "--out", "headless.bvh"};
    REQUIRE(retarget(found.folder, words).exit_code == 0);
    const PlainMotion headless = plain_motion_of(found.folder / "headless.bvh");
    for (std::size_t n = 0; n < 3; ++n)
        CHECK(headless.values[4][headless.joint(joint_named(headless, "Head")).first_channel + n] == 0);
}

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

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
    return done(run_command(folder.path, {"retarget", source.string(), target.string(), "--out", out})).out;
}

// The most keys that a channel of the first animation has: in these figures all others have keys at some of the same.
std::vector<double> key_times(const PlainGltf& gltf)
{
    std::vector<double> max;
    for (const auto& sampler : gltf.json["animations"][0]["samplers"])
        if (const auto& times = plain_numbers(gltf, sampler["input"]); times.size() > max.size()) max = times;
    return max;
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
        const auto hierarchy = [](const PlainMotion& motion) {
            return motion.header.substr(0, motion.header.find("MOTION"));
        };
        CHECK(hierarchy(after) == hierarchy(before));
        double turn = 0, place = 0;
        for (std::size_t frame = 0; frame < before.lines.size(); ++frame) {
            const auto turns = local_turns(before, frame), turns_after = local_turns(after, frame);
            for (std::size_t n = 0; n < turns.size(); ++n)
                turn = std::max(turn, turn_between(turns[n], turns_after[n]));
            place = std::max(place, (pose_of(before, frame)[0].position - pose_of(after, frame)[0].position).norm());
        }
        CHECK(turn < 1e-5);
        CHECK(place < 1e-5);
    }
    for (const char* name : {"m2m_human_ymca.glb", "m2m_human_skeleton_tpose.glb"})
        for (const char* out : {"same.glb", "same.gltf"}) {
            const fs::path path = find_or_warn(name);
            if (path.empty()) continue;
            INFO(name << " to " << out);
            retargeted(folder, path, path, out);
            const PlainGltf before = plain_gltf_of(path), after = plain_gltf_of(folder / out);
            for (const char* list : {"meshes", "skins", "materials", "scenes"})
                CHECK(after.json.value(list, nlohmann::json()) == before.json.value(list, nlohmann::json()));
            CHECK(new_gltf_messages(path, folder / out) == std::multiset<std::string>());
            const std::vector<double> times = key_times(before), new_times = key_times(after);
            REQUIRE(new_times.size() == times.size());
            double turn = 0, place = 0, size = 0;
            for (std::size_t n = 0; n < times.size(); ++n)
                for (int node = 0; node < static_cast<int>(before.nodes().size()); ++node) {
                    turn = std::max(turn, turn_between(plain_local(before, 0, node, times[n]).rotation(),
                                                       plain_local(after, 0, node, new_times[n]).rotation()));
                    const Eigen::Affine3d was = plain_world(before, 0, node, times[n]),
                                          is = plain_world(after, 0, node, new_times[n]);
                    place = std::max(place, (was.matrix() - is.matrix()).norm());
                    size = std::max(size, was.matrix().norm());
                }
            CHECK(turn < 1e-5);
            CHECK(place < 1e-5 * size);
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
    double sum = 0, max = 0;
    std::size_t count = 0;
    for (std::size_t frame = 0; frame < before.lines.size(); ++frame) {
        const auto turns = local_turns(before, frame, false), turns_after = local_turns(after, frame, false);
        for (const std::string side : {"Left", "Right"})
            for (const char* joint : {"Arm", "ForeArm", "Hand", "UpLeg", "Leg", "Foot"}) {
                const auto n = static_cast<std::size_t>(joint_named(before, side + joint));
                const double turn_deg = kDegrees * turn_between(turns[n], turns_after[n]);
                sum += turn_deg;
                max = std::max(max, turn_deg);
                ++count;
            }
    }
    CHECK(sum / static_cast<double>(count) < 3);
    CHECK(max < 10);
    const PlainLegs source = legs_path(before, 1.0 / 120), back = legs_path(after, 1.0 / 120);
    const PlainGltf figures = plain_gltf_of(folder / "figure.glb");
    const PlainLegs there =
        legs_path(figures, {"pelvis", "thigh_*", "calf_*", "foot_*", "ball_*"}, {"l", "r"}, key_times(figures));
    const PlainContacts contacts = plain_contacts(source, 0.5, 1.0 / 15);
    const auto in_legs = [&](const PlainLegs& legs) {
        const PlainSkating skating = plain_skating(legs, contacts);
        return std::array{skating.mean / legs.leg_length(0), skating.sink / legs.leg_length(0)};
    };
    const auto recorded = in_legs(source);
    REQUIRE(recorded[0] > 0.05);
    for (const PlainLegs& legs : {there, back}) {
        CHECK(in_legs(legs)[0] < 1.001 * recorded[0]);
        CHECK(in_legs(legs)[1] < 1.001 * recorded[1]);
    }
}

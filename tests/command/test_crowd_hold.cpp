// SPDX-License-Identifier: MIT
//
// The promise of limb.*.hold: a hand stays on the one that it holds where the clip has it, wherever that one is sent or
// kept. Checked in the files that are written, by the tests' own forward kinematics.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/crowd_stage.h"

using namespace swivel::test;

namespace {

constexpr double kUnit = 8.4;  // an arm's length, about

// One hand on another: its place and rotation there.
struct Grip {
    Vector3d place;
    Matrix3d rotation;
};
Grip grip_in(const PlainMotion& motion, std::size_t frame, const char* hand, const char* held)
{
    const PlainPose is = joint_in(motion, frame, hand), on = joint_in(motion, frame, held);
    return {on.rotation.transpose() * (is.position - on.position), on.rotation.transpose() * is.rotation};
}
// The most by which a hand's place and rotation on another differ from the clip's.
double slip(const CrowdStage& stage, const PlainMotion& motion, const char* hand, const char* held)
{
    double most = 0;
    for (std::size_t frame = 0; frame < motion.lines.size(); ++frame) {
        const Grip was = grip_in(stage.clip, frame, hand, held), is = grip_in(motion, frame, hand, held);
        most = std::max({most, (is.place - was.place).norm() / kUnit, (is.rotation - was.rotation).norm()});
    }
    return most;
}
// How far a hand goes from where the clip has it.
double moved(const CrowdStage& stage, const PlainMotion& motion, const char* hand)
{
    double most = 0;
    for (std::size_t frame = 0; frame < motion.lines.size(); ++frame) {
        const PlainPose was = joint_in(stage.clip, frame, hand), is = joint_in(motion, frame, hand);
        most = std::max(most, (is.position - was.position).norm());
    }
    return most;
}

}  // namespace

TEST_CASE("a hand follows the one that it holds, left or right, to its target")
{
    const CrowdStage stage{100, 10};
    for (const bool is_left : {true, false}) {
        const char *hand = is_left ? "LeftHand" : "RightHand", *held = is_left ? "RightHand" : "LeftHand";
        const std::string holds = is_left ? "[limb.left_arm]\nhold = \"right_arm\"\n[limb.right_arm.target]\n"
                                          : "[limb.right_arm]\nhold = \"left_arm\"\n[limb.left_arm.target]\n";
        INFO(hand);
        const PlainMotion still = stage.motion(holds + "offset = [0, 0, 0]\n");
        CHECK(slip(stage, still, hand, held) < 1e-5);
        CHECK(moved(stage, still, hand) < 1e-4);
        const PlainMotion up = stage.motion(holds + "offset = [0.2, 1.5, 0.3]\n");
        CHECK(moved(stage, up, held) > 1.5);
        CHECK(slip(stage, up, hand, held) < 1e-5);
    }
}

TEST_CASE("a hand follows where limits keep the one that it holds, by its effector, too")
{
    const CrowdStage stage{100, 10};
    const std::string limited =
        "[limb.left_arm]\nhold = \"right_arm\"\n[limb.right_arm.limits]\nflexion_deg = [25, 40]\n";
    const PlainMotion motion = stage.motion(limited);
    CHECK(moved(stage, motion, "RightHand") > 0.2);
    CHECK(slip(stage, motion, "LeftHand", "RightHand") < 1e-5);
    // The point of the hand that holds, and so the wrist, stays.
    const PlainMotion touching = stage.motion(limited + "[limb.left]\neffector = [0.5, 0, 0]\n");
    CHECK(slip(stage, touching, "LeftHand", "RightHand") < 1e-5);
}

TEST_CASE("a hand that holds has no target of its own")
{
    const CrowdStage stage{100, 10};
    const std::string toml =
        "[crowd]\nlimbs = \"all\"\n[limb.left_arm]\nhold = \"right_arm\"\n[limb.right_arm.target]\noffset = [0, 1, "
        "1]\n";
    for (const Words& more : {Words{"--export-targets", "t.csv"}, Words{"--targets", "t.csv"}})
        stage.output(toml, "out.csv", more);
    const std::string targets = slurp(stage.folder / "t.csv");
    CHECK(targets.find("left_arm") == std::string::npos);
    CHECK(targets.find("right_arm") != std::string::npos);
    const nlohmann::json arms = stage.json(toml).at("arms_bound");
    CHECK(arms.back().at("side") == "left");
    CHECK(arms.back().at("holds") == "right_arm");
    CHECK_FALSE(arms.front().contains("holds"));
}

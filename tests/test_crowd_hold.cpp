// SPDX-License-Identifier: MIT
//
// The promise of limb.*.hold: a hand stays on the one that it holds where the clip has it, wherever that one is sent or
// kept. Checked in the files that are written, by the tests' own forward kinematics.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/cache_stage.h"
#include "tests/crowd_stage.h"

using namespace swivel::test;
using Catch::Matchers::Contains;

namespace {

constexpr double kUnit = 8.4;  // an arm's length, about

// One hand on another: its place and rotation there.
struct Grip {
    Vector3d place;
    Matrix3d rotation;
};
Grip grip_in(const PlainMotion& motion, std::size_t frame, const char* hand, const char* held)
{
    const std::vector<PlainPose> pose = pose_of(motion, frame);
    const auto at = [&](const char* name) { return pose[static_cast<std::size_t>(joint_named(motion, name))]; };
    const PlainPose is = at(hand), on = at(held);
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
        const auto at = [&](const PlainMotion& of) {
            return pose_of(of, frame)[static_cast<std::size_t>(joint_named(of, hand))].position;
        };
        most = std::max(most, (at(motion) - at(stage.clip)).norm());
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

TEST_CASE("a hand that holds has no target of its own, and a cache has its bits")
{
    const CrowdStage stage{100, 10};
    const std::string toml =
        "[crowd]\nlimbs = \"all\"\n[limb.left_arm]\nhold = \"right_arm\"\n[limb.right_arm.target]\noffset = [0, 1, "
        "1]\n";
    spill(stage.folder / "c.toml", toml);
    for (const Words& words :
         {Words{"solve", "clip.bvh", "--crowd", "c.toml", "--characters", "20", "--out", "s.csv", "--export-targets",
                "t.csv"},
          Words{"store", "clip.bvh", "cache", "--crowd", "c.toml", "--characters", "20", "--chunk", "3,16"},
          Words{"fill", "cache"}, Words{"check", "cache"}, Words{"replay", "cache", "--out", "r.csv"},
          Words{"solve", "clip.bvh", "--crowd", "c.toml", "--characters", "20", "--targets", "t.csv", "--out",
                "again.csv"}})
        require_done(run_command(stage.folder.path, words));
    CHECK(sorted_lines(stage.folder / "r.csv") == sorted_lines(stage.folder / "s.csv"));
    const std::string targets = slurp(stage.folder / "t.csv");
    CHECK(targets.find("left_arm") == std::string::npos);
    CHECK(targets.find("right_arm") != std::string::npos);
    const nlohmann::json arms = stage.json(toml).at("arms_bound");
    CHECK(arms.back().at("side") == "left");
    CHECK(arms.back().at("holds") == "right_arm");
    CHECK_FALSE(arms.front().contains("holds"));
    spill(stage.folder / "mine.csv", "frame,character,limb,x,y,z\n0,0,left_arm,1,2,3\n");
    const Outcome mine =
        run_command(stage.folder.path, {"solve", "clip.bvh", "--crowd", "c.toml", "--targets", "mine.csv"});
    CHECK(mine.exit_code == 1);
    CHECK_THAT(mine.err, Contains("mine.csv:2: the left arm holds the right arm, so its target means nothing"));
}

TEST_CASE("what cannot be held is refused in a line")
{
    const CrowdStage stage{100, 10};
    const std::string hold = "[limb.left_arm]\nhold = \"right_arm\"\n";
    stage.require_refused("[limb.left_arm]\nhold = \"left_arm\"\n",
                          "c.toml:2: limb.left_arm.hold: is this limb itself");
    stage.require_refused("[limb.left_arm]\nhold = \"left_leg\"\n",
                          "c.toml:2: limb.left_arm.hold: the left leg is not solved; see crowd.limbs");
    stage.require_refused("[limb.left_arm]\nhold = \"hand\"\n", "c.toml:2: limb.left_arm.hold: ");
    stage.require_refused("[limb.arms]\nhold = \"left_arm\"\n",
                          "c.toml:2: limb.arms.hold: is of one limb; write it in that one's table");
    stage.require_refused(hold + "[limb.right_arm]\nhold = \"left_arm\"\n",
                          "the right arm holds something itself, by line 4");
    stage.require_refused(hold + "[limb.right_arm]\nhand = false\n", "the right arm goes without a hand, by line 4");
    stage.require_refused(hold + "[carry]\n", "hands that carry a box, by line 3, hold nothing else");
    stage.require_refused(hold + "hand = false\n",
                          "limb.left_arm.hold: means nothing beside limb.left_arm.hand = false");
    stage.require_refused(hold + "target.offset = [1, 0, 0]\n",
                          "limb.left_arm.target.offset: means nothing beside limb.left_arm.hold in line 2");
    stage.require_refused("[crowd]\nlimbs = \"all\"\n[ground]\n[limb.left_leg]\nhold = \"right_leg\"\n",
                          "limb.left_leg.hold: keeps a leg from standing on the ground of line 3");
}

// SPDX-License-Identifier: MIT
//
// The promises of limb.*.hold and of a crowd file's [carry]: a hand stays on the one that it holds where the clip has
// it, wherever that one is sent or kept; those who carry a box have both wrists beside it; all else stays as it is.
// Checked in the files that are written, by the tests' own forward kinematics.
#include <catch2/catch.hpp>

#include <algorithm>

#include "tests/crowd_stage.h"
#include "tools/crowd/carry_plan.h"
#include "tools/formats/bvh.h"

using namespace swivel::test;
using namespace swivel;
using namespace swivel::tools;

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

namespace {

const std::string kAll = "[carry]\nshare = 1\n";
const std::string kNoHands = "[limb.left_arm]\nhand = false\n[limb.right_arm]\nhand = false\n";
const std::string kCrowd = "[crowd]\ncharacters = 300\nlimbs = \"all\"\n";

// Of one frame: the wrists from the middle of the shoulders, to the left, up and ahead as the chest has it. At rest its
// joint has the world's axes.
struct Held {
    Vector3d left, right;
};
Held held_in(const PlainMotion& motion, std::size_t frame, const Vector3d& face)
{
    Matrix3d axes;
    axes << Vector3d::UnitY().cross(face), Vector3d::UnitY(), face;
    const auto offset = [&](const char* name) { return motion.joint(joint_named(motion, name)).offset; };
    const PlainPose chest = joint_in(motion, frame, "Spine1");
    const Vector3d shoulders =
        0.5 * (offset("LeftShoulder") + offset("LeftArm") + offset("RightShoulder") + offset("RightArm"));
    const auto from_shoulders = [&](const char* name) {
        const Vector3d from_chest =
            chest.rotation.transpose() * (joint_in(motion, frame, name).position - chest.position);
        return Vector3d(axes.transpose() * (from_chest - shoulders));
    };
    return {from_shoulders("LeftHand"), from_shoulders("RightHand")};
}

std::size_t carrier_count(const nlohmann::json& crowd)
{
    return static_cast<std::size_t>(
        std::ranges::count_if(crowd.at("each_character"), [](const auto& each) { return each.at("carries") == true; }));
}

}  // namespace

TEST_CASE("both wrists go along with a box on the chest, and nothing else moves")
{
    const CrowdStage stage;
    const PlainMotion motion = stage.motion(kAll + "size = [6, 4, 5]\nplace = [1, -5, 7]\n");
    const Vector3d face = stage.face();
    const Held first = held_in(motion, 0, face);
    const Vector3d palm = first.left - Vector3d(1 + 3, -5, 7), middle = 0.5 * (first.left + first.right);
    CHECK((palm - Vector3d(palm.x(), 0, palm.z())).norm() < 1e-3);  // beside the box, and behind its middle
    CHECK(palm.x() > 0);
    CHECK(palm.z() < 0);
    CHECK((middle - Vector3d(1, -5, 7 + palm.z())).norm() < 1e-3);
    for (std::size_t frame = 0; frame < motion.lines.size(); ++frame) {
        const Held held = held_in(motion, frame, face);
        CHECK((held.left - first.left).norm() < 1e-3);
        CHECK((held.right - first.right).norm() < 1e-3);
        for (const char* name : {"Head", "LeftArm", "RightArm", "LeftFoot", "RightToeBase"}) {
            const PlainPose was = joint_in(stage.clip, frame, name), is = joint_in(motion, frame, name);
            CHECK((is.position - was.position).norm() < 1e-3);
        }
    }
}

TEST_CASE("a share of a crowd carries boxes, by the seed, and who has none moves as in a crowd without them")
{
    const CrowdStage stage;
    const Words few{"--frames", "3"};
    const nlohmann::json some = stage.json(kCrowd + "[carry]\nshare = 0.3\n", few),
                         without = stage.json(kCrowd + kNoHands, few);
    const std::size_t count = carrier_count(some);
    CHECK(count > 60);
    CHECK(count < 120);
    CHECK(carrier_count(stage.json(kCrowd + kAll, few)) == 300);
    CHECK(carrier_count(stage.json(kCrowd + "[carry]\nshare = 0\n", few)) == 0);
    const auto carriers = [&](const Words& more) {
        Words words = few;
        words.insert(words.end(), more.begin(), more.end());
        return stage.json(kCrowd + "[carry]\nshare = 0.3\n", words).at("each_character");
    };
    CHECK(carriers({"--seed", "2"}) != some.at("each_character"));
    for (std::size_t n = 0; n < 300; ++n) {
        nlohmann::json each = some.at("each_character").at(n);
        each.erase("carries");
        CHECK(each == without.at("each_character").at(n));
    }
    for (const std::string& more : {std::string(), std::string("[ground]\n")})
        for (const char* limb : {"left_arm", "right_leg"}) {
            const auto boxes = stage.rows(kCrowd + "[carry]\nshare = 0.3\n" + more, limb, "", few),
                       none = stage.rows(kCrowd + kNoHands + more, limb, "", few);
            REQUIRE(boxes.size() == none.size());
            std::size_t moved = 0;
            for (std::size_t n = 0; n < boxes.size(); ++n) {
                const bool carries = some.at("each_character").at(boxes[n].character).at("carries");
                const auto same = [&](std::size_t joint) {
                    return boxes[n].joint[joint].coeffs() == none[n].joint[joint].coeffs();
                };
                const bool is_same = same(0) && same(1) && same(2);
                if (!carries || limb[0] == 'r') CHECK(is_same);
                moved += !is_same;
            }
            CHECK(moved == (limb[0] == 'l' ? 3 * count : 0));
        }
}

TEST_CASE("in a mirror each wrist is at the side of its own arm")
{
    const CrowdStage stage;
    formats::Clip clip = formats::read_bvh(stage.folder / "clip.bvh").clip;
    for (const double mirror : {1.0, -1.0}) {
        clip.joints[0].rest_scale.x() = mirror;
        const LimbChoice choice;
        const LimbSearch search = bind_limbs(clip, choose_joints(clip, "clip.bvh", choice), choice);
        const std::vector<Limb> arms = require_limbs(search, "clip.bvh");
        const std::vector<formats::JointPose> pose = rest_pose(clip);
        REQUIRE(why_not_carry(clip, arms).empty());
        const CarryPlan plan =
            plan_carry(clip, arms, {1, Vector3d(8, 4, 4), Vector3d(0, -5, 7), 1}, Vector3d::UnitY(), stage.face());
        for (const Limb& arm : arms) {
            const auto away = [&](const Limb& from) {
                return (carrying_wrist(plan, arm.name, pose) - pose[static_cast<std::size_t>(from.upper())].position)
                    .norm();
            };
            CHECK(away(arm) < away(&arm == &arms[0] ? arms[1] : arms[0]));
        }
    }
}

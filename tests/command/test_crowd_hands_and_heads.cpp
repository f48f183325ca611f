// SPDX-License-Identifier: MIT
//
// The promises of limb.*.hold and of a crowd file's [carry] and [look]: a hand stays on the one that it holds where the
// clip has it, wherever that one is sent or kept; those who carry a box have both wrists beside it; faces point at the
// target, as far as each joint may turn; all else stays as it is. Checked in the files that are written, by the tests'
// own forward kinematics.
#include <algorithm>
#include <array>
#include <bit>
#include <catch2/catch.hpp>

#include "tests/crowd_stage.h"
#include "tools/cache/cache.h"
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
    double max = 0;
    for (std::size_t frame = 0; frame < motion.lines.size(); ++frame) {
        const Grip was = grip_in(stage.clip, frame, hand, held), is = grip_in(motion, frame, hand, held);
        max = std::max({max, (is.place - was.place).norm() / kUnit, (is.rotation - was.rotation).norm()});
    }
    return max;
}
// How far a hand goes from where the clip has it.
double moved(const CrowdStage& stage, const PlainMotion& motion, const char* hand)
{
    double max = 0;
    for (std::size_t frame = 0; frame < motion.lines.size(); ++frame) {
        const PlainPose was = joint_in(stage.clip, frame, hand), is = joint_in(motion, frame, hand);
        max = std::max(max, (is.position - was.position).norm());
    }
    return max;
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
        const CarryPlan plan = plan_carry(clip, arms, {0, 1, {{Vector3d(8, 4, 4)}}, {{Vector3d(0, -5, 7)}}}, 1,
                                          Vector3d::UnitY(), stage.face());
        for (const Limb& arm : arms) {
            const auto away = [&](const Limb& from) {
                return (carrying_wrist(plan, arm.name, pose) - pose[static_cast<std::size_t>(from.upper())].position)
                    .norm();
            };
            CHECK(away(arm) < away(&arm == &arms[0] ? arms[1] : arms[0]));
        }
    }
}

namespace {

// Those frames before the figure walks past the target.
const Words kFew{"--frames", "30"};
constexpr std::size_t kCount = 30;

constexpr std::array kLooking{"Neck", "Neck1", "Head"};

std::string look_at(const Vector3d& target, const std::string& more = "")
{
    return "[look]\ntarget = " + text_of(target) + "\n" + more;
}

// By how many degrees the face misses the target.
double missed_by(const PlainMotion& motion, std::size_t frame, const Vector3d& face, const Vector3d& target)
{
    const PlainPose head = joint_in(motion, frame, "Head");
    return angle_between(head.rotation * face, target - head.position);
}
// How far each looking joint is turned from the clip, and the most of all others, in degrees.
struct Turned {
    std::array<double, 3> looking{};
    double others = 0;
};
Turned turned(const PlainMotion& clip, const PlainMotion& motion, std::size_t frame)
{
    Turned turned;
    for (const PlainJoint& joint : clip.joints) {
        const double by =
            kDegrees * turn_between(local_rotation(clip, frame, joint.name), local_rotation(motion, frame, joint.name));
        const auto at = std::ranges::find(kLooking, joint.name);
        if (at != kLooking.end())
            turned.looking[static_cast<std::size_t>(at - kLooking.begin())] = by;
        else
            turned.others = std::max(turned.others, by);
    }
    return turned;
}
// In front of the head, and as far to the side and up as forwards.
Vector3d aside(const PlainMotion& clip, double far)
{
    const PlainPose head = joint_in(clip, 0, "Head");
    return head.position + far * (head.rotation * Vector3d(1, 0.3, 1));
}

// The local rotation of a look's joint as the cache has it, of the only character.
Quaterniond looking(const tools::Cache& cache, std::uint32_t frame, std::size_t joint)
{
    const tools::CachedCrowd& crowd = cache.crowd();
    const char* const names[] = {"shoulder", "elbow", "wrist"};
    const auto& fields = cache.arrays().fields;
    const auto field = std::ranges::find(fields, std::string(names[joint]), &tools::ResultField::name) - fields.begin();
    const tools::Results results = cache.results({frame / crowd.chunk.frames, 0}).value();
    const std::size_t at = 4 * crowd.place(frame % crowd.chunk.frames, crowd.limbs.size(), 0);
    const auto number = [&](std::size_t n) {
        return double{std::bit_cast<float>(results[static_cast<std::size_t>(field)][at + n])};
    };
    return Quaterniond(number(3), number(0), number(1), number(2));
}

}  // namespace

TEST_CASE("heads look at a point, by necks and head alone")
{
    const CrowdStage stage{100, 2};
    const Vector3d target = aside(stage.clip, 60), face = stage.face();
    const PlainMotion motion = stage.motion(look_at(target), kFew);
    REQUIRE(motion.lines.size() == kCount);
    double clips_own = 0;
    for (std::size_t frame = 0; frame < kCount; ++frame) {
        INFO("frame " << frame);
        CHECK(missed_by(motion, frame, face, target) < 0.01);
        clips_own = std::max(clips_own, missed_by(stage.clip, frame, face, target));
        const Turned by = turned(stage.clip, motion, frame);
        CHECK(by.others < 0.01);  // arms are solved, to the clip's own wrists
        CHECK(std::ranges::max(by.looking) < 45);
    }
    CHECK(clips_own > 30);
    const nlohmann::json looks = stage.json(look_at(target), kFew).at("looks");
    CHECK(looks == nlohmann::json{{"count", motion.lines.size()},
                                  {"met", motion.lines.size()},
                                  {"limited", 0},
                                  {"faded", 0},
                                  {"on_their_way", 0}});
}

TEST_CASE("no joint of a look turns further than it may, and behind a head there is nothing to see")
{
    const CrowdStage stage{100, 2};
    const std::string narrow = look_at(aside(stage.clip, 60), "max_deg = 5\n");
    const PlainMotion limited = stage.motion(narrow, kFew);
    for (std::size_t frame = 0; frame < kCount; ++frame)
        for (const double by : turned(stage.clip, limited, frame).looking) CHECK(by == Approx(5).margin(0.01));
    CHECK(stage.json(narrow, kFew).at("looks").at("limited") == kCount);
    const Vector3d head = aside(stage.clip, 0), behind = 2 * head - aside(stage.clip, 60);
    const std::string away = look_at({behind.x(), head.y(), behind.z()});
    CHECK(stage.json(away, kFew).at("looks").at("faded") == kCount);
}

TEST_CASE("each of a crowd looks from where it is, whatever its size")
{
    const CrowdStage stage{100, 2};
    const PlainPose head = joint_in(stage.clip, 0, "Head");
    const Vector3d face = head.rotation * stage.face(), target = head.position + Vector3d(150, -5, 170);
    const std::string toml = "[crowd]\ncharacters = 100\nstagger = false\nsize = [0.5, 2]\n";
    const nlohmann::json all = stage.json(toml + look_at(target, "max_deg = 180\n"), {"--frames", "1"});
    std::size_t ahead = 0;
    for (const nlohmann::json& each : all.at("each_character")) {
        const nlohmann::json& place = each.at("place");
        const Vector3d from =
            Vector3d(place.at(0), place.at(1), place.at(2)) + each.at("size").get<double>() * head.position;
        ahead += face.dot((target - from).normalized()) > -0.1;  // from there on it fades
    }
    CHECK(ahead > 20);
    CHECK(ahead < 80);
    CHECK(all.at("looks") ==
          nlohmann::json{{"count", 100}, {"met", ahead}, {"limited", 0}, {"faded", 100 - ahead}, {"on_their_way", 0}});
}

TEST_CASE("heads look in a clip that goes on and on, on ground, and where no arm is solved")
{
    const CrowdStage stage{100, 2};
    const Vector3d target = aside(stage.clip, 60), face = stage.face();
    for (const std::string& toml : {std::string("[crowd]\nlimbs = \"legs\"\n"),
                                    std::string("[crowd]\nlimbs = \"legs\"\nloop = [0, 100]\n[ground]\n")}) {
        INFO(toml);
        const PlainMotion motion = stage.motion(toml + look_at(target), kFew);
        for (std::size_t frame = 0; frame < kCount; ++frame) CHECK(missed_by(motion, frame, face, target) < 0.01);
    }
    // Of a file that is written back, all but the rows of the frames stays.
    const PlainMotion whole = stage.motion(look_at(target));
    CHECK(whole.header == stage.clip.header);
    CHECK(whole.lines.size() == stage.clip.lines.size());
}

TEST_CASE("a cache has the poses of heads that solve writes")
{
    const CrowdStage stage{100, 2};
    const std::string toml = look_at(aside(stage.clip, 60));
    const PlainMotion motion = stage.motion(toml, kFew);
    for (const Words& words :
         {Words{"store", "clip.bvh", "cache", "--crowd", "c.toml", "--frames", "30"}, Words{"fill", "cache"}})
        done(run_command(stage.folder.path, words));
    const tools::Cache cache(stage.folder / "cache");
    for (std::uint32_t frame = 0; frame < kCount; ++frame)
        for (std::size_t n = 0; n < kLooking.size(); ++n) {
            const Quaterniond written(local_rotation(motion, frame, kLooking[n]));
            CHECK(kDegrees * looking(cache, frame, n).angularDistance(written) < 1e-3);
        }
}

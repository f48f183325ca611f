// SPDX-License-Identifier: MIT
//
// The promise of a crowd file's [look]: faces point at the target, as far as each joint may turn, and all else stays as
// it is. Checked in the files that are written, by the tests' own forward kinematics.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>

#include "tests/crowd_stage.h"

using namespace swivel::test;
using Catch::Matchers::Contains;

namespace {

// Those frames before the figure walks past the target.
const Words kFew{"--frames", "30"};
constexpr std::size_t kCount = 30;

constexpr std::array kLooking{"Neck", "Neck1", "Head"};

std::string look_at(const Vector3d& target, const std::string& more = "")
{
    return "[look]\ntarget = " + text_of(target) + "\n" + more;
}

// A joint's rotation against the one above it.
Matrix3d local(const PlainMotion& motion, const std::vector<PlainPose>& pose, int joint)
{
    const int above = motion.joint(joint).parent;
    const Matrix3d& turn = pose[static_cast<std::size_t>(joint)].rotation;
    return above < 0 ? turn : Matrix3d(pose[static_cast<std::size_t>(above)].rotation.transpose() * turn);
}
double turn_between(const Matrix3d& a, const Matrix3d& b)
{
    return kDegrees * Eigen::AngleAxisd(a.transpose() * b).angle();
}

// By how many degrees the face misses the target.
double missed_by(const PlainMotion& motion, std::size_t frame, const Vector3d& face, const Vector3d& target)
{
    const PlainPose head = pose_of(motion, frame)[static_cast<std::size_t>(joint_named(motion, "Head"))];
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
    const std::vector<PlainPose> was = pose_of(clip, frame), is = pose_of(motion, frame);
    for (int joint = 0; joint < static_cast<int>(clip.joints.size()); ++joint) {
        const double by = turn_between(local(clip, was, joint), local(motion, is, joint));
        const auto at = std::ranges::find(kLooking, clip.joint(joint).name);
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
    const PlainPose head = pose_of(clip, 0)[static_cast<std::size_t>(joint_named(clip, "Head"))];
    return head.position + far * (head.rotation * Vector3d(1, 0.3, 1));
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
    const std::string narrow = look_at(aside(stage.clip, 60), "most_deg = 5\n");
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
    const PlainPose head = pose_of(stage.clip, 0)[static_cast<std::size_t>(joint_named(stage.clip, "Head"))];
    const Vector3d face = head.rotation * stage.face(), target = head.position + Vector3d(150, -5, 170);
    const std::string toml = "[crowd]\ncharacters = 100\nstagger = false\nsize = [0.5, 2]\n";
    const nlohmann::json all = stage.json(toml + look_at(target, "most_deg = 180\n"), {"--frames", "1"});
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

TEST_CASE("a head that its name does not tell is named, and is then as any")
{
    const CrowdStage stage{100, 2};
    const Vector3d target = aside(stage.clip, 60);
    const PlainMotion known = stage.motion(look_at(target), kFew);
    spill(stage.folder / "clip.bvh", edited(slurp(stage.folder / "clip.bvh"), "JOINT Head", "JOINT Kopf"));
    CHECK_THAT(run_command(stage.folder.path, {"rig", "clip.bvh"}).out, Contains("head: missing: no joint above"));
    stage.require_refused(look_at(target),
                          "c.toml:1: look: no head of the clip is known that can turn; name one by "
                          "look.head, or take this out");
    CHECK(stage.motion(look_at(target, "head = \"Kopf\"\n"), kFew).lines == known.lines);
    stage.require_refused(look_at(target, "head = \"Head\"\n"), "c.toml:3: look.head: no joint is called 'Head'");
    stage.require_refused(look_at(target, "head = \"LeftArm\"\n"),
                          "c.toml:3: look.head: 'LeftArm' is the figure's leftUpperArm");
}

TEST_CASE("looks that cannot be are refused with file, line and key")
{
    const CrowdStage stage;
    stage.require_refused("[look]\nmost_deg = 20\n",
                          "c.toml:1: look.target: is missing; write what heads look at: [x, y, z]");
    stage.require_refused(look_at({1, 2, 3}, "most_deg = 181\n"), "c.toml:3: look.most_deg: ");
    stage.require_refused(look_at({1, 2, 3}, "joints = 2\n"), "c.toml:3: look.joints: ");
    stage.require_refused(look_at({1, 2, 3}) + "[budget]\nblocks = 1\n",
                          "c.toml:1: look: heads that look are solved in every frame; take this or [budget] out");
    spill(stage.folder / "arms.bvh", kTwoArms);
    spill(stage.folder / "c.toml", look_at({1, 2, 3}));
    const Outcome headless = run_command(stage.folder.path, {"solve", "arms.bvh", "--crowd", "c.toml"});
    CHECK(headless.exit_code == 1);
    CHECK_THAT(headless.err, Contains("c.toml:1: look: no head of the clip is known that can turn"));
}

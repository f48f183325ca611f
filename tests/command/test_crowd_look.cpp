// SPDX-License-Identifier: MIT
//
// The promise of a crowd file's [look]: faces point at the target, as far as each joint may turn, and all else stays as
// it is. Checked in the files that are written, by the tests' own forward kinematics.
#include <algorithm>
#include <array>
#include <bit>
#include <catch2/catch.hpp>

#include "tests/crowd_stage.h"
#include "tools/cache/cache.h"

using namespace swivel;
using namespace swivel::test;

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
    const PlainPose head = joint_in(stage.clip, 0, "Head");
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

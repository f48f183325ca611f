// SPDX-License-Identifier: MIT
//
// The promise: a cache keeps heads that look and boxes in hands, with the bits of solve, whoever fills it in whatever
// order. Heads are checked in a file that solve writes, by the tests' own reader.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>

#include "tests/cache_stage.h"
#include "tests/crowd_stage.h"

using namespace swivel;
using namespace swivel::test;

namespace {

// All stand in one place at first, and walk past what they look at.
std::string whole(const Vector3d& target)
{
    return "[crowd]\nlimbs = \"all\"\nspacing = 0\n[look]\ntarget = " + text_of(target) +
           "\nmost_deg = 50\n[carry]\nshare = 0.5\n";
}
constexpr std::uint32_t kFrames = 21, kChunk = 8;

struct WholeStage : CrowdStage {
    // first: of the clip's frames. aside: how far from the way of the head they look.
    WholeStage(std::size_t first, double aside) : CrowdStage{first, 2}
    {
        const auto head = [&](std::size_t frame) {
            return pose_of(clip, frame)[static_cast<std::size_t>(joint_named(clip, "Head"))].position;
        };
        const Vector3d ahead = head(kFrames) - head(0);
        spill(folder / "c.toml", whole(head(kFrames / 2) + aside * Vector3d(ahead.z(), 0, -ahead.x()).normalized()));
    }

    Words with_crowd(Words words, const char* characters) const
    {
        const Words more{"--crowd", "c.toml", "--characters", characters, "--frames", std::to_string(kFrames)};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    void do_all(const std::vector<Words>& commands) const
    {
        for (const Words& words : commands) require_done(run_command(folder.path, words));
    }
};

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

TEST_CASE("a cache has the poses of heads that solve writes")
{
    const WholeStage stage(100, 30);
    stage.do_all({stage.with_crowd({"store", "clip.bvh", "cache", "--chunk", "8,16"}, "1"),
                  {"fill", "cache"},
                  stage.with_crowd({"solve", "clip.bvh", "--out", "r.bvh"}, "1")});
    const PlainMotion motion = plain_motion_of(stage.folder / "r.bvh");
    const tools::Cache cache(stage.folder / "cache");
    const char* const joints[] = {"Neck", "Neck1", "Head"};
    double most = 0;
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
        const std::vector<PlainPose> pose = pose_of(motion, frame), own = pose_of(stage.clip, frame);
        for (std::size_t n = 0; n < std::size(joints); ++n) {
            const int joint = joint_named(motion, joints[n]), above = motion.joint(joint).parent;
            const auto local = [&](const std::vector<PlainPose>& of) {
                return Quaterniond(of[static_cast<std::size_t>(above)].rotation.transpose() *
                                   of[static_cast<std::size_t>(joint)].rotation);
            };
            const Quaterniond cached = looking(cache, frame, n);
            CHECK(kDegrees * cached.angularDistance(local(pose)) < 1e-3);
            most = std::max(most, kDegrees * cached.angularDistance(local(own)));
        }
    }
    CHECK(most > 5);
}

TEST_CASE("shards, a part of a cache and all of it have the bits of solve, with heads and boxes")
{
    const WholeStage stage(760, 2);  // a jump so near that the line of sight does not keep up
    stage.do_all({stage.with_crowd({"store", "clip.bvh", "cache", "--chunk", "8,16"}, "40"),
                  {"fill", "cache", "--shard", "2/2"},
                  {"fill", "cache", "--shard", "1/2"}});
    // A line of sight goes on from chunk to chunk: without its state the later ones would differ.
    const std::string digest = "cache/digest/" + std::to_string((kFrames - 1) / kChunk) + ".1";
    const std::string before = slurp(stage.folder / digest);
    fs::remove(stage.folder / digest);
    stage.do_all({{"fill", "cache"}});
    CHECK(slurp(stage.folder / digest) == before);
    stage.do_all({{"check", "cache"},
                  {"replay", "cache", "--out", "replayed.csv"},
                  stage.with_crowd({"solve", "clip.bvh", "--out", "solved.csv"}, "40")});
    CHECK(sorted_lines(stage.folder / "replayed.csv") == sorted_lines(stage.folder / "solved.csv"));
}

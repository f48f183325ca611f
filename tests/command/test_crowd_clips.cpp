// SPDX-License-Identifier: MIT
//
// The promise: characters of a crowd perform several clips of one skeleton, each as a crowd of that clip alone would.
#include <catch2/catch.hpp>

#include "tests/crowd_stage.h"
#include "tools/crowd/clip_parts.h"
#include "tools/formats/bvh.h"

using namespace swivel;
using namespace swivel::test;
using Catch::Matchers::Contains;

namespace {

const std::string kCrowd = "[crowd]\ncharacters = 12\nsize = [1, 1]\nlimbs = \"legs\"\n",
                  kClips = "clips = [{ file = \"other.bvh\" }]\n";

struct TwoClips {
    const CrowdStage first{0, 30}, second{900, 20};
    std::size_t first_count = first.clip.lines.size(), second_count = second.clip.lines.size();

    TwoClips() { spill(first.folder / "other.bvh", slurp(second.folder / "clip.bvh")); }
};

}  // namespace

TEST_CASE("crowd file: clips, of which each character performs one")
{
    const TwoClips stage;
    const std::vector<PoseLine> both = stage.first.rows(kCrowd + kClips, "left_leg");
    const std::string one = "[crowd]\nlimbs = \"legs\"\n";
    const std::vector<PoseLine> first = stage.first.rows(one, "left_leg"), second = stage.second.rows(one, "left_leg");
    REQUIRE(both.size() == 12 * stage.first_count);
    REQUIRE(stage.first_count != stage.second_count);
    int performers[2] = {0, 0};
    for (std::size_t n = 0; n < both.size(); ++n) {
        const PoseLine& is = both[n];
        const std::size_t frame = n / 12, start = static_cast<std::size_t>(is.number("start"));
        const bool is_second = start >= stage.first_count;
        if (frame == 0) ++performers[is_second];
        const PoseLine& alone = is_second ? second[(frame + start - stage.first_count) % stage.second_count]
                                          : first[(frame + start) % stage.first_count];
        // Twice what a joint may differ from the clip's, by the knee's bend.
        const double bend = alone.joint[1].angularDistance(Quaterniond::Identity());
        const double most = 2 * (2e-6 + 4 * 4e-7 / std::sin(bend));
        for (std::size_t j = 0; j < 3; ++j) REQUIRE(is.joint[j].angularDistance(alone.joint[j]) < most);
    }
    CHECK(both[0].number("start") == 0);
    CHECK(performers[0] > 1);
    CHECK(performers[1] > 1);
    const nlohmann::json json = stage.first.json(kCrowd + kClips);
    const nlohmann::json& performed = json.at("performed");
    CHECK_THAT(performed.at(1).at("motion").get<std::string>(), Contains("other.bvh: BVH"));
    CHECK(performed.at(1).at("first") == stage.first_count);
    CHECK(performed.at(1).at("frames") == stage.second_count);
}

TEST_CASE("several clips begin where the first one does, and go on in loops of their own")
{
    const TwoClips stage;
    const formats::Clip clips[] = {formats::read_bvh(stage.first.folder / "clip.bvh").clip,
                                   formats::read_bvh(stage.second.folder / "clip.bvh").clip};
    const formats::Clip both = tools::joined(clips, 0);
    REQUIRE(both.frame_count == clips[0].frame_count + clips[1].frame_count);
    const auto root = [](const formats::Clip& clip, std::size_t frame) {
        return formats::world_pose(clip, frame)[0].position;
    };
    const Eigen::Vector3d way = root(both, clips[0].frame_count) - root(clips[1], 0);
    CHECK((root(both, clips[0].frame_count) - root(both, 0)).cwiseProduct(Vector3d(1, 0, 1)).norm() < 1e-12);
    CHECK((root(both, both.frame_count - 1) - root(clips[1], clips[1].frame_count - 1) - way).norm() < 1e-12);
    // On one floor, below which the lowest joint is in a quarter of all frames: by the tests' own kinematics.
    const auto floor = [](const PlainMotion& motion) {
        std::vector<double> lows;
        for (std::size_t frame = 0; frame < motion.lines.size(); ++frame) {
            double low = std::numeric_limits<double>::infinity();
            for (const PlainPose& joint : pose_of(motion, frame)) low = std::min(low, joint.position.y());
            lows.push_back(low);
        }
        std::ranges::sort(lows);
        return lows[(lows.size() - 1) / 4];
    };
    CHECK(way.y() == Approx(floor(stage.first.clip) - floor(stage.second.clip)).margin(1e-9));
    REQUIRE(std::fabs(way.y()) > 1e-3);

    const Outcome outcome = stage.first.run(kCrowd + kClips + "loop = \"auto\"\n", {"--frames", "300"});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, Contains("300 frames") && Contains("of the clip 1, ") && Contains("of the clip 2, "));
    // A clip's first frames, where fewer are asked for.
    const nlohmann::json json = stage.first.json(kCrowd + kClips, {"--frames", "5"});
    for (const auto& each : json.at("performed")) CHECK(each.at("frames") == 5);
}

// SPDX-License-Identifier: MIT
//
// The promise: characters of a crowd perform several clips of one skeleton, each as a crowd of that clip alone would. A
// clip that loops goes on without a jump, and whoever walks walks on from where they were. The two frames are found, or
// named. Places are those of Eigen's matrices, of the clip alone.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>

#include "tests/crowd_stage.h"
#include "tests/test_data.h"
#include "tools/crowd/clip_loop.h"
#include "tools/crowd/clip_parts.h"
#include "tools/formats/bvh.h"

using namespace swivel;
using namespace swivel::test;
using Catch::Matchers::Contains;
using formats::Clip;
using tools::ClipLoop;

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
        const double max = 2 * (2e-6 + 4 * 4e-7 / std::sin(bend));
        for (std::size_t j = 0; j < 3; ++j) REQUIRE(is.joint[j].angularDistance(alone.joint[j]) < max);
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
    CHECK(way.y() == Approx(floor_of(stage.first.clip) - floor_of(stage.second.clip)).margin(1e-9));
    REQUIRE(std::fabs(way.y()) > 1e-3);

    const Outcome outcome = done(stage.first.run(kCrowd + kClips + "loop = \"auto\"\n", {"--frames", "300"}));
    CHECK_THAT(outcome.out, Contains("300 frames") && Contains("of the clip 1, ") && Contains("of the clip 2, "));
    // A clip's first frames, where fewer are asked for.
    const nlohmann::json json = stage.first.json(kCrowd + kClips, {"--frames", "5"});
    for (const auto& each : json.at("performed")) CHECK(each.at("frames") == 5);
}

namespace {

// The most that any joint moves between two frames that follow each other, from one frame to another.
double largest_step(const Clip& clip, std::size_t from, std::size_t to)
{
    double max = 0;
    std::vector<Eigen::Isometry3d> last = joints_of(clip, from);
    for (std::size_t frame = from + 1; frame <= to; ++frame) {
        const std::vector<Eigen::Isometry3d> now = joints_of(clip, frame);
        for (std::size_t n = 0; n < now.size(); ++n)
            max = std::max(max, (now[n].translation() - last[n].translation()).norm());
        last = now;
    }
    return max;
}

// A root, and two joints that are turned so far about x, in radians.
Clip nodding_clip(std::size_t frame_count, double frame_time, const auto& angles_of)
{
    Clip clip;
    clip.joints.resize(3);
    clip.joints[1].parent = clip.joints[2].parent = 0;
    clip.frame_time = frame_time, clip.frame_count = frame_count;
    for (std::size_t frame = 0; frame < frame_count; ++frame) {
        const std::array<double, 2> angles = angles_of(static_cast<double>(frame) * frame_time);
        clip.rotation.push_back(Quaterniond::Identity());
        for (const double angle : angles)
            clip.rotation.push_back(Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitX())));
    }
    return clip;
}

// The gap of two frames, of a clip of which the root alone never turns.
double plain_gap(const Clip& clip, std::size_t a, std::size_t b)
{
    const std::size_t joints = clip.joints.size();
    const auto motion = [&](std::size_t frame, std::size_t n) {
        const std::size_t before = std::max<std::size_t>(frame, 1) - 1,
                          after = std::min(frame + 1, clip.frame_count - 1);
        const Eigen::AngleAxisd turn(clip.rotation[after * joints + n] *
                                     clip.rotation[before * joints + n].conjugate());
        return Vector3d(turn.angle() / (static_cast<double>(after - before) * clip.frame_time) / 30 * turn.axis());
    };
    double sum2 = 0;
    for (std::size_t n = 0; n < joints; ++n) {
        const double sine = std::sin(clip.rotation[a * joints + n].angularDistance(clip.rotation[b * joints + n]) / 2);
        sum2 += 4 * sine * sine + (motion(a, n) - motion(b, n)).squaredNorm();
    }
    return std::sqrt(sum2 / static_cast<double>(joints - 1));
}

}  // namespace

TEST_CASE("the loop of a walk is one step of both legs, and no joint jumps where recorded clips go on")
{
    for (const std::string name : kSharedClips) {
        const fs::path path = find_or_warn(name);
        if (path.empty()) continue;
        const Clip clip = formats::read_bvh(path).clip;
        const ClipLoop loop = tools::find_loop(clip, 0).loop;
        const std::size_t length = loop.length(), count = 3 * length + 1;
        const Clip on = tools::looped(clip, 0, loop, count);
        INFO(name << ", frames " << loop.first << " to " << loop.last);
        REQUIRE(on.frame_count == count);
        if (name == "cmu_02_01_walk.bvh") {
            CHECK(std::abs(static_cast<int>(loop.first) - 136) <= 2);
            CHECK(std::abs(static_cast<int>(loop.last) - 268) <= 2);
        }
        CHECK(static_cast<double>(length) * clip.frame_time >= tools::kLongEnough - 1e-6);
        if (name == "cmu_05_06_dance.bvh") {  // it stands from frame 760 on, and once did so in a loop
            CHECK(static_cast<double>(length) * clip.frame_time > 2);
            CHECK(loop.last < 760);
        }
        CHECK(largest_step(on, 0, count - 1) <= 1.2 * largest_step(clip, loop.first, loop.last));
        // Where the second round begins, it is as in the last frame, and then as in the first round, some way on.
        const auto seam = joints_of(on, length), last = joints_of(clip, loop.last);
        for (std::size_t n = 0; n < seam.size(); ++n) REQUIRE((seam[n].matrix() - last[n].matrix()).norm() < 1e-6);
        const auto middle = length / 2 + length % 2;
        REQUIRE(static_cast<double>(middle) * clip.frame_time >= tools::kSeam);
        const auto first = joints_of(on, middle), second = joints_of(on, length + middle),
                   third = joints_of(on, 2 * length + middle);
        const Eigen::Isometry3d way = second[0] * first[0].inverse();
        CHECK(std::fabs(way.translation().y()) < 1e-6);
        CHECK((way.rotation() * Vector3d::UnitY() - Vector3d::UnitY()).norm() < 1e-6);
        for (std::size_t n = 0; n < first.size(); ++n) {
            REQUIRE((second[n].matrix() - (way * first[n]).matrix()).norm() < 1e-6);
            REQUIRE((third[n].matrix() - (way * second[n]).matrix()).norm() < 1e-6);
        }
    }
}

TEST_CASE("a clip that turns on the spot and about its height loops as it does")
{
    // A root that goes round a circle, and a joint that nods every second, at 50 frames a second.
    Clip clip;
    clip.joints.resize(2);
    clip.joints[0].track = 0, clip.track_count = 1;
    clip.joints[1].parent = 0, clip.joints[1].offset = Vector3d(0, 1, 0);
    clip.frame_time = 0.02, clip.frame_count = 120;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const double t = 0.02 * static_cast<double>(frame);
        const Eigen::AngleAxisd turn(0.7 * t, Vector3d::UnitY());
        clip.translation.push_back(turn * Vector3d(3, 1, 0));
        clip.rotation.push_back(Quaterniond(turn));
        clip.rotation.push_back(
            Quaterniond(Eigen::AngleAxisd(0.5 * std::sin(2 * std::numbers::pi * t), Vector3d::UnitX())));
    }
    const tools::FoundLoop found = tools::find_loop(clip, 0);
    CHECK(found.loop.length() == 50);
    CHECK(found.gap < 1e-3);
    const Clip on = tools::looped(clip, 0, found.loop, 500);
    for (std::size_t frame = 0; frame < on.frame_count; ++frame) {
        const Eigen::AngleAxisd turn(0.7 * 0.02 * static_cast<double>(found.loop.first + frame), Vector3d::UnitY());
        REQUIRE((joints_of(on, frame)[0].translation() - turn * Vector3d(3, 1, 0)).norm() < 1e-9);
    }
    // Too short to loop.
    clip.frame_count = 20;
    clip.translation.resize(20), clip.rotation.resize(40);
    const ClipLoop whole = tools::find_loop(clip, 0).loop;
    CHECK((whole.first == 0 && whole.last == 19));
}

TEST_CASE("a clip that moves has no loop in which it rests, however well it rests")
{
    // It rests, nods a little more each second, and rests again: a minute in all.
    const Clip clip = nodding_clip(3000, 0.02, [](double t) {
        const double moves = t < 28 || t > 34 ? 0.001 : 0.5 + 0.002 * t;
        return std::array{moves * std::sin(2 * std::numbers::pi * t), moves * std::cos(5 * t)};
    });
    const tools::FoundLoop found = tools::find_loop(clip, 0);
    CHECK(found.loop.first >= 1350);
    CHECK(found.loop.last <= 1750);
    CHECK(found.loop.length() >= 50);
    // One that does nothing but breathe has its loop there.
    const Clip breath = nodding_clip(1000, 0.02, [](double t) { return std::array{0.01 * std::sin(t), 0.0}; });
    CHECK(tools::find_loop(breath, 0).loop.length() >= 50);
    // Where all frames are alike, not all pairs of them are looked at.
    const Clip still = nodding_clip(tools::kMaxSearched, 0.02, [](double) { return std::array{0.3, 0.0}; });
    CHECK(tools::find_loop(still, 0).loop.length() == 50);
}

TEST_CASE("a stride of less than a second is a loop where the clip has no two seconds")
{
    const auto run = [](double t) {
        return std::array{std::sin(2 * std::numbers::pi * t / 0.7), std::cos(2 * std::numbers::pi * t / 0.7)};
    };
    CHECK(tools::find_loop(nodding_clip(61, 0.02, run), 0).loop.length() == 35);
    CHECK(tools::find_loop(nodding_clip(201, 0.02, run), 0).loop.length() == 70);  // two of them
}

TEST_CASE("the loop that is found is the best one, as a comparison of all frames has it")
{
    for (const double pitch : {1.37, 0.71, 3.3}) {
        const Clip clip = nodding_clip(700, 1.0 / 60, [pitch](double t) {
            return std::array{0.7 * std::sin(pitch * t) + 0.3 * std::sin(4.1 * t), 0.5 * std::cos(1.9 * t * pitch)};
        });
        double min = 1e9;
        for (std::size_t a = 0; a < clip.frame_count; ++a)
            for (std::size_t b = a + 60; b < clip.frame_count; ++b) min = std::min(min, plain_gap(clip, a, b));
        const tools::FoundLoop found = tools::find_loop(clip, 0);
        CHECK(found.gap == Approx(plain_gap(clip, found.loop.first, found.loop.last)).margin(1e-5));
        CHECK(found.gap <= min + 1e-5);
    }
}

TEST_CASE("crowd file: loop")
{
    const CrowdStage stage(0, 1);
    const std::string crowd = "[crowd]\ncharacters = 6\nsize = [1, 1]\nlimbs = \"legs\"\n";
    const Outcome outcome = done(stage.run(crowd + "loop = \"auto\"\n", {"--frames", "400", "--out", "out.csv"}));
    CHECK_THAT(outcome.out, Contains("400 frames") && Contains("loop     frames "));
    const std::vector<PoseLine> rows = pose_lines(slurp(stage.folder / "out.csv"));
    REQUIRE(rows.size() == 400 * 12);
    const nlohmann::json json = stage.json(crowd + "loop = [40, 90]\n", {"--frames", "200"});
    CHECK(json.at("loop") == nlohmann::json({40, 90}));
    CHECK(json.at("frames") == 200);
    for (const auto& each : json.at("each_character")) CHECK(each.at("start").get<int>() < 50);
    // The first character's frames are the clip's, and a round later they are again, where nothing fades any more.
    const std::vector<PoseLine> looped = stage.rows(crowd + "loop = [40, 90]\n", "left_leg", "", {"--frames", "200"}),
                                plain = stage.rows(crowd, "left_leg");
    for (std::size_t frame = 0; frame < 100; ++frame) {
        if (frame >= 50 && frame < 70) continue;
        const PoseLine &row = looped[6 * frame], &own = plain[6 * (40 + frame % 50)];
        for (std::size_t j = 0; j < 3; ++j) CHECK(row.joint[j].angularDistance(own.joint[j]) < 1e-4);
    }
    // Character n in frame f is the first one in frame f + start.
    for (std::size_t c = 1; c < 6; ++c)
        for (std::size_t frame = 0; frame < 100; frame += 9) {
            const PoseLine& is = looped[6 * frame + c];
            const PoseLine& first = looped[6 * (frame + static_cast<std::size_t>(is.number("start")))];
            for (std::size_t j = 0; j < 3; ++j) CHECK(is.joint[j].angularDistance(first.joint[j]) < 1e-4);
        }
    // A written clip has the frames of the loop, and poses as in the table.
    const PlainMotion written = stage.motion("[crowd]\nloop = [40, 90]\nlimbs = \"legs\"\n", {"--frames", "200"});
    REQUIRE(written.lines.size() == 200);
    const Vector3d first = arm_pose(written, stage.legs[0], 75).shoulder,
                   again = arm_pose(written, stage.legs[0], 125).shoulder,
                   third = arm_pose(written, stage.legs[0], 175).shoulder;
    CHECK((again - first).norm() > 1e-3);
    CHECK((third - again).norm() == Approx((again - first).norm()).margin(1e-4));
    CHECK(first.y() == Approx(third.y()).margin(1e-4));
}

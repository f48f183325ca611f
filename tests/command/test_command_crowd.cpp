// SPDX-License-Identifier: MIT
//
// What `swivel solve` writes for crowds, on real motion: its order and unit length. Memory must not grow with the
// length of a crowd's clip.
#include <catch2/catch.hpp>

#include <cmath>
#include <set>
#include <tuple>

#include "swivel/swivel.h"
#include "tests/crowd_stage.h"

using namespace swivel::test;

TEST_CASE("crowd: the table holds every frame, character and limb in order, and unit quaternions")
{
    const CrowdStage stage;
    const std::vector<PoseLine> rows = pose_lines(stage.output("[crowd]\n", "poses.csv", {"--characters", "50"}));
    const std::size_t frames = stage.clip.lines.size();
    REQUIRE(rows.size() == frames * 50 * 2);
    std::size_t misplaced = 0, unreached = 0;
    double worst_length = 0;
    std::set<std::string> poses_of_frame_0;
    for (std::size_t n = 0; n < rows.size(); ++n) {
        misplaced +=
            rows[n].place() != std::tuple(n / 100, n / 2 % 50, std::string(n % 2 == 0 ? "left_arm" : "right_arm"));
        unreached += (rows[n].flags & SWIVEL_REACHED) == 0;
        misplaced += rows[n].number("size") < 0.85 || rows[n].number("size") > 1.15;
        for (const Quaterniond& q : rows[n].joint) worst_length = std::max(worst_length, std::abs(q.norm() - 1));
        if (n < 100)
            poses_of_frame_0.insert(std::to_string(rows[n].joint[0].x()) + std::to_string(rows[n].joint[1].x()));
    }
    CHECK(misplaced == 0);
    CHECK(unreached == 0);
    CHECK(worst_length < 1e-6);
    CHECK(poses_of_frame_0.size() > 80);  // characters differ

    const std::vector<PoseLine> alone = pose_lines(stage.output("[crowd]\n", "alone.csv"));
    REQUIRE(alone.size() == frames * 2);
    for (std::size_t n = 0; n < alone.size(); ++n)
        for (std::size_t j = 0; j < 3; ++j)
            CHECK(alone[n].joint[j].coeffs() == rows[n / 2 * 100 + n % 2].joint[j].coeffs());  // the same bits
}

TEST_CASE("crowd: memory is bounded by clip and crowd, not by their product")
{
    // Per frame the command keeps its line of text (under 1.5 kB), 32 bytes for each of 31 joints, and the places of
    // two arms. These take 488 bytes, and three times that while a vector grows. The sum is under 4 kB; 8 kB leaves
    // room for the allocator. One frame of poses of 500 characters is 52 kB in memory and 150 kB as text.
    constexpr long kFrameKib = 8, kPosesKib = 500 * 2 * 52 / 1024;
    const TempFolder folder;
    const PlainMotion jump = plain_motion_of(must_find_jump());
    fs::create_symlink("/dev/null", folder / "poses.csv");
    const auto peak = [&](std::size_t repeats) {
        spill(folder / "clip.bvh", cut(jump, 0, 8, repeats));
        // A sanitizer keeps freed memory for a while; here that would hide what is measured.
        const Surroundings lean{{"ASAN_OPTIONS=quarantine_size_mb=1:thread_local_quarantine_size_kb=64"}};
        const Outcome outcome =
            spawn_command(folder.path, {"solve", "clip.bvh", "--characters", "500", "--out", "poses.csv"}, lean);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return outcome.peak_kib;
    };
    const long frames = static_cast<long>(jump.lines.size() + 7) / 8;
    const long once = peak(1), often = peak(4);
    INFO("peak " << once << " KiB for " << frames << " frames, " << often << " KiB for " << 4 * frames);
    REQUIRE(once > 1000);  // the command was seen at work
    const long grown = often - once;
    CHECK(grown < 3 * frames * kFrameKib);
    CHECK(3 * frames * kFrameKib < 3 * frames * kPosesKib / 4);  // else the bound would prove nothing
}

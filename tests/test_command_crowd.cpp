// SPDX-License-Identifier: MIT
//
// What `swivel solve` writes for crowds, on real motion. This checks order, unit length, reproducibility, and the grid
// that characters stand on. Memory must not grow with the length of a crowd's clip.
#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <cmath>
#include <set>
#include <tuple>

#include "swivel/swivel.h"
#include "tests/plain_motion.h"
#include "tests/pose_rows.h"
#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

using Words = std::vector<std::string>;

using Row = PoseLine;
std::vector<Row> rows_of(const std::string& text) { return pose_lines(text); }

// The jump, every step-th frame from `first` on, as clip.bvh in a folder of its own, and a command to solve it.
struct Stage {
    TempFolder folder;
    PlainMotion clip;
    std::vector<PlainArm> arms;

    explicit Stage(std::size_t first = 100, std::size_t step = 25)
    {
        spill(folder / "clip.bvh", cut(plain_motion_of(must_find_jump()), first, step));
        clip = plain_motion_of(folder / "clip.bvh");
        arms = arms_of(clip);
    }
    std::string solve(Words more, const std::string& out = "") const
    {
        more.insert(more.begin(), {"solve", "clip.bvh"});
        if (!out.empty()) more.insert(more.end(), {"--out", out});
        const Outcome outcome = run_command(folder.path, more);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        REQUIRE(outcome.err.empty());
        return out.empty() ? outcome.out : slurp(folder / out);
    }
    void write_targets(const std::string& rows) const
    {
        spill(folder / "t.csv", "frame,character,limb,x,y,z,pole_x,pole_y,pole_z\n" + rows);
    }
};

std::string row_text(std::size_t character, const Vector3d& wrist, const Vector3d& pole)
{
    return fmt::format("0,{},left_arm,{},{},{},{},{},{}\n", character, wrist.x(), wrist.y(), wrist.z(), pole.x(),
                       pole.y(), pole.z());
}

}  // namespace

TEST_CASE("crowd: the table holds every frame, character and limb in order, and unit quaternions")
{
    const Stage stage;
    const std::vector<Row> rows = rows_of(stage.solve({"--characters", "50"}, "poses.csv"));
    const std::size_t frames = stage.clip.lines.size();
    REQUIRE(rows.size() == frames * 50 * 2);
    std::size_t misplaced = 0, unreached = 0;
    double worst_length = 0;
    std::set<std::string> poses_of_frame_0;
    for (std::size_t n = 0; n < rows.size(); ++n) {
        misplaced +=
            rows[n].place() != std::tuple(n / 100, n / 2 % 50, std::string(n % 2 == 0 ? "left_arm" : "right_arm"));
        unreached += (rows[n].flags & SWIVEL_REACHED) == 0;
        for (const Quaterniond& q : rows[n].joint) worst_length = std::max(worst_length, std::abs(q.norm() - 1));
        if (n < 100)
            poses_of_frame_0.insert(std::to_string(rows[n].joint[0].x()) + std::to_string(rows[n].joint[1].x()));
    }
    CHECK(misplaced == 0);
    CHECK(unreached == 0);
    CHECK(worst_length < 1e-6);
    CHECK(poses_of_frame_0.size() > 80);  // characters differ

    const std::vector<Row> alone = rows_of(stage.solve({}, "alone.csv"));
    REQUIRE(alone.size() == frames * 2);
    for (std::size_t n = 0; n < alone.size(); ++n)
        for (std::size_t j = 0; j < 3; ++j)
            CHECK(alone[n].joint[j].coeffs() == rows[n / 2 * 100 + n % 2].joint[j].coeffs());  // the same bits
}

TEST_CASE("crowd: the seed and nothing else decides the bytes")
{
    const Stage stage;
    const auto solve = [&](const Words& more) {
        Words all = {"--characters", "300"};
        all.insert(all.end(), more.begin(), more.end());
        return stage.solve(all, "poses.csv");
    };
    const std::string first = solve({"--threads", "1"});
    CHECK(first == solve({"--threads", "2"}));
    CHECK(first == solve({}));
    CHECK(first == solve({"--seed", "1"}));
    const std::string other = solve({"--seed", "2"});
    CHECK(first != other);
    CHECK(other == solve({"--seed", "2", "--threads", "1"}));
}

TEST_CASE("targets: characters stand on the documented grid")
{
    // One frame, so that all start at it. A character's arms are the clip's by an unknown factor; in the clip's lengths
    // its wrist must point at its target, and that factor follows from the distance.
    const Stage stage(1200, 100000);
    REQUIRE(stage.clip.lines.size() == 1);
    const double span = 2 * std::max(stage.arms[0].length(), stage.arms[1].length());
    const PlainArm& left = stage.arms[0];
    const PlainArmPose at = arm_pose(stage.clip, left, 0);
    const Vector3d goal = at.shoulder + left.length() * Vector3d(0.1, -0.3, 0.5);
    std::string rows;
    for (std::size_t n = 0; n < 7; ++n) {  // w = 3
        const Vector3d place = 3 * span * Vector3d(static_cast<double>(n % 3), 0, static_cast<double>(n / 3));
        rows += row_text(n, goal + place, at.elbow + place);
    }
    stage.write_targets(rows);
    std::set<int> factors;
    for (const Row& row : rows_of(stage.solve({"--characters", "7", "--targets", "t.csv"}, "grid.csv"))) {
        if (row.limb != "left_arm") continue;
        INFO("character " << row.character);
        const Matrix3d shoulder = at.parent * row.joint[0].toRotationMatrix();
        const Vector3d reach =
            shoulder * (stage.clip.joint(left.elbow).offset + row.joint[1] * stage.clip.joint(left.wrist).offset);
        const double factor = (goal - at.shoulder).norm() / reach.norm();
        CHECK((factor * reach - (goal - at.shoulder)).norm() < 2e-5 * left.length());
        CHECK(factor > 0.85 - 1e-5);
        CHECK(factor < 1.15 + 1e-5);
        if (row.character == 0) CHECK(factor == Approx(1).epsilon(1e-5));
        CHECK(row.number("size") == Approx(factor).epsilon(1e-5));
        CHECK(row.number("place_x") == Approx(3 * span * static_cast<double>(row.character % 3)).epsilon(1e-6));
        CHECK(row.number("place_y") == 0);
        CHECK(row.number("place_z") == Approx(3 * span * static_cast<double>(row.character / 3)).epsilon(1e-6));
        factors.insert(static_cast<int>(factor * 1e4));
    }
    CHECK(factors.size() > 4);
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

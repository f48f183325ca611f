// SPDX-License-Identifier: MIT
// New rotations, positions and frames written into BVH files: accuracy, and continuity of keys. That all other text of
// real files stays is for tests/command/test_clip_back.cpp, and whole motions are for
// tests/command/test_retarget_clips.cpp. Written angles are checked by rotation matrices from the bare text as well as
// by reading the file again.

#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

#include "tests/bvh_samples.h"
#include "tests/complaint.h"
#include "tests/plain_motion.h"
#include "tests/test_data.h"
#include "tools/formats/bvh.h"
#include "tools/formats/clip.h"

using namespace swivel::formats;
using namespace swivel::test;
using Catch::Matchers::Contains;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

Quaterniond random_rotation(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    return Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
}

constexpr std::array<const char*, 6> kOrders = {"XYZ", "YZX", "ZXY", "XZY", "ZYX", "YXZ"};

std::string channels_of(const std::string& order)
{
    return fmt::format("3 {}rotation {}rotation {}rotation", order[0], order[1], order[2]);
}

Eigen::Matrix3d matrix_of(const std::string& order, const Vector3d& angles_deg)
{
    return turn(order[0], angles_deg[0]) * turn(order[1], angles_deg[1]) * turn(order[2], angles_deg[2]);
}

// The angles written for these rotations, three in each frame, where the file's first frame has `start`.
std::vector<Vector3d> written_angles(const TempFolder& folder, const std::string& order,
                                     const std::vector<Quaterniond>& rotations, const std::string& start = "0 0 0")
{
    std::string values = start + "\n";
    for (std::size_t frame = 1; frame < rotations.size(); ++frame) values += "0 0 0\n";
    const BvhFile file = read(folder, one_joint(channels_of(order), values, rotations.size()));
    write_bvh(folder / "w.bvh", file, {{{0, rotations}}});
    std::vector<Vector3d> angles;
    for (const std::vector<double>& frame : plain_motion_of(folder / "w.bvh").values) angles.emplace_back(frame.data());
    return angles;
}

}  // namespace

TEST_CASE("bvh: blanks, line ends and other channels around new angles stay")
{
    const TempFolder folder;
    const std::string values = " 1  2\t3 +4.50 \r\n\r\n5 6 7\t\t8e0";
    const BvhFile file = read(folder, one_joint("4 Zrotation Xrotation Yrotation Xposition", values, 2));
    const std::vector<Quaterniond> rotations = {Quaterniond(turn('Z', 90)), Quaterniond(turn('X', -20))};
    write_bvh(folder / "w.bvh", file, {{{0, rotations}}});
    const std::string text = slurp(folder / "w.bvh");
    CHECK(text == edited(file.text, values,
                         " 90.000000000  0.000000000\t0.000000000 +4.50 \r\n\r\n"
                         "0.000000000 -20.000000000 0.000000000\t\t8e0"));
}

TEST_CASE("bvh: any rotation in any order comes back to 1e-9 rad")
{
    const TempFolder folder;
    for (const std::string order : kOrders) {
        rc::prop(order, [&](unsigned seed) {
            std::mt19937 random(seed);
            std::vector<Quaterniond> rotations;
            for (int i = 0; i < 40; ++i) {
                rotations.push_back(random_rotation(random));
                // And near the lock, at every distance from it.
                const double gap_deg = std::pow(10.0, -static_cast<double>(random() % 17));
                const double side = random() % 2 ? 1 : -1;
                const Vector3d angles(static_cast<double>(random() % 360), side * 90 - gap_deg,
                                      static_cast<double>(random() % 360));
                rotations.emplace_back(matrix_of(order, angles));
            }
            const std::vector<Vector3d> angles = written_angles(folder, order, rotations);
            const Clip clip = read_bvh(folder / "w.bvh").clip;
            RC_ASSERT(angles.size() == rotations.size());
            for (std::size_t i = 0; i < rotations.size(); ++i) {
                RC_ASSERT(Quaterniond(matrix_of(order, angles[i])).angularDistance(rotations[i]) < 1e-9);
                RC_ASSERT(clip.rotation[i].angularDistance(rotations[i]) < 1e-9);
            }
        });
    }
}

TEST_CASE("bvh: keys follow a smooth motion over full turns, through the lock, from the file's first values")
{
    const TempFolder folder;
    for (const std::string order : kOrders) {
        CAPTURE(order);
        std::vector<Quaterniond> rotations;
        std::vector<Vector3d> wanted;
        for (int frame = 0; frame < 300; ++frame) {
            const double f = frame;
            // The middle angle crosses 90 between two frames, then once hits it exactly.
            const Vector3d angles_deg(700 + 3.1 * f, -200 + (f < 150 ? 1.3 * f : 195 + 0.5 * (f - 150)), -4.7 * f);
            wanted.push_back(angles_deg);
            rotations.emplace_back(matrix_of(order, angles_deg));
            if (frame % 2) rotations.back().coeffs() *= -1;
        }
        const std::vector<Vector3d> angles = written_angles(folder, order, rotations, "702 -199 1");
        double worst = 0;
        for (std::size_t i = 0; i < rotations.size(); ++i) {
            worst = std::max(worst, (angles[i] - wanted[i]).norm());
        }
        CHECK(worst < 1e-6);
    }
}

TEST_CASE("bvh: at gimbal lock the first angle rests and the last takes the motion")
{
    const TempFolder folder;
    for (const std::string order : kOrders) {
        for (const double side : {90.0, -90.0}) {
            CAPTURE(order, side);
            std::vector<Quaterniond> rotations;
            for (int frame = 0; frame < 100; ++frame) {
                const Vector3d angles(30, side, 10 + 5.0 * frame);
                rotations.emplace_back(matrix_of(order, angles));
            }
            const std::vector<Vector3d> angles = written_angles(folder, order, rotations, "30 80 10");
            for (std::size_t i = 0; i < rotations.size(); ++i) {
                REQUIRE(std::abs(angles[i][0] - 30) < 1e-6);
                REQUIRE(std::abs(angles[i][1] - side) < 1e-6);
                REQUIRE(std::abs(angles[i][2] - (10 + 5.0 * static_cast<double>(i))) < 1e-6);
            }
        }
    }
}

TEST_CASE("bvh: enormous original angles do not spoil the new ones")
{
    const TempFolder folder;
    const std::vector<Quaterniond> rotations = {Quaterniond(matrix_of("ZYX", {10, 20, 30}))};
    const std::vector<Vector3d> angles = written_angles(folder, "ZYX", rotations, "1e9 -9e8 3e6");
    CHECK((angles[0] - Vector3d(10, 20, 30)).norm() < 1e-8);
}

TEST_CASE("bvh: overrides the file's channels cannot hold are refused with the reason")
{
    const TempFolder folder;
    const std::vector<Quaterniond> one = {Quaterniond::Identity()};
    const auto refusal = [&](const std::string& channels, const std::string& values) {
        const BvhFile file = read(folder, one_joint(channels, values, 1));
        const std::string complaint = complaint_of(folder, [&] { write_bvh(folder / "w.bvh", file, {{{0, one}}}); });
        CHECK(complaint_of(folder, [&] { require_can_key(file, 0); }) == complaint);  // known before any work
        return complaint;
    };
    CHECK_THAT(refusal("2 Xrotation Yrotation", "1 2"),
               Contains("t.bvh:5: joint 'A' cannot take a new rotation: it has fewer than three rotation channels"));
    CHECK_THAT(refusal("3 Xposition Yposition Zposition", "1 2 3"), Contains("fewer than three"));
    CHECK_THAT(refusal("3 Zrotation Xrotation Zrotation", "1 2 3"), Contains("its rotation channels repeat an axis"));
    CHECK_THAT(refusal("4 Zrotation Xrotation Yrotation Zrotation", "1 2 3 4"), Contains("more than three"));
    CHECK_FALSE(fs::exists(folder / "w.bvh"));
    CHECK(refusal("6 Xrotation Zposition Yrotation Xposition Zrotation Yposition", "1 2 3 4 5 6").empty());
    CHECK_THAT(slurp(folder / "w.bvh"), Contains("0.000000000 2 0.000000000 4 0.000000000 6"));
}

TEST_CASE("bvh: overrides that fit no file are the caller's mistake")
{
    const TempFolder folder;
    const BvhFile file = read(folder, kTiny);
    const std::vector<Quaterniond> fit(2, Quaterniond::Identity()), less(1, Quaterniond::Identity());
    const std::vector<Quaterniond> zero(2, Quaterniond(0, 0, 0, 0)), nan(2, Quaterniond(NAN, 0, 0, 0));
    for (const std::vector<JointKeys>& overrides :
         {std::vector<JointKeys>{{3, fit}}, {{-1, fit}}, {{1, less}}, {{1, zero}}, {{1, nan}}, {{1, fit}, {1, fit}}})
        CHECK_THROWS_AS(write_bvh(folder / "w.bvh", file, overrides), std::invalid_argument);
    CHECK_FALSE(fs::exists(folder / "w.bvh"));
}

TEST_CASE("bvh: new frames: what has no keys rests in BVH; what cannot hold them is refused")
{
    const TempFolder folder;
    const BvhFile file = read(folder, kTiny);
    const std::vector<Vector3d> place(3, Vector3d(-7, 0.125, 1e-10));
    const std::vector<Quaterniond> turned(3, Quaterniond(turn('X', 50)));
    write_bvh(folder / "w.bvh", file, {{{0, {}, place}}}, NewFrames{3, 0.25});
    const std::string row = "-7.000000000 0.125000000 0.000000000 0 0 0 0 0 0\n";
    CHECK(slurp(folder / "w.bvh") ==
          kTiny.substr(0, kTiny.find("Frames:")) + "Frames: 3\nFrame Time: 0.25\n" + row + row + row);
    write_bvh(folder / "w.bvh", file, {{{1, turned}}}, NewFrames{3, 0.25});
    CHECK_THAT(slurp(folder / "w.bvh"), Contains("\n1 2 3 0 0 0 0.000000000 50.000000000 0.000000000\n"));
    CHECK(complaint_of(folder, [&] {
              write_bvh(folder / "x.bvh", file, {{{1, {}, place}}}, NewFrames{3, 1});
          }) == "t.bvh:9: joint 'Arm' cannot take a new position: it has fewer than three position channels");
    CHECK_THROWS_AS(write_bvh(folder / "x.bvh", file, {{{0, {}, place}}}, NewFrames{2, 1}), std::invalid_argument);
    const std::vector<Vector3d> endless(3, Vector3d(0, HUGE_VAL, 0));
    CHECK_THROWS_AS(write_bvh(folder / "x.bvh", file, {{{0, {}, endless}}}, NewFrames{3, 1}), std::invalid_argument);
    CHECK_FALSE(fs::exists(folder / "x.bvh"));
}

TEST_CASE("bvh: new frames: a position in a clip's own frames leaves its other numbers alone")
{
    const TempFolder folder;
    const BvhFile file = read(folder, kTiny);
    const std::vector<Vector3d> place = {{1, 2, 3}, {4, 5, 6}};
    write_bvh(folder / "w.bvh", file, {{{0, {}, place}}});
    CHECK(slurp(folder / "w.bvh") == edited(edited(kTiny, "\n10 20 30 90", "\n1.000000000 2.000000000 3.000000000 90"),
                                            "\n10 20 30 0", "\n4.000000000 5.000000000 6.000000000 0"));
}

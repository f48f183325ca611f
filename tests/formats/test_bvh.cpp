// SPDX-License-Identifier: MIT
//
// BVH files: the clip that they give, and new rotations, positions and frames written into them. Hand-made files have
// known answers, and rotation matrices from the bare text judge all others. That all other text of real files stays is
// for tests/command/test_rigs.cpp, and whole motions are for tests/command/test_retarget.cpp. What is said of damaged
// files is in tests/transcripts/bvh.txt.
#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tests/plain_motion.h"
#include "tests/test_data.h"
#include "tools/formats/bvh.h"
#include "tools/formats/clip.h"

using namespace swivel::formats;
using namespace swivel::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

const std::string kTiny =  // line
    "HIERARCHY\n"          // 1
    "ROOT Hips\n"          // 2
    "{\n"                  // 3
    "  OFFSET 1 2 3\n"     // 4
    "  CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation\n"
    "  JOINT Arm\n"        // 6
    "  {\n"                // 7
    "    OFFSET 0 10 0\n"  // 8
    "    CHANNELS 3 Zrotation Xrotation Yrotation\n"
    "    JOINT Hand\n"           // 10
    "    {\n"                    // 11
    "      OFFSET 5 0 0\n"       // 12
    "      End Site\n"           // 13
    "      {\n"                  // 14
    "        OFFSET 1 0 0\n"     // 15
    "      }\n"                  // 16
    "    }\n"                    // 17
    "  }\n"                      // 18
    "}\n"                        // 19
    "MOTION\n"                   // 20
    "Frames: 2\n"                // 21
    "Frame Time: .5\n"           // 22
    "10 20 30 90 0 0 0 0 0\n"    // 23
    "10 20 30 0 0 0 90 0 90\n";  // 24

BvhFile read(const TempFolder& folder, std::string_view text)
{
    spill(folder / "t.bvh", text);
    return read_bvh(folder / "t.bvh");
}

// A file with one joint of the given channels; one line of values per frame.
std::string one_joint(const std::string& channels, const std::string& values, std::size_t frame_count)
{
    return fmt::format("HIERARCHY\nROOT A\n{{\nOFFSET 0 0 0\nCHANNELS {}\n}}\nMOTION\nFrames: {}\nFrame Time: 1\n{}",
                       channels, frame_count, values);
}

Eigen::Matrix3d turn(char axis, double angle_deg)
{
    return Eigen::AngleAxisd(angle_deg * std::numbers::pi / 180, Eigen::Vector3d::Unit(axis - 'X')).toRotationMatrix();
}

std::string complaint(const TempFolder& folder, std::string_view text)
{
    return complaint_of(folder, [&] { read(folder, text); });
}

}  // namespace

TEST_CASE("bvh: a tiny file gives its joints and known positions")
{
    const TempFolder folder;
    const Clip clip = read(folder, kTiny).clip;
    REQUIRE(clip.joints.size() == 3);
    CHECK(clip.frame_count == 2);
    CHECK(clip.frame_time == 0.5);
    CHECK(clip.track_count == 1);
    const std::vector<JointPose> first_w = world_pose(clip, 0);  // the hips turn everything by 90 degrees about z
    CHECK((first_w[0].position - Vector3d(10, 20, 30)).norm() < 1e-12);  // channels take the place of OFFSET
    CHECK((first_w[1].position - Vector3d(0, 20, 30)).norm() < 1e-12);
    CHECK((first_w[2].position - Vector3d(0, 25, 30)).norm() < 1e-12);
    const std::vector<JointPose> second_w =
        world_pose(clip, 1);  // Rz Rx Ry in this order: y first, x to -z, z keeps it
    CHECK((second_w[1].position - Vector3d(10, 30, 30)).norm() < 1e-12);
    CHECK((second_w[2].position - Vector3d(10, 30, 25)).norm() < 1e-12);
    const std::vector<JointPose> rest_w = rest_pose(clip);
    CHECK(rest_w[0].position == Vector3d(1, 2, 3));
    CHECK(rest_w[2].position == Vector3d(6, 12, 3));
}

TEST_CASE("clip: joints by name, path and family")
{
    const TempFolder folder;
    const Clip clip = read(folder, edited(kTiny, "JOINT Hand", "JOINT Arm")).clip;
    CHECK(find_joints(clip, "Hips") == std::vector<int>{0});
    CHECK(find_joints(clip, "Arm") == std::vector<int>{1, 2});
    CHECK(find_joints(clip, "Hips/Arm") == std::vector<int>{1});
    CHECK(find_joints(clip, "Hips/Arm/Arm") == std::vector<int>{2});
    for (const char* none : {"", "arm", "Arm/Arm", "/Hips", "Hips/", "xHips/Arm", "Hips/Arm/Arm/Arm"}) {
        CHECK(find_joints(clip, none).empty());
    }
    CHECK(joint_path(clip, 2) == "Hips/Arm/Arm");
    CHECK(child_joints(clip, -1) == std::vector<int>{0});
    CHECK(child_joints(clip, 0) == std::vector<int>{1});
    CHECK(child_joints(clip, 2).empty());
}

TEST_CASE("bvh: dialects give the same clip")
{
    const TempFolder folder;
    const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
        for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
            text.replace(at, from.size(), to);
        }
        return text;
    };
    std::string lower = kTiny;
    for (const char* word : {"HIERARCHY", "ROOT", "JOINT", "OFFSET", "CHANNELS", "End Site", "MOTION", "Frames", "Xpos",
                             "Zrot", "Frame Time"}) {
        std::string small = word;
        for (char& c : small) c = static_cast<char>(std::tolower(c));
        lower = replaced(lower, word, small);
    }
    const std::vector<std::string> dialects = {
        replaced(kTiny, "\n", "\r\n"),
        replaced(kTiny, " 0", "\t0"),
        replaced(kTiny, "\n", "  \t\n"),
        replaced(kTiny, "\n{\n", " {\n"),
        replaced(kTiny, "\n}\n", "}\n"),
        replaced(kTiny, "10 20 30", "1e1 +20.0E0 .3e+02"),
        lower,
        kTiny + "\n\r\n  \n",
        edited(kTiny, "0 0 0\n10", "0 0 0\n\n10"),
        kTiny.substr(0, kTiny.size() - 1),
        "\xEF\xBB\xBF" + kTiny,
        edited(kTiny, "Frames: 2", "Frames:\t2"),
        edited(kTiny, "Frames: 2", "Frames:2"),
        edited(kTiny, "      OFFSET 5 0 0\n", "      OFFSET 5 0 0\n      CHANNELS 0\n"),
    };
    const std::vector<JointPose> wanted_w = world_pose(read(folder, kTiny).clip, 1);
    for (const std::string& text : dialects) {
        CAPTURE(text);
        const BvhFile file = read(folder, text);
        REQUIRE(file.clip.joints.size() == 3);
        CHECK(file.clip.joints[1].name == "Arm");
        CHECK(world_pose(file.clip, 1)[2].position == wanted_w[2].position);
        write_bvh(folder / "copy.bvh", file, {});
        CHECK(slurp(folder / "copy.bvh") == text);
    }
}

TEST_CASE("bvh: unusual channels, names and roots are read")
{
    const TempFolder folder;
    SECTION("six channels, rotations first and one position alone")
    {
        const std::string mixed = "6 Xrotation Zposition Yrotation Xposition Zrotation Yposition";
        const Clip clip = read(folder, one_joint(mixed, "90 3 0 1 90 2\n", 1)).clip;
        CHECK(local_translation(clip, 0, 0) == Vector3d(1, 2, 3));
        CHECK(clip.rotation[0].angularDistance(Quaterniond(turn('X', 90) * turn('Z', 90))) < 1e-15);
        const std::string text = edited(one_joint("1 Yposition", "7\n", 1), "OFFSET 0 0 0", "OFFSET 1 2 3");
        CHECK(local_translation(read(folder, text).clip, 0, 0) == Vector3d(1, 7, 3));
    }
    SECTION("names with blanks and colons")
    {
        const Clip clip = read(folder, edited(kTiny, "JOINT Arm", "JOINT  rig:Left Arm \t")).clip;
        CHECK(clip.joints[1].name == "rig:Left Arm");
    }
    SECTION("two roots")
    {
        const std::string second = "}\nROOT B\n{\nOFFSET 7 0 0\nCHANNELS 1 Xrotation\n}\nMOTION";
        const Clip clip = read(folder, edited(one_joint("1 Xrotation", "1 2\n", 1), "}\nMOTION", second)).clip;
        CHECK(child_joints(clip, -1) == std::vector<int>{0, 1});
        CHECK(world_pose(clip, 0)[1].position == Vector3d(7, 0, 0));
    }
}

TEST_CASE("bvh: what is no BVH file is refused")
{
    const TempFolder folder;
    CHECK_THAT(complaint(folder, ""), StartsWith("t.bvh: is empty"));
    fs::resize_file(folder / "t.bvh", std::uintmax_t{3} << 30);
    CHECK(complaint_of(folder, [&] { read_bvh(folder / "t.bvh"); }) == "t.bvh: is longer than 2 GiB; cut it");
    CHECK_THAT(complaint(folder, std::string_view("H\0I\0E\0", 6)), StartsWith("t.bvh: is a binary file"));
    CHECK_THAT(complaint(folder, " \n\n"), StartsWith("t.bvh:2: the file ends where HIERARCHY should be"));
    CHECK_THAT(complaint(folder, edited(kTiny, "HIER", "HIR")), StartsWith("t.bvh:1: 'HIRARCHY' where HIERARCHY"));
    CHECK_THROWS_WITH(read_bvh(folder / "none.bvh"), Contains("none.bvh: cannot be opened: No such file"));
    CHECK_THROWS_WITH(read_bvh(folder.path), Contains("is a directory"));
}

TEST_CASE("bvh: a file cut anywhere is refused, unless only blanks or digits are lost")
{
    const TempFolder folder;
    const std::size_t whole = kTiny.find_last_of('9') + 1;  // "... 0 9" still is a frame
    for (std::size_t size = 0; size < kTiny.size(); ++size) {
        CAPTURE(size);
        CHECK(complaint(folder, kTiny.substr(0, size)).empty() == (size >= whole));
    }
}

TEST_CASE("bvh: real files agree with matrices from the bare text and come back byte for byte")
{
    must_find_jump();
    const TempFolder folder;
    for (const fs::path& path : all_bvh_files()) {
        CAPTURE(path);
        const BvhFile file = read_bvh(path);
        write_bvh(folder / "copy.bvh", file, {});
        CHECK(slurp(folder / "copy.bvh") == slurp(path));
        const PlainMotion plain = plain_motion(file.text);
        REQUIRE(plain.lines.size() >= file.clip.frame_count);  // Boxing_Toes.bvh has a line too many
        double worst = 0;
        for (std::size_t frame = 0; frame < file.clip.frame_count; frame += 97) {
            const std::vector<JointPose> pose_w = world_pose(file.clip, frame);
            const std::vector<PlainPose> wanted_w = pose_of(plain, frame);
            for (std::size_t i = 0; i < pose_w.size(); ++i) {
                worst = std::max(worst, (pose_w[i].position - wanted_w[i].position).norm());
                worst = std::max(worst, (pose_w[i].rotation.toRotationMatrix() - wanted_w[i].rotation).norm());
            }
        }
        CHECK(worst < 1e-11);
    }
}

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

TEST_CASE("bvh: keys follow a motion over full turns, through the lock and at it, from the file's first values")
{
    struct Course {
        const char* start;  // the file's
        int frame_count;
        Vector3d (*angles_deg)(double frame);
        double max;
    };
    const Course courses[] = {
        // The middle angle crosses 90 between two frames, then once hits it exactly.
        {"702 -199 1", 300,
         [](double f) { return Vector3d(700 + 3.1 * f, -200 + (f < 150 ? 1.3 * f : 195 + 0.5 * (f - 150)), -4.7 * f); },
         1e-6},
        // At gimbal lock the first angle rests and the last takes the motion.
        {"30 80 10", 100, [](double f) { return Vector3d(30, 90, 10 + 5 * f); }, 1e-6},
        {"30 80 10", 100, [](double f) { return Vector3d(30, -90, 10 + 5 * f); }, 1e-6},
        {"1e9 -9e8 3e6", 1, [](double) { return Vector3d(10, 20, 30); }, 1e-8},  // enormous ones spoil nothing
    };
    const TempFolder folder;
    for (const std::string order : kOrders)
        for (const Course& course : courses) {
            CAPTURE(order, course.start);
            std::vector<Quaterniond> rotations;
            for (int frame = 0; frame < course.frame_count; ++frame) {
                rotations.emplace_back(matrix_of(order, course.angles_deg(frame)));
                if (frame % 2) rotations.back().coeffs() *= -1;
            }
            const std::vector<Vector3d> angles = written_angles(folder, order, rotations, course.start);
            for (std::size_t n = 0; n < angles.size(); ++n)
                REQUIRE((angles[n] - course.angles_deg(static_cast<double>(n))).norm() < course.max);
        }
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

TEST_CASE("bvh: at another rate joints turn the shortest way, angles without a third axis too, and both ends stay")
{
    const TempFolder folder;
    std::string text = edited(kTiny, "CHANNELS 3 Zrotation Xrotation Yrotation", "CHANNELS 2 Zrotation Xrotation");
    text = edited(edited(text, "90 0 0 0 0 0", "90 0 0 350 0"), "0 0 0 90 0 90", "0 0 0 10 90");
    const BvhFile file = read(folder, text);
    for (const double rate : {0.5, 7.6, 16.0}) {
        const BvhFile other = at_rate(file, rate);
        const std::size_t steps = rate < 1 ? 1 : rate < 10 ? 4 : 8;
        REQUIRE(other.clip.frame_count == steps + 1);
        CHECK(other.clip.frame_time == 0.5 / static_cast<double>(steps));
        for (std::size_t frame = 0; frame <= steps; ++frame) {
            const double share = static_cast<double>(frame) / static_cast<double>(steps);
            const Quaterniond hips = file.clip.rotation[0].slerp(share, file.clip.rotation[3]);
            CHECK(other.clip.rotation[3 * frame].angularDistance(hips) < 1e-9);
            CHECK((other.clip.rotation[3 * frame + 1].matrix() - turn('Z', 20 * share - 10) * turn('X', 90 * share))
                      .norm() < 1e-9);
            CHECK((other.clip.translation[frame] - Vector3d(10, 20, 30)).norm() < 1e-9);
        }
    }
    CHECK(at_rate(read(folder, one_joint("1 Xrotation", "5\n", 1)), 30).clip.frame_time == 1);
    CHECK_THROWS_WITH(at_rate(file, 1e12), Contains("take more than 2 GiB; give a lower --fps"));
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
    CHECK(complaint_of(folder,
                       [&] {
                           write_bvh(folder / "x.bvh", file, {{{1, {}, place}}}, NewFrames{3, 1});
                       }) ==
          "t.bvh:9: joint 'Arm' cannot take a new position: it has fewer than three position channels; "
          "export the clip with three position channels for it, of X, Y and Z");
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

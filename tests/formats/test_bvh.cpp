// SPDX-License-Identifier: MIT
// BVH files read, and the clip they give. Checked against hand-made files with known answers and against forward
// kinematics by 4x4 matrices from the bare text.

#include <catch2/catch.hpp>

#include <algorithm>
#include <cctype>

#include "tests/bvh_samples.h"
#include "tests/complaint.h"
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
    SECTION("one line more than announced")
    {
        const BvhFile file = read(folder, edited(kTiny, "Frames: 2", "Frames: 1"));
        CHECK(file.clip.frame_count == 1);
        CHECK(file.surplus_count == 1);
        CHECK(file.clip.rotation.size() == 3);
        const std::vector<Quaterniond> one = {Quaterniond::Identity()};
        write_bvh(folder / "w.bvh", file, {{{1, one}}});
        CHECK_THAT(slurp(folder / "w.bvh"),
                   Contains("90 0 0 0.000000000 0.000000000 0.000000000\n10 20 30 0 0 0 90 0 90\n"));
    }
}

TEST_CASE("bvh: malformed files are refused with line and cause")
{
    struct Damage {
        std::string from, to, complaint;
    };
    const std::string last = "10 20 30 0 0 0 90 0 90\n";
    const std::vector<Damage> damages = {
        {"HIERARCHY", "HIRARCHY",
         "t.bvh:1: 'HIRARCHY' where HIERARCHY should be; correct it, or export the clip as BVH again"},
        {"ROOT Hips", "JOINT Hips", "t.bvh:2: 'JOINT' where ROOT should be"},
        {"ROOT Hips", "ROOT", "t.bvh:2: a joint without a name"},
        {"Hips\n{", "Hips\nOFFSET", "t.bvh:3: 'OFFSET' where { should be"},
        {"OFFSET 1 2 3", "OFFSET 1 2", "t.bvh:4: OFFSET has fewer than three numbers"},
        {"OFFSET 1 2 3", "OFFSET 1 1e30 3", "t.bvh:4: OFFSET: 1e+30 is more than 1e+15; correct it"},
        {"OFFSET 1 2 3", "OFFSET 1 nan 3", "t.bvh:4: OFFSET: 'nan' is not a finite decimal number"},
        {"OFFSET 1 2 3", "OFFSET 1 2 3\nOFFSET 1 2 3", "t.bvh:5: 'OFFSET' where OFFSET or CHANNELS (once"},
        {"  OFFSET 1 2 3\n", "", "t.bvh:18: joint 'Hips' has no OFFSET"},
        {"CHANNELS 6", "CHANNELS 7", "t.bvh:5: CHANNELS: '7' is not a count from 0 to 6"},
        {"CHANNELS 3", "CHANNELS 2", "t.bvh:9: CHANNELS announces 2 and names 3"},
        {"Xrotation", "Wrotation", "t.bvh:5: unknown channel 'Wrotation'; known are"},
        {"Yposition", "Xposition", "t.bvh:5: CHANNELS names Xposition twice"},
        {"    }\n  }\n", "    }\n  CHANNELS 1 Xrotation\n  }\n", "t.bvh:18: 'CHANNELS' where OFFSET or CHANNELS (once"},
        {"        OFFSET 1 0 0\n", "        CHANNELS 0\n", "t.bvh:15: 'CHANNELS' where OFFSET should be"},
        {"MOTION\nFrames: 2", "Frames: 2", "t.bvh:20: 'Frames:' where ROOT or MOTION should be"},
        {"}\nMOTION", "MOTION", "t.bvh:19: 'MOTION' where OFFSET or CHANNELS"},
        {"Frames: 2", "Frames: 0", "t.bvh:21: Frames: '0' is not a whole number above 0"},
        {"Frames: 2", "Frames: 2.5", "t.bvh:21: Frames: '2.5' is not a whole number"},
        {"Frames: 2", "Frames: 9000000000000000000",
         "t.bvh:24: the file ends after 2 of the 9000000000000000000 frames"},
        {"Frames: 2", "Frames: 3", "t.bvh:24: the file ends after 2 of the 3 frames announced in line 21; is it cut"},
        {last, last + last + "1 2\n", "t.bvh:26: 2 values, the channels need 9"},
        {"Frame Time: .5", "Frame Time: 0", "t.bvh:22: Frame Time: '0' is not a number of seconds above 0"},
        {"Frame Time: .5", "Frame Time: ,5", "t.bvh:22: Frame Time: ',5' is not"},
        {"Frame Time: .5\n", "", "t.bvh:22: '10' where Frame should be"},
        {last, "10 20 30 0 0 0 90 0\n", "t.bvh:24: 8 values, the channels need 9 (one frame is one line)"},
        {last, "10 20 30 0 0 0 90 0 90 1\n", "t.bvh:24: 10 values, the channels need 9"},
        {last, "10 20 30 0 0 0 90 nan 90\n", "t.bvh:24: value 8 (Arm Xrotation): 'nan' is not a finite"},
        {last, "10 20 30 0 0 0 90 0 1e308\n", "t.bvh:24: value 9 (Arm Yrotation): 1e+308 is more than 1e+09 degrees"},
        {last, "10 -2e15 30 0 0 0 90 0 0\n",
         "t.bvh:24: value 2 (Hips Yposition): -2e+15 is more than 1e+15; correct it"},
        {last, "10 2o 30 0 0 0 90 0 90\n", "t.bvh:24: value 2 (Hips Yposition): '2o' is not a finite"},
    };
    const TempFolder folder;
    for (const Damage& damage : damages) {
        INFO(damage.to);
        CHECK_THAT(complaint(folder, edited(kTiny, damage.from, damage.to)), StartsWith(damage.complaint));
    }
    CHECK_THAT(complaint(folder, one_joint("0", "", 1)), StartsWith("t.bvh:7: no joint has CHANNELS"));
}

TEST_CASE("bvh: what is no BVH file is refused")
{
    const TempFolder folder;
    CHECK_THAT(complaint(folder, ""), StartsWith("t.bvh: is empty"));
    fs::resize_file(folder / "t.bvh", std::uintmax_t{3} << 30);
    CHECK(complaint_of(folder, [&] { read_bvh(folder / "t.bvh"); }) == "t.bvh: is longer than 2 GiB; cut it");
    CHECK_THAT(complaint(folder, std::string_view("H\0I\0E\0", 6)), StartsWith("t.bvh: is a binary file"));
    CHECK_THAT(complaint(folder, " \n\n"), StartsWith("t.bvh:2: the file ends where HIERARCHY should be"));
    CHECK_THROWS_WITH(read_bvh(folder / "none.bvh"), Contains("none.bvh: cannot be opened: No such file"));
    CHECK_THROWS_WITH(read_bvh(folder.path), Contains("is a directory"));
    std::string deep = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n";
    for (int depth = 0; depth < 200000; ++depth) deep += "JOINT a {\nOFFSET 0 0 0\n";
    CHECK_THAT(complaint(folder, deep), StartsWith("t.bvh:2003: more than 1000 joints inside each other"));
    // 3 MB whose poses would take 1 TB.
    std::string wide = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n";
    for (int joint = 0; joint < 50000; ++joint) wide += "JOINT b{\nOFFSET 0 0 0\n}\n";
    wide += "}\nMOTION\nFrames: 600000\nFrame Time: 1\n";
    for (int frame = 0; frame < 600000; ++frame) wide += "1\n";
    CHECK_THAT(complaint(folder, wide), Contains("600000 frames of 50001 joints need more than 8 GiB"));
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

// SPDX-License-Identifier: MIT
// The two tables: targets read, poses written. Reading is checked against hand-made rows, writing of poses by the text
// of known rows. That written targets read the same is for tests/fuzz/fuzz_formats.cpp, and what is said of damaged
// tables is in tests/transcripts/tables.txt.

#include <catch2/catch.hpp>

#include <limits>

#include "tests/test_data.h"
#include "tools/formats/poses_csv.h"
#include "tools/formats/targets_csv.h"

using namespace swivel::formats;
using namespace swivel::test;
using Catch::Matchers::Contains;

namespace {

const std::string kPlain =
    "frame,character,limb,x,y,z,pole_x,pole_y,pole_z\n"
    "0,0,left_arm,1,2,3,4,5,6\n"
    "0,0,right_leg,-1.5,.25,1e2,+4,5.,-6E-1\n";

const std::string kOriented =
    "frame,character,limb,x,y,z,pole_x,pole_y,pole_z,qx,qy,qz,qw\n"
    "0,7,left_leg,1,2,3,4,5,6,0,0,2,0\n"
    "1,7,left_leg,1,2,3,4,5,6,,,,\n";

std::vector<Target> read(const TempFolder& folder, std::string_view text)
{
    spill(folder / "t.csv", text);
    return read_targets_csv(folder / "t.csv");
}

}  // namespace

TEST_CASE("targets: rows with and without pole and orientation, which is made unit")
{
    const TempFolder folder;
    CHECK(read(folder, edited(kPlain, "4,5,6", "\"4\", \"5\" ,6"))[0].pole == Eigen::Vector3d(4, 5, 6));
    const std::vector<Target> plain = read(folder, edited(kPlain, "4,5,6", ", ,\t"));
    REQUIRE(plain.size() == 2);
    CHECK(plain[0].limb == LimbName{LimbKind::arm, Side::left});
    CHECK(plain[0].position == Eigen::Vector3d(1, 2, 3));
    CHECK_FALSE((plain[0].has_pole || plain[0].has_orientation));
    CHECK(plain[1].limb == LimbName{LimbKind::leg, Side::right});
    CHECK(plain[1].position == Eigen::Vector3d(-1.5, 0.25, 100));
    CHECK(plain[1].has_pole);
    CHECK(plain[1].pole == Eigen::Vector3d(4, 5, -0.6));
    CHECK(plain[1].line == 3);
    const std::vector<Target> oriented = read(folder, kOriented);
    CHECK(oriented[0].character == 7);
    CHECK(oriented[0].has_orientation);
    CHECK(oriented[0].orientation.coeffs() == Eigen::Vector4d(0, 0, 1, 0));
    CHECK_FALSE(oriented[1].has_orientation);
    const std::vector<Target> turned =
        read(folder, "qw,qx,qy,qz,frame,character,limb,x,y,z\n1,0,0,0,0,0,left_arm,1,2,3\n");
    CHECK(turned[0].has_orientation);
    CHECK_FALSE(turned[0].has_pole);
}

TEST_CASE("targets: sides of arms, columns in any order, comments, blanks, CRLF, no last line end, sorted result")
{
    const TempFolder folder;
    const std::vector<Target> targets = read(folder,
                                             "# made by hand\r\n\r\n"
                                             "side, z,y,x ,pole_z,pole_y,pole_x,character,frame\r\n"
                                             "right,3,2,1,6,5,4,0,4294967295\r\n"
                                             "   \r\n# more\r\n"
                                             "right,3,2,1,6,5,4,2,1\r\n"
                                             "left , 3,2,\t1,6,5,4,2,1");
    REQUIRE(targets.size() == 3);
    CHECK(targets[0].frame == 1);
    CHECK(targets[0].limb == LimbName{LimbKind::arm, Side::left});
    CHECK(targets[0].line == 8);
    CHECK(targets[0].position == Eigen::Vector3d(1, 2, 3));
    CHECK(targets[1].limb == LimbName{LimbKind::arm, Side::right});
    CHECK(targets[2].frame == 4294967295u);
}

TEST_CASE("poses: the text of known rows")
{
    const TempFolder folder;
    PosesCsv csv(folder / "p.csv");
    const float tiny = std::numeric_limits<float>::denorm_min();
    PoseRow left = {12,         {LimbKind::arm, Side::left}, {0, -0.0f, 0.1f, 1}, {1e-10f, tiny, 0.5f, 3}, {1, 0, 0, 0},
                    4294967295u};
    left.place = {-1.5, 0, 1e300};
    left.size = 0.1;
    left.start = 18446744073709551615u;
    const PoseRow right = {12, {LimbKind::leg, Side::right}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, 0};
    csv.append(239, {{left, right}});
    csv.append(240, {});
    CHECK_FALSE(fs::exists(folder / "p.csv"));
    csv.commit();
    CHECK(slurp(folder / "p.csv") ==
          "frame,character,limb,shoulder_x,shoulder_y,shoulder_z,shoulder_w,elbow_x,elbow_y,elbow_z,elbow_w,"
          "wrist_x,wrist_y,wrist_z,wrist_w,flags,place_x,place_y,place_z,size,start\n"
          "239,12,left_arm,0,-0,0.1,1,1e-10,1e-45,0.5,3,1,0,0,0,4294967295,-1.5,0,1e+300,0.1,18446744073709551615\n"
          "239,12,right_leg,0,0,0,1,0,0,0,1,0,0,0,1,0,0,0,0,1,0\n");
}

TEST_CASE("poses: columns for what limbs have beside")
{
    const TempFolder folder;
    PosesCsv csv(folder / "p.csv", {true, true, 2});
    const PoseRow row = {0, {LimbKind::arm, Side::left}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, 1};
    PoseExtra full{1.5f, true, {1, 0, 0, 0}, 2, {}}, bare{};
    full.twist[0] = {0, 1, 0, 0};
    full.twist[1] = {0, 0, 0.5f, 0};
    const std::vector<PoseExtra> extras = {full, bare};
    csv.append(3, {{row, row}}, extras);
    csv.commit();
    const std::string text = slurp(folder / "p.csv");
    CHECK_THAT(text, Contains(",start,stretch,clavicle_x,clavicle_y,clavicle_z,clavicle_w,twist1_x,twist1_y,twist1_z,"
                              "twist1_w,twist2_x,twist2_y,twist2_z,twist2_w\n"));
    CHECK_THAT(text, Contains("3,0,left_arm,0,0,0,1,0,0,0,1,0,0,0,1,1,0,0,0,1,0,1.5,1,0,0,0,0,1,0,0,0,0,0.5,0\n"));
    CHECK_THAT(text, Contains("3,0,left_arm,0,0,0,1,0,0,0,1,0,0,0,1,1,0,0,0,1,0,1,,,,,,,,,,,,\n"));
}

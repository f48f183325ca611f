// SPDX-License-Identifier: MIT
//
// The goals of a crowd file are met in the poses that `swivel solve` writes. Each key is checked by forward kinematics
// of the written file, or against the same crowd without it. Limits and reach are in test_crowd_bounds.cpp.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/crowd_stage.h"

using namespace swivel::test;
namespace {

// Frames of an arm bent enough for its plane to be known.
template <class See>
void for_bent(const CrowdStage& stage, const PlainArm& limb, See see)
{
    std::size_t seen = 0;
    for (std::size_t frame = 0; frame < stage.clip.lines.size(); ++frame) {
        if (arm_pose(stage.clip, limb, frame).bend() < 0.1) continue;
        see(frame);
        ++seen;
    }
    REQUIRE(seen > 30);
}

// As a table has it.
std::string three_cells(const Vector3d& v) { return text_of(v).substr(1, text_of(v).size() - 2); }

}  // namespace

TEST_CASE("agents: the clip's character, turned, sized, later and at its place, with all that it is asked for")
{
    const CrowdStage stage(100, 25);
    const std::string ben = "Ben Bartholomew Featherstonehaugh of the north gate";
    spill(stage.folder / "agents.csv", "name,x,z,y,heading_deg,size,start\n# turned\nAnna,30,-70,2,90,1,3\n\"" + ben +
                                           "\",0,0,0,-150,1,0\nCleo,5,2,1,0,0.9,10\n");
    const std::string crowd = "[crowd]\nlimbs = \"all\"\n", with = "agents = \"agents.csv\"\n",
                      asked = "[limb.arms]\ntarget.offset = [0.5, 1, 2]\n";
    const std::vector<PoseLine> own = stage.rows(crowd + asked, "left_arm"),
                                agents = stage.rows(crowd + with + asked, "left_arm", ",heading_deg,name");
    const struct {
        std::string name;
        double heading_deg, size;
        std::size_t start;
        Vector3d place;
    } wanted[] = {{"Anna", 90, 1, 3, {30, 2, -70}}, {ben, -150, 1, 0, {0, 0, 0}}, {"Cleo", 0, 0.9, 10, {5, 1, 2}}};
    const std::size_t frames = stage.clip.lines.size();
    REQUIRE(agents.size() == 3 * frames);
    for (const PoseLine& line : agents) {
        const auto& who = wanted[line.character];
        CHECK(line.cell.at("name") == who.name);
        CHECK(line.number("heading_deg") == Approx(who.heading_deg));
        // A joint may differ by 2e-3 where the arm is straight, as docs/command.md says.
        if (who.size == 1)
            for (std::size_t j = 0; j < 3; ++j)
                CHECK(line.joint[j].angularDistance(own[(line.frame + who.start) % frames].joint[j]) < 2e-3);
        const Vector3d hips = joint_in(stage.clip, who.start, "Hips").position,
                       at = Eigen::AngleAxisd(who.heading_deg / kDegrees, Vector3d::UnitY()) * (who.size * hips);
        CHECK(line.number("place_x") + at.x() == Approx(who.place.x()).margin(1e-3));
        CHECK(line.number("place_z") + at.z() == Approx(who.place.z()).margin(1e-3));
    }

    // Targets are in the world: rows where the turned clip has its wrists bring the clip's own poses back.
    const Words more = {"--export-targets", "t.csv"};
    const std::vector<PoseLine> plain = stage.rows(crowd + with, "left_arm", ",heading_deg,name", more),
                                back =
                                    stage.rows(crowd + with + "targets = \"t.csv\"\n", "left_arm", ",heading_deg,name");
    CHECK(worst_rotation(plain, back) < 2e-3);
}

TEST_CASE("crowd file: a grid's headings are drawn by the seed, and turn each character where it stands")
{
    const CrowdStage stage(100, 25);
    const std::string crowd = "[crowd]\ncharacters = 9\n";
    const std::vector<PoseLine> ahead = stage.rows(crowd, "left_arm"),
                                turned = stage.rows(crowd + "heading_deg = [-30, 90]\n", "left_arm", ",heading_deg");
    CHECK(worst_rotation(ahead, turned) < 2e-3);
    const Vector3d first = joint_in(stage.clip, 0, "Hips").position;
    for (std::size_t c = 0; c < 9; ++c) {
        const double deg = turned[c].number("heading_deg"), size = turned[c].number("size");
        CHECK((c == 0 ? deg == 0 : deg > -30 && deg < 90 && deg != turned[c - 1].number("heading_deg")));
        const Vector3d at = Eigen::AngleAxisd(deg / kDegrees, Vector3d::UnitY()) * (size * first);
        for (const auto& [column, axis] : {std::pair("place_x", 0), {"place_z", 2}})
            CHECK(turned[c].number(column) + at[axis] ==
                  Approx(ahead[c].number(column) + size * first[axis]).margin(1e-3));
    }
}

TEST_CASE("crowd file: size, stagger, spacing and targets beside the file")
{
    const CrowdStage stage(1200, 50);
    const std::string same = "[crowd]\ncharacters = 4\nsize = [1, 1]\nstagger = false\n";
    const std::vector<PoseLine> rows = stage.rows(same, "left_arm");
    for (std::size_t n = 0; n < rows.size(); n += 4)
        for (std::size_t c = 1; c < 4; ++c) CHECK(rows[n].joint[0].coeffs() == rows[n + c].joint[0].coeffs());
    const std::vector<PoseLine> staggered = stage.rows("[crowd]\ncharacters = 4\nsize = [1, 1]\n", "left_arm");
    CHECK(worst_rotation(rows, staggered) > 0.1);

    // Targets where the clip has its wrists, moved to where each character stands: the clip's poses come back.
    const PlainArm& left = stage.arms[0];
    const double span = 2 * std::max(stage.arms[0].length(), stage.arms[1].length());
    std::string table = "frame,character,limb,x,y,z,pole_x,pole_y,pole_z\n";
    for (std::size_t c = 0; c < 4; ++c) {
        const Vector3d place = 5 * span * Vector3d(static_cast<double>(c % 2), 0, static_cast<double>(c / 2));
        const PlainArmPose at = arm_pose(stage.clip, left, 0);
        table += "0," + std::to_string(c) + ",left_arm," + three_cells(at.wrist + place) + "," +
                 three_cells(at.elbow + place) + "\n";
    }
    fs::create_directory(stage.folder / "sub");
    spill(stage.folder / "sub" / "t.csv", table);
    spill(stage.folder / "sub" / "c.toml", same + "spacing = 5\ntargets = \"t.csv\"\n");
    done(run_command(stage.folder.path, {"solve", "clip.bvh", "--crowd", "sub/c.toml", "--out", "out.csv"}));
    const std::vector<PoseLine> placed = pose_lines(slurp(stage.folder / "out.csv"));
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t j = 0; j < 3; ++j)
            CHECK(placed[2 * c].joint[j].angularDistance(rows[c].joint[j]) < 1e-4);  // targets have 6 decimals
}

TEST_CASE("crowd file: joints and bend")
{
    const CrowdStage stage;
    const std::string swapped =
        "[limb.left_arm]\njoints = [\"RightArm\", \"RightForeArm\", \"RightHand\"]\n"
        "[limb.right_arm]\njoints = [\"LeftArm\", \"LeftForeArm\", \"LeftHand\"]\n";
    CHECK(worst_rotation(stage.rows(swapped, "left_arm"), stage.rows("[crowd]\n", "right_arm")) == 0);
    CHECK(stage.json("[limb.right_leg]\njoints = [\"RightUpLeg\", \"RightLeg\", \"RightFoot\"]\n")
              .contains("legs_bound"));

    // The clip's own elbows come back, whichever way the limb is said to bend.
    for (const std::string bend : {"[0, 0, 1]", "[0, 0, -1]"}) {
        const double sign = bend == "[0, 0, 1]" ? 1 : -1;
        const std::string toml = "[limb.left_arm]\nbend = " + bend + "\n";
        CHECK(stage.json(toml).at("arms_bound").at(0).at("bend") == nlohmann::json({0.0, 0.0, sign}));
        CHECK(worst_rotation(stage.rows(toml, "left_arm"), stage.rows("[crowd]\n", "left_arm")) < 1e-4);
    }
}

TEST_CASE("crowd file: target.offset and target.point")
{
    const CrowdStage stage;
    const PlainArm& left = stage.arms[0];
    const PlainMotion moved = stage.motion("[limb.left_arm.target]\noffset = [0.3, -0.2, 0.1]\n");
    std::size_t reached = 0;
    for (std::size_t frame = 0; frame < stage.clip.lines.size(); ++frame) {
        const PlainArmPose from = arm_pose(stage.clip, left, frame), to = arm_pose(moved, left, frame);
        const Vector3d target = from.wrist + Vector3d(0.3, -0.2, 0.1);
        if ((target - from.shoulder).norm() > left.length()) continue;
        CHECK((to.wrist - target).norm() < 1e-5 * left.length());
        ++reached;
    }
    CHECK(reached > 50);
    CHECK((arm_pose(moved, stage.arms[1], 3).wrist - arm_pose(stage.clip, stage.arms[1], 3).wrist).norm() < 1e-4);

    const CrowdStage one(1200, 100000);
    const PlainArmPose at = arm_pose(one.clip, left, 0);
    const Vector3d point = at.shoulder + 0.7 * left.length() * Vector3d(1, 2, 2).normalized();
    const PlainMotion pointed = one.motion("[limb.left_arm.target]\npoint = " + text_of(point) + "\n");
    CHECK((arm_pose(pointed, left, 0).wrist - point).norm() < 1e-5 * left.length());
}

TEST_CASE("crowd file: hand off keeps the wrist's own channels; an effector goes to the target")
{
    const CrowdStage stage;
    const PlainArm& left = stage.arms[0];
    const PlainMotion loose = stage.motion("[limb.left_arm]\nhand = false\n");
    const PlainJoint& wrist = stage.clip.joint(left.wrist);
    for (std::size_t frame = 0; frame < stage.clip.lines.size(); ++frame) {
        for (std::size_t c = 0; c < 3; ++c)
            CHECK(loose.values[frame][wrist.first_channel + c] == stage.clip.values[frame][wrist.first_channel + c]);
        CHECK((arm_pose(loose, left, frame).wrist - arm_pose(stage.clip, left, frame).wrist).norm() <
              1e-5 * left.length());
    }
    const std::vector<PoseLine> rows = stage.rows("[limb.left_arm]\nhand = false\n", "left_arm");
    const std::vector<PlainPose> pose = pose_of(stage.clip, 4);
    const Matrix3d fore = pose[static_cast<std::size_t>(left.elbow)].rotation;
    CHECK(rows[4].joint[2].angularDistance(Quaterniond(fore.transpose() * arm_pose(stage.clip, left, 4).hand)) < 1e-6);

    const CrowdStage one(1200, 100000);
    const PlainArmPose at = arm_pose(one.clip, left, 0);
    const Vector3d effector(1, -0.5, 0.25), point = at.shoulder + 0.6 * left.length() * Vector3d(1, 0, 2).normalized();
    const std::string toml = "[limb.left_arm]\neffector = [1, -0.5, 0.25]\n";
    const PlainArmPose to =
        arm_pose(one.motion(toml + "[limb.left_arm.target]\npoint = " + text_of(point) + "\n"), left, 0);
    CHECK((to.wrist + to.hand * effector - point).norm() < 1e-5 * left.length());
    CHECK((to.hand - at.hand).norm() < 1e-5);
    CHECK((arm_pose(one.motion(toml), left, 0).wrist - at.wrist).norm() <
          1e-5 * left.length());  // the clip's own point
}

TEST_CASE("crowd file: kinds of poles")
{
    const CrowdStage stage;
    const PlainArm& left = stage.arms[0];
    const std::string pole = "[limb.left_arm.pole]\nkind = ";
    for (const std::string kind : {"\"point\"", "\"direction\"", "\"normal\""}) {
        INFO(kind);
        const PlainMotion back = stage.motion(pole + kind + "\n");
        for_bent(stage, left, [&](std::size_t frame) {
            CHECK((arm_pose(back, left, frame).elbow - arm_pose(stage.clip, left, frame).elbow).norm() <
                  1e-4 * left.length());
        });
    }
    // Fixed: the plane of line and elbow holds the direction, on the elbow's side; or has the normal.
    const Vector3d fixed(0.2, -1, 0.3);
    const std::string vector = "\nfixed = " + text_of(fixed) + "\n";
    const PlainMotion directed = stage.motion(pole + "\"direction\"" + vector),
                      normal = stage.motion(pole + "\"normal\"" + vector),
                      point = stage.motion(pole + "\"point\"" + vector),
                      incoming = stage.motion(pole + "\"incoming\"\n"), by_hand = stage.motion(pole + "\"hand\"\n"),
                      half_line = stage.motion(pole + "\"half_line\"\n"),
                      turned = stage.motion("[limb.left_arm.pole]\nangle_deg = 40\n");
    const Vector3d hinge = stage.axes(0).in_joint.col(0);
    for_bent(stage, left, [&](std::size_t frame) {
        const PlainArmPose from = arm_pose(stage.clip, left, frame);
        const Vector3d line = (from.wrist - from.shoulder).normalized();
        const auto plane = [&](const PlainMotion& motion) { return plane_normal(arm_pose(motion, left, frame)); };
        const auto off = [&](const Vector3d& got, const Vector3d& want) {
            return std::abs(angle_about(line, want, got));
        };
        if (angle_between(line, fixed) > 5 && angle_between(line, fixed) < 175) {
            CHECK(off(plane(directed), line.cross(fixed)) < 0.02);
            CHECK(off(plane(point), line.cross(fixed)) < 0.02);  // from the shoulder
        }
        CHECK(off(plane(normal), fixed) < 0.02);
        const Matrix3d upper = pose_of(stage.clip, frame)[static_cast<std::size_t>(left.shoulder)].rotation;
        CHECK(off(plane(incoming), upper * hinge) < 0.02);
        // All joints' axes are parallel at rest. Beyond 20 degrees from the line, the hand alone counts.
        const Vector3d hand = pose_of(stage.clip, frame)[static_cast<std::size_t>(left.wrist)].rotation *
                              stage.clip.joint(left.wrist).offset.normalized();
        if (angle_between(line, hand) > 20.1) CHECK(off(plane(by_hand), hand.cross(line)) < 0.02);
        // The half-line is behind the elbow at rest, -y of the arm frame; the formula's other direction is then z.
        const Matrix3d arm = from.parent * stage.axes(0).in_joint;
        const Vector3d behind = -arm.col(1);
        if (angle_between(line, behind) > 10) CHECK(off(plane(half_line), (line - behind).cross(arm.col(2))) < 0.05);
        CHECK(angle_about(line, plane_normal(from), plane(turned)) == Approx(40).margin(0.02));
    });
}

TEST_CASE("crowd file: a leg's half-line is where its knee bends to")
{
    const CrowdStage stage;
    const PlainArm& left = stage.legs[0];
    const PlainMotion solved =
        stage.motion("[crowd]\nlimbs = \"legs\"\n[limb.left_leg]\nbend = [0, 0, -1]\npole.kind = \"half_line\"\n");
    const Vector3d behind(0, 0, -1), z = stage.clip.joint(left.elbow).offset.normalized(),
                                     y = (behind - behind.dot(z) * z).normalized();
    const auto normal_by = [&](const Vector3d& side, const Vector3d& line) {
        return (line - behind).cross(side).eval();
    };
    // Across the half-line, and such that the leg at rest bends about its hinge.
    Vector3d side = behind.cross(y.cross(z - behind)).normalized();
    if (normal_by(side, z).dot(y.cross(z)) < 0) side = -side;
    for_bent(stage, left, [&](std::size_t frame) {
        const PlainArmPose from = arm_pose(stage.clip, left, frame);
        const Vector3d line = (from.wrist - from.shoulder).normalized(),
                       want = from.parent * normal_by(side, from.parent.transpose() * line);
        CHECK(std::abs(angle_about(line, want, plane_normal(arm_pose(solved, left, frame)))) < 0.05);
    });
}

TEST_CASE("crowd file: an angle for both sides is mirrored on the right one")
{
    const CrowdStage stage;
    const PlainMotion turned = stage.motion("[limb.arms.pole]\nangle_deg = 25\n"),
                      own = stage.motion("[limb.right_arm.pole]\nangle_deg = 25\n");
    for (std::size_t arm = 0; arm < 2; ++arm)
        for_bent(stage, stage.arms[arm], [&](std::size_t frame) {
            const PlainArmPose from = arm_pose(stage.clip, stage.arms[arm], frame);
            const Vector3d line = (from.wrist - from.shoulder).normalized();
            const auto turn = [&](const PlainMotion& motion) {
                return angle_about(line, plane_normal(from), plane_normal(arm_pose(motion, stage.arms[arm], frame)));
            };
            CHECK(turn(turned) == Approx(arm == 0 ? 25 : -25).margin(0.02));
            CHECK(turn(own) == Approx(arm == 0 ? 0 : 25).margin(0.02));
        });
}

TEST_CASE("crowd file: weights blend with the clip's own pose")
{
    const CrowdStage stage;
    const PlainArm& left = stage.arms[0];
    const std::string offset = "[limb.left_arm.target]\noffset = [0.4, -0.3, 0]\n",
                      weights = "[limb.left_arm.weights]\n";
    for (const double weight : {0.0, 0.5}) {
        const PlainMotion blended = stage.motion(offset + weights + "position = " + std::to_string(weight) + "\n");
        for (std::size_t frame = 0; frame < stage.clip.lines.size(); ++frame) {
            const PlainArmPose from = arm_pose(stage.clip, left, frame);
            const Vector3d target = from.wrist + weight * Vector3d(0.4, -0.3, 0);
            if ((target - from.shoulder).norm() < left.length())
                CHECK((arm_pose(blended, left, frame).wrist - target).norm() < 1e-5 * left.length());
        }
    }
    const std::string pole = "[limb.left_arm.pole]\nkind = \"direction\"\nfixed = [0, 1, 0]\n";
    const auto of_pole = stage.rows(pole + weights + "pole = 0\n", "left_arm");
    CHECK(worst_rotation(of_pole, stage.rows("[limb.left_arm.pole]\nkind = \"incoming\"\n", "left_arm")) < 1e-3);
    CHECK(worst_rotation(of_pole, stage.rows(pole, "left_arm")) > 0.1);

    // A table asks for another orientation; without weight the hand keeps its own, relative to the forearm or not.
    const PlainArmPose at = arm_pose(stage.clip, left, 7);
    spill(stage.folder / "t.csv", "frame,character,limb,x,y,z,pole_x,pole_y,pole_z,qx,qy,qz,qw\n7,0,left_arm," +
                                      three_cells(at.wrist) + "," + three_cells(at.elbow) + ",0,0,0,1\n");
    const auto hand = [&](const std::string& toml) {
        return arm_pose(stage.motion("[crowd]\ntargets = \"t.csv\"\n" + toml), left, 7).hand;
    };
    CHECK((hand("") - Matrix3d::Identity()).norm() < 1e-5);
    CHECK((hand(weights + "hand = 0\n") - Matrix3d::Identity()).norm() > 0.1);
    const Quaterniond asked = Quaterniond::Identity(), own(hand(weights + "hand = 0\n")),
                      half(hand(weights + "hand = 0.5\n"));
    CHECK(half.angularDistance(asked) == Approx(half.angularDistance(own)).margin(0.02));
}

TEST_CASE("crowd file: aim points the hand at the target, flexion as given")
{
    const CrowdStage stage;
    const PlainArm& right = stage.arms[1];
    const Vector3d point(3, 25, 60), axis = Vector3d(-1, 0.2, 0).normalized();
    const PlainMotion aimed =
        stage.motion("[limb.right_arm.target]\npoint = [3, 25, 60]\n[limb.right_arm.aim]\naxis = " + text_of(axis) +
                     "\nflexion_deg = 35\n");
    for (std::size_t frame = 0; frame < stage.clip.lines.size(); ++frame) {
        const PlainArmPose at = arm_pose(aimed, right, frame);
        CHECK(angle_between(at.hand * axis, point - at.wrist) < 0.01);
        CHECK(at.bend() * kDegrees == Approx(35).margin(0.01));
    }
}

TEST_CASE("crowd file: a clavicle takes its share")
{
    CrowdStage one(1200, 100000);
    const PlainArm& left = one.arms[0];
    const int clavicle = one.clip.joint(left.shoulder).parent;
    // This clip's own clavicles never turn; this one has.
    for (std::size_t c = 0; c < 3; ++c)
        one.clip.values[0][one.clip.joint(clavicle).first_channel + c] = 10.0 + 5 * static_cast<double>(c);
    std::string line;
    for (const double value : one.clip.values[0]) line += std::to_string(value) + " ";
    spill(one.folder / "clip.bvh", one.clip.header + line + "\n");
    one.clip = plain_motion_of(one.folder / "clip.bvh");
    // As a rigid arm would, the clavicle turns by its share of the angle from the clip's wrist to the target.
    const PlainPose own = pose_of(one.clip, 0)[static_cast<std::size_t>(clavicle)];
    const Vector3d arm = arm_pose(one.clip, left, 0).wrist - own.position;
    const Vector3d point = own.position + Eigen::AngleAxisd(0.5, arm.unitOrthogonal()) * arm;
    const auto left_over = [&](double share) {
        const PlainMotion solved = one.motion("[limb.left_arm.target]\npoint = " + text_of(point) +
                                              "\n[limb.left_arm.clavicle]\nshare = " + std::to_string(share) + "\n");
        CHECK((arm_pose(solved, left, 0).wrist - point).norm() < 1e-5 * left.length());
        const PlainPose turned = pose_of(solved, 0)[static_cast<std::size_t>(clavicle)];
        return angle_between(turned.rotation * own.rotation.transpose() * arm, point - turned.position);
    };
    const double whole = 0.5 * kDegrees;
    CHECK(left_over(0) == Approx(whole).margin(1e-3));
    CHECK(left_over(1) < 0.01);
    CHECK(left_over(0.5) == Approx(0.5 * whole).epsilon(0.1));
    const std::string share = "[limb.left_arm.clavicle]\nshare = 0.5\n";
    const PoseLine row = one.rows(share, "left_arm", ",clavicle_x,clavicle_y,clavicle_z,clavicle_w")[0];
    const PlainMotion solved = one.motion(share);
    const Matrix3d above = pose_of(solved, 0)[static_cast<std::size_t>(one.clip.joint(clavicle).parent)].rotation;
    const Matrix3d local = above.transpose() * pose_of(solved, 0)[static_cast<std::size_t>(clavicle)].rotation;
    CHECK((row.rotation("clavicle").toRotationMatrix() - local).norm() < 1e-5);
}

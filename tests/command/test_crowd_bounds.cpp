// SPDX-License-Identifier: MIT
//
// The bounds of a crowd file hold in the poses that `swivel solve` writes. An oracle of angles judges joint limits, and
// the formula judges reach. Steps of the swivel, twist bones and budgets are checked, too.
#include <catch2/catch.hpp>

#include <functional>
#include <set>

#include "swivel/swivel.h"
#include "tests/crowd_stage.h"
#include "tests/limit_oracle.h"

using namespace swivel::test;

namespace {

// How far a pose is outside of a limit, as a cosine, about the arm frame's axes.
using Violation = std::function<double(const Quaterniond& shoulder, const Quaterniond& wrist)>;

constexpr double kKept = 3e-5;  // of a cosine: what a CSV's rotations of floats leave of the solver's 1e-6

// The clip's own wishes break the limit, all poses keep it where any swivel can, and flags tell.
void require_limit(const CrowdStage& stage, std::size_t arm, const std::string& limits, unsigned flag,
                   const Violation& violation)
{
    INFO(limits);
    const std::string limb = arm == 0 ? "left_arm" : "right_arm";
    const ArmAxes axes = stage.axes(arm);
    const auto outside = [&](const PoseLine& row) { return violation(axes.of(row.joint[0]), axes.of(row.joint[2])); };
    const auto wished = stage.rows("[crowd]\n", limb), kept = stage.rows(limits, limb);
    REQUIRE(wished.size() == kept.size());
    std::size_t broken = 0, mended = 0, unlike_flag = 0;
    double worst = -1;
    for (std::size_t n = 0; n < wished.size(); ++n) {
        const double was = outside(wished[n]), is = outside(kept[n]);
        const bool limited = (kept[n].flags & flag) != 0, feasible = (kept[n].flags & SWIVEL_INFEASIBLE) == 0;
        broken += was > kKept;
        unlike_flag += std::abs(was) > kKept && limited != (was > 0);
        mended += limited && feasible;
        if (feasible) worst = std::max(worst, is);
    }
    CHECK(broken > 10);
    CHECK(unlike_flag == 0);
    CHECK(mended > 5);
    CHECK(worst < kKept);
}

AngleRange degrees(double min, double max) { return {0.5 * (min + max) / kDegrees, 0.5 * (max - min) / kDegrees}; }

const Vector3d kBone = Vector3d::UnitZ();

Violation cone(const Vector3d& axis, double opening_deg, bool of_hand)
{
    return [=](const Quaterniond& shoulder, const Quaterniond& wrist) {
        const Vector3d unit = axis.normalized();
        return of_hand ? cone_violation(kBone, std::cos(opening_deg / kDegrees), wrist * unit)
                       : cone_violation(unit, std::cos(opening_deg / kDegrees), shoulder * kBone);
    };
}
Violation twist(const Vector3d& axis, const AngleRange& range, bool of_wrist)
{
    return [=](const Quaterniond& shoulder, const Quaterniond& wrist) {
        return twist_violation(axis.normalized(), range, of_wrist ? wrist : shoulder);
    };
}
Violation box(const AngleBox& box, bool of_wrist)
{
    return [=](const Quaterniond& shoulder, const Quaterniond& wrist) {
        return box_violation(box, (of_wrist ? wrist : shoulder).toRotationMatrix());
    };
}

}  // namespace

TEST_CASE("crowd bounds: limits are kept wherever a swivel can, those for both sides mirrored on the right one")
{
    const CrowdStage stage;
    require_limit(stage, 0, "[limb.left_arm.limits.shoulder_cone]\naxis = [0.3, 0.2, 0.6]\nopening_deg = 74\n",
                  SWIVEL_LIMITED_SHOULDER_CONE, cone({0.3, 0.2, 0.6}, 74, false));
    require_limit(stage, 0, "[limb.left_arm.limits]\nforearm_twist_deg = [-8, 4]\n", SWIVEL_LIMITED_FOREARM_TWIST,
                  twist(kBone, degrees(-8, 4), true));
    require_limit(stage, 0, "[limb.left_arm.limits.hand_cone]\naxis = [0.3, 0, 1]\nopening_deg = 14\n",
                  SWIVEL_LIMITED_HAND_CONE, cone({0.3, 0, 1}, 14, true));
    require_limit(stage, 0, "[limb.left_arm.limits.hand_twist]\naxis = [0.2, 0, 1]\nrange_deg = [-8, 4]\n",
                  SWIVEL_LIMITED_HAND_TWIST, twist({0.2, 0, 1}, degrees(-8, 4), true));
    require_limit(
        stage, 0, "[limb.left_arm.limits.shoulder_box]\norder = \"YZX\"\nx_deg = [-60, 20]\nz_deg = [-50, 50]\n",
        SWIVEL_LIMITED_SHOULDER_BOX, box({{1, 2, 0}, {degrees(-180, 180), degrees(-50, 50), degrees(-60, 20)}}, false));
    require_limit(stage, 0, "[limb.left_arm.limits.wrist_box]\nz_deg = [-15, 10]\n", SWIVEL_LIMITED_WRIST_BOX,
                  box({{0, 1, 2}, {degrees(-180, 180), degrees(-180, 180), degrees(-15, 10)}}, true));
    require_limit(stage, 1, "[limb.arms.limits.shoulder_cone]\naxis = [0.3, 0.2, 0.6]\nopening_deg = 74\n",
                  SWIVEL_LIMITED_SHOULDER_CONE, cone({-0.3, 0.2, 0.6}, 74, false));
    require_limit(stage, 1, "[limb.all.limits]\nhumeral_twist_deg = [-20, 25]\n", SWIVEL_LIMITED_HUMERAL_TWIST,
                  twist(kBone, degrees(-25, 20), false));
    require_limit(stage, 1, "[limb.right.limits]\nhumeral_twist_deg = [-20, 25]\n", SWIVEL_LIMITED_HUMERAL_TWIST,
                  twist(kBone, degrees(-20, 25), false));
    require_limit(stage, 1, "[limb.arms.limits.wrist_box]\norder = \"ZXY\"\nz_deg = [-15, 10]\n",
                  SWIVEL_LIMITED_WRIST_BOX,
                  box({{2, 0, 1}, {degrees(-10, 15), degrees(-180, 180), degrees(-180, 180)}}, true));
}

TEST_CASE("crowd bounds: regions are kept, those for both sides mirrored on the right one")
{
    const CrowdStage stage;
    const std::string cones = "cones = [{axis = [0.3, 0.2, 0.6], opening_deg = 74}]\n";
    require_limit(stage, 0, "[limb.left_arm.limits.region]\n" + cones, SWIVEL_LIMITED_REGION,
                  cone({0.3, 0.2, 0.6}, 74, false));
    require_limit(stage, 1, "[limb.arms.limits.region]\n" + cones, SWIVEL_LIMITED_REGION,
                  cone({-0.3, 0.2, 0.6}, 74, false));
    const std::string polygon = "polygons = [{corners = [[1, 0.2, -0.5], [-0.6, 1, -0.3], [0, -0.3, 1]]}]\n";
    for (const std::size_t arm : {0u, 1u})
        require_limit(stage, arm, "[limb.arms.limits.region]\n" + polygon, SWIVEL_LIMITED_REGION,
                      [=](const Quaterniond& shoulder, const Quaterniond&) {
                          Vector3d d = shoulder * kBone;
                          if (arm == 1) d.x() = -d.x();
                          const Vector3d corner[] = {{1, 0.2, -0.5}, {-0.6, 1, -0.3}, {0, -0.3, 1}};
                          double out = -1;
                          for (int n = 0; n < 3; ++n)
                              out = std::max(out, -corner[n].cross(corner[(n + 1) % 3]).normalized().dot(d));
                          return out;
                      });
    const Violation forbidden = cone({-1, 0.1, 0.1}, 30, false);
    require_limit(stage, 0,
                  "[limb.left_arm.limits.region]\ncones = [{opening_deg = 170}]\n"
                  "forbidden = [{axis = [-1, 0.1, 0.1], opening_deg = 30}]\n",
                  SWIVEL_LIMITED_REGION, [=](const auto& shoulder, const auto& wrist) {
                      return std::max(-forbidden(shoulder, wrist), cone(kBone, 170, false)(shoulder, wrist));
                  });
}

TEST_CASE("crowd bounds: a region about where the clip's arm points allows the clip, and not all else")
{
    const CrowdStage stage;
    const std::string region = "[limb.arms.limits.region]\nclip_margin_deg = 3\n";
    const auto limited = [&](const std::string& toml, const std::string& limb) {
        const auto rows = stage.rows(toml, limb);
        return std::ranges::count_if(rows, [](const PoseLine& row) { return row.flags & SWIVEL_LIMITED_REGION; });
    };
    for (const std::string limb : {"left_arm", "right_arm"}) {
        CHECK(limited(region, limb) == 0);
        CHECK(limited(region + "[limb.arms.target]\noffset = [0, 6, 3]\n", limb) > 5);
    }
}

TEST_CASE("crowd bounds: the elbow's flexion")
{
    const CrowdStage stage;
    const PlainMotion kept = stage.motion("[limb.left_arm.limits]\nflexion_deg = [30, 60]\n");
    std::size_t broken = 0;
    for (std::size_t frame = 0; frame < stage.clip.lines.size(); ++frame) {
        const double was = arm_pose(stage.clip, stage.arms[0], frame).bend() * kDegrees,
                     is = arm_pose(kept, stage.arms[0], frame).bend() * kDegrees;
        broken += was < 30 || was > 60;
        CHECK(is == Approx(std::clamp(was, 30.0, 60.0)).margin(0.1));
    }
    CHECK(broken > 20);
}

TEST_CASE("crowd bounds: reach")
{
    const CrowdStage one(1200, 100000);
    const PlainArm& left = one.arms[0];
    const PlainArmPose at = arm_pose(one.clip, left, 0);
    const Vector3d way = Vector3d(1, 1, 2).normalized();
    const double length = left.length();
    const auto toml = [&](double share, const std::string& reach) {
        return "[limb.left_arm.target]\npoint = " + text_of(at.shoulder + share * length * way) +
               "\n[limb.left_arm.reach]\n" + reach;
    };
    const auto distance = [&](double share, const std::string& reach) {
        return (arm_pose(one.motion(toml(share, reach)), left, 0).wrist - at.shoulder).norm() / length;
    };
    // d - (d - R + s)^2 / 4s about R = 1, and its mirror image about the least distance.
    CHECK(distance(0.95, "soft_far = 0.2\n") == Approx(0.95 - 0.15 * 0.15 / 0.8).epsilon(1e-5));
    CHECK(distance(1.3, "soft_far = 0.2\n") == Approx(1).epsilon(1e-5));
    CHECK(distance(0.5, "soft_far = 0.2\n") == Approx(0.5).epsilon(1e-5));
    CHECK(distance(0.3, "min_distance = 0.4\n") == Approx(0.4).epsilon(1e-5));
    CHECK(distance(0.45, "min_distance = 0.4\nsoft_near = 0.1\n") == Approx(0.45 + 0.05 * 0.05 / 0.4).epsilon(1e-5));

    const auto stretch = [&](double share, const std::string& reach) {
        return one.rows(toml(share, reach), "left_arm", ",stretch")[0].number("stretch");
    };
    CHECK(stretch(1.2, "max_stretch = 1.5\n") == Approx(1.2).epsilon(1e-5));
    CHECK(stretch(2, "max_stretch = 1.5\n") == 1.5);
    CHECK(stretch(0.8, "max_stretch = 1.5\n") == 1);
}

namespace {

// How far the swivel plane turns from frame to frame, in degrees, carried across the new line as the shoulder's parent
// sees both.
std::vector<double> steps(const PlainMotion& motion, const PlainArm& arm)
{
    std::vector<double> steps;
    Vector3d before = Vector3d::Zero();
    for (std::size_t frame = 0; frame < motion.lines.size(); ++frame) {
        const PlainArmPose at = arm_pose(motion, arm, frame);
        const Vector3d line = at.parent.transpose() * (at.wrist - at.shoulder),
                       normal = at.parent.transpose() * plane_normal(at);
        if (frame > 0) steps.push_back(std::abs(angle_about(line.normalized(), before, normal)));
        before = normal.normalized();
    }
    return steps;
}

}  // namespace

TEST_CASE("crowd bounds: the swivel turns no further in a frame than it may")
{
    const CrowdStage stage(1000, 4);
    const PlainArm& left = stage.arms[0];
    const auto max = [](const std::vector<double>& all) { return *std::max_element(all.begin(), all.end()); };
    REQUIRE(max(steps(stage.clip, left)) > 3);
    const std::string swivel = "[limb.left_arm.swivel]\nmax_deg_per_";
    const double frame_time = stage.json("[crowd]\n").at("frame_time");
    for (const std::string& limit : {std::string("frame = 1.5"), "second = " + std::to_string(1.5 / frame_time)})
        CHECK(max(steps(stage.motion(swivel + limit + "\n"), left)) == Approx(1.5).margin(0.02));
    CHECK(stage.json(swivel + "frame = 1.5\n").at("flags").at("limited step") > 10);

    // Character 1 starts within the clip. Where it starts the clip again nothing holds its elbow back.
    const std::string crowd = "[crowd]\ncharacters = 2\nsize = [1, 1]\n";
    const auto free = stage.rows("[crowd]\n", "left_arm"),
               held = stage.rows(crowd + swivel + "frame = 0.01\n", "left_arm");
    std::size_t as_at_first = 0;
    for (const PoseLine& row : held)
        as_at_first += row.character == 1 && row.joint[0].angularDistance(free[0].joint[0]) < 1e-5;
    CHECK(as_at_first == 1);
}

TEST_CASE("crowd bounds: one limb's step wins, and not another's")
{
    const CrowdStage stage;
    const std::string steps =
        "[limb.arms]\nswivel.max_deg_per_frame = 2\n"
        "limits.shoulder_cone = {axis = [0.3, 0.2, 0.6], opening_deg = 74}\n";
    const std::string wins = steps + "[limb.left_arm]\nswivel.step_wins = true\n";
    CHECK(worst_rotation(stage.rows(wins, "right_arm"), stage.rows(steps, "right_arm")) == 0);
    CHECK(worst_rotation(stage.rows(wins, "left_arm"), stage.rows(steps, "left_arm")) > 0.01);
}

TEST_CASE("crowd bounds: twist bones share what is new of the hand's twist")
{
    const CrowdStage stage;
    const std::string columns = ",twist1_x,twist1_y,twist1_z,twist1_w,twist2_x,twist2_y,twist2_z,twist2_w";
    const std::string toml = "[limb.left_arm]\ntwist_bones = 2\n", raised = "target.offset = [0, 3, 0]\n";
    const ArmAxes axes = stage.axes(0);
    const auto twist_of = [&](const Quaterniond& joint) {
        const Quaterniond turn = axes.of(joint);
        return 2 * std::atan2(turn.z(), turn.w()) * kDegrees;
    };
    const auto own = stage.rows(toml, "left_arm", columns), moved = stage.rows(toml + raised, "left_arm", columns);
    std::size_t turned = 0;
    for (std::size_t n = 0; n < own.size(); ++n) {
        const double whole = twist_of(moved[n].joint[2]) - twist_of(own[n].joint[2]);
        for (int bone = 1; bone <= 2; ++bone) {
            const std::string column = "twist" + std::to_string(bone);
            const Quaterniond twist = axes.of(moved[n].rotation(column));
            CHECK(2 * std::atan2(twist.z(), twist.w()) * kDegrees == Approx(bone * whole / 3).margin(0.13));
            CHECK(std::hypot(twist.x(), twist.y()) < 1e-5);
            CHECK(own[n].rotation(column).angularDistance(Quaterniond::Identity()) < 1e-4);
        }
        turned += std::abs(whole) > 10;
    }
    CHECK(turned > 10);
    CHECK(stage.rows(toml, "right_arm", columns)[0].cell.at("twist1_x").empty());
}

TEST_CASE("crowd bounds: a budget solves so many blocks of characters in a frame, in turns")
{
    const CrowdStage stage(100, 50);
    const std::size_t frames = stage.clip.lines.size();
    const std::string crowd =
        "[crowd]\ncharacters = 48\nstagger = false\n[budget]\nblocks = 1\n[limb.left_arm]\nhand = false\n";
    CHECK(stage.json(crowd).at("arms") == 96 + 32 * (frames - 1));
    std::map<std::string, std::vector<std::set<std::size_t>>> changed;
    for (const char* limb : {"left_arm", "right_arm"}) {
        std::map<std::size_t, std::string> before;
        changed[limb].resize(frames);
        for (const PoseLine& row : stage.rows(crowd, limb)) {
            const std::string pose = row.cell.at("shoulder_x") + row.cell.at("shoulder_y") + row.cell.at("elbow_x");
            if (before[row.character] != pose) changed[limb][row.frame].insert(row.character);
            before[row.character] = pose;
        }
    }
    CHECK(changed["left_arm"] == changed["right_arm"]);
    for (std::size_t frame = 4; frame < frames; ++frame) {
        CHECK(changed["left_arm"][frame].size() == 16);
        CHECK(changed["left_arm"][frame] == changed["left_arm"][frame - 3]);
        CHECK(changed["left_arm"][frame] != changed["left_arm"][frame - 1]);
    }
}

TEST_CASE("crowd bounds: the examples run")
{
    const CrowdStage stage;
    const fs::path examples = fs::path(SWIVEL_SOURCE_DIR) / "examples";
    const std::string columns =
        ",stretch,clavicle_x,clavicle_y,clavicle_z,clavicle_w,twist1_x,twist1_y,twist1_z,twist1_w,twist2_x,twist2_y,"
        "twist2_z,twist2_w";
    CHECK(stage.rows(slurp(examples / "crowd.toml"), "left_leg", columns).size() == 40 * stage.clip.lines.size());
    const PlainArmPose kick = arm_pose(stage.motion(slurp(examples / "kick.toml")), stage.legs[1], 10);
    CHECK(angle_between(kick.hand.col(2), Vector3d(0, 12, 60) - kick.wrist) < 0.01);
}

// SPDX-License-Identifier: MIT
//
// The promise: with SWIVEL_POLE_HALF_LINE nobody gives a pole. The swivel plane's normal is (u - R) x V, made
// orthogonal to u, by Eigen in double: u is the direction to the wrist, R pole_behind, and V such that an elbow at rest
// lies where the limb bends from. Elbows jump where a wrist passes R alone.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include <rapidcheck/catch.h>

#include "swivel/swivel_explain.hpp"
#include "tests/body_crowd.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr double kDegree = std::numbers::pi / 180;

// The normal for a wrist in a direction, both in the arm frame, of any length. V is the one direction across R for
// which the formula gives the hinge, x, at rest, z.
Vector3d normal_of(const Vector3d& behind, const Vector3d& direction)
{
    const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ(), r = behind.normalized();
    const auto by = [&](const Vector3d& v, const Vector3d& u) -> Vector3d {
        const Vector3d n = (u - r).cross(v);
        return n - n.dot(u) * u;
    };
    Vector3d v = r.cross(y.cross(z - r)).normalized();
    if (by(v, z).dot(x) < 0) v = -v;
    return by(v, direction.normalized());
}

swivel_limb_def half_line(std::uint32_t limb_count, const Vector3d& behind, swivel_features more = 0)
{
    swivel_limb_def made = limbs(limb_count, SWIVEL_POLE_HALF_LINE | more);
    std::ranges::copy(floats(behind), made.pole_behind);
    return made;
}
LimbPose solved(const swivel_limb_def& def, const Arm& arm)
{
    Crowd crowd(def);
    write_arm(crowd, 0, arm);
    crowd.solve({.on_this_thread = true});
    return pose_of(crowd);
}

// Directions all over the sphere, each within `step` of the one before: rings about an axis, one after the other.
std::vector<Vector3d> swept_sphere(double step, double between_rings, const Quaterniond& turn)
{
    std::vector<Vector3d> all;
    for (double polar = 0.5 * step; polar < std::numbers::pi; polar += step) {
        const bool is_ring = std::fmod(polar, between_rings) < step;
        const double width = is_ring ? 2 * std::numbers::pi : 0;  // otherwise straight on to the next ring
        const auto count = static_cast<int>(std::ceil(width * std::sin(polar) / step));
        for (int n = 0; n <= count; ++n) {
            const double azimuth = count > 0 ? width * n / count : 0;
            all.push_back(turn * Vector3d(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                                          std::cos(polar)));
        }
    }
    return all;
}

// How many steps of a sweep turn the swivel plane by more than 20 degrees: all, and those further than 10 degrees from
// a direction.
struct Jumps {
    int all = 0, elsewhere = 0;
};
Jumps jumps_of(const swivel_limb_def& def, const std::vector<Vector3d>& sweep, const Vector3d& behind)
{
    Crowd crowd(def);
    std::vector<Float3> targets;
    for (const Vector3d& direction : sweep) targets.push_back(floats(Vector3d(1.5 * direction)));
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
    if (def.features & SWIVEL_WORLD) crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0, 0, 0});
    crowd.solve();
    const std::vector<Float4> shoulders = read<Float4>(crowd, SWIVEL_SHOULDER);
    Jumps jumps;
    for (std::size_t n = 1; n < sweep.size(); ++n) {
        const Vector3d before = quat(shoulders[n - 1]) * Vector3d::UnitX(),
                       now = quat(shoulders[n]) * Vector3d::UnitX();
        if (angle_between(before, now) <= 20 * kDegree) continue;
        ++jumps.all;
        jumps.elsewhere += angle_between(sweep[n], behind) > 10 * kDegree;
    }
    return jumps;
}

}  // namespace

TEST_CASE("the normal of an elbow without a pole is that of the half-line")
{
    rc::prop("for any half-line", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 100; ++n) {
            const Arm arm = random_reachable(random);
            const Vector3d behind = random.spread(1e-6, 1e6) * random.direction();
            const double from_behind = angle_between(behind, arm.wrist);
            if (from_behind < 0.01 || angle_between(behind, Vector3d::UnitZ()) < 0.01) continue;
            const LimbPose got = solved(half_line(1, behind), arm);
            RC_ASSERT((got.hinge() - normal_of(behind, arm.wrist).normalized()).norm() <= 3e-6 + 2e-6 / from_behind);
            RC_ASSERT(!(got.flags & SWIVEL_SWIVEL_UNDEFINED));
        }
    });
    rc::prop("in the frame of the shoulder's parent, where joints have frames", [](std::uint64_t seed) {
        Random random{seed};
        const BodySkeleton skeleton = random_body_skeleton(random, {2, 1, 1, false});
        const Vector3d behind = random.direction();
        swivel_limb_def def = half_line(1, behind, SWIVEL_WORLD | SWIVEL_JOINTS);
        def.binding = bind(skeleton.view(), skeleton.joints(0));
        const Quaterniond parent = random.rotation(), arm_in_parent = quat(def.binding.parent_from_arm);
        const Vector3d behind_in_arm = arm_in_parent.conjugate() * behind, direction = random.direction();
        const double length = double{def.binding.lengths[0]} + double{def.binding.lengths[1]};
        if (angle_between(behind_in_arm, direction) < 0.1 || angle_between(behind_in_arm, Vector3d::UnitZ()) < 0.1)
            return;
        swivel_limb_def by_normal = def;
        by_normal.features = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_POLE_NORMAL;
        std::fill_n(by_normal.pole_behind, 3, 0.0f);
        Crowd crowd({def, by_normal});
        for (std::uint32_t group = 0; group < 2; ++group) {
            crowd.write_all(SWIVEL_SHOULDER_POSITION, group, Float3{0, 0, 0});
            crowd.write_all(SWIVEL_PARENT_ROTATION, group, floats(parent));
            crowd.write_all(SWIVEL_TARGET, group,
                            floats(Vector3d(0.8 * length * (parent * (arm_in_parent * direction)))));
        }
        crowd.write_all(SWIVEL_POLE, 1,
                        floats(Vector3d(parent * (arm_in_parent * normal_of(behind_in_arm, direction)))));
        crowd.solve();
        for (const swivel_field joint : {SWIVEL_SHOULDER, SWIVEL_ELBOW})
            RC_ASSERT(distance(quat(value_of<Float4>(crowd, joint, 0, 0)),
                               quat(value_of<Float4>(crowd, joint, 1, 0))) <= 3e-5);
    });
}

TEST_CASE("an arm and a leg at rest have their elbow and knee where they bend from")
{
    // Left, forwards and up are x, z and y: an arm to the left bends forwards, a leg down bends backwards.
    const struct {
        Vector3d bone, bend, behind, forwards;                      // where the wrist goes, too
    } cases[] = {{{1, 0, 0}, {0, 0, 1}, {0, 0, 0}, {0, 0, 1}},      // an arm, by default behind the back
                 {{0, -1, 0}, {0, 0, -1}, {0, 0, -1}, {0, 0, 1}}};  // a leg, which kicks forwards
    for (const auto& [bone, bend, behind, forwards] : cases) {
        const std::int32_t parents[] = {-1, 0, 1, 2};
        const Float3 offsets[] = {{0, 0, 0}, {0, 0, 0}, floats(bone), floats(bone)};
        swivel_skeleton skeleton = swivel_default_skeleton();
        skeleton.parents = {parents, sizeof parents[0]}, skeleton.translations = {offsets, sizeof offsets[0]};
        skeleton.joint_count = 4;
        swivel_limb_joints joints = swivel_default_limb_joints(1, 2, 3);
        std::ranges::copy(floats(bend), joints.bend);
        swivel_limb_def def = half_line(2, behind, SWIVEL_JOINTS | SWIVEL_WORLD);
        def.binding = bind(skeleton, joints);
        Crowd crowd(def);
        crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0, 0, 0});
        crowd.write(SWIVEL_TARGET, 0, std::array{floats(Vector3d(1.5 * bone)), floats(Vector3d(1.5 * forwards))});
        crowd.solve();
        const Vector3d elbow = quat(value_of<Float4>(crowd, SWIVEL_SHOULDER, 0, 0)) * bone;
        const Vector3d off_line = elbow - elbow.dot(bone) * bone;
        CHECK((off_line.normalized() + bend).norm() < 1e-5);
        for (std::uint32_t limb = 0; limb < 2; ++limb)
            CHECK((flags_of(crowd, 0, limb) & (SWIVEL_REACHED | SWIVEL_SWIVEL_UNDEFINED)) == SWIVEL_REACHED);
    }
}

TEST_CASE("an elbow without a pole jumps on its half-line alone")
{
    const Quaterniond turn(Eigen::AngleAxisd(1, Vector3d(0.3, 0.5, 0.8).normalized()));
    const std::vector<Vector3d> sweep = swept_sphere(0.2 * kDegree, 1 * kDegree, turn);
    const auto count = static_cast<std::uint32_t>(sweep.size());
    const Vector3d behind(0.2, -0.9, 0.4), down(0, -1, 0);
    CHECK(jumps_of(half_line(count, behind), sweep, behind).elsewhere == 0);
    CHECK(jumps_of(half_line(count, Vector3d::Zero()), sweep, down).elsewhere == 0);
    // Poles, which begin as (0, -1, 0), have a whole line where elbows jump.
    CHECK(jumps_of(limbs(count), sweep, down).elsewhere > 0);
    CHECK(jumps_of(limbs(count, SWIVEL_WORLD | SWIVEL_POLE_DIRECTION), sweep, down).elsewhere > 0);
}

TEST_CASE("on the half-line the elbow is where an undefined pole leaves it")
{
    const Vector3d behind(0.6, 0, -0.8);
    for (const double from_behind : {0.9e-3, 1.1e-3}) {
        const Vector3d direction = (behind + from_behind * Vector3d::UnitY()).normalized();
        const LimbPose got = solved(half_line(1, behind), rounded(Arm{1.5 * direction, Vector3d::Zero(), 1, 1}));
        CHECK(((got.flags & SWIVEL_SWIVEL_UNDEFINED) != 0) == (from_behind < 1e-3));
        CHECK((got.wrist_place() - 1.5 * direction).norm() < 3e-6);
        if (from_behind > 1e-3)
            CHECK((got.hinge() - normal_of(behind, direction).normalized()).norm() < 2e-3);
        else
            CHECK(angle_between(got.hinge(), Vector3d(0.64, 0, 0.48)) < 0.01);  // the rest hinge, across the line
    }
    Crowd crowd(half_line(1, behind));
    write_arm(crowd, 0, Arm{1.5 * behind, Vector3d::Zero(), 1, 1});
    crowd.solve();
    CHECK_THAT(explain(crowd, 0, 0), Catch::Contains("points along pole_behind"));
}

TEST_CASE("an elbow without a pole takes an angle, a pole's weight and a max swivel")
{
    rc::prop("as one with the same normal as its pole", [](std::uint64_t seed) {
        Random random{seed};
        constexpr swivel_features more =
            SWIVEL_WITH_ANGLE | SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_MAX_SWIVEL;
        const Arm arm = random_reachable(random);
        const Vector3d behind = random.direction();
        if (angle_between(behind, arm.wrist) < 0.1 || angle_between(behind, Vector3d::UnitZ()) < 0.1) return;
        Crowd crowd({half_line(1, behind, more), limbs(1, SWIVEL_POLE_NORMAL | more)});
        const double angle = random.between(-1, 1), step = random.between(0.1, 3), weight = random.between(0.1, 0.9);
        const Float4 shoulder = floats(random.rotation());
        const Vector3d line = arm.wrist.normalized(), incoming = quat(shoulder) * Vector3d::UnitX();
        const Vector3d across = incoming - incoming.dot(line) * line,
                       wish = Eigen::AngleAxisd(angle, line) * normal_of(behind, arm.wrist);
        if (across.norm() < 0.1 || angle_between(across, wish) > 3) return;  // rounding decides which way it turns
        for (std::uint32_t group = 0; group < 2; ++group) {
            crowd.write_all(SWIVEL_TARGET, group, floats(arm.wrist));
            crowd.write_all(SWIVEL_LENGTHS, group, Float2{static_cast<float>(arm.upper), static_cast<float>(arm.fore)});
            crowd.write_all(SWIVEL_INCOMING_SHOULDER, group, shoulder);
            crowd.write_all(SWIVEL_ANGLE, group, cos_sin(angle));
            crowd.write_all(SWIVEL_MAX_SWIVEL, group, cos_sin(step));
            crowd.write_all(SWIVEL_WEIGHTS, group, Float3{1, 1, static_cast<float>(weight)});
        }
        crowd.write_all(SWIVEL_POLE, 1, floats(normal_of(behind, arm.wrist)));
        for (int frame = 0; frame < 2; ++frame) crowd.solve();
        RC_ASSERT(distance(quat(value_of<Float4>(crowd, SWIVEL_SHOULDER, 0, 0)),
                           quat(value_of<Float4>(crowd, SWIVEL_SHOULDER, 1, 0))) <= 1e-4);
    });
}

// SPDX-License-Identifier: MIT
//
// The promise: arms of every valid size, ratio and place are solved to 1e-6 of the arm. The plain formula solves those
// for which it says that it holds, everyday arms among them. The others are solved as whole limbs. A solve corrects the
// incoming pose: the wrist goes to its target wherever that is, also with bones that are straight or have no length.
// Forward kinematics is Eigen's, in double. test_bodies.cpp has whole bodies.
#include "core/correction.h"

#include <utility>

#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include "tests/formula_arm.h"

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr double kMin = 2e-15;  // shorter bones are bad input, nearer wrists on the shoulder

// Sizes from corner to corner of what floats hold, most arms where products of them come near the limits.
Arm sized_arm(Random& random)
{
    const double corners[] = {1e-10, 1e-9, 1e-5, 1, 1e4, 1e7, 1e10};
    const auto size = [&] { return corners[random.below(7)] * random.spread(0.1, 10); };
    Arm arm;
    arm.upper = size();
    arm.fore = random.below(2) ? arm.upper * random.spread(1e-8, 1) : arm.upper * random.spread(0.5, 1);
    arm.fore = std::max(arm.fore, kMin);
    if (random.below(2)) std::swap(arm.upper, arm.fore);
    arm = rounded({Vector3d::UnitX(), Vector3d::UnitY(), arm.upper, arm.fore});
    const double near = std::fabs(arm.upper - arm.fore), far = arm.length();
    const double wrists[] = {near + (far - near) * random.unit(), near + (far - near) * 1e-6 * random.unit(),
                             far * (1 - 1e-6 * random.unit()), far * random.spread(1e-6, 10), size()};
    const Vector3d line = random.direction();
    const double sine = random.spread(1.1e-3, 1), side = random.below(2) ? 1 : -1;
    arm.wrist = std::max(wrists[random.below(5)], kMin) * line;
    arm.pole = size() * (side * std::sqrt(1 - sine * sine) * line + sine * random.across(line));
    return rounded(arm);
}

ArmGoal<float> goal_of(const Arm& arm)
{
    return {mv<float>(arm.wrist), mv<float>(arm.pole), static_cast<float>(arm.upper), static_cast<float>(arm.fore)};
}

bool is_right(const Arm& arm, const LimbPose& pose)
{
    const double d = arm.wrist.norm(), reach = std::clamp(d, std::fabs(arm.upper - arm.fore), arm.length());
    const bool near_enough = (pose.wrist_place() - reach / d * arm.wrist).norm() <= 1e-6 * arm.length();
    const double sine = arm.wrist.normalized().cross(arm.pole.normalized()).norm();
    return near_enough && sine * (pose.hinge() - arm.normal()).norm() <= 1e-6;
}

}  // namespace

TEST_CASE("arms of every size are solved, as plain arms and as whole limbs")
{
    rc::prop("with the same flags", [](std::uint64_t seed) {
        Random random{seed};
        std::vector<Arm> arms;
        for (int n = 0; n < 1000; ++n) arms.push_back(sized_arm(random));
        // The angle is at rest, and makes a whole limb of each.
        const std::vector<LimbPose> plain = solve_all(arms), whole = solve_all(arms, SWIVEL_WITH_ANGLE);
        for (std::size_t n = 0; n < arms.size(); ++n) {
            RC_ASSERT(is_right(arms[n], plain[n]));
            RC_ASSERT(is_right(arms[n], whole[n]));
            RC_ASSERT(plain[n].flags == whole[n].flags);
        }
    });
}

TEST_CASE("everyday arms are plain, so they cost what the benchmarks say")
{
    rc::prop("in metres, centimetres and millimetres", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 1000; ++n) {
            const double unit = n % 3 == 0 ? 1 : n % 3 == 1 ? 100 : 1000;
            Arm arm;
            arm.upper = unit * random.between(0.2, 0.4);
            arm.fore = arm.upper * random.between(0.7, 1.4);
            const Vector3d line = random.direction();
            arm.wrist = unit * random.between(0.05, 1) * line;
            arm.pole = unit * random.between(0.1, 2) * (0.9 * line + 0.43 * random.across(line));
            RC_ASSERT(solve_plain(goal_of(arm)).holds);
        }
    });
}

// The forearm is much shorter than the upper arm, and the pole is far away. So the product of all lengths left the
// range of floats, which once gave a rotor of zeros.
TEST_CASE("the product of all lengths may not overflow unseen")
{
    const Arm arm = rounded({{0x1.7982e6p+14, 0x1.fafb84p+10, -0x1.de74f4p-8},
                             {-0x1.3c4d98p+27, 0x1.372494p+27, 0x1.81a0b2p+5},
                             0x1.7ad6b8p+14,
                             0x1.9b4fc6p-8});
    CHECK(is_right(arm, solve_all({arm})[0]));
}

TEST_CASE("a folded arm with a pole far away is as exact as one with a pole nearby")
{
    Random random{5};
    for (int n = 0; n < 2000; ++n) {
        const double upper = random.between(0.5, 1.5), fore = upper * (1 + 1e-7 * random.between(-9, 9));
        const Vector3d line = random.direction();
        const Arm arm = rounded({random.spread(1e-6, 1e-3) * line, 1e12 * random.across(line), upper, fore});
        CHECK_FALSE(solve_plain(goal_of(arm)).holds);
        CHECK(is_right(arm, solve_all({arm})[0]));
    }
}

namespace {

// An incoming limb: bones of joints whose rotations are any.
struct Posed {
    Vector3d upper, fore, hinge;
    Quaterniond shoulder, elbow;  // in the same space

    double size() const { return upper.norm() + fore.norm(); }
};
Posed random_posed(Random& random, double bend)
{
    const Vector3d line = random.direction(), axis = random.across(line);
    Posed in;
    in.upper = random.between(0.1, 1) * line;
    in.fore = random.between(0.1, 1) * (Eigen::AngleAxisd(bend, axis) * line);
    in.shoulder = random.rotation(), in.elbow = random.rotation();
    in.hinge = random.across(in.upper);
    return in;
}
template <class T>
BoneLines<T> posed_bones(const Posed& in)
{
    return bone_lines(mv<T>(in.upper), mv<T>(in.fore));
}
template <class T>
BendNormals<T> posed_normals(const Posed& in)
{
    return bend_normals(posed_bones<T>(in), mv<T>(in.hinge));
}

// A joint turns by what carries its incoming bone's frame to the solved one.
struct CorrectedLimb {
    Quaterniond shoulder, elbow;
    Vector3d wrist;  // where the bones then end

    CorrectedLimb(const Posed& in, const Vector3d& target, const Vector<float>& normal)
    {
        const BoneLines<float> bones = posed_bones<float>(in);
        FreeLimb limb({target, eigen(normal), bones.upper_length, bones.fore_length}, SWIVEL_POLE_NORMAL);
        const LimbPose pose = limb.solve();
        const BoneFrames<float> incoming = bone_frames(bones, normal);
        shoulder = (pose.shoulder * eigen(incoming.upper).conjugate() * in.shoulder).normalized();
        elbow = (pose.shoulder * pose.elbow * eigen(incoming.fore).conjugate() * in.elbow).normalized();
        wrist = shoulder * (in.shoulder.inverse() * in.upper) + elbow * (in.elbow.inverse() * in.fore);
    }
};

}  // namespace

TEST_CASE(
    "the wrist goes to any target in reach, with either normal, straight bones and bones without length among them")
{
    rc::prop("the bones end on it", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 50; ++n) {
            Posed in = random_posed(random, n % 5 ? random.between(-3.1, 3.1) : 0);
            if (n % 7 == 1) in.fore.setZero();
            if (n % 7 == 2) in.upper.setZero();
            const double near = std::fabs(in.upper.norm() - in.fore.norm());
            const Vector3d target = (near + random.between(0.02, 0.98) * (in.size() - near)) * random.direction();
            for (const bool is_steady : {false, true}) {
                const BendNormals<float> normals = posed_normals<float>(in);
                const CorrectedLimb got(in, target, is_steady ? normals.steady : normals.own);
                RC_ASSERT((got.wrist - target).norm() <= 2e-6 * in.size());
                // A bone without a length turns as the other one.
                const Quaterniond with_shoulder = got.shoulder * in.shoulder.inverse() * in.elbow;
                if (n % 7 == 1 || n % 7 == 2) RC_ASSERT(got.elbow.angularDistance(with_shoulder) <= 4e-6);
            }
        }
    });
}

TEST_CASE("the steady normal is the hinge of straight bones, their own of bent ones, and turns slowly between")
{
    Random random{3};
    for (int n = 0; n < 2000; ++n) {
        const Posed straight = random_posed(random, 0);
        Vector3d before = straight.hinge;
        const Vector3d axis = random.across(straight.upper);
        const double side = axis.dot(straight.hinge) < 0 ? -1 : 1;
        for (int step = 0; step <= 300; ++step) {
            Posed bent = straight;
            const double sine = 0.001 * step;
            bent.fore = Eigen::AngleAxisd(-std::asin(sine), axis) * straight.fore;
            const Vector3d normal = eigen(posed_normals<double>(bent).steady).normalized();
            if (sine < 0.05) REQUIRE((normal - straight.hinge).norm() <= 1e-12);
            if (sine > 0.17) REQUIRE((normal - side * axis).norm() <= 1e-9);
            // At most a right angle on the way. The steepest place of the blend is 1.5 times its mean, and a chord of
            // its length 1 is passed at distance sqrt(1/2).
            REQUIRE((normal - before).norm() <= 0.001 / 0.12 * 1.5 * 2 + 1e-9);
            before = normal;
        }
    }
}

// SPDX-License-Identifier: MIT
//
// The promise: the oracle's pose puts the wrist on its target, with the elbow on the pole's side. Random arms are
// posed by Eigen from their joint angles, so that their answer is known before the oracle is asked. One arm is known
// from the literature; see test_formulas.cpp.

#include "core/reference.h"

#include <rapidcheck/catch.h>
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

namespace {

using namespace swivel;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// Wrist and lengths, relative to the whole arm's length.
constexpr double kClosure = 3e-13;

// Directions, rotors and cosines, of size 1. Measured 3e-13 at worst over 300,000 of the arms generated below, for a
// nearly folded arm.
constexpr double kTolerance = 1e-12;

// An arm to solve, and what must come out.
struct PosedArm {
    ReferenceArm goal;
    Vector3d elbow, normal;
    Quaterniond shoulder_rotor, elbow_rotor;
    double cos_flexion;
};

// Even over [lo, hi] whatever size rapidcheck asks for; shrinks towards lo.
double uniform(double lo, double hi)
{
    const int steps = 1000000;
    const int step = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, steps + 1));
    return lo + (hi - lo) * step / steps;
}

double either_sign(double value) { return *rc::gen::arbitrary<bool>() ? value : -value; }

// Bones from 1:10 to 10:1; the upper arm 0.1 rad from e3 and -e3, flexion and twist 0.1 rad from their ends.
PosedArm any_arm()
{
    const double upper = std::exp(uniform(-1.15, 1.15)), fore = std::exp(uniform(-1.15, 1.15));
    const double tilt = uniform(0.1, std::numbers::pi - 0.1), azimuth = uniform(-std::numbers::pi, std::numbers::pi);
    const double twist = either_sign(uniform(0.1, std::numbers::pi - 0.1)),
                 flexion = uniform(0.1, std::numbers::pi - 0.1);

    PosedArm arm;
    // The shoulder turns e3 to `along` by pi about the bisector, after a twist about e3; flexion is about -e1.
    const Vector3d along(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
    const Quaterniond middle(Eigen::AngleAxisd(std::numbers::pi, (along + Vector3d::UnitZ()).normalized()));
    arm.shoulder_rotor = middle * Eigen::AngleAxisd(twist, Vector3d::UnitZ());
    arm.elbow_rotor = Eigen::AngleAxisd(flexion, -Vector3d::UnitX());
    arm.cos_flexion = std::cos(flexion);
    arm.elbow = arm.shoulder_rotor * Vector3d(0, 0, upper);
    arm.normal = arm.shoulder_rotor * Vector3d::UnitX();

    const Vector3d wrist = arm.elbow + arm.shoulder_rotor * arm.elbow_rotor * Vector3d(0, 0, fore);
    // Any point of the elbow's half of the swivel plane is a pole for this pose.
    const Vector3d outward = arm.normal.cross(wrist).normalized();
    const double forward = uniform(-2, 2), aside = uniform(0.1, 5);
    const Vector3d pole = forward * wrist + aside * outward;
    arm.goal = {{wrist.x(), wrist.y(), wrist.z()}, {pole.x(), pole.y(), pole.z()}, upper, fore};
    return arm;
}

Vector3d vector_of(const double v[3]) { return {v[0], v[1], v[2]}; }
Quaterniond rotor(const double q[4]) { return {q[3], q[0], q[1], q[2]}; }

// Distance of two rotations: q and -q are one.
double distance(const double q[4], const Quaterniond& p)
{
    const Eigen::Vector4d a = rotor(q).coeffs(), b = p.coeffs();
    return std::fmin((a - b).norm(), (a + b).norm());
}

Vector3d wrist(const ReferencePose& pose, const ReferenceArm& goal)
{
    double out[3];
    wrist_of(pose, goal.upper, goal.fore, out);
    return vector_of(out);
}

}  // namespace

TEST_CASE("the oracle gives random arms back as they were posed", "[reference]")
{
    rc::prop("places and joints", [] {
        for (int n = 0; n < 25; ++n) {
            const PosedArm arm = any_arm();
            const ReferencePose pose = solve_reference(arm.goal);
            const double size = arm.goal.upper + arm.goal.fore;
            RC_ASSERT((vector_of(pose.elbow) - arm.elbow).norm() <= kClosure * size);
            RC_ASSERT((wrist(pose, arm.goal) - vector_of(arm.goal.wrist)).norm() <= kClosure * size);
            RC_ASSERT(std::fabs(pose.cos_flexion - arm.cos_flexion) <= kTolerance);
            RC_ASSERT(distance(pose.elbow_rotor, arm.elbow_rotor) <= kTolerance);
            RC_ASSERT(distance(pose.shoulder_rotor, arm.shoulder_rotor) <= kTolerance);
        }
    });
    rc::prop("every rotor has unit length, q_s = q12 q3, and q12 alone carries e3 to the upper arm", [] {
        const PosedArm arm = any_arm();
        const ReferencePose pose = solve_reference(arm.goal);
        for (const double* q : {pose.elbow_rotor, pose.middle_rotor, pose.twist_rotor, pose.shoulder_rotor})
            RC_ASSERT(std::fabs(rotor(q).norm() - 1) <= kTolerance);
        const Quaterniond product = rotor(pose.middle_rotor) * rotor(pose.twist_rotor);
        RC_ASSERT((rotor(pose.shoulder_rotor).coeffs() - product.coeffs()).norm() <= kTolerance);
        RC_ASSERT((rotor(pose.middle_rotor) * Vector3d::UnitZ() - arm.elbow / arm.goal.upper).norm() <= kTolerance);
    });
    rc::prop("a normal of any length and the pole are two ways to say the same", [] {
        const PosedArm arm = any_arm();
        const ReferenceArm& goal = arm.goal;
        const ReferencePose pose = solve_reference(goal);
        const Vector3d normal = uniform(0.5, 5) * arm.normal;
        const ReferencePose same = solve_reference_for_normal(goal.wrist, normal.data(), goal.upper, goal.fore);
        RC_ASSERT((vector_of(same.elbow) - vector_of(pose.elbow)).norm() <= kClosure * (goal.upper + goal.fore));
        RC_ASSERT(distance(same.shoulder_rotor, rotor(pose.shoulder_rotor)) <= kTolerance);
    });
}

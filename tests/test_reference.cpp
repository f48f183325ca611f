// SPDX-License-Identifier: MIT
//
// The promise: the oracle's pose puts the wrist on its target, with the elbow on the pole's side. Random arms are
// posed by Eigen from their joint angles, so that their answer is known before the oracle is asked; one arm is known
// from the literature.

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

// 25 arms in each of rapidcheck's 100 cases: 2,500 random arms for every property.
template <class Property>
void for_random_arms(Property holds)
{
    for (int n = 0; n < 25; ++n) {
        const PosedArm arm = any_arm();
        holds(arm, solve_reference(arm.goal));
    }
}

}  // namespace

TEST_CASE("the known answer", "[reference]")
{
    // Points, q_e and q12 agree with the public Gaalop test of this algorithm; the sign of its q3 does not close.
    const double target[3] = {1.1, 1.1, 1.1}, normal[3] = {-std::sqrt(0.5), std::sqrt(0.5), 0};
    const ReferencePose pose = solve_reference_for_normal(target, normal, 1.4, 1.3);

    const double last_digit = 1e-6;  // one unit in the sixth decimal: the published digits are of single precision
    CHECK((vector_of(pose.elbow) - Vector3d(0.980883, 0.980883, -0.189039)).cwiseAbs().maxCoeff() < last_digit);
    CHECK(std::fabs(pose.cos_flexion - -0.005494) < last_digit);
    const auto close = [=](const double q[4], double x, double y, double z, double w) {
        return (rotor(q).coeffs() - Eigen::Vector4d(x, y, z, w)).cwiseAbs().maxCoeff() < last_digit;
    };
    CHECK(close(pose.elbow_rotor, -0.709047, 0, 0, 0.705162));
    CHECK(close(pose.middle_rotor, 0.532689, 0.532689, 0.657637, 0));
    CHECK(close(pose.shoulder_rotor, 0.288289, 0.695991, 0.607577, 0.251667));

    // To full precision what has a closed form: the law of cosines, and the bisector of e3 and the upper arm.
    const Vector3d bisector = (vector_of(pose.elbow) / 1.4 + Vector3d::UnitZ()).normalized();
    CHECK(std::fabs(pose.cos_flexion - (3.63 - 1.96 - 1.69) / (2 * 1.4 * 1.3)) < kTolerance);
    CHECK((rotor(pose.middle_rotor).vec() - bisector).norm() < kTolerance);

    double out[3];
    wrist_of(pose, 1.4, 1.3, out);
    CHECK((vector_of(out) - vector_of(target)).norm() <= kClosure * 2.7);
}

TEST_CASE("the length of the normal does not matter", "[reference]")
{
    const double target[3] = {1.1, 1.1, 1.1}, normal[3] = {-1, 1, 0}, longer[3] = {-5, 5, 0};
    const ReferencePose pose = solve_reference_for_normal(target, normal, 1.4, 1.3);
    const ReferencePose same = solve_reference_for_normal(target, longer, 1.4, 1.3);
    CHECK((vector_of(pose.elbow) - vector_of(same.elbow)).norm() < kTolerance);
    CHECK(distance(pose.shoulder_rotor, rotor(same.shoulder_rotor)) < kTolerance);
}

TEST_CASE("an arm bent at a right angle in the plane of e1 and e2", "[reference]")
{
    // By hand: upper arm 2 e1, forearm e2, so the shoulder turns e3 to e1 about e2 and the elbow e3 to e2 about -e1.
    const ReferenceArm arm = {{2, 1, 0}, {3, -1, 0}, 2, 1};
    const ReferencePose pose = solve_reference(arm);
    const double h = std::sqrt(0.5);
    CHECK((vector_of(pose.elbow) - Vector3d(2, 0, 0)).norm() < kTolerance);
    CHECK(std::fabs(pose.cos_flexion) < kTolerance);
    CHECK(distance(pose.elbow_rotor, Quaterniond(h, -h, 0, 0)) < kTolerance);
    CHECK(distance(pose.middle_rotor, Quaterniond(0, h, 0, h)) < kTolerance);
    CHECK(distance(pose.shoulder_rotor, Quaterniond(h, 0, h, 0)) < kTolerance);
}

TEST_CASE("the other side of the pole is the other elbow", "[reference]")
{
    const ReferenceArm arm = {{2, 1, 0}, {-3, 1, 0}, 2, 1};
    const ReferencePose pose = solve_reference(arm);
    // 2 e1 mirrored in the wrist's line along (2, 1, 0).
    CHECK((vector_of(pose.elbow) - Vector3d(1.2, 1.6, 0)).norm() < kTolerance);
}

TEST_CASE("random arms", "[reference]")
{
    rc::prop("forward kinematics puts the wrist on the target", [] {
        for_random_arms([](const PosedArm& arm, const ReferencePose& pose) {
            const double size = arm.goal.upper + arm.goal.fore;
            RC_ASSERT((wrist(pose, arm.goal) - vector_of(arm.goal.wrist)).norm() <= kClosure * size);
        });
    });
    rc::prop("the elbow is at both bones' lengths, in the swivel plane, on the pole's side", [] {
        for_random_arms([](const PosedArm& arm, const ReferencePose& pose) {
            const double size = arm.goal.upper + arm.goal.fore;
            const Vector3d elbow = vector_of(pose.elbow), target = vector_of(arm.goal.wrist);
            RC_ASSERT(std::fabs(elbow.norm() - arm.goal.upper) <= kClosure * size);
            RC_ASSERT(std::fabs((target - elbow).norm() - arm.goal.fore) <= kClosure * size);
            RC_ASSERT(std::fabs(elbow.dot(arm.normal)) <= kClosure * size);
            RC_ASSERT(target.cross(elbow).dot(target.cross(vector_of(arm.goal.pole))) > 0);
            RC_ASSERT((elbow - arm.elbow).norm() <= kClosure * size);
        });
    });
    rc::prop("every rotor has unit length, and q_s = q12 q3", [] {
        for_random_arms([](const PosedArm&, const ReferencePose& pose) {
            for (const double* q : {pose.elbow_rotor, pose.middle_rotor, pose.twist_rotor, pose.shoulder_rotor})
                RC_ASSERT(std::fabs(rotor(q).norm() - 1) <= kTolerance);
            const Quaterniond product = rotor(pose.middle_rotor) * rotor(pose.twist_rotor);
            RC_ASSERT((rotor(pose.shoulder_rotor).coeffs() - product.coeffs()).norm() <= kTolerance);
        });
    });
    rc::prop("q_s carries e3 to the upper arm and e1 to the normal, q12 alone e3 to the upper arm", [] {
        for_random_arms([](const PosedArm& arm, const ReferencePose& pose) {
            const Vector3d along = arm.elbow / arm.goal.upper;
            const Vector3d normal = vector_of(arm.goal.wrist).cross(vector_of(arm.goal.pole)).normalized();
            RC_ASSERT((rotor(pose.middle_rotor) * Vector3d::UnitZ() - along).norm() <= kTolerance);
            RC_ASSERT((rotor(pose.shoulder_rotor) * Vector3d::UnitZ() - along).norm() <= kTolerance);
            RC_ASSERT((rotor(pose.shoulder_rotor) * Vector3d::UnitX() - normal).norm() <= kTolerance);
        });
    });
    rc::prop("the joints are those the arm was posed with", [] {
        for_random_arms([](const PosedArm& arm, const ReferencePose& pose) {
            RC_ASSERT(std::fabs(pose.cos_flexion - arm.cos_flexion) <= kTolerance);
            RC_ASSERT(distance(pose.elbow_rotor, arm.elbow_rotor) <= kTolerance);
            RC_ASSERT(distance(pose.shoulder_rotor, arm.shoulder_rotor) <= kTolerance);
        });
    });
    rc::prop("the plane's normal and the pole are two ways to say the same", [] {
        for_random_arms([](const PosedArm& arm, const ReferencePose& pose) {
            const ReferenceArm& goal = arm.goal;
            const ReferencePose same = solve_reference_for_normal(goal.wrist, arm.normal.data(), goal.upper, goal.fore);
            RC_ASSERT((vector_of(same.elbow) - vector_of(pose.elbow)).norm() <= kClosure * (goal.upper + goal.fore));
            RC_ASSERT(distance(same.shoulder_rotor, rotor(pose.shoulder_rotor)) <= kTolerance);
        });
    });
}

TEST_CASE("forward kinematics is Eigen's", "[reference]")
{
    rc::prop("for rotors made from joint angles", [] {
        const PosedArm arm = any_arm();
        const Eigen::Vector4d q_s = arm.shoulder_rotor.coeffs(), q_e = arm.elbow_rotor.coeffs();
        ReferencePose pose = {};
        for (int c = 0; c < 4; ++c) {
            pose.shoulder_rotor[c] = q_s[c];
            pose.elbow_rotor[c] = q_e[c];
        }
        const double size = arm.goal.upper + arm.goal.fore;
        RC_ASSERT((wrist(pose, arm.goal) - vector_of(arm.goal.wrist)).norm() <= kClosure * size);
    });
}

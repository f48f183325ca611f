// SPDX-License-Identifier: MIT
//
// The promise: the solver is written three times, and the three agree: the dense oracle, the lecture's steps and the
// production formula. swivel_verify() compares them on random arms; here are one known answer, the swivel plane, arms
// of other sizes, and that swivel_verify() measures what it says. Forward kinematics is Eigen's.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include <rapidcheck/catch.h>

#include "core/pipeline.h"
#include "core/reference.h"
#include "core/solve_arm.h"
#include "swivel/lecture.h"
#include "tests/formula_arm.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// Far from where the lecture's formulas divide by zero or lose digits.
Arm regular_arm(Random& random)
{
    for (;;) {
        Arm arm;
        arm.upper = random.spread(0.3, 3);
        arm.fore = random.spread(0.3, 3);
        const double near = std::fabs(arm.upper - arm.fore), far = arm.length();
        const Vector3d line = random.direction();
        arm.wrist = (near + (far - near) * random.between(0.1, 0.95)) * line;
        arm.pole = random.between(-2, 2) * line + random.between(0.3, 2) * random.across(line);
        const Vector3d bone = arm.elbow() / arm.upper;
        const Vector3d middle = (bone + Vector3d::UnitZ()).normalized();
        const Vector3d turned = 2 * arm.normal().dot(middle) * middle - arm.normal();  // c3, s3: the twist
        if (std::fabs(bone.z()) < 0.95 && std::fabs(turned.y()) > 0.1) return arm;
    }
}

// Any arm there is a promise for. Rounded to floats; the pole's line is kept at least 1.1e-3 from the wrist's.
Arm any_arm(Random& random)
{
    const double shorter = 1 / random.spread(1, 1000);
    const bool swap = random.below(2) == 0;
    Arm arm;
    arm.upper = swap ? shorter : 1;
    arm.fore = swap ? 1 : shorter;
    if (random.below(8) == 0) arm.upper = arm.fore = 1;
    arm = rounded(arm);
    const double near = std::fabs(arm.upper - arm.fore), far = arm.length();
    const double share[] = {random.unit(), 1e-4 * random.unit(), 1 - 1e-4 * random.unit(), random.spread(1e-7, 1)};
    Vector3d line = random.direction();
    if (random.below(8) == 0)
        line = (Vector3d(0, 0, random.below(2) ? 1 : -1) + 1e-3 * random.direction()).normalized();
    arm.wrist = (near + (far - near) * share[random.below(4)]) * line;
    const double sine = random.spread(1.1e-3, 1), side = random.below(2) ? 1 : -1;
    arm.pole = random.spread(0.1, 10) * (side * std::sqrt(1 - sine * sine) * line + sine * random.across(line));
    return rounded(arm);
}

template <class Arms, class Property>
void for_arms(std::uint64_t seed, Arms arms, Property holds)
{
    Random random{seed};
    for (int n = 0; n < 50; ++n) holds(arms(random));
}

const double h = std::sqrt(0.5);
const Arm kKnown = {{1.1, 1.1, 1.1}, {0, 0, -1}, 1.4, 1.3};  // its normal p_w x pole is (-1, 1, 0) / sqrt(2)

}  // namespace

// ---- the known answer

TEST_CASE("the known answer: oracle, lecture's steps and production formula")
{
    REQUIRE((kKnown.normal() - Vector3d(-h, h, 0)).norm() < 1e-15);
    const Vector3d elbow(0.980883, 0.980883, -0.189039);
    const double c4 = -0.005494, digit = 1e-6;
    const Quaterniond q_e(0.705162, -0.709047, 0, 0), q12(0, 0.532689, 0.532689, 0.657637),
        q_s(0.251667, 0.288289, 0.695991, 0.607577);

    const double wrist[] = {1.1, 1.1, 1.1}, normal[] = {-h, h, 0};
    const ReferencePose oracle = solve_reference_for_normal(wrist, normal, 1.4, 1.3);
    CHECK((Vector3d(oracle.elbow) - elbow).norm() < 2 * digit);
    CHECK(std::fabs(oracle.cos_flexion - c4) < digit);
    CHECK(distance(eigen(oracle.elbow_rotor), q_e) < 2 * digit);
    CHECK(distance(eigen(oracle.middle_rotor), q12) < 2 * digit);
    CHECK(distance(eigen(oracle.shoulder_rotor), q_s) < 2 * digit);

    const PipelineSteps<double> steps = solve_pipeline(mv<double>(kKnown.wrist), mv<double>(kKnown.normal()), 1.4, 1.3);
    CHECK((eigen(steps.elbow()) - elbow).norm() < 2 * digit);
    CHECK(std::fabs(steps.c4 - c4) < digit);
    CHECK(distance(eigen(steps.q_e), q_e) < 2 * digit);
    const Quaterniond middle(0, steps.q12.at<kI>(), steps.q12.at<kJ>(), steps.q12.at<kK>());
    CHECK(distance(middle, q12) < 2 * digit);
    CHECK(distance(eigen(steps.q_s), q_s) < 2 * digit);

    const auto check_production = [&](const auto& pose) {
        CHECK((elbow_place(pose, kKnown) - elbow).norm() < 2 * digit);
        CHECK(std::fabs(pose.cos_half * pose.cos_half - pose.sin_half * pose.sin_half - c4) < 2 * digit);
        CHECK(distance(elbow_rotation(pose), q_e) < 2 * digit);
        CHECK(distance(eigen(pose.shoulder), q_s) < 2 * digit);
        CHECK((wrist_place(pose, kKnown) - kKnown.wrist).norm() < 1e-6 * kKnown.length());
        CHECK(pose.flags == SWIVEL_REACHED);
    };
    check_production(solve<double>(kKnown));
    check_production(solve<float>(kKnown));
}

TEST_CASE("q_s carries e3 to the upper arm and e1 to the swivel plane's normal")
{
    rc::prop("the upper arm by the law of cosines, over double", [](std::uint64_t seed) {
        for_arms(seed, regular_arm, [](const Arm& arm) {
            const Quaterniond q = eigen(solve<double>(arm).shoulder);
            RC_ASSERT((q * Vector3d::UnitZ() - arm.elbow() / arm.upper).norm() < 1e-12);
            RC_ASSERT((q * Vector3d::UnitX() - arm.normal()).norm() < 1e-12);
        });
    });
    rc::prop("over float: the plane holds shoulder, elbow, wrist and pole, the elbow is on the pole's side",
             [](std::uint64_t seed) {
                 for_arms(seed, any_arm, [](const Arm& arm) {
                     const ArmPose<float> pose = solve<float>(arm);
                     const Vector3d hinge = eigen(pose.shoulder).normalized() * Vector3d::UnitX();
                     // A normal's digits are lost by the sine of the pole's angle.
                     const Vector3d across = arm.wrist.normalized().cross(arm.pole.normalized());
                     RC_ASSERT((across.norm() * hinge - across).norm() < 1e-6);
                     RC_ASSERT(std::fabs(hinge.dot(arm.wrist.normalized())) < 1e-6);
                     const Vector3d elbow = elbow_place(pose, arm);
                     RC_ASSERT(std::fabs(hinge.dot(elbow)) < 1e-6 * arm.length());
                     RC_ASSERT(elbow.dot(arm.normal().cross(arm.wrist.normalized())) > -1e-6 * arm.length());
                 });
             });
}

// ---- equivariance

TEST_CASE("lengths times a power of two give the same arm")
{
    const auto check_sizes = [](const Arm& arm, std::initializer_list<double> sizes) {
        const ArmPose<float> pose = solve<float>(arm);
        for (const double size : sizes) {
            const ArmPose<float> other =
                solve<float>(Arm{size * arm.wrist, size * arm.pole, size * arm.upper, size * arm.fore});
            RC_ASSERT(std::memcmp(pose.shoulder.c, other.shoulder.c, sizeof pose.shoulder.c) == 0);
            RC_ASSERT(pose.cos_half == other.cos_half);
            RC_ASSERT(pose.sin_half == other.sin_half);
            RC_ASSERT(pose.flags == other.flags);
        }
    };
    rc::prop("everyday arms, sizes from 2^-10 to 2^10: the same bits", [=](std::uint64_t seed) {
        const auto everyday = [](Random& random) { return rounded(regular_arm(random)); };
        for_arms(seed, everyday, [=](const Arm& arm) { check_sizes(arm, {0x1p-10, 0x1p-3, 0x1p1, 0x1p10}); });
    });
}

// ---- swivel_verify()

namespace {

struct Line {
    std::string name, set;
    std::uint64_t arm_count;
    double max, rms, max_limit, rms_limit;

    bool operator==(const Line&) const = default;
};

std::vector<Line> verify(std::uint64_t arm_count, std::uint64_t seed)
{
    std::vector<Line> lines;
    const auto add = [](const swivel_check* check, void* user) {
        static_cast<std::vector<Line>*>(user)->push_back(
            {check->name, check->set, check->arm_count, check->max, check->rms, check->max_limit, check->rms_limit});
    };
    REQUIRE(swivel_verify(arm_count, seed, add, &lines) == 1);
    return lines;
}

}  // namespace

TEST_CASE("swivel_verify passes, and says what it measured")
{
    constexpr std::uint64_t arm_count = 20000;
    const std::vector<Line> lines = verify(arm_count, 1);
    std::set<std::string> names, sets;
    for (const Line& line : lines) {
        INFO(line.name << ", " << line.set);
        names.insert(line.name);
        sets.insert(line.set);
        CHECK(line.max_limit > 0);
        CHECK(line.max_limit <= 1e-6);
        CHECK(line.max <= line.max_limit);
        CHECK(line.max > 0);  // something was measured
        CHECK(line.rms <= line.max);
        CHECK(line.rms > 0);
        if (line.rms_limit > 0) CHECK(line.rms <= line.rms_limit);
        CHECK(line.arm_count >= (line.set == "regular arms" ? 50u : 10000u));
    }
    CHECK(lines.size() == 19);
    CHECK(names.size() == 5);
    CHECK(sets.size() == 7);  // regular arms, five bands of reach, hard poses
    // One check each for the oracle, the formula over double, and the wrist in every band.
    const auto count = [&](const char* part) {
        return std::count_if(lines.begin(), lines.end(),
                             [&](const Line& l) { return l.name.find(part) != std::string::npos; });
    };
    CHECK(count("oracle") == 1);
    CHECK(count("production<double>") == 1);
    CHECK(count("wrist") == 6);
}

TEST_CASE("swivel_verify's arms are the seed's, its report may be left out")
{
    const std::vector<Line> one = verify(500, 7), same = verify(500, 7), other = verify(500, 8);
    CHECK(one == same);
    CHECK_FALSE(one == other);
    CHECK(swivel_verify(100, 3, nullptr, nullptr) == 1);
    CHECK(swivel_verify(0, 3, nullptr, nullptr) == 0);
}

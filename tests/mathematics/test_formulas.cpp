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

// Neither nearly straight nor nearly folded, nor with the upper arm nearly along e3.
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

    const ReferencePose oracle = solve_reference({{1.1, 1.1, 1.1}, {0, 0, -1}, 1.4, 1.3});
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

// ---- other sizes

TEST_CASE("an arm with a bad number is bad input by the formula, too")
{
    const Arm good{{0.4, 0.3, 1}, {0, -1, 0}, 1, 0.8};
    CHECK(!(solve<double>(good).flags & SWIVEL_BAD_INPUT));
    for (const double bad : {-1.1e15, 1.1e15, std::nan(""), HUGE_VAL})
        for (int part = 0; part < 4; ++part) {
            Arm arm = good;
            (part == 0 ? arm.wrist.y() : part == 1 ? arm.pole.y() : part == 2 ? arm.upper : arm.fore) = bad;
            CAPTURE(bad, part);
            CHECK(solve<double>(arm).flags & SWIVEL_BAD_INPUT);
        }
}

TEST_CASE("lengths times a power of two give the same arm, to the bit")
{
    rc::prop("everyday arms, sizes from 2^-10 to 2^10", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 50; ++n) {
            const Arm arm = rounded(regular_arm(random));
            const ArmPose<float> pose = solve<float>(arm);
            for (const double size : {0x1p-10, 0x1p-3, 0x1p1, 0x1p10}) {
                const ArmPose<float> other =
                    solve<float>(Arm{size * arm.wrist, size * arm.pole, size * arm.upper, size * arm.fore});
                RC_ASSERT(std::memcmp(pose.shoulder.c, other.shoulder.c, sizeof pose.shoulder.c) == 0);
                RC_ASSERT(pose.cos_half == other.cos_half);
                RC_ASSERT(pose.sin_half == other.sin_half);
                RC_ASSERT(pose.flags == other.flags);
            }
        }
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

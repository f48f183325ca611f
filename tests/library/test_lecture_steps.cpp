// SPDX-License-Identifier: MIT
//
// The promise: swivel_steps() shows the lecture's entities. Each is checked against plain geometry of vectors and
// Eigen's quaternions: points lie on spheres and planes, rotors turn the arm to its target.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include <cmath>
#include <map>
#include <string>

#include "swivel/lecture.h"
#include "tests/test_random.h"

namespace {

using Catch::Matchers::Contains;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using swivel::test::Random;

constexpr std::uint32_t kBlade1 = 1, kBlade2 = 2, kBlade3 = 4, kBladeInf = 8, kBlade0 = 16, kUnitI = 6, kUnitJ = 5,
                        kUnitK = 3;

struct LectureArm {
    Vector3d target, pole;
    double upper, fore;
};

// All entities by name, each name once; none of an arm that is refused.
struct LectureEntities {
    std::map<std::string, swivel_entity> named;
    double closing_error;

    explicit LectureEntities(const LectureArm& arm) : closing_error(0)
    {
        swivel_entity entities[SWIVEL_ENTITY_COUNT];
        if (swivel_steps(arm.target.data(), arm.pole.data(), arm.upper, arm.fore, entities, &closing_error)) return;
        for (const swivel_entity& entity : entities) named[entity.name] = entity;
        REQUIRE(named.size() == SWIVEL_ENTITY_COUNT);
    }
    double at(const std::string& name, std::uint32_t blade) const { return named.at(name).coefficients[blade]; }
    double scalar(const std::string& name) const { return at(name, 0); }
    Vector3d vector(const std::string& name) const { return {at(name, kBlade1), at(name, kBlade2), at(name, kBlade3)}; }
    Quaterniond rotor(const std::string& name) const
    {
        return {at(name, 0), at(name, kUnitI), at(name, kUnitJ), at(name, kUnitK)};
    }
};

// An arm that is neither straight nor folded, with its pole off the line to its target.
LectureArm random_lecture_arm(Random& random)
{
    const double upper = random.between(0.1, 2), fore = random.between(0.1, 2), min = std::fabs(upper - fore);
    const double distance = min + random.between(0.05, 0.95) * (upper + fore - min);
    const Vector3d along = random.direction();
    return {distance * along, random.between(0.2, 3) * (random.across(along) + 0.3 * random.between(-1, 1) * along),
            upper, fore};
}

void check_entities(const LectureArm& arm, const LectureEntities& got)
{
    const Vector3d elbow = got.vector("p_e"), target = arm.target;
    const double size = arm.upper + arm.fore, small = 1e-11 * size;

    // Step 1: points on both spheres and on the plane; spheres as centre and (centre^2 - radius^2) / 2 of einf.
    RC_ASSERT((got.vector("p_w") - target).norm() == 0);
    RC_ASSERT(std::fabs(got.at("p_w", kBladeInf) - target.squaredNorm() / 2) < small * size);
    RC_ASSERT(got.at("p_w", kBlade0) == 1);
    RC_ASSERT((got.vector("S1") - target).norm() == 0);
    RC_ASSERT(std::fabs(2 * got.at("S1", kBladeInf) - (target.squaredNorm() - arm.fore * arm.fore)) < small * size);
    RC_ASSERT(std::fabs(2 * got.at("S2", kBladeInf) + arm.upper * arm.upper) < small * size);
    const Vector3d normal = got.vector("pi_swivel");
    RC_ASSERT((normal - target.cross(arm.pole).normalized()).norm() < 1e-12);
    RC_ASSERT(std::fabs(elbow.norm() - arm.upper) < small);
    RC_ASSERT(std::fabs((elbow - target).norm() - arm.fore) < small);
    RC_ASSERT(std::fabs(elbow.dot(normal)) < small);
    RC_ASSERT(elbow.dot(arm.pole - arm.pole.dot(target) / target.squaredNorm() * target) > 0);

    // Step 2: the lines' directions, the angle between them, and a turn by it about -e1.
    const auto direction = [&](const std::string& line) {
        return Vector3d(got.at(line, kBlade1 | kBladeInf | kBlade0), got.at(line, kBlade2 | kBladeInf | kBlade0),
                        got.at(line, kBlade3 | kBladeInf | kBlade0));
    };
    RC_ASSERT((direction("line_se") - elbow).norm() < small);
    RC_ASSERT((direction("line_ew") - (target - elbow)).norm() < small);
    const double cos_flexion = elbow.normalized().dot((target - elbow).normalized());
    RC_ASSERT(std::fabs(got.scalar("c4") - cos_flexion) < 1e-10);
    const Quaterniond q_e = got.rotor("q_e");
    RC_ASSERT(std::fabs((q_e * Vector3d::UnitZ()).z() - cos_flexion) < 1e-10);
    RC_ASSERT((q_e * Vector3d::UnitZ()).y() > 0);

    // Steps 3 and 4: the middle line lies in both planes and between both elbows; a turn by pi about it swaps them.
    const Vector3d rest = arm.upper * Vector3d::UnitZ();
    RC_ASSERT((got.vector("p_ze") - rest).norm() == 0);
    RC_ASSERT((got.vector("pi_M") - (rest - elbow)).norm() < small);
    RC_ASSERT(got.vector("pi_e").cross(rest.cross(elbow)).norm() < small * size * size * size);
    const Vector3d line(got.at("l_M", kUnitI), got.at("l_M", kUnitJ), got.at("l_M", kUnitK));
    RC_ASSERT(line.cross(rest + elbow).norm() < 1e-9 * line.norm() * size);
    const Quaterniond q12 = got.rotor("q12");
    RC_ASSERT(std::fabs(q12.norm() - 1) < 1e-12);
    RC_ASSERT((q12 * rest - elbow).norm() < 1e-9 * size);

    // Step 5: the turn about the upper arm, and the whole arm.
    const Quaterniond q3 = got.rotor("q3"), q_s = got.rotor("q_s");
    RC_ASSERT(std::fabs(2 * q3.w() * q3.w() - 1 - got.scalar("c3")) < 1e-12);
    RC_ASSERT(q3.x() == 0);
    RC_ASSERT(q3.y() == 0);
    const Vector3d wrist = q_s * (rest + q_e * (arm.fore * Vector3d::UnitZ()));
    RC_ASSERT((q_s * rest - elbow).norm() < 1e-9 * size);
    RC_ASSERT((wrist - target).norm() < 1e-9 * size);
    RC_ASSERT(std::fabs(got.closing_error - (wrist - target).norm() / size) < 1e-12);
    for (const auto& [name, entity] : got.named)
        RC_ASSERT((entity.step >= 1 && entity.step <= 5 && std::string(entity.meaning).size() > 10));
}

std::string refused(const LectureArm& arm)
{
    swivel_entity untouched[SWIVEL_ENTITY_COUNT] = {};
    double closing_error = 99;
    const char* const why =
        swivel_steps(arm.target.data(), arm.pole.data(), arm.upper, arm.fore, untouched, &closing_error);
    for (const swivel_entity& entity : untouched) CHECK(!entity.name);
    CHECK(closing_error == 99);
    return why ? why : "";
}

}  // namespace

TEST_CASE("the lecture's entities are where plain geometry puts them")
{
    rc::prop("on random arms", [](std::uint64_t seed) {
        Random random{static_cast<std::uint32_t>(seed)};
        for (int n = 0; n < 20; ++n) {
            const LectureArm arm = random_lecture_arm(random);
            // Where the upper arm is nearly along e3 or -e3 the middle line loses digits, as the header says.
            const LectureEntities got(arm);
            if (got.named.empty() || got.vector("p_e").head<2>().norm() < 0.05 * arm.upper) continue;
            check_entities(arm, got);
        }
    });
}

TEST_CASE("arms for which the lecture's formulas divide by zero are refused, with the entity that fails")
{
    const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
    CHECK_THAT(refused({3 * x, y, 1, 1.5}), Contains("S1 and S2") && Contains("too far by 0.5"));
    CHECK_THAT(refused({0.25 * x, y, 1, 1.5}), Contains("S1 and S2") && Contains("too near by 0.25"));
    CHECK_THAT(refused({2.5 * x, y, 1, 1.5}), Contains("PP") && Contains("straight"));
    CHECK_THAT(refused({0.5 * x, y, 1, 1.5}), Contains("PP") && Contains("folded"));
    CHECK_THAT(refused({2 * x, -x, 1, 1.5}), Contains("pi_swivel") && Contains("pole"));
    CHECK_THAT(refused({2 * x, 0 * x, 1, 1.5}), Contains("pi_swivel") && Contains("pole"));
    CHECK_THAT(refused({0 * x, y, 1, 1}), Contains("on the shoulder"));
    CHECK_THAT(refused({y - 1.5 * z + 0 * x, -z, 1.5, 1}), Contains("l_M"));
    CHECK_THAT(refused({y + 1.5 * z, z, 1.5, 1}), Contains("l_M"));
    CHECK_THAT(refused({x, y, 0, 1}), Contains("no length"));
    CHECK_THAT(refused({x, y, 1, NAN}), Contains("no length"));
    CHECK_THAT(refused({NAN * x, y, 1, 1}), Contains("not finite"));
    CHECK_THAT(refused({1e200 * x, y, 1, 1}), Contains("too large"));
    CHECK_THAT(refused({x, 1e-200 * y, 1, 1}), Contains("pi_swivel"));
}

TEST_CASE("arms in the plane of e2 and e3 close to half of the digits: c3 is 1 or -1, but for rounding")
{
    Random random{7};
    for (int n = 0; n < 2000; ++n) {
        LectureArm arm = random_lecture_arm(random);
        const double distance = arm.target.norm(), angle = random.between(-3, 3);
        arm.target = distance * Vector3d(0, std::sin(angle), std::cos(angle));
        arm.pole = (n % 2 == 0 ? 1 : -1) * Vector3d(0, std::cos(angle), -std::sin(angle));
        const LectureEntities got(arm);
        // The upper arm is nearly along e3 or -e3.
        if (got.named.empty() || std::fabs(got.vector("p_e").y()) < 0.05 * arm.upper) continue;
        REQUIRE(got.closing_error < 1e-7);
        REQUIRE(std::fabs(got.scalar("c3")) <= 1);
        for (const auto& [name, entity] : got.named)
            for (const double c : entity.coefficients) REQUIRE(std::isfinite(c));
    }
}

TEST_CASE("arms of any valid size close, and those of other sizes are refused")
{
    const LectureArm arm{{1.1, 1.1, 1.1}, {1.1, 1.1, 0}, 1.4, 1.3};
    const auto scaled = [&](double size) {
        return LectureArm{size * arm.target, size * arm.pole, size * arm.upper, size * arm.fore};
    };
    for (const double size : {7e14, 1e9, 1e-9, 1e-15}) {
        INFO(size);
        const LectureEntities got(scaled(size));
        CHECK(got.closing_error < 1e-14);
        CHECK((got.vector("p_e") / size - LectureEntities(arm).vector("p_e")).norm() < 1e-14);
    }
    for (const double size : {1e100, 1e60, 1e15, 7e-16, 1e-60, 1e-100}) {
        INFO(size);
        CHECK_THAT(refused(scaled(size)), Contains(size > 1 ? "at most 1e15" : "1e-15 to 1e15"));
    }
    CHECK_THAT(refused({arm.target, arm.pole, 1e60, 1e60}), Contains("1e-15 to 1e15"));
    CHECK_THAT(refused({arm.target, arm.pole, 1e-60, 1.3}), Contains("1e-15 to 1e15"));
}

TEST_CASE("blades have names")
{
    CHECK(swivel_blade_name(0) == std::string("1"));
    CHECK(swivel_blade_name(kUnitI) == std::string("i"));
    CHECK(swivel_blade_name(kUnitJ | kBladeInf | kBlade0) == std::string("j^einf^e0"));
    CHECK(swivel_blade_name(31) == std::string("e1^e2^e3^einf^e0"));
    CHECK(swivel_blade_name(32) == nullptr);
}

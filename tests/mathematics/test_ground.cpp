// SPDX-License-Identifier: MIT
//
// The promise: a foot on ground has neither toe nor heel below their clearances, turns with the ground by its share and
// no further than its angle, and about its toe alone. Without ground it stays, to the bit. All is checked by geometry
// of Eigen's, in double. test_body_ground.cpp has feet that walk.
#include "core/ground.h"

#include <catch2/catch.hpp>

#include <cstring>
#include <limits>

#include <rapidcheck/catch.h>

#include "tests/formula_arm.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// 200 of a seed make 20,000. RC_PARAMS=max_success=5000 makes a million.
constexpr int kSeedFeet = 200;
constexpr double kAngle = 3e-7;  // radians: the rules have sines and cosines in floats
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// A foot near a plane. Lengths in metres.
struct FootCase {
    Vector3d up, place, normal;  // the normal is of any length
    Vector3d toe, heel;          // heel: from the toe, in the foot's frame, in the world's unit
    Quaterniond foot;
    double scale, share, max;  // most: an angle
    double toe_clearance, heel_clearance;

    Vector3d unit() const { return normal.normalized(); }
    double over(const Vector3d& point) const { return unit().dot(point - place); }
    GroundRules rules() const
    {
        swivel_ground ground = swivel_default_ground();
        ground.toe_clearance = static_cast<float>(toe_clearance);
        ground.heel_clearance = static_cast<float>(heel_clearance);
        return {.given = ground,
                .cos_half_max = static_cast<float>(std::cos(max / 2)),
                .sin_half_max = static_cast<float>(std::sin(max / 2)),
                .lift = spring_rule(0.05f)};
    }
};
float as_float(double x) { return static_cast<float>(x); }
// slope: the steepest, as an angle.
FootCase random_case(Random& random, double slope = 1.4)
{
    FootCase given;
    given.up = random.direction();
    const Vector3d across = random.across(given.up);
    given.normal = random.spread(0.1, 10) * (Eigen::AngleAxisd(random.between(0, slope), across) * given.up);
    given.place = Vector3d(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    given.toe =
        given.place + random.between(-0.2, 0.3) * given.unit() + random.between(0, 0.5) * random.across(given.normal);
    given.foot = random.rotation();
    given.heel = random.vector(0.02, 0.3);
    given.scale = random.spread(0.5, 2);
    given.share = random.below(4) ? random.unit() : random.below(2);
    given.max = random.below(8) ? random.spread(1e-4, 1.5) : 0;
    given.toe_clearance = random.below(3) ? as_float(random.between(0, 0.05)) : 0;
    given.heel_clearance = random.below(3) ? as_float(random.between(0, 0.05)) : 0;
    return given;
}

struct Stood {
    Vector3d toe;
    Quaterniond foot;
};
template <class T>
Foot<T> by_formula(const FootCase& given, const Foot<T>& foot)
{
    const Vector<T> up = mv<T>(given.up);
    const GroundPlane<T> ground = ground_plane(mv<T>(given.place), mv<T>(given.normal), up);
    return foot_on_ground(ground, ground_plane(ground.place, ground.slope(up), up), up, foot, mv<T>(given.heel),
                          static_cast<T>(given.scale), static_cast<T>(given.share), given.rules());
}
template <class T>
Foot<T> animated(const FootCase& given)
{
    return {mv<T>(given.toe), mv<T>(given.foot)};
}
template <class T>
Stood stood(const FootCase& given)
{
    const Foot<T> got = by_formula(given, animated<T>(given));
    return {eigen(got.toe), eigen(got.rotation)};
}
template <class T>
bool has_same_bits(const FootCase& given)
{
    const Foot<T> before = animated<T>(given), got = by_formula(given, before);
    return std::memcmp(&got.toe, &before.toe, sizeof got.toe) == 0 &&
           std::memcmp(&got.rotation, &before.rotation, sizeof got.rotation) == 0;
}

// How far a slope turns a foot, about cross(up, normal): by its share, up to the angle.
double lean_of(const FootCase& given)
{
    const double slope = std::atan2(given.up.cross(given.unit()).norm(), given.up.dot(given.unit()));
    const double turn =
        2 * std::atan2(given.share * std::sin(slope), 2 * (1 - given.share) + given.share * (1 + std::cos(slope)));
    return std::min(turn, given.max);
}
// What must come out: a toe that is too low goes straight up, the foot leans with the slope, and a heel that is then
// too low goes up a circle about the toe, in the plane that it and the normal span, so that no turn is less.
struct Wanted : Stood {
    double room;    // the cosine of the heel's rise over the toe: near 0, where it is straight above, it turns much
    bool is_clear;  // whether it is known which way the heel goes: not of one straight below

    explicit Wanted(const FootCase& given)
    {
        const Vector3d normal = given.unit(), axis = given.up.cross(normal);
        const double low = std::max(given.scale * given.toe_clearance - given.over(given.toe), 0.0);
        toe = given.toe + low / normal.dot(given.up) * given.up;
        foot = given.foot;
        if (axis.norm() > 1e-12) foot = Eigen::AngleAxisd(lean_of(given), axis.normalized()) * foot;
        const Vector3d heel = foot * given.heel, flat = heel - heel.dot(normal) * normal;
        const double length = heel.norm(), rise = given.scale * given.heel_clearance - given.over(toe),
                     sine = std::min(rise / length, 1.0);
        room = std::sqrt(std::max(1 - sine * sine, 0.0));
        is_clear = flat.norm() > 0.1 * length;
        if (heel.dot(normal) < rise)
            foot = turn_between(heel, length * (sine * normal + room * flat.normalized())) * foot;
    }
};

// error: how far the toe, the heel, and the length of the turn's rotor may be off.
template <class T>
void require_wanted(double error)
{
    rc::prop(sizeof(T) == 8 ? "in double" : "in float", [=](std::uint64_t seed) {
        Random random{seed};
        int lifted = 0, leaning = 0, raised = 0;
        for (int n = 0; n < kSeedFeet; ++n) {
            const FootCase given = random_case(random);
            const Wanted want(given);
            const Stood got = stood<T>(given);
            RC_ASSERT((got.toe - want.toe).norm() <= error);
            RC_ASSERT(std::fabs(got.foot.norm() - 1) <= error);
            // Whichever way a heel goes up, it is high enough, or as high as it gets.
            const double rise = std::min(given.scale * given.heel_clearance, given.over(got.toe) + given.heel.norm());
            RC_ASSERT(given.over(got.toe + got.foot * given.heel) >= rise - error);
            const double angle = 2 * kAngle + 2 * error / given.heel.norm();
            if (want.is_clear) RC_ASSERT(got.foot.angularDistance(want.foot) <= angle / std::max(want.room, 0.01));
            raised += (want.toe - given.toe).norm() > 0.01, leaning += lean_of(given) > 0.01;
            lifted += want.is_clear && want.foot.angularDistance(given.foot) > lean_of(given) + 0.01;
        }
        RC_ASSERT(raised > kSeedFeet / 5);
        RC_ASSERT(leaning > kSeedFeet / 5);
        RC_ASSERT(lifted > kSeedFeet / 20);
    });
}

}  // namespace

TEST_CASE("a foot on ground is where geometry has it")
{
    require_wanted<double>(1e-12);
    require_wanted<float>(3e-6);
}

TEST_CASE("a foot turns with the whole of its ground, by no share not at all, and no further than its angle")
{
    rc::prop("about the line across the slope", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kSeedFeet; ++n) {
            FootCase given = random_case(random);
            // High enough for any heel.
            given.toe = given.place + random.between(0.5, 1) * given.unit();
            given.toe_clearance = given.heel_clearance = 0;
            RC_ASSERT(stood<double>(given).foot.angularDistance(given.foot) <= given.max + kAngle);
            given.share = 1, given.max = 1.57;
            RC_ASSERT((stood<double>(given).foot * given.foot.conjugate() * given.up - given.unit()).norm() <= 1e-12);
            given.share = 0;
            RC_ASSERT(stood<double>(given).foot.angularDistance(given.foot) <= 1e-12);
            given.share = random.unit(), given.max = 0;
            RC_ASSERT(stood<float>(given).foot.angularDistance(given.foot) <= kAngle);
        }
    });
}

TEST_CASE("without ground, and on ground that is too steep, a foot stays to the bit")
{
    rc::prop("where none is known", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kSeedFeet; ++n) {
            FootCase given = random_case(random);
            for (const double hole : {kNone, 2e15, std::numeric_limits<double>::infinity()}) {
                const Vector3d place = given.place;
                given.place[random.below(3)] = hole;
                RC_ASSERT(has_same_bits<double>(given));
                RC_ASSERT(has_same_bits<float>(given));
                given.place = place;
            }
            // 87 degrees and 8 minutes and more, also from below.
            const double angle = random.between(1.5209, 3.14);
            given.normal = random.spread(0.1, 10) * (Eigen::AngleAxisd(angle, random.across(given.up)) * given.up);
            RC_ASSERT(has_same_bits<double>(given));
            RC_ASSERT(has_same_bits<float>(given));
        }
    });
}

TEST_CASE("a point that locks does so at its clearance, and its target stays")
{
    rc::prop("where it locks alone", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kSeedFeet; ++n) {
            const FootCase given = random_case(random);
            const auto any = [&] { return mv<double>(random.vector(0, 0.3)); };
            PlantState<double> state{};
            state.mark = mv<double>(given.toe), state.offset = any(), state.velocity = any();
            const PlantState<double> before = state;
            const Vector<double> up = mv<double>(given.up);
            const GroundPlane<double> ground = ground_plane(mv<double>(given.place), mv<double>(given.normal), up);
            const double way = ground.way_up(state.mark, given.toe_clearance);
            lock_on_ground(state, false, up, way);
            RC_ASSERT(std::memcmp(&state.mark, &before.mark, sizeof before.mark) == 0);
            RC_ASSERT(std::memcmp(&state.offset, &before.offset, sizeof before.offset) == 0);
            lock_on_ground(state, true, up, way);
            RC_ASSERT(std::fabs(given.over(eigen(state.mark)) - given.toe_clearance) <= 1e-13);
            RC_ASSERT((eigen(state.mark) - given.toe).cross(given.up).norm() <= 1e-13);
            RC_ASSERT((eigen(state.mark) + eigen(state.offset) - eigen(before.mark) - eigen(before.offset)).norm() <=
                      1e-13);
            RC_ASSERT(std::memcmp(&state.velocity, &before.velocity, sizeof before.velocity) == 0);
        }
    });
}

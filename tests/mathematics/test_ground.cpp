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
    double scale, share, most;  // most: an angle
    double toe_clearance, heel_clearance;

    Vector3d unit() const { return normal.normalized(); }
    double over(const Vector3d& point) const { return unit().dot(point - place); }
    GroundRules rules() const
    {
        return {{},
                static_cast<float>(toe_clearance),
                static_cast<float>(heel_clearance),
                static_cast<float>(std::cos(most / 2)),
                static_cast<float>(std::sin(most / 2)),
                spring_rule(0.05f)};
    }
};
float as_float(double x) { return static_cast<float>(x); }
// slope: the steepest, as an angle.
FootCase random_case(Random& random, double slope = 1.4)
{
    FootCase of;
    of.up = random.direction();
    const Vector3d across = random.across(of.up);
    of.normal = random.spread(0.1, 10) * (Eigen::AngleAxisd(random.between(0, slope), across) * of.up);
    of.place = Vector3d(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    of.toe = of.place + random.between(-0.2, 0.3) * of.unit() + random.between(0, 0.5) * random.across(of.normal);
    of.foot = random.rotation();
    of.heel = random.vector(0.02, 0.3);
    of.scale = random.spread(0.5, 2);
    of.share = random.below(4) ? random.unit() : random.below(2);
    of.most = random.below(8) ? random.spread(1e-4, 1.5) : 0;
    of.toe_clearance = random.below(3) ? as_float(random.between(0, 0.05)) : 0;
    of.heel_clearance = random.below(3) ? as_float(random.between(0, 0.05)) : 0;
    return of;
}

struct Stood {
    Vector3d toe;
    Quaterniond foot;
};
template <class T>
Foot<T> by_formula(const FootCase& of, const Foot<T>& foot)
{
    const Vector<T> up = mv<T>(of.up);
    const GroundPlane<T> ground = ground_plane(mv<T>(of.place), mv<T>(of.normal), up);
    return foot_on_ground(ground, leaning(ground, ground.slope(up), up), up, foot, mv<T>(of.heel),
                          static_cast<T>(of.scale), static_cast<T>(of.share), of.rules());
}
template <class T>
Foot<T> animated(const FootCase& of)
{
    return {mv<T>(of.toe), mv<T>(of.foot)};
}
template <class T>
Stood stood(const FootCase& of)
{
    const Foot<T> is = by_formula(of, animated<T>(of));
    return {eigen(is.toe), eigen(is.rotation)};
}
template <class T>
bool has_same_bits(const FootCase& of)
{
    const Foot<T> was = animated<T>(of), is = by_formula(of, was);
    return std::memcmp(&is.toe, &was.toe, sizeof is.toe) == 0 &&
           std::memcmp(&is.rotation, &was.rotation, sizeof is.rotation) == 0;
}

// How far a slope turns a foot, about cross(up, normal): by its share, up to the angle.
double lean_of(const FootCase& of)
{
    const double slope = std::atan2(of.up.cross(of.unit()).norm(), of.up.dot(of.unit()));
    const double turn =
        2 * std::atan2(of.share * std::sin(slope), 2 * (1 - of.share) + of.share * (1 + std::cos(slope)));
    return std::min(turn, of.most);
}
Quaterniond turn_between(const Vector3d& from, const Vector3d& to)
{
    const Vector3d axis = from.cross(to);
    if (axis.norm() < 1e-15) return Quaterniond::Identity();
    return Quaterniond(Eigen::AngleAxisd(std::atan2(axis.norm(), from.dot(to)), axis.normalized()));
}
// What must come out: a toe that is too low goes straight up, the foot leans with the slope, and a heel that is then
// too low goes up a circle about the toe, in the plane that it and the normal span, so that no turn is less.
struct Wanted : Stood {
    double room;    // the cosine of the heel's rise over the toe: near 0, where it is straight above, it turns much
    bool is_clear;  // whether it is known which way the heel goes: not of one straight below

    explicit Wanted(const FootCase& of)
    {
        const Vector3d normal = of.unit(), axis = of.up.cross(normal);
        const double low = std::max(of.scale * of.toe_clearance - of.over(of.toe), 0.0);
        toe = of.toe + low / normal.dot(of.up) * of.up;
        foot = of.foot;
        if (axis.norm() > 1e-12) foot = Eigen::AngleAxisd(lean_of(of), axis.normalized()) * foot;
        const Vector3d heel = foot * of.heel, flat = heel - heel.dot(normal) * normal;
        const double length = heel.norm(), rise = of.scale * of.heel_clearance - of.over(toe),
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
            const FootCase of = random_case(random);
            const Wanted want(of);
            const Stood is = stood<T>(of);
            RC_ASSERT((is.toe - want.toe).norm() <= error);
            RC_ASSERT(std::fabs(is.foot.norm() - 1) <= error);
            // Whichever way a heel goes up, it is high enough, or as high as it gets.
            const double rise = std::min(of.scale * of.heel_clearance, of.over(is.toe) + of.heel.norm());
            RC_ASSERT(of.over(is.toe + is.foot * of.heel) >= rise - error);
            const double angle = 2 * kAngle + 2 * error / of.heel.norm();
            if (want.is_clear) RC_ASSERT(is.foot.angularDistance(want.foot) <= angle / std::max(want.room, 0.01));
            raised += (want.toe - of.toe).norm() > 0.01, leaning += lean_of(of) > 0.01;
            lifted += want.is_clear && want.foot.angularDistance(of.foot) > lean_of(of) + 0.01;
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
            FootCase of = random_case(random);
            // High enough for any heel.
            of.toe = of.place + random.between(0.5, 1) * of.unit();
            of.toe_clearance = of.heel_clearance = 0;
            RC_ASSERT(stood<double>(of).foot.angularDistance(of.foot) <= of.most + kAngle);
            of.share = 1, of.most = 1.57;
            RC_ASSERT((stood<double>(of).foot * of.foot.conjugate() * of.up - of.unit()).norm() <= 1e-12);
            of.share = 0;
            RC_ASSERT(stood<double>(of).foot.angularDistance(of.foot) <= 1e-12);
            of.share = random.unit(), of.most = 0;
            RC_ASSERT(stood<float>(of).foot.angularDistance(of.foot) <= kAngle);
        }
    });
}

TEST_CASE("without ground, and on ground that is too steep, a foot stays to the bit")
{
    rc::prop("where none is known", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kSeedFeet; ++n) {
            FootCase of = random_case(random);
            for (const double hole : {kNone, 2e15, std::numeric_limits<double>::infinity()}) {
                const Vector3d place = of.place;
                of.place[random.below(3)] = hole;
                RC_ASSERT(has_same_bits<double>(of));
                RC_ASSERT(has_same_bits<float>(of));
                of.place = place;
            }
            // 87 degrees and 8 minutes and more, also from below.
            const double angle = random.between(1.5209, 3.14);
            of.normal = random.spread(0.1, 10) * (Eigen::AngleAxisd(angle, random.across(of.up)) * of.up);
            RC_ASSERT(has_same_bits<double>(of));
            RC_ASSERT(has_same_bits<float>(of));
        }
    });
}

TEST_CASE("a point that locks does so at its clearance, and its target stays")
{
    rc::prop("where it locks alone", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kSeedFeet; ++n) {
            const FootCase of = random_case(random);
            const auto any = [&] { return mv<double>(random.vector(0, 0.3)); };
            PlantState<double> state{};
            state.mark = mv<double>(of.toe), state.offset = any(), state.velocity = any();
            const PlantState<double> was = state;
            const Vector<double> up = mv<double>(of.up);
            const GroundPlane<double> ground = ground_plane(mv<double>(of.place), mv<double>(of.normal), up);
            const double way = ground.way_up(state.mark, of.toe_clearance);
            lock_on_ground(state, false, up, way);
            RC_ASSERT(std::memcmp(&state.mark, &was.mark, sizeof was.mark) == 0);
            RC_ASSERT(std::memcmp(&state.offset, &was.offset, sizeof was.offset) == 0);
            lock_on_ground(state, true, up, way);
            RC_ASSERT(std::fabs(of.over(eigen(state.mark)) - of.toe_clearance) <= 1e-13);
            RC_ASSERT((eigen(state.mark) - of.toe).cross(of.up).norm() <= 1e-13);
            RC_ASSERT((eigen(state.mark) + eigen(state.offset) - eigen(was.mark) - eigen(was.offset)).norm() <= 1e-13);
            RC_ASSERT(std::memcmp(&state.velocity, &was.velocity, sizeof was.velocity) == 0);
        }
    });
}

// SPDX-License-Identifier: MIT
//
// The promise: a foot on ground has neither toe nor heel below their clearances, turns with the ground by its share and
// no further than its angle, and about its toe alone. Without ground it stays, to the bit. All is checked by geometry
// of Eigen's, in double.
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
Stood stood(const FootCase& of)
{
    const Vector<T> up = mv<T>(of.up);
    const GroundPlane<T> ground = ground_plane(mv<T>(of.place), mv<T>(of.normal), up);
    const Foot<T> is =
        foot_on_ground(ground, leaning(ground, ground.slope(up), up), up, Foot<T>{mv<T>(of.toe), mv<T>(of.foot)},
                       mv<T>(of.heel), static_cast<T>(of.scale), static_cast<T>(of.share), of.rules());
    return {eigen(is.toe), eigen(is.rotation)};
}

// How far a slope turns a foot, about cross(up, normal): by its share, up to the angle.
double lean_of(const FootCase& of)
{
    const double slope = std::atan2(of.up.cross(of.unit()).norm(), of.up.dot(of.unit()));
    const double turn =
        2 * std::atan2(of.share * std::sin(slope), 2 * (1 - of.share) + of.share * (1 + std::cos(slope)));
    return std::min(turn, of.most);
}
Quaterniond leaning(const FootCase& of)
{
    const Vector3d axis = of.up.cross(of.unit());
    if (axis.norm() < 1e-12) return of.foot;
    return Quaterniond(Eigen::AngleAxisd(lean_of(of), axis.normalized())) * of.foot;
}

template <class T>
bool has_same_bits(const FootCase& of)
{
    const Vector<T> up = mv<T>(of.up);
    const Foot<T> was{mv<T>(of.toe), mv<T>(of.foot)};
    const GroundPlane<T> ground = ground_plane(mv<T>(of.place), mv<T>(of.normal), up);
    const Foot<T> is = foot_on_ground(ground, leaning(ground, ground.slope(up), up), up, was, mv<T>(of.heel),
                                      static_cast<T>(of.scale), static_cast<T>(of.share), of.rules());
    return std::memcmp(&is.toe, &was.toe, sizeof is.toe) == 0 &&
           std::memcmp(&is.rotation, &was.rotation, sizeof is.rotation) == 0;
}

template <class T>
void require_clear(double error)
{
    rc::prop("neither is below", [&](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kSeedFeet; ++n) {
            const FootCase of = random_case(random);
            const Stood is = stood<T>(of);
            const double toe = of.over(is.toe), wanted = of.scale * of.heel_clearance, heel = of.heel.norm();
            RC_ASSERT(toe >= of.scale * of.toe_clearance - error);
            // Higher than straight over its toe no heel gets.
            const double reach = std::min(wanted, toe + heel);
            RC_ASSERT(of.over(is.toe + is.foot * of.heel) >= reach - error);
            RC_ASSERT(std::fabs(is.foot.norm() - 1) <= error);
        }
    });
}

}  // namespace

TEST_CASE("neither toe nor heel is below its clearance")
{
    require_clear<double>(1e-12);
    require_clear<float>(3e-6);
}

TEST_CASE("a toe goes up as far as it must, and stays where it is over the ground")
{
    rc::prop("along up", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kSeedFeet; ++n) {
            const FootCase of = random_case(random);
            const Vector3d way = stood<double>(of).toe - of.toe;
            const double height = of.over(of.toe) - of.scale * of.toe_clearance;
            if (height >= 0)
                RC_ASSERT(way.norm() == 0);
            else
                RC_ASSERT((way + height / of.unit().dot(of.up) * of.up).norm() <= 1e-12);
        }
    });
}

TEST_CASE("a foot turns with the ground by its share, no further than its angle")
{
    rc::prop("about the line across the slope", [](std::uint64_t seed) {
        Random random{seed};
        int turned_count = 0;
        for (int n = 0; n < kSeedFeet; ++n) {
            FootCase of = random_case(random);
            // High enough for any heel.
            of.toe = of.place + random.between(0.5, 1) * of.unit();
            of.toe_clearance = of.heel_clearance = 0;
            const Quaterniond is = stood<double>(of).foot;
            RC_ASSERT(is.angularDistance(leaning(of)) <= kAngle);
            RC_ASSERT(is.angularDistance(of.foot) <= of.most + kAngle);
            turned_count += lean_of(of) > 1e-3;
            of.share = 1, of.most = 1.57;
            const Quaterniond whole = stood<double>(of).foot * of.foot.conjugate();
            RC_ASSERT((whole * of.up - of.unit()).norm() <= 1e-12);
            of.share = 0;
            RC_ASSERT(stood<double>(of).foot.angularDistance(of.foot) <= 1e-12);
            of.share = random.unit(), of.most = 0;
            RC_ASSERT(stood<double>(of).foot.angularDistance(of.foot) <= 1e-12);
            RC_ASSERT(stood<float>(of).foot.angularDistance(of.foot) <= kAngle);
        }
        RC_ASSERT(turned_count > kSeedFeet / 5);
    });
}

TEST_CASE("a heel that would be below goes up a circle about the toe")
{
    rc::prop("by the least turn", [](std::uint64_t seed) {
        Random random{seed};
        int lifted_count = 0;
        for (int n = 0; n < kSeedFeet; ++n) {
            const FootCase of = random_case(random);
            const Stood is = stood<double>(of);
            const Vector3d was = leaning(of) * of.heel, heel = is.foot * of.heel;
            const double wanted = of.scale * of.heel_clearance, height = of.over(is.toe + was);
            RC_ASSERT(std::fabs(heel.norm() - of.heel.norm()) <= 1e-13);
            if (std::fabs(height - wanted) < kAngle) continue;  // it may be either
            if (height > wanted) {
                RC_ASSERT(is.foot.angularDistance(leaning(of)) <= kAngle);
                continue;
            }
            const Vector3d flat_was = was - was.dot(of.unit()) * of.unit(),
                           flat = heel - heel.dot(of.unit()) * of.unit();
            if (flat_was.norm() < 0.1 * was.norm()) continue;
            ++lifted_count;
            const double highest = of.over(is.toe) + heel.norm();
            RC_ASSERT(std::fabs(of.over(is.toe + heel) - std::min(wanted, highest)) <= 1e-8);
            // In the plane that it and the normal span, so no turn is less.
            RC_ASSERT(flat.cross(flat_was).norm() <= kAngle * flat_was.norm());
            RC_ASSERT(flat.dot(flat_was) >= -1e-9);
            const double turn = std::atan2(was.cross(heel).norm(), was.dot(heel));
            RC_ASSERT(std::fabs(is.foot.angularDistance(leaning(of)) - turn) <= 2 * kAngle);
        }
        RC_ASSERT(lifted_count > kSeedFeet / 20);
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

TEST_CASE("a foot on ground moves as little as what it stands on")
{
    // Also across the places where toe and heel begin to be lifted and where the angle ends.
    rc::prop("by a bounded factor", [](std::uint64_t seed) {
        Random random{seed};
        const auto shift = [&](double size) { return Vector3d(size * random.direction()); };
        for (int n = 0; n < kSeedFeet; ++n) {
            FootCase of = random_case(random, 1);
            if (random.below(2)) of.most = lean_of(of);
            const Stood a = stood<double>(of);
            const Vector3d heel = leaning(of) * of.heel;
            if (random.below(2)) of.heel_clearance = as_float(std::max(of.over(a.toe + heel), 0.0) / of.scale);
            // A heel straight below its toe may go up to any side.
            if (heel.cross(of.unit()).norm() < 0.2 * heel.norm()) continue;
            const Stood from = stood<double>(of);
            for (const double step : {1e-3, 1e-5, 1e-6}) {
                FootCase to = of;
                to.place += shift(step), to.toe += shift(step), to.heel += shift(0.02 * step);
                to.normal = Eigen::AngleAxisd(step, random.direction()) * of.normal;
                to.foot = Quaterniond(Eigen::AngleAxisd(step, random.direction())) * of.foot;
                const Stood is = stood<double>(to);
                RC_ASSERT((is.toe - from.toe).norm() <= 12 * step);
                // Near its highest place a heel turns by the root of a step.
                const double length = of.heel.norm(), high = of.scale * of.heel_clearance - of.over(from.toe);
                const double room = std::sqrt(std::max(1 - std::pow(high / length, 2), 0.0));
                if (room > 0.2) RC_ASSERT(is.foot.angularDistance(from.foot) <= (12 / (length * room) + 20) * step);
            }
        }
    });
}

TEST_CASE("a foot in floats is where the same foot in doubles is")
{
    rc::prop("within rounding", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kSeedFeet; ++n) {
            const FootCase of = random_case(random, 1.2);
            const Stood want = stood<double>(of), is = stood<float>(of);
            RC_ASSERT((is.toe - want.toe).norm() <= 3e-6);
            const Vector3d heel = leaning(of) * of.heel;
            const double high = (of.scale * of.heel_clearance - of.over(want.toe)) / heel.norm();
            if (high > 0.9 || heel.cross(of.unit()).norm() < 0.1 * heel.norm()) continue;
            RC_ASSERT(is.foot.angularDistance(want.foot) <= 1e-6 + 6e-6 / heel.norm());
        }
    });
}

// SPDX-License-Identifier: MIT
//
// The promise: a thing that hands hold moves as little as it must so that both reach it, wherever their reaches share a
// point. Elsewhere it goes where the worse of both misses least. Moves of like reaches are alike. All is checked by a
// search in double that knows no circles.
#include "core/prop.h"

#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/formula_arm.h"
#include "tests/nearest_in_balls.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// 1,000 of a seed make 100,000. RC_PARAMS=max_success=1000 makes a million.
constexpr int kSeedPairs = 1000;

struct Reaches {
    Ball a, b;

    // Whether the slack that a reach is given decides nothing.
    bool is_clear() const
    {
        const auto beside = [&](const Ball& one, const Ball& other) {
            const double far = std::max(0.0, one.middle.norm() - one.radius);
            return std::fabs(other.beyond(far * one.middle.normalized())) > 2 * kReachSlack * size();
        };
        return beside(a, b) && beside(b, a);
    }
    double size() const { return a.middle.norm() + b.middle.norm() + a.radius + b.radius; }
    double beyond(const Vector3d& move) const { return std::max(a.beyond(move), b.beyond(move)); }
    std::optional<Vector3d> nearest(double shrunk_a = 0, double shrunk_b = 0) const
    {
        return nearest_in_balls({a.middle, std::max(0.0, a.radius - shrunk_a)},
                                {b.middle, std::max(0.0, b.radius - shrunk_b)});
    }
    // How far the nearest point is at most if rounding makes either ball, or both, so much smaller. None if they then
    // share no point.
    std::optional<double> farthest(double off) const
    {
        double max = 0;
        for (const auto& [less_a, less_b] : {std::pair{off, off}, {off, 0.0}, {0.0, off}}) {
            const std::optional<Vector3d> at = nearest(less_a, less_b);
            if (!at) return {};
            max = std::max(max, at->norm());
        }
        return max;
    }
};
enum class Kind { any, touching, inside, apart, alike, parallel, count };
Reaches random_reaches(Random& random, Kind kind)
{
    const auto place = [&] { return Vector3d(random.spread(0.01, 3) * random.direction()); };
    Reaches r{{place(), random.spread(0.05, 1.5)}, {place(), random.spread(0.05, 1.5)}};
    const Vector3d way = random.direction();
    const double both = r.a.radius + r.b.radius, tiny = random.below(4) ? random.spread(1e-9, 1e-3) : 0;
    switch (kind) {
        case Kind::touching:
            r.b.middle = r.a.middle + (both + (random.below(2) ? tiny : -tiny)) * way;
            break;
        case Kind::inside:
            r.b.middle = r.a.middle + random.unit() * std::fabs(r.a.radius - r.b.radius) * way;
            break;
        case Kind::apart:
            r.b.middle = r.a.middle + (both + random.spread(1e-3, 3)) * way;
            break;
        case Kind::alike:
            r.b = {r.a.middle + tiny * way, r.a.radius + (random.below(2) ? tiny * random.between(-1, 1) : 0)};
            break;
        case Kind::parallel:  // all on one line with the origin
            r.b.middle = random.between(-2, 2) * r.a.middle;
            break;
        default:
            break;
    }
    return r;
}

template <class T>
Reaches rounded(const Reaches& r)
{
    const auto rounded_ball = [](const Ball& ball) {
        return Ball{ball.middle.cast<T>().template cast<double>(), double{static_cast<T>(ball.radius)}};
    };
    return {rounded_ball(r.a), rounded_ball(r.b)};
}
template <class T>
Vector3d min_move_of(const Reaches& r)
{
    const auto reaching = [](const Ball& ball) {
        return ReachingMoves<T>{mv<T>(ball.middle), static_cast<T>(ball.radius)};
    };
    return eigen(min_move(reaching(r.a), reaching(r.b)));
}

// unit: what one rounding of T may be, and something for what comes after it.
template <class T>
void check_least(const Reaches& wanted, double unit)
{
    const Reaches r = rounded<T>(wanted);
    const double off = unit * r.size(), gap = gap_of(r.a, r.b);
    const Vector3d move = min_move_of<T>(r);
    RC_ASSERT(r.beyond(move) <= std::max(0.0, 0.5 * gap) + off);
    if (gap > off)  // no point misses one of them by less than half
        RC_ASSERT(std::fabs(r.a.beyond(move) - 0.5 * gap) <= off);
    // Where the balls touch, from outside or from inside, the nearest point moves much if they change little.
    if (const std::optional<double> farthest = r.farthest(off)) RC_ASSERT(move.norm() <= *farthest + off);
    if (r.beyond(Vector3d::Zero()) < -off) RC_ASSERT(move.norm() == 0);
}

Quaterniond random_rotation(Random& random) { return random.rotation().normalized(); }
template <class T>
Rotor<T> rotor_of(const Quaterniond& q)
{
    return rotor(static_cast<T>(q.x()), static_cast<T>(q.y()), static_cast<T>(q.z()), static_cast<T>(q.w()));
}
template <class T>
HeldFrame<T> random_frame(Random& random)
{
    return {rotor_of<T>(random_rotation(random)), mv<T>(Vector3d(random.spread(0.01, 3) * random.direction()))};
}
template <class T>
bool is_same(const HeldFrame<T>& a, const HeldFrame<T>& b)
{
    return std::equal(std::begin(a.rotation.c), std::end(a.rotation.c), std::begin(b.rotation.c)) &&
           std::equal(std::begin(a.place.c), std::end(a.place.c), std::begin(b.place.c));
}
template <class T>
double off_between(const HeldFrame<T>& a, const HeldFrame<T>& b)
{
    return (eigen(a.place) - eigen(b.place)).norm() + distance(eigen(a.rotation), eigen(b.rotation));
}
Eigen::Isometry3d isometry(const Vector3d& place, const Quaterniond& rotation)
{
    return Eigen::Translation3d(place) * rotation.normalized();
}
template <class T>
Eigen::Isometry3d isometry(const HeldFrame<T>& frame)
{
    return isometry(eigen(frame.place), eigen(frame.rotation));
}

}  // namespace

TEST_CASE("the least move is in both reaches, and no shorter one is")
{
    const auto kind = static_cast<Kind>(GENERATE(range(0, static_cast<int>(Kind::count))));
    rc::prop("by a search, kind " + std::to_string(static_cast<int>(kind)), [&](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kSeedPairs / static_cast<int>(Kind::count); ++n) {
            const Reaches r = random_reaches(random, kind);
            check_least<double>(r, r.is_clear() ? 1e-12 : 2 * kReachSlack);
            check_least<float>(r, 4 * kReachSlack);
        }
    });
}

TEST_CASE("one arm's least move is the nearest point of its reach")
{
    rc::prop("and none if that has the origin", [](std::uint64_t seed) {
        Random random{seed};
        const Ball ball = random_reaches(random, Kind::any).a;
        const ReachingMoves<double> reach{mv<double>(ball.middle), ball.radius};
        const double far = std::max(0.0, ball.middle.norm() - ball.radius);
        RC_ASSERT((eigen(reach.shortest()) - far * ball.middle.normalized()).norm() <= 1e-14 * ball.middle.norm());
        RC_ASSERT((eigen(min_move(reach, reach)) - eigen(reach.shortest())).norm() <= 1e-14 * ball.middle.norm());
    });
}

TEST_CASE("least moves of like reaches are alike")
{
    const auto kind = static_cast<Kind>(GENERATE(range(0, static_cast<int>(Kind::count))));
    rc::prop("kind " + std::to_string(static_cast<int>(kind)), [&](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 100; ++n) {
            constexpr double kStep = 1e-12;
            const Reaches r = random_reaches(random, kind);
            Reaches near = r;
            for (Ball* ball : {&near.a, &near.b}) {
                ball->middle += kStep * random.direction();
                ball->radius += kStep * random.between(-1, 1);
            }
            // The tip of a lens moves by the root of what the balls move.
            RC_ASSERT((min_move_of<double>(near) - min_move_of<double>(r)).norm() <= 20 * std::sqrt(kStep * r.size()));
        }
    });
}

TEMPLATE_TEST_CASE("a thing is where the hand and its grip say, and the hand where the thing and the grip say", "",
                   float, double)
{
    using T = TestType;
    const double unit = sizeof(T) == 4 ? 1e-6 : 1e-14;
    rc::prop("as Eigen has it, and each the inverse of the other", [&](std::uint64_t seed) {
        Random random{seed};
        const auto frame = random_frame<T>(random), grip = random_frame<T>(random);
        const T scale = static_cast<T>(random.spread(0.1, 10));
        RC_ASSERT(off_between(held_by(gripped(frame, grip, T(1)), grip), frame) <= 10 * unit);
        RC_ASSERT(off_between(gripped(held_by(frame, grip), grip, T(1)), frame) <= 10 * unit);
        const Eigen::Isometry3d scaled = isometry(double{scale} * eigen(grip.place), eigen(grip.rotation));
        const Eigen::Isometry3d got = isometry(gripped(frame, grip, scale)), wanted = isometry(frame) * scaled;
        RC_ASSERT((got.matrix() - wanted.matrix()).norm() <= 100 * unit);
        RC_ASSERT(
            (isometry(held_by(frame, grip)).matrix() - (isometry(frame) * isometry(grip).inverse()).matrix()).norm() <=
            20 * unit);
    });
}

TEMPLATE_TEST_CASE("between two hands a thing is one's to the bit, or on the way from one to the other", "", float,
                   double)
{
    using T = TestType;
    const double unit = sizeof(T) == 4 ? 1e-6 : 1e-14;
    rc::prop("the short way round", [&](std::uint64_t seed) {
        Random random{seed};
        const auto a = random_frame<T>(random), b = random_frame<T>(random);
        RC_ASSERT(is_same(between(a, b, T(0)), a));
        RC_ASSERT(is_same(between(a, b, T(1)), b));
        const T share = static_cast<T>(random.unit());
        const HeldFrame<T> got = between(a, b, share), middle = between(a, b, T(0.5));
        const Quaterniond q_a = eigen(a.rotation).normalized(), q_b = eigen(b.rotation).normalized(),
                          q = eigen(got.rotation);
        const double s = double{share};
        RC_ASSERT((eigen(got.place) - (1 - s) * eigen(a.place) - s * eigen(b.place)).norm() <= 5 * unit);
        RC_ASSERT(std::fabs(q.norm() - 1) <= unit);
        const double angle = q_a.angularDistance(q_b);
        RC_ASSERT(std::fabs(q_a.angularDistance(q) + q.angularDistance(q_b) - angle) <= std::sqrt(unit));
        if (angle < 3) {
            RC_ASSERT(eigen(middle.rotation).angularDistance(q_a.slerp(0.5, q_b)) <= 100 * unit);
            const double wanted = std::atan2(s * std::sin(angle / 2), 1 - s + s * std::cos(angle / 2));
            RC_ASSERT(std::fabs(q_a.angularDistance(q) - 2 * wanted) <= std::sqrt(unit));
        }
    });
}

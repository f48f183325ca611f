// SPDX-License-Identifier: MIT
//
// The promise of the look's formulas, in float: the shortest turn carries one direction to the other, a share of it is
// that share of the angle, a cone holds it, the last joint brings the line of sight to the target, and eased
// turns change by no more than they may. Eigen judges, by angles.
#include "core/look.h"

#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/formula_arm.h"
#include "tests/limit_oracle.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// 2,000 of a seed make 200,000.
constexpr int kTurns = 2000;

// Any angle between them is as likely as any other, and some are nearly half a turn.
Vector3d beside(Random& random, const Vector3d& direction)
{
    const double angle = random.below(4) == 0 ? kPi - random.spread(1e-7, 0.1) : random.between(0, kPi);
    return std::cos(angle) * direction.normalized() + std::sin(angle) * random.across(direction.normalized());
}
LookJoint joint_of(double share, double max)
{
    return {float(share), float(std::cos(0.5 * max)), float(std::sin(0.5 * max))};
}

TEST_CASE("the shortest turn carries a direction to another, whatever the two are and however long")
{
    rc::prop("any two", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kTurns; ++n) {
            const Vector3d from = random.direction(), goal = beside(random, from);
            const Vector<float> a = mv<float>(Vector3d(random.spread(1e-7, 1e7) * from)),
                                b = mv<float>(Vector3d(random.spread(1e-7, 1e7) * goal));
            const Quaterniond turn = eigen(shortest_turn(a, b));
            RC_ASSERT(std::fabs(turn.norm() - 1) <= 1e-6);
            RC_ASSERT(angle_between(turn.normalized() * eigen(a), eigen(b)) <= 2e-6);
            RC_ASSERT(std::fabs(angle_of(turn) - angle_between(eigen(a), eigen(b))) <= 2e-6);
        }
    });
    const Vector<float> none = vector(0.0f, 0.0f, 0.0f), some = vector(1.0f, 2.0f, 3.0f);
    for (const Rotor<float>& turn : {shortest_turn(none, some), shortest_turn(some, none), shortest_turn(none, none)})
        CHECK(eigen(turn).coeffs() == Quaterniond::Identity().coeffs());
}

TEST_CASE("a share of a turn is that share of its angle, within 0.06 degrees, and a cone holds it")
{
    double worst = 0;
    rc::prop("any turn, share and cone", [&](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kTurns; ++n) {
            const Vector3d from = random.direction(), goal = beside(random, from);
            const double share = random.below(4) == 0 ? 0.5 * random.below(3) : random.unit(),
                         max = random.below(2) == 0 ? random.spread(1e-3, 3) : random.between(0, 3);
            const LookTurn<float> turn = look_turn(mv<float>(from), mv<float>(goal), float(share), joint_of(1, max));
            const Quaterniond got = eigen(turn.turn);
            const double whole = angle_between(from, goal), angle = angle_of(got), wanted = share * whole;
            RC_ASSERT(std::fabs(got.norm() - 1) <= 1e-6);
            RC_ASSERT(angle <= max + 2e-6);
            if (std::fabs(wanted - max) > 2e-3) RC_ASSERT(turn.held == (wanted > max));
            if (turn.held) {
                RC_ASSERT(std::fabs(angle - max) <= 2e-6);
            } else {
                worst = std::max(worst, std::fabs(angle - wanted));
                if (share == 0) RC_ASSERT(got.coeffs() == Quaterniond::Identity().coeffs());
                if (share == 0.5 || share == 1) RC_ASSERT(std::fabs(angle - wanted) <= 2e-6);
            }
            // It turns about the axis of the whole.
            if (whole > 0.01 && whole < kPi - 0.01 && angle > 0.01)
                RC_ASSERT(angle_between(got.vec(), from.cross(goal)) <= 1e-4);
        }
    });
    CAPTURE(worst * 180 / kPi);
    CHECK(worst <= 0.06 * kPi / 180 + 1e-6);
}

TEST_CASE("the last joint brings the line of sight to its target")
{
    rc::prop("an eye beside the joint, targets further away than it", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kTurns; ++n) {
            const Vector3d place = random.spread(0.01, 10) * random.direction(),
                           eye = place + random.spread(0.01, 0.3) * random.direction(), axis = random.direction();
            const Vector3d target = place + random.spread(0.4, 1e6) * random.direction();
            const LookTurn<float> turn = rest_of_look(LineOfSight<float>{mv<float>(eye), mv<float>(axis)},
                                                      mv<float>(place), mv<float>(target), 1.0f, joint_of(1, kPi));
            const Quaterniond q = eigen(turn.turn).normalized();
            const Vector3d at = rounded(place), sight = rounded(target) - at - q * (rounded(eye) - at);
            RC_ASSERT(!turn.held);
            RC_ASSERT(angle_between(q * rounded(axis), sight) <= 2e-6 + 2e-7 * place.norm() / sight.norm());
        }
    });
}

TEST_CASE("a carried turn is the turn again, and a part of a way turns by less than its tangents say")
{
    rc::prop("any two turns of a cone, and any part", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kTurns; ++n) {
            const double cone = random.below(3) == 0 ? kPi : random.spread(1e-3, 3);
            const auto any_turn = [&] {
                return Quaterniond(Eigen::AngleAxisd(cone * (random.below(4) ? random.unit() : 1), random.direction()));
            };
            const Quaterniond start = any_turn(), goal = any_turn();
            const Rotor<float> from = from_quarter_tangent(quarter_tangent(mv<float>(start)));
            RC_ASSERT(eigen(from).angularDistance(start) <= 2e-6);
            const LookWay<float> way = look_way(from, mv<float>(goal));
            const double part = random.below(4) ? random.unit() : 1;
            const Quaterniond got = eigen(on_way(from, way, float(part)));
            RC_ASSERT(std::fabs(got.norm() - 1) <= 1e-6);
            RC_ASSERT(got.angularDistance(start) <= 2 * part * double{way.tangent} + 2e-6);
            RC_ASSERT(angle_of(got) <= cone + 4e-6);
            // A way of half a turn or more, on which no step is the last, ends before half a turn.
            if (part == 1 && start.dot(goal) > 2e-3) RC_ASSERT(got.angularDistance(goal) <= 4e-6);
        }
    });
}

TEST_CASE("a look counts from none behind to all ahead, and less very near")
{
    const LookFade fade{-0.9f, 1 / 0.8f, 0.05f};
    rc::prop("any target", [&](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < kTurns; ++n) {
            const Vector3d axis = random.direction(), goal = random.spread(1e-3, 1e3) * beside(random, axis);
            const double unit = random.spread(0.1, 10);
            const auto smooth = [](double x) {
                x = std::clamp(x, 0.0, 1.0);
                return x * x * (3 - 2 * x);
            };
            const double cosine = axis.dot(goal.normalized());
            const float got = look_weight(LineOfSight<float>{vector(0.0f, 0.0f, 0.0f), mv<float>(axis)},
                                          mv<float>(goal), fade, float(unit));
            RC_ASSERT(std::fabs(double{got} - smooth((cosine + 0.9) / 0.8) * smooth(goal.norm() / (0.05 * unit))) <=
                      2e-6);
        }
    });
}

}  // namespace

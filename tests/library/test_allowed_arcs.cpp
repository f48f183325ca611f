// SPDX-License-Identifier: MIT
//
// The promise: allowed arcs are where joint limits and regions leave room, and the solver's choice is in one of them.
// The judges work in angles and half-spaces (limited_arms.h).
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "tests/limited_arms.h"

using namespace swivel;
using namespace swivel::test;

TEST_CASE("allowed arcs are where there is room, and the solver's choice is in one")
{
    Random random{8};
    int some = 0, none = 0;
    for (int crowd_count = 0; crowd_count < 200; ++crowd_count) {
        const LimitedArms of(random, 5, crowd_count % 3 == 0);
        Crowd crowd = of.crowd();
        crowd.solve();
        for (std::uint32_t n = 0; n < of.arms.size(); ++n) {
            const std::vector<swivel_arc> arcs = crowd.allowed_arcs(0, n);
            const LimbPose pose = pose_of(crowd, n);
            const SwivelCircle circle(of.arms[n], pose);
            if (circle.away < 0.05) continue;  // nearly straight: its swivel is hardly known
            const auto is_inside = [&](double angle, double wider) {
                return std::ranges::any_of(arcs, [&](const swivel_arc& arc) {
                    const double from = std::atan2(arc.from[1], arc.from[0]), to = std::atan2(arc.to[1], arc.to[0]);
                    const auto ahead = [](double a, double b) { return std::fmod(b - a + 4 * kPi, 2 * kPi); };
                    return from == to || ahead(from - wider, angle) <= ahead(from, to) + 2 * wider;
                });
            };
            (arcs.empty() ? none : some) += 1;
            CHECK(arcs.empty() == ((pose.flags & SWIVEL_INFEASIBLE) != 0));
            if (!arcs.empty()) CHECK(is_inside(swivel_of(of.arms[n], pose), 1e-4));
            for (int k = 0; k < 500; ++k) {
                const double angle = -kPi + 2 * kPi * (k + 0.5) / 500, room = of.room(n, circle.at(angle));
                if (std::fabs(room) > 1e-5) REQUIRE(is_inside(angle, 0) == (room > 0));
            }
        }
    }
    CHECK(some > 100);
    CHECK(none > 100);
}

// SPDX-License-Identifier: MIT
//
// The promise: reach is eased as documented, without a jump or a corner, never leaves its range, and stretching the
// bones makes up for what is missing.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include <rapidcheck/catch.h>

#include "core/soft_reach.h"
#include "tests/test_random.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// docs/fields.md's words, in long double: d - (d - R + s)^2 / (4 s) between R - s and R + s, R beyond; mirrored at the
// near end.
long double eased(long double d, long double near, long double far, long double s_near, long double s_far)
{
    if (d > far + s_far) return far;
    if (d > far - s_far && s_far > 0) return d - (d - far + s_far) * (d - far + s_far) / (4 * s_far);
    if (d < near - s_near) return near;
    if (d < near + s_near && s_near > 0) return d + (near + s_near - d) * (near + s_near - d) / (4 * s_near);
    return d;
}

template <class T>
ReachRange<T> random_range(Random& random)
{
    const double far = random.between(0.5, 2), near = random.below(3) ? far * random.between(0, 0.9) : 0;
    const double half = (far - near) / 2;
    const auto width = [&] { return random.below(3) ? half * random.unit() : 0; };
    return {static_cast<T>(near), static_cast<T>(far), static_cast<T>(width()), static_cast<T>(width()), T(1)};
}

}  // namespace

TEST_CASE("the eased distance is the documented one, and flags say so")
{
    rc::prop("to 2e-7 of the reach in float", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 1000; ++n) {
            const ReachRange<float> range = random_range<float>(random);
            const auto wanted = static_cast<float>(random.between(0, 2.5));
            const SoftReach<float> got = soft_reach(wanted, range);
            const long double want = eased(wanted, range.near, range.far, range.soft_near, range.soft_far);
            RC_ASSERT(std::fabs(static_cast<double>(got.distance - want)) <= 2e-7 * double{range.far});
            RC_ASSERT(got.distance >= range.near && got.distance <= range.far);
            RC_ASSERT(got.stretch == 1);
            // A float's rounding decides at the ends of the zones.
            const double d = double{wanted}, far = double{range.far} + range.soft_far,
                         near = double{range.near} - range.soft_near, zone = double{range.far} - range.soft_far,
                         near_zone = double{range.near} + range.soft_near;
            const auto is_at = [&](double end) { return std::fabs(d - end) <= 1e-6; };
            if (is_at(far) || is_at(near) || is_at(zone) || is_at(near_zone)) continue;
            RC_ASSERT(got.too_far == (d > far));
            RC_ASSERT(got.too_near == (d < near));
            RC_ASSERT(got.softened == (d > near && d < far && (d > zone || d < near_zone)));
        }
    });
}

TEST_CASE("zones wider than half of the range are cut to it")
{
    const SoftReach<double> reach = soft_reach(1.5, ReachRange<double>{1, 2, 5, 7, 1});
    CHECK(reach.distance == Approx(1.5));  // each zone is half a unit wide: they meet in the middle
    CHECK(soft_reach(2.0, ReachRange<double>{1, 2, 5, 7, 1}).distance == Approx(2 - 0.125));
}

TEST_CASE("no jump, no corner, never backwards")
{
    rc::prop("in double, over the whole range", [](std::uint64_t seed) {
        Random random{seed};
        ReachRange<double> range = random_range<double>(random);
        range.soft_far = std::max(range.soft_far, 0.05 * (range.far - range.near));
        range.soft_near = std::max(range.soft_near, 0.05 * (range.far - range.near));
        const double step = 1e-5;
        const double curve = 1 / (2 * std::min(range.soft_far, range.soft_near));  // the largest second derivative
        double before = soft_reach(0.0, range).distance, slope = -1;
        for (double d = step; d < 2.5; d += step) {
            const double now = soft_reach(d, range).distance, rise = (now - before) / step;
            RC_ASSERT(rise >= -1e-9 && rise <= 1 + 1e-9);
            RC_ASSERT(slope < 0 || std::fabs(rise - slope) <= 1.01 * curve * step + 1e-9);
            before = now, slope = rise;
        }
    });
}

TEST_CASE("stretching reaches what the eased arm would miss, up to the most")
{
    rc::prop("wrist at the target or at the most stretch", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 1000; ++n) {
            ReachRange<float> range = random_range<float>(random);
            range.max_stretch = static_cast<float>(random.between(1, 1.5));
            const auto wanted = static_cast<float>(random.between(0.01, 2.5));
            const SoftReach<float> got = soft_reach(wanted, range);
            RC_ASSERT(got.stretch >= 1 && got.stretch <= range.max_stretch);
            const double wrist = double{got.stretch} * got.distance;
            if (!(got.too_far || got.too_near || got.softened))
                RC_ASSERT(std::fabs(wrist - wanted) <= 3e-7 * double{range.far});
            else if (wanted > range.far)
                RC_ASSERT(got.stretch == range.max_stretch && wrist <= wanted + 3e-7);
        }
    });
}

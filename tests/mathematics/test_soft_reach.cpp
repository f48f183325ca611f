// SPDX-License-Identifier: MIT
//
// The promise: what goes into a solve is prepared as documented. Reach is eased without a jump or a corner, never
// leaves its range, and stretching the bones makes up for what is missing. Matrices that are rotations times scales
// give both back, for any rotation and any scale; all others are refused. Eigen makes the matrices.
#include "core/matrix_frame.h"
#include "core/soft_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include "tests/formula_arm.h"
#include "tests/test_random.h"

using namespace swivel;
using namespace swivel::test;
using Eigen::Matrix3d;

namespace {

// swivel.h's words, in long double: d - (d - R + s)^2 / (4 s) between R - s and R + s, R beyond; mirrored at the near
// end.
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
            range.most_stretch = static_cast<float>(random.between(1, 1.5));
            const auto wanted = static_cast<float>(random.between(0.01, 2.5));
            const SoftReach<float> got = soft_reach(wanted, range);
            RC_ASSERT(got.stretch >= 1 && got.stretch <= range.most_stretch);
            const double wrist = double{got.stretch} * got.distance;
            if (!(got.too_far || got.too_near || got.softened))
                RC_ASSERT(std::fabs(wrist - wanted) <= 3e-7 * double{range.far});
            else if (wanted > range.far)
                RC_ASSERT(got.stretch == range.most_stretch && wrist <= wanted + 3e-7);
        }
    });
}

namespace {

MatrixFrame<float> frame_of(const Matrix3d& m)
{
    return matrix_frame(mv<float>(Vector3d(m.col(0))), mv<float>(Vector3d(m.col(1))), mv<float>(Vector3d(m.col(2))));
}

}  // namespace

TEST_CASE("a rotation times a scale comes back, half turns among them")
{
    rc::prop("from its matrix", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 100; ++n) {
            const double angle = n % 3 == 0 ? std::numbers::pi - random.spread(1e-9, 1e-2)
                                            : random.between(-std::numbers::pi, std::numbers::pi);
            const Vector3d axis = n % 5 == 0 ? Vector3d::Unit(n % 3) : random.direction();
            const Quaterniond q(Eigen::AngleAxisd(angle, axis));
            const double scale = random.spread(1e-14, 1e14);
            const MatrixFrame<float> got = frame_of(scale * q.toRotationMatrix());
            RC_ASSERT(got.valid);
            RC_ASSERT(eigen(got.rotation).normalized().angularDistance(q) <= 4e-7);
            RC_ASSERT(std::fabs(std::sqrt(len2(got.rotation)) - 1) <= 3e-7);
            RC_ASSERT(std::fabs(got.scale / scale - 1) <= 3e-7);
        }
    });
}

TEST_CASE("a slant or an uneven scale is refused beyond a thousandth")
{
    rc::prop("of any rotation", [](std::uint64_t seed) {
        Random random{seed};
        const Matrix3d rotation = random.spread(1e-3, 1e3) * random.rotation().toRotationMatrix();
        const int axis = static_cast<int>(random.below(3)), other = (axis + 1 + static_cast<int>(random.below(2))) % 3;
        for (const auto& [off, valid] : {std::pair(0.9e-3, true), {1.2e-3, false}, {0.5, false}}) {
            Matrix3d uneven = rotation, slanted = rotation;
            uneven.col(axis) *= 1 + (random.below(2) ? off : -off);
            slanted.col(axis) += (random.below(2) ? off : -off) * rotation.col(other);
            RC_ASSERT(frame_of(uneven).valid == valid);
            RC_ASSERT(frame_of(slanted).valid == valid);
        }
        RC_ASSERT(!frame_of(-rotation).valid);
        Matrix3d mirrored = rotation;
        mirrored.col(axis) *= -1;
        RC_ASSERT(!frame_of(mirrored).valid);
    });
}

TEST_CASE("matrices that are no numbers, without an axis, or of sizes beyond the bounds are refused")
{
    const double infinity = std::numeric_limits<double>::infinity();
    for (int n = 0; n < 9; ++n)
        for (const double bad : {std::nan(""), infinity, -infinity, 1e30}) {
            Matrix3d m = Matrix3d::Identity();
            m(n / 3, n % 3) = bad;
            CHECK(!frame_of(m).valid);
        }
    for (int axis = 0; axis < 3; ++axis) {
        Matrix3d m = Matrix3d::Identity();
        m.col(axis).setZero();
        CHECK(!frame_of(m).valid);
    }
    for (const double size : {0.0, 1e-16, 1e-40, 1e16, 1e38}) CHECK(!frame_of(size * Matrix3d::Identity()).valid);
}

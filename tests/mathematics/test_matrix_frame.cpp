// SPDX-License-Identifier: MIT
//
// The promise: matrices of rotations times scales give both back, of any rotation and any scale; all others are
// refused. Matrices are Eigen's.
#include "core/matrix_frame.h"

#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include <limits>
#include <numbers>

#include "tests/formula_arm.h"

namespace {

using namespace swivel;
using namespace swivel::test;
using Eigen::Matrix3d;

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

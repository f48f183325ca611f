// SPDX-License-Identifier: MIT
//
// The promise: a bone is turned by the least rotation, from any direction to any other.
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "tools/rig/limb_chain.h"

using namespace swivel;

TEST_CASE("the least rotation from one direction to another")
{
    using Eigen::Vector3d;
    std::mt19937 random{7};
    const auto any = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
    for (int n = 0; n < 1000; ++n) {
        const double x = any(), y = any(), z = any();
        const Vector3d from = std::pow(10.0, 60 * any()) * Vector3d(x, y, z), aside = from.unitOrthogonal();
        const Vector3d along = from.normalized();
        for (const double angle : {0.0, 1e-7, 0.3, 1.5707963, 3.0, 3.1415925, 3.141592653589793}) {
            const Vector3d to = std::pow(10.0, 60 * any()) * (std::cos(angle) * along + std::sin(angle) * aside);
            const Eigen::Quaterniond turn = tools::aim(from, to);
            INFO(from.transpose() << " to " << to.transpose());
            CHECK(std::fabs(turn.norm() - 1) <= 1e-15);
            CHECK((turn * along - to.normalized()).norm() <= 2e-9);
            CHECK(std::fabs(turn.angularDistance(Eigen::Quaterniond::Identity()) - angle) <= 2e-8);
        }
        CHECK(tools::aim(from, Vector3d::Zero()).w() == 1);
        CHECK(tools::aim(Vector3d::Zero(), from).w() == 1);
    }
}

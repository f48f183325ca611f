// SPDX-License-Identifier: MIT
#include "tests/gltf_closure.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

namespace swivel::test {

namespace {

double angle_between(const Eigen::Affine3d& a, const Eigen::Affine3d& b)
{
    const Eigen::Matrix3d turn = plain_axes(a).transpose() * plain_axes(b);
    const Eigen::Vector3d axis(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
    return std::atan2(axis.norm(), turn.trace() - 1);
}

}  // namespace

Closure closure(const PlainGltf& from, const PlainGltf& to, int animation, const std::vector<LimbNodes>& limbs)
{
    const int written = std::max(animation, 0);
    std::vector<bool> solved(to.nodes().size());
    for (const LimbNodes& limb : limbs)
        for (const int node : limb) solved.at(static_cast<std::size_t>(node)) = true;
    Closure worst;
    for (const double time : key_times(to, limbs.at(0)[0], "rotation", written)) {
        ++worst.frames;
        for (const LimbNodes& limb : limbs) {
            std::array<Eigen::Affine3d, 3> before, after;
            for (std::size_t n = 0; n < 3; ++n) {
                before[n] = plain_world(from, animation, limb[n], time);
                after[n] = plain_world(to, written, limb[n], time);
            }
            const auto place = [](const Eigen::Affine3d& pose) { return Eigen::Vector3d(pose.translation()); };
            const Eigen::Vector3d upper = place(before[1]) - place(before[0]),
                                  lower = place(before[2]) - place(before[1]);
            const double length = upper.norm() + lower.norm();
            const bool is_bent = upper.normalized().cross(lower.normalized()).norm() > 0.02 || upper.dot(lower) < 0;
            const auto keep = [](double& most, double error) { most = error <= most ? most : error; };  // NaN stays
            keep(worst.end, (place(after[2]) - place(before[2])).norm() / length);
            const double sine = upper.normalized().cross(lower.normalized()).norm(),
                         most = 2e-6 + 4e-7 * length * length / (upper.norm() * lower.norm() * sine),
                         off = (place(after[1]) - place(before[1])).norm() / length;
            const bool is_folded = is_bent && sine <= 0.02;
            keep(is_bent ? worst.lower_bent : worst.lower_straight, is_folded ? off / 1e-5
                                                                    : is_bent ? off / most
                                                                              : off);
            keep(worst.orientation, (plain_axes(after[2]) - plain_axes(before[2])).norm());
            keep(worst.others, (place(after[0]) - place(before[0])).norm() / length);
            for (const int node : limb)
                keep(worst.turn,
                     angle_between(plain_local(from, animation, node, time), plain_local(to, written, node, time)) /
                         most);
        }
        for (int node = 0; node < static_cast<int>(solved.size()); ++node)
            if (!solved[static_cast<std::size_t>(node)])
                worst.others = std::max(worst.others, (plain_local(to, written, node, time).matrix() -
                                                       plain_local(from, animation, node, time).matrix())
                                                          .norm());
    }
    return worst;
}

void require_closed(const Closure& worst)
{
    INFO("end " << worst.end << ", bent " << worst.lower_bent << ", straight " << worst.lower_straight
                << ", orientation " << worst.orientation << ", others " << worst.others << ", turn " << worst.turn);
    CHECK(worst.end <= 1e-5);
    CHECK(worst.lower_bent <= 1);
    CHECK(worst.lower_straight <= 2e-3);
    CHECK(worst.orientation <= 2e-5);
    CHECK(worst.others <= 1e-12);
    CHECK(worst.turn <= 1);
    CHECK(worst.frames > 0);
}

}  // namespace swivel::test

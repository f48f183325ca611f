#pragma once
// SPDX-License-Identifier: MIT
// Holds a written glTF file against the one it was solved from: where wrists and elbows are, by the plain reading of
// both, and whether anything else moved.

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/plain_gltf.h"

namespace swivel::test {

// Upper, lower and end joint, as nodes.
using LimbNodes = std::array<int, 3>;

// Worst of all frames and limbs: places in the limb's length, the end joint's orientation as its axes' distance.
struct Closure {
    double end = 0, lower_bent = 0, lower_straight = 0, orientation = 0, others = 0;
    std::size_t frames = 0;
};

inline Eigen::Matrix3d plain_axes(const Eigen::Affine3d& pose) { return pose.linear().colwise().normalized(); }

// animation: index in `from`, and -1 (rest) for a file that had none: `to` has one then. nodes_kept: nodes not below
// any limb, or between its joints, whose local transforms must be as they were.
inline Closure closure(const PlainGltf& from, const PlainGltf& to, int animation, const std::vector<LimbNodes>& limbs)
{
    const int written = std::max(animation, 0);
    const auto& channels = to.json.at("animations").at(static_cast<std::size_t>(written)).at("channels");
    const auto& samplers = to.json.at("animations").at(static_cast<std::size_t>(written)).at("samplers");
    const auto times_of = [&](int node) -> const std::vector<double>& {
        for (const auto& channel : channels)
            if (channel.at("target").value("node", -1) == node && channel.at("target").at("path") == "rotation")
                return plain_numbers(to, samplers.at(channel.at("sampler").get<std::size_t>()).at("input"));
        FAIL("node " << node << " has no rotation keys");
        throw 0;
    };
    std::vector<bool> solved(to.nodes().size());
    for (const LimbNodes& limb : limbs)
        for (const int node : limb) solved.at(static_cast<std::size_t>(node)) = true;
    Closure worst;
    for (const double time : times_of(limbs.at(0)[0])) {
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
            keep(is_bent ? worst.lower_bent : worst.lower_straight,
                 (place(after[1]) - place(before[1])).norm() / length);
            keep(worst.orientation, (plain_axes(after[2]) - plain_axes(before[2])).norm());
            keep(worst.others, (place(after[0]) - place(before[0])).norm() / length);
        }
        for (int node = 0; node < static_cast<int>(solved.size()); ++node)
            if (!solved[static_cast<std::size_t>(node)])
                worst.others = std::max(worst.others, (plain_local(to, written, node, time).matrix() -
                                                       plain_local(from, animation, node, time).matrix())
                                                          .norm());
    }
    return worst;
}

// 1e-5 of the limb's length; of an elbow bent by less than 0.02 rad the height over the line from shoulder to wrist is
// the root of what a float knows of the reach: 2e-3, see tests/test_clip_back.cpp.
inline void require_closed(const Closure& worst)
{
    INFO("end " << worst.end << ", bent " << worst.lower_bent << ", straight " << worst.lower_straight
                << ", orientation " << worst.orientation << ", others " << worst.others);
    CHECK(worst.end <= 1e-5);
    CHECK(worst.lower_bent <= 1e-5);
    CHECK(worst.lower_straight <= 2e-3);
    CHECK(worst.orientation <= 2e-5);
    CHECK(worst.others <= 1e-12);
    CHECK(worst.frames > 0);
}

}  // namespace swivel::test

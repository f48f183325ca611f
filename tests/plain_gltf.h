#pragma once
// SPDX-License-Identifier: MIT
// Other readers of glTF files, for checks: one of the tests' own, Khronos' validator and three.js. The first makes
// whole affine matrices in double, straight from the accessors, and shares no code with the reader under test. It reads
// floats and no sparse accessors; anything else fails the test. node runs the others by tests/gltf/check.mjs.

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/test_data.h"

namespace swivel::test {

struct PlainGltf {
    nlohmann::json json;
    std::vector<std::string> buffers;
    std::vector<int> parents;                              // of each node; -1: a root
    mutable std::map<int, std::vector<double>> accessors;  // those asked for so far

    const nlohmann::json& nodes() const { return json.at("nodes"); }
    int node_named(const std::string& name) const
    {
        for (std::size_t n = 0; n < nodes().size(); ++n)
            if (nodes()[n].value("name", "") == name) return static_cast<int>(n);
        FAIL("no node " << name);
        return -1;
    }
    int parent_of(int node) const { return parents.at(static_cast<std::size_t>(node)); }
};

std::string plain_base64(std::string_view text);

PlainGltf plain_gltf_of(const fs::path& path);

// An accessor's elements, one after the other.
const std::vector<double>& plain_numbers(const PlainGltf& gltf, int index);

// When an animation has keys of a node: of its rotation, or of another path. Fails the test if it has none.
std::vector<double> key_times(const PlainGltf& gltf, int node, const std::string& path = "rotation", int animation = 0);

// The value of one node's channel at a time, as the specification's appendix C has it; `rest` where there is none.
Eigen::VectorXd plain_value(const PlainGltf& gltf, int animation, int node, const std::string& path, double time,
                            const Eigen::VectorXd& rest);

// A node's transform against its parent.
Eigen::Affine3d plain_local(const PlainGltf& gltf, int animation, int node, double time);

// A node's transform in the world; animation -1: at rest.
Eigen::Affine3d plain_world(const PlainGltf& gltf, int animation, int node, double time);

// ---- A written file beside the one that it was solved from. A plain reading of both gives the places of wrists and
// elbows, and tells whether anything else moved.

// Upper, lower and end joint, as nodes.
using LimbNodes = std::array<int, 3>;

inline Eigen::Matrix3d plain_axes(const Eigen::Affine3d& pose) { return pose.linear().colwise().normalized(); }

// A limb in one frame: where its three joints are, how they are turned against their parents, and its end's axes.
struct LimbJointsAt {
    std::array<Eigen::Vector3d, 3> place;
    std::array<Eigen::Matrix3d, 3> turn;
    Eigen::Matrix3d end_axes;
};

// Worst of all frames and limbs: places in the limb's length, the end joint's orientation as its axes' distance.
struct Closure {
    double end = 0, lower_straight = 0, orientation = 0, others = 0;
    double turn = 0, lower_bent = 0;  // as shares of what is allowed
    std::size_t frames = 0;

    void keep(const LimbJointsAt& before, const LimbJointsAt& after);
};

// Of glTF files. animation: index in `from`, or -1 (rest) for a file that had none: `to` has one then. Nodes that are
// no limb's joint must have the local transforms they had.
Closure closure(const PlainGltf& from, const PlainGltf& to, int animation, const std::vector<LimbNodes>& limbs);

// Joints are turned as in the clip within docs/fields.md's bound, 2e-6 + 4e-7 L^2 / (L1 L2 sin b) rad. An elbow misses
// its place by at most this number times the limb's length, all else by 1e-5 of that length.
//
// An elbow bent by less than 0.02 rad may miss by 2e-3. It lies at height h over the line from shoulder to wrist, its
// foot at a from the shoulder and b from the wrist, d = a + b. From h^2 = L1^2 - a^2 and a = (d^2 + L1^2 - L2^2) / 2d
// follows da/dd = b/d, so |dh^2/dd| = 2ab/d <= 2 L1 L2 / d. The solver knows d to e, so it knows h to the root of
// 2 L1 L2 e / d. Wrist and shoulder are floats relative to the root, each off by 2^-24 of its distance from it
// (together up to 3.5 limb lengths), bone lengths by 6e-8, d by two roundings: e is 4e-7 of L. That is 5e-4 of L for
// the height alone, and 2e-3 with the direction in which it points.
//
// A folded elbow, within 0.02 rad of 180 degrees, may miss by 1e-5 + 4e-7 / sin b: with c the angle at the wrist, the
// law of cosines turns the error e into e cos c / sin b of the elbow's place.
void require_closed(const Closure& worst);

// ---- Khronos' validator and three.js

nlohmann::json ask_check(std::vector<std::string> arguments);

// The validator's errors, each as text.
std::multiset<std::string> gltf_errors(const fs::path& path);

// The validator's errors and warnings about `written` that it does not have about `source`, code and place of each.
std::multiset<std::string> new_gltf_messages(const fs::path& source, const fs::path& written);

// The same of many pairs of source and written file, in their order.
std::vector<std::multiset<std::string>> new_gltf_messages(const std::vector<std::pair<fs::path, fs::path>>& files);

// [time][node]: world matrices as three.js plays the file.
std::vector<std::vector<Eigen::Matrix4d>> three_poses(const fs::path& path, int animation,
                                                      const std::vector<double>& times);

}  // namespace swivel::test

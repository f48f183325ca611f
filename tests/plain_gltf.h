#pragma once
// SPDX-License-Identifier: MIT
// A second reading of glTF files, for checks: whole affine matrices in double, straight from the accessors, sharing no
// code with the reader under test. Floats only, no sparse accessors; anything else fails the test.

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <string_view>
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

}  // namespace swivel::test

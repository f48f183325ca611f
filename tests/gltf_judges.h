#pragma once
// SPDX-License-Identifier: MIT
// What Khronos' validator and three.js make of a glTF file: tests/gltf/check.mjs, run by node.

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <Eigen/Geometry>
#include <set>
#include <string>
#include <vector>

#include "tests/run_program.h"
#include "tests/test_data.h"

namespace swivel::test {

inline nlohmann::json ask_check(std::vector<std::string> arguments)
{
    const fs::path folder = fs::path(SWIVEL_SOURCE_DIR) / "tests" / "gltf";
    INFO("node and its packages are set up by tools/test: npm ci in tests/gltf");
    REQUIRE(fs::is_directory(folder / "node_modules"));
    arguments.insert(arguments.begin(), {"/usr/bin/env", "node", (folder / "check.mjs").string()});
    const Outcome outcome = run_program(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return nlohmann::json::parse(outcome.out);
}

// The validator's errors, each as text; and in `warnings`, where given, its warnings.
inline std::multiset<std::string> gltf_errors(const fs::path& path, std::multiset<std::string>* warnings = nullptr)
{
    std::multiset<std::string> errors;
    const nlohmann::json reports = ask_check({"validate", path.string()});
    for (const auto& message : reports.at(0).at("messages"))
        if (message.at("severity") == 0)
            errors.insert(message.dump());
        else if (warnings)
            warnings->insert(message.dump());
    return errors;
}

// [time][node]: world matrices as three.js plays the file.
inline std::vector<std::vector<Eigen::Matrix4d>> three_poses(const fs::path& path, int animation,
                                                             const std::vector<double>& times)
{
    std::vector<std::string> arguments = {"pose", path.string(), std::to_string(animation)};
    for (const double time : times) arguments.push_back(nlohmann::json(time).dump());
    std::vector<std::vector<Eigen::Matrix4d>> poses;
    for (const auto& frame : ask_check(arguments)) {
        poses.emplace_back();
        for (const auto& matrix : frame) {
            const std::vector<double> numbers = matrix;
            poses.back().push_back(Eigen::Map<const Eigen::Matrix4d>(numbers.data()));
        }
    }
    return poses;
}

}  // namespace swivel::test

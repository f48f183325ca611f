#pragma once
// SPDX-License-Identifier: MIT
// What `swivel rig` says of a made-up skeleton.

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/gltf_rig.h"
#include "tests/run_command.h"

namespace swivel::test {

inline constexpr double kDegree = std::numbers::pi / 180;

inline std::vector<float> turns(const Eigen::Vector3d& axis, const std::vector<double>& degrees)
{
    std::vector<float> keys;
    for (const double angle : degrees) {
        const Eigen::Quaterniond q(Eigen::AngleAxisd(angle * kDegree, axis));
        for (const double value : {q.x(), q.y(), q.z(), q.w()}) keys.push_back(static_cast<float>(value));
    }
    return keys;
}

inline nlohmann::json rig_report(const GltfRig& rig, const std::vector<std::string>& options = {})
{
    const TempFolder folder;
    rig.write(folder / "rig.glb");
    std::vector<std::string> words = {"rig", "rig.glb", "--json"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = run_command(folder.path, words);
    INFO(outcome.err);
    REQUIRE(!outcome.out.empty());
    return nlohmann::json::parse(outcome.out);
}

inline nlohmann::json limb_of(const nlohmann::json& report, const std::string& name)
{
    for (const nlohmann::json& limb : report.at("limbs"))
        if (limb.at("limb") == name) return limb;
    FAIL("no limb " + name);
    return {};
}

inline Eigen::Vector3d vector_of(const nlohmann::json& numbers)
{
    return Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}

inline double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
    return std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree;
}

// Why a limb is not bound; empty where it is.
inline std::string problem_of(const nlohmann::json& report, const std::string& limb)
{
    return limb_of(report, limb).value("problem", "");
}

}  // namespace swivel::test

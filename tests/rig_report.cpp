// SPDX-License-Identifier: MIT
#include "tests/rig_report.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace swivel::test {

std::vector<float> turns(const Eigen::Vector3d& axis, const std::vector<double>& degrees)
{
    std::vector<float> keys;
    for (const double angle : degrees) {
        const Eigen::Quaterniond q(Eigen::AngleAxisd(angle * kDegree, axis));
        for (const double value : {q.x(), q.y(), q.z(), q.w()}) keys.push_back(static_cast<float>(value));
    }
    return keys;
}

nlohmann::json report_of(const fs::path& folder, Words words, int exit_code)
{
    words.push_back("--json");
    const Outcome outcome = run_command(folder, words);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == exit_code);
    CHECK(outcome.err.empty() == (exit_code == 0));
    return nlohmann::json::parse(outcome.out);
}

nlohmann::json rig_report(const GltfRig& rig, const Words& options)
{
    const TempFolder folder;
    rig.write(folder / "rig.glb");
    Words words = {"rig", "rig.glb", "--json"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = run_command(folder.path, words);
    INFO(outcome.err);
    REQUIRE(!outcome.out.empty());
    return nlohmann::json::parse(outcome.out);
}

nlohmann::json limb_of(const nlohmann::json& report, const std::string& name)
{
    for (const nlohmann::json& limb : report.at("limbs"))
        if (limb.at("limb") == name) return limb;
    FAIL("no limb " + name);
    return {};
}

Eigen::Vector3d vector_of(const nlohmann::json& numbers) { return Eigen::Vector3d(numbers[0], numbers[1], numbers[2]); }

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
    return std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree;
}

std::string problem_of(const nlohmann::json& report, const std::string& limb)
{
    return limb_of(report, limb).value("problem", "");
}

}  // namespace swivel::test

#pragma once
// SPDX-License-Identifier: MIT
// What `swivel rig` says of a made-up skeleton.

#include <nlohmann/json.hpp>

#include <Eigen/Geometry>
#include <numbers>
#include <string>
#include <vector>

#include "tests/gltf_rig.h"
#include "tests/run_command.h"

namespace swivel::test {

inline constexpr double kDegree = std::numbers::pi / 180;

std::vector<float> turns(const Eigen::Vector3d& axis, const std::vector<double>& degrees);

// What the command says in a folder with --json. It must end with this code.
nlohmann::json report_of(const fs::path& folder, Words words, int exit_code = 0);

nlohmann::json rig_report(const GltfRig& rig, const Words& options = {});

nlohmann::json limb_of(const nlohmann::json& report, const std::string& name);

Eigen::Vector3d vector_of(const nlohmann::json& numbers);

double degrees_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

// Why a limb is not bound; empty where it is.
std::string problem_of(const nlohmann::json& report, const std::string& limb);

}  // namespace swivel::test

#pragma once
// SPDX-License-Identifier: MIT
// What Khronos' validator and three.js make of a glTF file: tests/gltf/check.mjs, run by node.

#include <nlohmann/json.hpp>

#include <Eigen/Geometry>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/run_program.h"
#include "tests/test_data.h"

namespace swivel::test {

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

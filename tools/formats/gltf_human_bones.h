#pragma once
// SPDX-License-Identifier: MIT
// What a VRM file says of its figure's joints. Knows nothing of the figure's motion.

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace swivel::formats {

// The node of each human bone, by VRM's names ("leftUpperArm"), from VRM 1.0 or else 0.x. Empty where the document says
// nothing. Throws InputError, naming the bone, for wrong types, for nodes that do not exist, and for a bone named
// twice. document: one that has nodes.
std::map<std::string, int> read_human_bones(const std::filesystem::path& path, const nlohmann::json& document);

}  // namespace swivel::formats

#pragma once
// SPDX-License-Identifier: MIT
// A glTF file's nodes as the joints of a skeleton. Knows nothing of animations.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "tools/formats/clip.h"

namespace swivel::formats {

// Fills the joints of a clip, parents first and children in the file's order, and its human bones. Returns the joint of
// each node. document: one that check_members() has passed. Throws InputError for
// - nodes that do not exist, have two parents, or stand in a circle;
// - a file without nodes;
// - transforms that turn or scale to nothing.
// Takes time in proportion to the nodes, however they hang on each other.
std::vector<int> read_nodes(const std::filesystem::path& path, const nlohmann::json& document, Clip& clip);

}  // namespace swivel::formats

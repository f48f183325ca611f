// SPDX-License-Identifier: MIT
//
// A cached crowd as the attributes of its folder, and back. docs/cache.md has them for readers of the files.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tools/cache/cached_crowd.h"

namespace swivel::tools {

// Arrays hold sources and positions.
nlohmann::ordered_json attributes_of(const CachedCrowd& crowd);
// The way back, without sources and positions. All numbers are within their ranges, and the limbs are some that the
// solver takes. Throws InputError naming path where a value is missing, damaged or of another version.
CachedCrowd crowd_of_attributes(const nlohmann::ordered_json& attributes, const std::filesystem::path& path);

}  // namespace swivel::tools

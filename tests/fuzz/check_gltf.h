#pragma once
// SPDX-License-Identifier: MIT
// What holds of every glTF file that is read: its clip is sound, and it says the same after it was written.

#include <filesystem>

#include "tools/formats/gltf.h"

namespace swivel::fuzz {

// Reads a file, which may be refused in one line; `written` is a folder for what is written.
void check_gltf(const std::filesystem::path& path, const std::filesystem::path& written, double rate);

}  // namespace swivel::fuzz

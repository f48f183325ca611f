#pragma once
// SPDX-License-Identifier: MIT
// FBX and DAE (COLLADA) files, read by assimp and made into glTF, with which everything goes on. Two sources implement
// it: scene_import.cpp where the build has assimp (SWIVEL_ASSIMP), scene_import_none.cpp, which says how to get it,
// where it has not. See scene_gltf.h for what is kept.

#include <filesystem>
#include <string>

#include "tools/formats/gltf_container.h"
#include "tools/formats/text.h"

namespace swivel::formats {

// Whether the suffix is .fbx or .dae, in any case.
inline bool is_scene(const std::filesystem::path& path)
{
    const std::string suffix = lower_suffix(path);
    return suffix == ".fbx" || suffix == ".dae";
}

// What reads them, "assimp 5.2"; empty: this build does not.
std::string scene_importer();

// Reads and converts a whole file. DAE nodes are known by their names. If these repeat and animations or skins need
// them, nodes are known by their ids. Throws InputError, with assimp's own reason where it has one, for a file that
// cannot be read or is of another format. It also does for what gltf_of() refuses, and for every file where this build
// does not read them. assimp is trusted with the file: a file that makes it crash, or ask for too much memory, does so
// to the caller.
GltfContainer import_scene(const std::filesystem::path& path);

}  // namespace swivel::formats

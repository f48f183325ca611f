// SPDX-License-Identifier: MIT
#include "tools/formats/scene_import.h"

#include "tools/formats/error.h"

namespace swivel::formats {

std::string scene_importer() { return {}; }

GltfContainer import_scene(const std::filesystem::path& path)
{
    throw InputError(path,
                     "this build of swivel does not read FBX and DAE; build it with -DSWIVEL_ASSIMP=ON and Debian's "
                     "libassimp-dev, or export the file as glTF, as Blender and `assimp export FILE FILE.glb` do");
}

}  // namespace swivel::formats

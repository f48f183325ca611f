#pragma once
// SPDX-License-Identifier: MIT
// An assimp scene as glTF 2.0. assimp's own exporter is not used. Version 5.2 fails on some scenes, such as
// box_nested_animation.dae of its models. It leaves an FBX file's axes and unit as they are, and has one skin for all
// meshes. Khronos' validator calls its weights and texture names errors. Kept are:
// - nodes with their names and rest poses, in glTF's axes and metres;
// - every animation of nodes, as LINEAR keys at assimp's own times, in seconds. assimp says no other interpolation.
//   Keys before 0 move the whole animation to start there. Of two keys at one time the later comes a float's last digit
//   later. Without a number of ticks per second it is 25;
// - triangles with normals, one set of texture coordinates, skins, and a material's colour and its PNG or JPEG.
// Cameras, lights, morph targets, lines, points and everything else of the file are not kept.

#include <filesystem>

#include "tools/formats/gltf_container.h"

struct aiScene;

namespace swivel::formats {

// scene: as assimp reads it, triangulated, with a root node. path: where from, for messages and textures beside it.
// Throws InputError for a key that is not finite, and for a name of an animated node or a bone that several nodes have.
GltfContainer gltf_of(const aiScene& scene, const std::filesystem::path& path);

}  // namespace swivel::formats

#pragma once
// SPDX-License-Identifier: MIT
// What hangs on an assimp scene's nodes, as glTF: triangles, their skins and their materials' colours.

#include "tools/formats/gltf_builder.h"
#include "tools/formats/scene_nodes.h"

namespace swivel::formats {

// Adds meshes, skins, materials, textures and images to a document that has the scene's nodes and no others. A node's
// meshes without bones become one mesh; each mesh with bones its own, on a node of its own where a node has several.
// A skin's joints are the mesh's bones and, so that no hand is missing that moves no vertex, all below them that
// carries no mesh. A vertex follows its four strongest bones; one without any stays with the mesh's own node.
// Throws AmbiguousName for a bone whose name several nodes have.
void add_meshes(GltfBuilder& gltf, const aiScene& scene, const SceneNodes& nodes);

// Adds the scene's materials, in its order, so that a mesh's material index is glTF's: the diffuse colour and its
// texture, where that is a PNG or JPEG in the file or beside it. Returns for each whether it has a texture.
std::vector<bool> add_materials(GltfBuilder& gltf, const aiScene& scene, const std::filesystem::path& path);

}  // namespace swivel::formats

// SPDX-License-Identifier: MIT
#include "tools/formats/scene_import.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <exception>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "tools/formats/error.h"
#include "tools/formats/scene_gltf.h"
#include "tools/formats/scene_nodes.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

// by_name: DAE nodes have their names, not their ids. The scene lives in `importer`.
const aiScene& read(Assimp::Importer& importer, const std::filesystem::path& path, bool by_name, bool with_pivots)
{
    // Without: one node for each of an FBX file's; else assimp puts up to nine in a row for one.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, with_pivots);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);  // no mesh that the file has not
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, by_name);
    std::string cause;
    try {
        if (const aiScene* scene =
                importer.ReadFile(path.string(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
            scene && scene->mRootNode)
            return *scene;
        cause = importer.GetErrorString();
    } catch (const std::exception& thrown) {
        cause = thrown.what();
    }
    std::replace(cause.begin(), cause.end(), '\n', ' ');
    cause = printable(trimmed(cause), 200);
    if (cause.ends_with('.')) cause.pop_back();
    throw InputError(path, fmt::format("assimp cannot read it: {}; export the file again, or as glTF",
                                       cause.empty() ? "it gives no reason" : cause));
}

// ---- joints that assimp misreads

constexpr std::string_view kPartMark = "_$AssimpFbx$_";  // between a node's name and that of a part of its transform

std::string name_without_part(const std::string& name) { return name.substr(0, name.find(kPartMark)); }

// Every node that has parts of its own, with the part's name. Parts that are none are left out by assimp.
std::vector<std::pair<std::string, std::string>> parts_of_nodes(const aiScene& scene)
{
    std::vector<std::pair<std::string, std::string>> parts;
    std::vector<const aiNode*> open{scene.mRootNode};
    while (!open.empty()) {
        const aiNode& node = *open.back();
        open.pop_back();
        const std::string name = node.mName.C_Str();
        if (const std::size_t at = name.find(kPartMark); at != std::string::npos)
            parts.emplace_back(name.substr(0, at), name.substr(at + kPartMark.size()));
        open.insert(open.end(), node.mChildren, node.mChildren + node.mNumChildren);
    }
    return parts;
}

std::set<std::string> moved_names(const aiScene& scene)
{
    std::set<std::string> names;
    for (const aiAnimation* animation : std::span(scene.mAnimations, scene.mNumAnimations))
        for (const aiNodeAnim* at : std::span(animation->mChannels, animation->mNumChannels))
            names.insert(name_without_part(at->mNodeName.C_Str()));
    return names;
}

// A node whose meshes all follow bones: its own keys and pivots move nothing.
bool is_skinned(const aiScene& scene, const aiNode& node)
{
    return node.mNumMeshes > 0 && node.mNumChildren == 0 &&
           std::all_of(node.mMeshes, node.mMeshes + node.mNumMeshes,
                       [&](unsigned mesh) { return scene.mMeshes[mesh]->mNumBones > 0; });
}

// Of an FBX node's parts 5.2 gets translation, pre-rotation, rotation and scale right. A post-rotation turns the wrong
// way, a geometric transform moves what hangs below, and all others are lost where the node has keys.
void refuse_misread(const aiScene& scene, const std::filesystem::path& path)
{
    Assimp::Importer importer;
    const std::set<std::string> moved = moved_names(scene);
    for (const auto& [name, part] : parts_of_nodes(read(importer, path, false, true))) {
        const bool is_sound = part == "Translation" || part == "PreRotation" || part == "Rotation" || part == "Scaling";
        const aiNode* node = scene.mRootNode->FindNode(name.c_str());
        const bool moves = moved.contains(name) && !(node && is_skinned(scene, *node));
        const bool moves_others = part.starts_with("Geometric") && !(node && node->mNumChildren == 0);
        if (is_sound || !(part.starts_with("PostRotation") || moves || moves_others)) continue;
        throw InputError(path,
                         fmt::format("node '{}' has a {}, which assimp misreads; freeze or bake it where the rig was "
                                     "made, or export the file as glTF",
                                     printable(name), part));
    }
}

GltfContainer import_by(const std::filesystem::path& path, bool by_name)
{
    Assimp::Importer importer;
    const aiScene& scene = read(importer, path, by_name, false);
    if (lower_suffix(path) == ".fbx") refuse_misread(scene, path);
    return gltf_of(scene, path);
}

}  // namespace

std::string scene_importer() { return fmt::format("assimp {}.{}", aiGetVersionMajor(), aiGetVersionMinor()); }

GltfContainer import_scene(const std::filesystem::path& path)
{
    open_text(path);  // says what is wrong in this tool's own words where no format matters
    if (lower_suffix(path) == ".fbx") return import_by(path, false);
    try {
        return import_by(path, true);
    } catch (const AmbiguousName&) {
        return import_by(path, false);
    }
}

}  // namespace swivel::formats

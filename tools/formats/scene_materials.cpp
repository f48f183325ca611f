// SPDX-License-Identifier: MIT
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include "tools/formats/picture.h"
#include "tools/formats/scene_meshes.h"

namespace swivel::formats {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Beside the file, where exporters put them: at a relative path that stays below its folder, else by its bare name.
std::string bytes_beside(const fs::path& file, std::string name)
{
    std::replace(name.begin(), name.end(), '\\', '/');
    const fs::path path = fs::path(name).lexically_normal();
    const bool is_below = path.is_relative() && (path.empty() || *path.begin() != "..");
    for (const fs::path& candidate : {is_below ? path : path.filename(), path.filename()}) {
        if (candidate.empty()) continue;
        if (std::string bytes = picture_at(file.parent_path() / candidate); !bytes.empty()) return bytes;
    }
    return {};
}

std::string image_of(const aiScene& scene, const fs::path& file, const std::string& name)
{
    const aiTexture* embedded = scene.GetEmbeddedTexture(name.c_str());
    if (!embedded) return bytes_beside(file, name);
    if (embedded->mHeight != 0) return {};  // bare pixels
    return {reinterpret_cast<const char*>(embedded->pcData), embedded->mWidth};
}

// Textures by the names that materials have for their images; none of those that cannot be had.
using Textures = std::map<std::string, std::optional<std::size_t>>;

// The texture of an image; each is looked for and taken in once.
std::optional<std::size_t> add_texture(GltfBuilder& gltf, const aiScene& scene, const fs::path& path,
                                       const std::string& name, Textures& known)
{
    const auto [at, is_new] = known.try_emplace(name);
    if (!is_new) return at->second;
    const std::string bytes = image_of(scene, path, name);
    const std::string_view kind = picture_kind(bytes);
    if (kind != "image/png" && kind != "image/jpeg") return {};  // glTF has no others without an extension
    const std::size_t view = add_view(gltf, bytes, GltfUse::none);
    gltf.json["images"].push_back({{"bufferView", view}, {"mimeType", kind}});
    gltf.json["textures"].push_back({{"source", gltf.json["images"].size() - 1}});
    at->second = gltf.json["textures"].size() - 1;
    return at->second;
}

// Diffuse colour and opacity, each from 0 to 1.
std::vector<float> colour_of(const aiMaterial& material)
{
    aiColor3D colour(1, 1, 1);
    float opacity = 1;
    material.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
    material.Get(AI_MATKEY_OPACITY, opacity);
    std::vector<float> rgba{colour.r, colour.g, colour.b, opacity};
    for (float& part : rgba) part = std::isfinite(part) ? std::clamp(part, 0.0f, 1.0f) : 1;
    return rgba;
}

}  // namespace

std::vector<bool> add_materials(GltfBuilder& gltf, const aiScene& scene, const fs::path& path)
{
    std::vector<bool> textured;
    Textures textures;
    for (const aiMaterial* from : std::span(scene.mMaterials, scene.mNumMaterials)) {
        Json surface{{"baseColorFactor", colour_of(*from)}, {"metallicFactor", 0}};
        aiString name, image;
        std::optional<std::size_t> texture;
        if (from->GetTexture(aiTextureType_DIFFUSE, 0, &image) == aiReturn_SUCCESS)
            texture = add_texture(gltf, scene, path, image.C_Str(), textures);
        if (texture) surface["baseColorTexture"] = {{"index", *texture}};
        textured.push_back(texture.has_value());
        const bool is_clear = surface["baseColorFactor"][3] < 1;
        Json material{{"pbrMetallicRoughness", std::move(surface)}};
        if (is_clear) material["alphaMode"] = "BLEND";
        if (from->Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS && name.length > 0) material["name"] = name.C_Str();
        gltf.json["materials"].push_back(std::move(material));
    }
    return textured;
}

}  // namespace swivel::formats

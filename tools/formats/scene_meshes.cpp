// SPDX-License-Identifier: MIT
#include "tools/formats/scene_meshes.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

using Eigen::Matrix4d;
using Json = nlohmann::json;

struct MeshWriter {
    GltfBuilder& gltf;
    const aiScene& scene;
    const SceneNodes& nodes;
    std::vector<bool> textured;                           // of each material
    std::map<unsigned, std::optional<Json>> shapes = {};  // of meshes, which several nodes may carry
};

float finite_or_zero(float value) { return std::isfinite(value) ? value : 0; }

std::span<const aiBone* const> bones_of(const aiMesh& mesh) { return {mesh.mBones, mesh.mNumBones}; }

// ---- triangles

std::vector<std::uint32_t> triangles_of(const aiMesh& mesh)
{
    std::vector<std::uint32_t> indices;
    for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
        const std::span corners(face.mIndices, face.mNumIndices);
        const bool is_sound = corners.size() == 3 && std::all_of(corners.begin(), corners.end(), [&](unsigned corner) {
                                  return corner < mesh.mNumVertices;
                              });
        if (is_sound) indices.insert(indices.end(), corners.begin(), corners.end());
    }
    return indices;
}

std::vector<float> positions_of(const aiMesh& mesh)
{
    std::vector<float> values;
    for (const aiVector3D& at : std::span(mesh.mVertices, mesh.mNumVertices))
        for (const float part : {at.x, at.y, at.z}) values.push_back(finite_or_zero(part));
    return values;
}

// Unit normals; none where one of them has no direction: viewers then make their own.
std::vector<float> normals_of(const aiMesh& mesh)
{
    std::vector<float> values;
    if (!mesh.HasNormals()) return values;
    for (const aiVector3D& at : std::span(mesh.mNormals, mesh.mNumVertices)) {
        const Eigen::Vector3d normal(at.x, at.y, at.z);
        if (!(normal.norm() > 1e-12 && std::isfinite(normal.norm()))) return {};
        for (const double part : normal.normalized()) values.push_back(static_cast<float>(part));
    }
    return values;
}

// The first set, from its top as glTF has it; zeros where there is none and a texture wants one.
std::vector<float> texture_coordinates_of(const aiMesh& mesh, bool is_wanted)
{
    std::vector<float> values;
    if (!mesh.HasTextureCoords(0)) {
        values.resize(is_wanted ? 2 * std::size_t{mesh.mNumVertices} : 0);
        return values;
    }
    for (const aiVector3D& at : std::span(mesh.mTextureCoords[0], mesh.mNumVertices))
        values.insert(values.end(), {finite_or_zero(at.x), finite_or_zero(1 - at.y)});
    return values;
}

// ---- skins

struct Skin {
    std::vector<int> joints;
    std::vector<float> inverse_binds;  // 16 for each joint
};

void add_joint(Skin& skin, int node, const Matrix4d& inverse_bind)
{
    skin.joints.push_back(node);
    for (const double number : inverse_bind.reshaped()) skin.inverse_binds.push_back(static_cast<float>(number));
}

// The place of a node's joint in the skin, where it gets one that it has not.
int place_of(Skin& skin, int node, const Matrix4d& inverse_bind)
{
    const auto known = std::find(skin.joints.begin(), skin.joints.end(), node) - skin.joints.begin();
    if (known == std::ssize(skin.joints)) add_joint(skin, node, inverse_bind);
    return static_cast<int>(known);
}

// The nodes below the bones that carry no mesh, and are no bones.
void add_idle_joints(const MeshWriter& writer, const Matrix4d& mesh_world, Skin& skin)
{
    const SceneNodes& nodes = writer.nodes;
    std::vector<bool> is_below(nodes.nodes.size());
    const std::set<int> bones(skin.joints.begin(), skin.joints.end());
    for (std::size_t n = 0; n < nodes.nodes.size(); ++n) {
        const int node = static_cast<int>(n);
        const bool is_bone = bones.contains(node);
        is_below[n] = is_bone || (nodes.parents[n] >= 0 && is_below[static_cast<std::size_t>(nodes.parents[n])]);
        if (!is_below[n] || is_bone || nodes.nodes[n]->mNumMeshes > 0) continue;
        const Eigen::Affine3d world(world_of(nodes, node));
        const bool has_inverse = world.linear().determinant() != 0;
        add_joint(
            skin, node,
            has_inverse ? Matrix4d((world.inverse() * Eigen::Affine3d(mesh_world)).matrix()) : Matrix4d::Identity());
    }
}

struct Influence {
    std::uint16_t joint = 0;
    double weight = 0;
};

void add_influence(std::vector<Influence>& all, int joint, float weight)
{
    const auto same = std::find_if(all.begin(), all.end(), [&](const Influence& each) { return each.joint == joint; });
    if (same == all.end())
        all.push_back({static_cast<std::uint16_t>(joint), static_cast<double>(weight)});
    else
        same->weight += static_cast<double>(weight);  // glTF has a joint once a vertex
}

// What each vertex follows, by the joints' places in the skin.
std::vector<std::vector<Influence>> influences_of(const MeshWriter& writer, const aiMesh& mesh, Skin& skin)
{
    std::vector<std::vector<Influence>> influences(mesh.mNumVertices);
    for (const aiBone* bone : bones_of(mesh)) {
        const int node = node_named(writer.nodes, bone->mName.C_Str(), "a bone is called");
        if (node < 0) continue;
        const int joint = place_of(skin, node, matrix_of(bone->mOffsetMatrix));
        for (const aiVertexWeight& weight : std::span(bone->mWeights, bone->mNumWeights))
            if (weight.mVertexId < mesh.mNumVertices && weight.mWeight > 0 && std::isfinite(weight.mWeight))
                add_influence(influences[weight.mVertexId], joint, weight.mWeight);
    }
    return influences;
}

// The strongest four of a vertex, their weights adding up to 1.
std::array<Influence, 4> strongest(std::vector<Influence> all)
{
    std::array<Influence, 4> best;
    std::stable_sort(all.begin(), all.end(),
                     [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
    std::copy_n(all.begin(), std::min(all.size(), best.size()), best.begin());
    double sum = 0;
    for (const Influence& each : best) sum += each.weight;
    for (Influence& each : best) each.weight /= sum;
    return best;
}

void add_weights(GltfBuilder& gltf, const std::vector<std::vector<Influence>>& influences, Json& attributes)
{
    std::vector<std::uint16_t> joints;
    std::vector<float> weights;
    for (const std::vector<Influence>& all : influences)
        for (const Influence& each : strongest(all)) {
            weights.push_back(static_cast<float>(each.weight));
            joints.push_back(weights.back() > 0 ? each.joint : std::uint16_t{0});
        }
    attributes["JOINTS_0"] = add_joints(gltf, joints);
    attributes["WEIGHTS_0"] = add_floats(gltf, weights, 4, GltfUse::vertices);
}

// The skin of a mesh that hangs on `node`, as its number, and its vertices' weights.
std::size_t add_skin(MeshWriter& writer, const aiMesh& mesh, int node, Json& attributes)
{
    Skin skin;
    auto influences = influences_of(writer, mesh, skin);
    add_idle_joints(writer, world_of(writer.nodes, node), skin);
    for (std::vector<Influence>& all : influences)  // what follows no bone stays with the mesh's own node
        if (all.empty()) add_influence(all, place_of(skin, node, Matrix4d::Identity()), 1);
    add_weights(writer.gltf, influences, attributes);
    const std::size_t binds = add_floats(writer.gltf, skin.inverse_binds, 16, GltfUse::none);
    writer.gltf.json["skins"].push_back({{"inverseBindMatrices", binds}, {"joints", skin.joints}});
    return writer.gltf.json["skins"].size() - 1;
}

// ---- meshes

std::optional<Json> make_primitive(MeshWriter& writer, const aiMesh& mesh)
{
    const std::vector<std::uint32_t> triangles = triangles_of(mesh);
    if (triangles.empty()) return {};
    const bool has_material = mesh.mMaterialIndex < writer.textured.size();
    Json attributes;
    attributes["POSITION"] = add_floats(writer.gltf, positions_of(mesh), 3, GltfUse::vertices);
    if (const auto normals = normals_of(mesh); !normals.empty())
        attributes["NORMAL"] = add_floats(writer.gltf, normals, 3, GltfUse::vertices);
    const bool is_textured = has_material && writer.textured[mesh.mMaterialIndex];
    if (const auto coordinates = texture_coordinates_of(mesh, is_textured); !coordinates.empty())
        attributes["TEXCOORD_0"] = add_floats(writer.gltf, coordinates, 2, GltfUse::vertices);
    Json primitive{{"attributes", std::move(attributes)}, {"indices", add_indices(writer.gltf, triangles)}};
    if (has_material) primitive["material"] = mesh.mMaterialIndex;
    return primitive;
}

// The scene's mesh of this number; nothing where it has no triangles.
std::optional<Json> primitive_of(MeshWriter& writer, unsigned index)
{
    const auto [known, is_new] = writer.shapes.try_emplace(index);
    if (is_new) known->second = make_primitive(writer, *writer.scene.mMeshes[index]);
    return known->second;
}

std::size_t add_mesh(MeshWriter& writer, const std::string& name, Json primitives)
{
    Json mesh{{"primitives", std::move(primitives)}};
    if (!name.empty()) mesh["name"] = name;
    writer.gltf.json["meshes"].push_back(std::move(mesh));
    return writer.gltf.json["meshes"].size() - 1;
}

void hang_meshes(MeshWriter& writer, int number)
{
    const aiNode& node = *writer.nodes.nodes[static_cast<std::size_t>(number)];
    Json rigid = Json::array();
    bool is_taken = false;
    const auto place = [&]() -> Json& {  // the node itself for the first, then children that lie where it does
        Json& list = writer.gltf.json["nodes"];
        Json& own = list[static_cast<std::size_t>(number)];
        if (!std::exchange(is_taken, true)) return own;
        own["children"].push_back(list.size());
        list.push_back(Json::object());
        return list.back();
    };
    for (const unsigned index : std::span(node.mMeshes, node.mNumMeshes)) {
        const aiMesh& mesh = *writer.scene.mMeshes[index];
        std::optional<Json> primitive = primitive_of(writer, index);
        if (!primitive) continue;
        if (mesh.mNumBones == 0) {
            rigid.push_back(std::move(*primitive));
            continue;
        }
        const std::size_t skin = add_skin(writer, mesh, number, (*primitive)["attributes"]);
        const std::size_t skinned = add_mesh(writer, mesh.mName.C_Str(), Json::array({std::move(*primitive)}));
        Json& at = place();
        at["mesh"] = skinned;
        at["skin"] = skin;
    }
    if (rigid.empty()) return;
    const std::size_t mesh = add_mesh(writer, node.mName.C_Str(), std::move(rigid));
    place()["mesh"] = mesh;
}

}  // namespace

void add_meshes(GltfBuilder& gltf, const aiScene& scene, const SceneNodes& nodes)
{
    MeshWriter writer{gltf, scene, nodes, add_materials(gltf, scene, nodes.path)};
    for (std::size_t n = 0; n < nodes.nodes.size(); ++n) hang_meshes(writer, static_cast<int>(n));
}

}  // namespace swivel::formats

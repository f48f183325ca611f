// SPDX-License-Identifier: MIT
#include "tools/formats/scene_gltf.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>

#include "tools/formats/error.h"
#include "tools/formats/gltf_builder.h"
#include "tools/formats/scene_meshes.h"
#include "tools/formats/scene_nodes.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

using Json = nlohmann::json;

constexpr double kDefaultTicks = 25;  // a second, where a file says none: assimp's own tools take this

struct AnimationWriter {
    GltfBuilder& gltf;
    const SceneNodes& nodes;
    std::map<std::vector<float>, std::size_t> times = {};  // accessors of key times, which most channels share
    std::set<int> moved = {};                              // nodes that any animation moves
};

struct Track {
    std::vector<float> times, values;
};

void append(std::vector<float>& values, const aiVector3D& v) { values.insert(values.end(), {v.x, v.y, v.z}); }

void append(std::vector<float>& values, const aiQuaternion& q)
{
    const Eigen::Quaterniond unit = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
    for (const double part : unit.coeffs()) values.push_back(static_cast<float>(part));
}

bool is_sound(const aiVectorKey& key) { return std::isfinite(key.mTime) && std::isfinite(key.mValue.SquareLength()); }

bool is_sound(const aiQuatKey& key)
{
    const aiQuaternion& q = key.mValue;
    const double square = Eigen::Vector4d(q.x, q.y, q.z, q.w).squaredNorm();
    return std::isfinite(key.mTime) && std::isfinite(square) && square > 1e-12;  // 1e-12: no rotation for the reader
}

// The keys by their times, in seconds from `begin`.
template <class Key>
Track track_of(std::span<const Key> from, double begin, double ticks)
{
    std::vector<Key> keys(from.begin(), from.end());
    std::stable_sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a.mTime < b.mTime; });
    Track track;
    for (const Key& key : keys) {
        auto time = static_cast<float>(key.mTime / ticks - begin);
        if (!track.times.empty() && time <= track.times.back())
            time = std::nextafter(track.times.back(), std::numeric_limits<float>::infinity());
        track.times.push_back(time);
        append(track.values, key.mValue);
    }
    return track;
}

void add_channel(AnimationWriter& writer, Json& animation, int node, const char* path, const Track& track)
{
    if (track.times.empty()) return;
    auto [known, is_new] = writer.times.try_emplace(track.times);
    if (is_new) known->second = add_floats(writer.gltf, track.times, 1, GltfUse::none);
    const std::size_t width = track.values.size() / track.times.size();
    const std::size_t output = add_floats(writer.gltf, track.values, width, GltfUse::none);
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
    animation["samplers"].push_back({{"input", known->second}, {"interpolation", "LINEAR"}, {"output", output}});
    writer.moved.insert(node);
}

std::span<const aiVectorKey> positions(const aiNodeAnim& at) { return {at.mPositionKeys, at.mNumPositionKeys}; }
std::span<const aiQuatKey> rotations(const aiNodeAnim& at) { return {at.mRotationKeys, at.mNumRotationKeys}; }
std::span<const aiVectorKey> scales(const aiNodeAnim& at) { return {at.mScalingKeys, at.mNumScalingKeys}; }

// The time of the animation's first key in seconds, if that is before 0, which glTF does not have.
double checked_begin(const AnimationWriter& writer, const aiAnimation& from, double ticks)
{
    double begin = 0;
    const auto check = [&](const auto& keys, const aiNodeAnim& at) {
        for (const auto& key : keys) {
            if (!is_sound(key))
                throw InputError(writer.nodes.path,
                                 fmt::format("a key of animation '{}' for '{}' is not finite or no rotation",
                                             printable(from.mName.C_Str()), printable(at.mNodeName.C_Str())));
            begin = std::min(begin, key.mTime / ticks);
        }
    };
    for (const aiNodeAnim* at : std::span(from.mChannels, from.mNumChannels)) {
        check(positions(*at), *at);
        check(rotations(*at), *at);
        check(scales(*at), *at);
    }
    return begin;
}

void add_animation(AnimationWriter& writer, const aiAnimation& from)
{
    const double ticks = from.mTicksPerSecond > 0 ? from.mTicksPerSecond : kDefaultTicks;
    const double begin = checked_begin(writer, from, ticks);
    Json animation;
    if (from.mName.length > 0) animation["name"] = from.mName.C_Str();
    animation["channels"] = Json::array();
    animation["samplers"] = Json::array();
    const std::string use = fmt::format("animation '{}' moves", printable(from.mName.C_Str()));
    for (const aiNodeAnim* at : std::span(from.mChannels, from.mNumChannels)) {
        const int node = node_named(writer.nodes, at->mNodeName.C_Str(), use);
        if (node < 0) continue;  // a camera's or a light's own
        add_channel(writer, animation, node, "translation", track_of(positions(*at), begin, ticks));
        add_channel(writer, animation, node, "rotation", track_of(rotations(*at), begin, ticks));
        add_channel(writer, animation, node, "scale", track_of(scales(*at), begin, ticks));
    }
    if (!animation["channels"].empty()) writer.gltf.json["animations"].push_back(std::move(animation));
}

void set_transform(Json& node, const Eigen::Matrix4d& local, bool is_moved)
{
    if (local.isIdentity(0)) return;
    const NodeParts parts = parts_of(local);
    if (!parts.is_whole && !is_moved) {  // what moves must be in parts, and its keys are
        node["matrix"] = std::vector<double>(local.data(), local.data() + local.size());
        return;
    }
    const auto list = [](const auto& v) { return std::vector<double>(v.data(), v.data() + v.size()); };
    if (!parts.translation.isZero(0)) node["translation"] = list(parts.translation);
    node["rotation"] = list(parts.rotation.coeffs());
    if (parts.scale != Eigen::Vector3d::Ones()) node["scale"] = list(parts.scale);
}

void add_nodes(GltfBuilder& gltf, const SceneNodes& nodes, const std::set<int>& moved)
{
    Json list = Json::array();
    for (std::size_t n = 0; n < nodes.nodes.size(); ++n) {
        Json node = Json::object();
        if (nodes.nodes[n]->mName.length > 0) node["name"] = nodes.nodes[n]->mName.C_Str();
        set_transform(node, nodes.local[n], moved.contains(static_cast<int>(n)));
        if (nodes.parents[n] >= 0) list[static_cast<std::size_t>(nodes.parents[n])]["children"].push_back(n);
        list.push_back(std::move(node));
    }
    gltf.json["scene"] = 0;
    gltf.json["scenes"] = {{{"nodes", {0}}}};
    gltf.json["nodes"] = std::move(list);
}

}  // namespace

GltfContainer gltf_of(const aiScene& scene, const std::filesystem::path& path)
{
    GltfBuilder gltf;
    gltf.json["asset"] = {{"version", "2.0"}, {"generator", "swivel, from assimp"}};
    const SceneNodes nodes = nodes_of(scene, path);
    AnimationWriter writer{gltf, nodes};
    for (const aiAnimation* animation : std::span(scene.mAnimations, scene.mNumAnimations))
        add_animation(writer, *animation);
    add_nodes(gltf, nodes, writer.moved);
    add_meshes(gltf, scene, nodes);
    return container_of(std::move(gltf));
}

}  // namespace swivel::formats

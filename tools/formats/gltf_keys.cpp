// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_keys.h"

#include <algorithm>
#include <span>

namespace swivel::formats {
namespace {

using Json = nlohmann::json;

constexpr int kFloat = 5126;  // glTF's componentType

// An animated node must not have a matrix.
void take_matrix_apart(Json& node, const GltfChanges::Track& track)
{
    if (node.erase("matrix") == 0) return;
    const Eigen::Quaterniond& q = track.rotation;
    node["translation"] = {track.translation.x(), track.translation.y(), track.translation.z()};
    node["rotation"] = {q.x(), q.y(), q.z(), q.w()};
    node["scale"] = {track.scale.x(), track.scale.y(), track.scale.z()};
}

// Adds an accessor of floats. Its index.
std::size_t add_floats(GltfAsset& asset, std::span<const float> values, std::size_t width, const char* type)
{
    asset.list("bufferViews")
        .push_back(asset.add_bytes({reinterpret_cast<const char*>(values.data()), values.size_bytes()}));
    asset.list("accessors")
        .push_back({{"bufferView", asset.list("bufferViews").size() - 1},
                    {"componentType", kFloat},
                    {"count", values.size() / width},
                    {"type", type}});
    return asset.list("accessors").size() - 1;
}

// The sampler of the node's rotation, unless other channels use it, too; else a new one.
Json& sampler_for(Json& animation, int node)
{
    Json &channels = animation["channels"], &samplers = animation["samplers"];
    const auto is_its = [&](const Json& channel) {
        const Json& target = channel.at("target");
        return target.at("path") == "rotation" && target.value("node", -1) == node;
    };
    auto channel = std::find_if(channels.begin(), channels.end(), is_its);
    if (channel == channels.end()) {
        channels.push_back({{"target", {{"node", node}, {"path", "rotation"}}}});
        channel = channels.end() - 1;
    } else {
        const Json& old = channel->at("sampler");
        const auto uses_it = [&](const Json& each) { return each.at("sampler") == old; };
        if (std::count_if(channels.begin(), channels.end(), uses_it) == 1) return samplers[old.get<std::size_t>()];
    }
    (*channel)["sampler"] = samplers.size();
    return samplers.emplace_back(Json::object());
}

}  // namespace

Json& GltfAsset::list(const char* name)
{
    Json& found = document[name];
    if (!found.is_array()) found = Json::array();
    return found;
}

void GltfAsset::drop_empty_lists()
{
    for (const char* name : {"buffers", "bufferViews", "accessors"})
        if (list(name).empty()) document.erase(name);
}

Json GltfAsset::add_bytes(std::string_view content)
{
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    const Json view{{"buffer", buffer}, {"byteOffset", bytes.size()}, {"byteLength", content.size()}};
    bytes += content;
    return view;
}

void add_keys(GltfAsset& asset, const GltfChanges& changes)
{
    if (changes.tracks.empty()) return;
    const std::size_t times = add_floats(asset, changes.times, 1, "SCALAR");
    asset.list("accessors")[times]["min"] = {changes.times.front()};
    asset.list("accessors")[times]["max"] = {changes.times.back()};
    if (changes.animation < 0) asset.list("animations").push_back({{"name", "swivel"}});
    Json& animations = asset.list("animations");
    Json& animation =
        changes.animation < 0 ? animations.back() : animations[static_cast<std::size_t>(changes.animation)];
    for (const char* name : {"channels", "samplers"})
        if (!animation.contains(name)) animation[name] = Json::array();
    for (const GltfChanges::Track& track : changes.tracks) {
        take_matrix_apart(asset.list("nodes")[static_cast<std::size_t>(track.node)], track);
        const std::size_t rotations = add_floats(asset, track.xyzw, 4, "VEC4");
        Json& sampler = sampler_for(animation, track.node);
        sampler["input"] = times;
        sampler["output"] = rotations;
        sampler["interpolation"] = track.is_stepped ? "STEP" : "LINEAR";
    }
}

}  // namespace swivel::formats

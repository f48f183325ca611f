// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_edit.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/formats/gltf_buffers.h"
#include "tools/formats/gltf_json.h"
#include "tools/formats/gltf_uri.h"

namespace swivel::formats {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr int kFloat = 5126;  // glTF's componentType

// A document being edited: its JSON, and the buffer for new bytes.
struct GltfAsset {
    Json document;
    std::string bytes = {};  // of the GLB's chunk, or of a new buffer
    std::size_t buffer = 0;  // whose bytes these are

    // The document's list of this name, which is made if it is missing.
    Json& list(const char* name)
    {
        Json& found = document[name];
        if (!found.is_array()) found = Json::array();
        return found;
    }
    // Adds bytes, and returns the index of their buffer view.
    Json add_bytes(std::string_view content)
    {
        bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
        const Json view{{"buffer", buffer}, {"byteOffset", bytes.size()}, {"byteLength", content.size()}};
        bytes += content;
        return view;
    }
};

// Buffers of a .gltf: a GLB's chunk moves into the text, and files are used where they are.
void settle_text(GltfAsset& asset, std::span<const std::string_view> buffers)
{
    Json& list = asset.list("buffers");
    for (std::size_t n = 0; n < list.size(); ++n)
        if (!list[n].contains("uri")) list[n]["uri"] = data_uri_of(buffers[n]);
    asset.buffer = list.size();
    list.push_back({{"byteLength", 0}});
}

// Makes a buffer view, and its extensions, refer to the chunk.
void move_into_chunk(Json& view, std::span<const std::size_t> begins)
{
    const auto number = [&](const char* member) {
        const auto found = view.find(member);
        return found != view.end() && found->is_number_unsigned() ? found->get<std::size_t>() : SIZE_MAX;
    };
    if (const std::size_t buffer = number("buffer"), offset = number("byteOffset"); buffer < begins.size()) {
        view["buffer"] = 0;
        if (begins[buffer] > 0) view["byteOffset"] = begins[buffer] + (offset == SIZE_MAX ? 0 : offset);
    }
    if (const auto extensions = view.find("extensions"); extensions != view.end() && extensions->is_object())
        for (Json& extension : *extensions)
            if (extension.is_object()) move_into_chunk(extension, begins);
}

// Buffers of a GLB: its chunk is the first and only one.
void settle_binary(GltfAsset& asset, std::span<const std::string_view> buffers)
{
    Json& list = asset.list("buffers");
    std::vector<std::size_t> begins;
    for (const std::string_view bytes : buffers) {
        const Json view = asset.add_bytes(bytes);
        begins.push_back(view["byteOffset"]);
    }
    if (buffers.size() > 1) {
        for (Json& view : asset.list("bufferViews")) move_into_chunk(view, begins);
        list.erase(list.begin() + 1, list.end());
    }
    if (list.empty()) list.push_back({{"byteLength", 0}});
    list[0].erase("uri");
}

// A vector, or a quaternion's coeffs(), as a list.
Json list_of(const auto& numbers) { return std::vector<double>(numbers.begin(), numbers.end()); }

// An animated node must not have a matrix.
void take_matrix_apart(Json& node, const GltfChanges::Track& track)
{
    if (node.erase("matrix") == 0) return;
    node["translation"] = list_of(track.rest.offset);
    node["rotation"] = list_of(track.rest.rotation.coeffs());
    node["scale"] = list_of(track.rest.scale);
}

// Adds an accessor of floats, and returns its index.
std::size_t add_floats(GltfAsset& asset, std::span<const float> values, std::size_t width)
{
    asset.list("bufferViews")
        .push_back(asset.add_bytes({reinterpret_cast<const char*>(values.data()), values.size_bytes()}));
    asset.list("accessors")
        .push_back({{"bufferView", asset.list("bufferViews").size() - 1},
                    {"componentType", kFloat},
                    {"count", values.size() / width},
                    {"type", accessor_type(width)}});
    return asset.list("accessors").size() - 1;
}

// Adds a channel of the node's rotation or translation, and returns its sampler.
Json& add_channel(Json& animation, int node, const char* path)
{
    Json& samplers = animation["samplers"];
    animation["channels"].push_back({{"sampler", samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
    return samplers.emplace_back(Json::object());
}

// The sampler of the node's rotation or translation, unless other channels use it, too; else a new one.
Json& sampler_for(Json& animation, int node, const char* path)
{
    Json &channels = animation["channels"], &samplers = animation["samplers"];
    const auto is_its = [&](const Json& channel) {
        const Json& target = channel.at("target");
        return target.at("path") == path && target.value("node", -1) == node;
    };
    const auto channel = std::find_if(channels.begin(), channels.end(), is_its);
    if (channel == channels.end()) return add_channel(animation, node, path);
    const Json& old = channel->at("sampler");
    const auto uses_it = [&](const Json& each) { return each.at("sampler") == old; };
    if (std::count_if(channels.begin(), channels.end(), uses_it) == 1) return samplers[old.get<std::size_t>()];
    (*channel)["sampler"] = samplers.size();
    return samplers.emplace_back(Json::object());
}

// The animation that new keys go into.
Json& animation_for(GltfAsset& asset, const GltfChanges& changes)
{
    if (changes.animation < 0) asset.list("animations").push_back({{"name", "swivel"}});
    Json& animations = asset.list("animations");
    Json& animation =
        changes.animation < 0 ? animations.back() : animations[static_cast<std::size_t>(changes.animation)];
    if (changes.name) animation = {{"name", *changes.name}};
    for (const char* name : {"channels", "samplers"})
        if (!animation.contains(name)) animation[name] = Json::array();
    return animation;
}

// A node rests as its first keys have it.
void rest_at_first_keys(Json& node, const GltfChanges::Track& track)
{
    const auto rest = [&](const char* name, std::span<const float> keys, std::size_t width) {
        if (!keys.empty())
            node[name] = std::vector<float>(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(width));
    };
    rest("rotation", track.xyzw, 4);
    rest("translation", track.xyz, 3);
}

// Adds keys of nodes, counted from the first node of a figure. sampler_of: sampler_for(), or add_channel() if the
// animation has none of these nodes, which saves the search.
void add_tracks(GltfAsset& asset, std::size_t times, std::span<const GltfChanges::Track> tracks, Json& animation,
                std::size_t first_node, Json& (*sampler_of)(Json&, int, const char*))
{
    for (const GltfChanges::Track& track : tracks) {
        const std::size_t node = first_node + static_cast<std::size_t>(track.node);
        take_matrix_apart(asset.list("nodes")[node], track);
        const auto add = [&](const char* path, std::span<const float> keys, std::size_t width) {
            if (keys.empty()) return;
            Json& sampler = sampler_of(animation, static_cast<int>(node), path);
            sampler["input"] = times;
            sampler["output"] = add_floats(asset, keys, width);
            sampler["interpolation"] = track.is_stepped ? "STEP" : "LINEAR";
        };
        add("rotation", track.xyzw, 4);
        add("translation", track.xyz, 3);
    }
}

// Nodes that are no child of another.
std::vector<std::size_t> root_nodes(const Json& nodes)
{
    std::vector<bool> is_child(nodes.size());
    for (const Json& node : nodes)
        if (node.contains("children"))
            for (const Json& child : node["children"]) is_child[child.get<std::size_t>()] = true;
    std::vector<std::size_t> roots;
    for (std::size_t n = 0; n < nodes.size(); ++n)
        if (!is_child[n]) roots.push_back(n);
    return roots;
}

// Moves an object's indices of nodes or skins by an offset.
void shift(Json& object, const char* name, std::size_t by)
{
    const auto found = object.find(name);
    if (found == object.end()) return;
    if (found->is_array())
        for (Json& each : *found) each = each.get<std::size_t>() + by;
    else if (found->is_number_unsigned())
        *found = found->get<std::size_t>() + by;
}

// Appends copies of the first nodes and skins.
void copy_nodes(GltfAsset& asset, std::size_t node_count, std::size_t skin_count)
{
    Json &nodes = asset.list("nodes"), &skins = asset.list("skins");
    const std::size_t by = nodes.size(), skins_by = skins.size();
    for (std::size_t n = 0; n < node_count; ++n) {
        Json node = nodes[n];
        shift(node, "children", by), shift(node, "skin", skins_by);
        nodes.push_back(std::move(node));
    }
    for (std::size_t n = 0; n < skin_count; ++n) {
        Json skin = skins[n];
        shift(skin, "joints", by), shift(skin, "skeleton", by);
        skins.push_back(std::move(skin));
    }
}

void add_figures(GltfAsset& asset, std::size_t times, const GltfChanges& changes)
{
    const std::size_t node_count = asset.list("nodes").size(), skin_count = asset.list("skins").size();
    for (std::size_t n = 1; n < changes.figures.size(); ++n) copy_nodes(asset, node_count, skin_count);
    const std::vector<std::size_t> roots = root_nodes(asset.list("nodes"));  // so many of each figure
    Json shown = Json::array();
    Json animation{{"name", changes.name.value_or("")}, {"channels", Json::array()}, {"samplers", Json::array()}};
    for (std::size_t n = 0; n < changes.figures.size(); ++n) {
        const GltfChanges::Figure& figure = changes.figures[n];
        const auto first = roots.begin() + static_cast<std::ptrdiff_t>(n * roots.size() / changes.figures.size()),
                   end = roots.begin() + static_cast<std::ptrdiff_t>((n + 1) * roots.size() / changes.figures.size());
        shown.push_back(asset.list("nodes").size());
        asset.list("nodes").push_back({{"name", figure.name},
                                       {"translation", list_of(figure.place)},
                                       {"scale", {figure.size, figure.size, figure.size}},
                                       {"children", std::vector<std::size_t>(first, end)}});
        if (!figure.rotation.vec().isZero(0))
            asset.list("nodes").back()["rotation"] = list_of(figure.rotation.coeffs());
        add_tracks(asset, times, figure.tracks, animation, n * node_count, add_channel);
        for (const GltfChanges::Track& track : figure.tracks)
            rest_at_first_keys(asset.list("nodes")[n * node_count + static_cast<std::size_t>(track.node)], track);
    }
    asset.document["scenes"] = {{{"nodes", std::move(shown)}}};
    asset.document["scene"] = 0;
    asset.document["animations"] = Json::array({std::move(animation)});
    if (skin_count == 0) asset.document.erase("skins");
}

// Puts the new node in. read: the file before its buffers moved.
void add_node(GltfAsset& asset, const GltfData& read, const GltfChanges::NewNode& added)
{
    Json& nodes = asset.list("nodes");
    const std::size_t node = nodes.size();
    const auto put_in = [&](Json& owners, const char* list) {
        for (Json& owner : owners)
            if (const auto found = owner.find(list); found != owner.end())
                std::replace(found->begin(), found->end(), Json(added.below), Json(node));
    };
    put_in(nodes, "children");
    if (asset.document.contains("scenes")) put_in(asset.document["scenes"], "nodes");
    nodes.push_back({{"name", added.name}, {"children", Json::array({added.below})}});
    if (!asset.document.contains("skins")) return;
    for (Json& skin : asset.document["skins"]) {
        if (skin.contains("skeleton") && skin["skeleton"] == added.below) skin["skeleton"] = node;
        const auto joints = skin.find("joints");
        if (joints == skin.end() || std::find(joints->begin(), joints->end(), Json(added.below)) == joints->end())
            continue;
        if (const auto binds = skin.find("inverseBindMatrices"); binds != skin.end()) {
            std::vector<double> matrices = read_accessor(read, binds->get<int>(), 16, joints->size(), true);
            matrices.resize(16 * joints->size());  // a skin may have more of them than joints
            const auto added_bind = added.inverse_bind.reshaped();
            matrices.insert(matrices.end(), added_bind.begin(), added_bind.end());
            *binds = add_floats(asset, std::vector<float>(matrices.begin(), matrices.end()), 16);
        }
        joints->push_back(node);
    }
}

void add_keys(GltfAsset& asset, const GltfChanges& changes)
{
    if (changes.drops_animations) asset.document.erase("animations");
    if (changes.tracks.empty() && changes.figures.empty()) return;
    const std::size_t times = add_floats(asset, changes.times, 1);
    asset.list("accessors")[times]["min"] = {changes.times.front()};
    asset.list("accessors")[times]["max"] = {changes.times.back()};
    if (changes.figures.empty())
        add_tracks(asset, times, changes.tracks, animation_for(asset, changes), 0, sampler_for);
    else
        add_figures(asset, times, changes);
}

}  // namespace

GltfContainer with_changes(const GltfContainer& file, std::span<const std::string_view> buffers,
                           const GltfChanges& changes, const fs::path& from, const fs::path& to, bool binary)
{
    GltfAsset asset{gltf_document(from, file.json)};
    const Json before = changes.node ? asset.document : Json();
    if (binary)
        settle_binary(asset, buffers);
    else
        settle_text(asset, buffers);
    if (changes.node) add_node(asset, {from, before, buffers}, *changes.node);
    for_each_uri(asset.document, [&](Json& object) {
        auto& uri = object["uri"].get_ref<std::string&>();
        if (!is_data_uri(uri)) uri = moved_uri(uri, from, to);
    });
    add_keys(asset, changes);
    Json& list = asset.list("buffers");
    list[asset.buffer]["byteLength"] = asset.bytes.size();
    if (!binary && asset.bytes.empty()) list.erase(asset.buffer);
    if (!binary && !asset.bytes.empty()) list[asset.buffer]["uri"] = data_uri_of(asset.bytes);
    if (binary && asset.bytes.empty() && buffers.empty()) list.clear();
    for (const char* name : {"buffers", "bufferViews", "accessors"})  // an empty list is not legal glTF
        if (asset.list(name).empty()) asset.document.erase(name);
    GltfContainer out;
    out.json = asset.document.dump();
    out.is_binary = binary;
    if (binary) {
        out.bytes = std::move(asset.bytes);
        out.other_chunks = file.other_chunks;
    }
    return out;
}

}  // namespace swivel::formats

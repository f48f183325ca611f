// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "tools/formats/error.h"
#include "tools/formats/gltf_check.h"
#include "tools/formats/gltf_uri.h"
#include "tools/formats/picture.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr int kFloat = 5126, kVertices = 34962;  // glTF's componentType, and its target of a buffer view
constexpr std::array kGrowing = {"buffers", "bufferViews", "accessors"};

// How deep brackets lie in each other, those in strings aside.
std::size_t depth_of(std::string_view json)
{
    std::size_t depth = 0, deepest = 0;
    bool in_string = false;
    for (std::size_t at = 0; at < json.size(); ++at) {
        const char c = json[at];
        if (in_string && c == '\\')
            ++at;
        else if (c == '"')
            in_string = !in_string;
        else if (!in_string && (c == '{' || c == '['))
            deepest = std::max(deepest, ++depth);
        else if (!in_string && (c == '}' || c == ']') && depth > 0)
            --depth;
    }
    return deepest;
}

// What the JSON library says, without its number for it: "[json.exception.parse_error.101] ".
std::string cause_of(const Json::exception& error)
{
    const std::string_view said = error.what();
    const std::size_t end = said.starts_with('[') ? said.find("] ") : std::string_view::npos;
    return printable(end == std::string_view::npos ? said : said.substr(end + 2), 160);
}

Json parse(const fs::path& path, std::string_view text)
{
    if (depth_of(text) > 500)
        throw InputError(path, "its JSON is nested deeper than 500 levels; no exporter does that");
    try {
        Json document = Json::parse(text);
        if (document.is_object()) return document;
    } catch (const Json::exception& error) {
        throw InputError(path, fmt::format("is not glTF: {}", cause_of(error)));
    }
    throw InputError(path, "is not glTF: its JSON is no object");
}

void copy_members(const Json& from, Json& to, std::initializer_list<const char*> names)
{
    if (!from.is_object()) return;
    for (const char* name : names)
        if (const auto found = from.find(name); found != from.end()) to[name] = *found;
}

// An array's elements with the named members only; nothing where it is no array.
void copy_array(const Json& from, Json& to, const char* array, std::initializer_list<const char*> names)
{
    const auto found = from.find(array);
    if (found == from.end() || !found->is_array()) return;
    to[array] = Json::array();
    for (const Json& element : *found) {
        to[array].push_back(Json::object());
        copy_members(element, to[array].back(), names);
    }
}

void refuse_compression(const fs::path& path, const Json& document)
{
    const auto found = document.find("extensionsRequired");
    if (found == document.end() || !found->is_array()) return;
    for (const Json& name : *found)
        if (name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression")
            throw InputError(path, fmt::format("its buffers are compressed ({}); export it without, or decompress it",
                                               name.get<std::string>()));
}

// An asset on its way into a file: its JSON, and where new bytes go. An object of this Json is a vector of members: a
// new one moves all others, so the lists that grow are there (open_lists()) before anything refers into the document.
struct Asset {
    Json document;
    std::string bytes;       // of the GLB's chunk, or of a new buffer
    std::size_t buffer = 0;  // whose bytes these are

    Json& list(const char* name)
    {
        Json& found = document[name];
        if (!found.is_array()) found = Json::array();
        return found;
    }
    void open_lists()
    {
        for (const char* name : kGrowing) list(name);
    }
    // An empty list is not legal glTF.
    void drop_empty_lists()
    {
        for (const char* name : kGrowing)
            if (document[name].empty()) document.erase(name);
    }
    // Adds bytes as a buffer view; its index.
    std::size_t add_view(std::string_view content)
    {
        bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
        list("bufferViews")
            .push_back({{"buffer", buffer}, {"byteOffset", bytes.size()}, {"byteLength", content.size()}});
        bytes += content;
        return list("bufferViews").size() - 1;
    }
    std::size_t add_floats(std::span<const float> values, const char* type, std::size_t width)
    {
        const std::string_view content(reinterpret_cast<const char*>(values.data()), values.size_bytes());
        const std::size_t view = add_view(content);
        list("accessors")
            .push_back(
                {{"bufferView", view}, {"componentType", kFloat}, {"count", values.size() / width}, {"type", type}});
        return list("accessors").size() - 1;
    }
};

std::string data_uri(std::string_view bytes) { return "data:application/octet-stream;base64," + base64_of(bytes); }

bool is_beside(const Json& object)
{
    if (!object.is_object()) return false;
    const auto uri = object.find("uri");
    return uri != object.end() && uri->is_string() && !is_data_uri(uri->get<std::string>());
}

// Buffers of a .gltf: the chunk of a GLB moves into the text, and what lies in files is used from there.
void settle_text(Asset& asset, std::span<const std::string_view> buffers, const fs::path& from, const fs::path& to)
{
    Json& list = asset.list("buffers");
    for (std::size_t n = 0; n < list.size(); ++n) {
        if (!list[n].contains("uri"))
            list[n]["uri"] = data_uri(buffers[n]);
        else if (is_beside(list[n]))
            list[n]["uri"] = moved_uri(list[n]["uri"], from, to);
    }
    asset.buffer = list.size();
    list.push_back({{"byteLength", 0}});
}

// Buffers of a GLB: the first is its chunk; others move into the text.
void settle_binary(Asset& asset, std::span<const std::string_view> buffers)
{
    Json& list = asset.list("buffers");
    for (std::size_t n = 1; n < list.size(); ++n)
        if (is_beside(list[n])) list[n]["uri"] = data_uri(buffers[n]);
    if (list.empty()) list.push_back({{"byteLength", 0}});
    list[0].erase("uri");
    if (!buffers.empty()) asset.bytes = buffers[0];
}

void settle_images(Asset& asset, const fs::path& from, const fs::path& to, bool binary)
{
    const auto found = asset.document.find("images");
    if (found == asset.document.end() || !found->is_array()) return;
    for (Json& image : asset.list("images")) {
        if (!is_beside(image)) continue;
        const std::string uri = image["uri"];
        const std::string bytes = binary ? picture_at(file_at(uri, from)) : std::string();
        const std::string_view kind = picture_kind(bytes);
        if (kind.empty()) {  // also where there is none
            image["uri"] = moved_uri(uri, from, to);
            continue;
        }
        image.erase("uri");
        image["mimeType"] = kind;
        image["bufferView"] = asset.add_view(bytes);
    }
}

// An animated node must not have a matrix.
void take_matrix_apart(Json& node, const GltfChanges::Track& track)
{
    if (!node.contains("matrix")) return;
    node.erase("matrix");
    const Eigen::Quaterniond& q = track.rotation;
    node["translation"] = {track.translation.x(), track.translation.y(), track.translation.z()};
    node["rotation"] = {q.x(), q.y(), q.z(), q.w()};
    node["scale"] = {track.scale.x(), track.scale.y(), track.scale.z()};
}

bool is_rotation_of(const Json& channel, int node)
{
    const auto target = channel.find("target");
    return target != channel.end() && target->value("path", "") == "rotation" && target->value("node", -1) == node;
}

// Gives the node's rotation channel the sampler: in the place of the one it had, unless others use that one too.
void put_sampler(Json& animation, int node, const Json& sampler)
{
    for (const char* name : {"channels", "samplers"})  // both, before a reference is taken to one
        if (!animation.contains(name)) animation[name] = Json::array();
    Json &channels = animation["channels"], &samplers = animation["samplers"];
    const auto channel =
        std::find_if(channels.begin(), channels.end(), [&](const Json& each) { return is_rotation_of(each, node); });
    if (channel == channels.end()) {
        channels.push_back({{"sampler", samplers.size()}, {"target", {{"node", node}, {"path", "rotation"}}}});
        samplers.push_back(sampler);
        return;
    }
    const std::size_t old = (*channel)["sampler"];
    const auto users = std::count_if(channels.begin(), channels.end(),
                                     [&](const Json& each) { return each.value("sampler", -1) == int(old); });
    if (users == 1) {
        samplers[old].update(sampler);
    } else {
        (*channel)["sampler"] = samplers.size();
        samplers.push_back(sampler);
    }
}

void add_keys(Asset& asset, const GltfChanges& changes)
{
    if (changes.tracks.empty()) return;
    const std::size_t times = asset.add_floats(changes.times, "SCALAR", 1);
    asset.list("accessors")[times]["min"] = {changes.times.front()};
    asset.list("accessors")[times]["max"] = {changes.times.back()};
    Json& animations = asset.list("animations");
    const int at = changes.animation;
    if (at < 0) animations.push_back({{"name", "swivel"}, {"channels", Json::array()}, {"samplers", Json::array()}});
    Json& animation = at < 0 ? animations.back() : animations[static_cast<std::size_t>(at)];
    for (const GltfChanges::Track& track : changes.tracks) {
        take_matrix_apart(asset.list("nodes")[static_cast<std::size_t>(track.node)], track);
        put_sampler(animation, track.node,
                    {{"input", times},
                     {"interpolation", track.is_stepped ? "STEP" : "LINEAR"},
                     {"output", asset.add_floats(track.xyzw, "VEC4", 4)}});
    }
}

void add_weights(Asset& asset, std::span<const GltfWeights> all)
{
    for (const GltfWeights& weights : all)
        for (std::size_t n = 0; n < weights.sets.size(); ++n) {
            const std::size_t accessor = asset.add_floats(weights.sets[n], "VEC4", 4);
            asset.list("bufferViews").back()["target"] = kVertices;
            for (const auto& [mesh, primitive] : weights.primitives)
                asset.document["meshes"][mesh]["primitives"][primitive]["attributes"][fmt::format("WEIGHTS_{}", n)] =
                    accessor;
        }
}

}  // namespace

Json gltf_document(const fs::path& path, std::string_view json)
{
    Json document = parse(path, json);
    refuse_compression(path, document);
    check_members(path, document);
    return document;
}

std::vector<fs::path> files_beside(const fs::path& path, const Json& document)
{
    std::vector<fs::path> files;
    for (const char* const kind : {"buffers", "images"}) {
        const auto list = document.find(kind);
        if (list == document.end() || !list->is_array()) continue;
        for (const Json& each : *list)
            if (is_beside(each)) files.push_back(file_at(each["uri"].get<std::string>(), path));
    }
    std::erase(files, fs::path());  // addresses that name no file
    return files;
}

std::string skeleton_json(const Json& whole)
{
    Json part = Json::object();
    copy_members(whole, part, {"asset"});
    copy_array(whole, part, "bufferViews", {"buffer", "byteOffset", "byteLength", "byteStride"});
    copy_array(whole, part, "accessors",
               {"bufferView", "byteOffset", "componentType", "normalized", "count", "type", "sparse"});
    copy_array(whole, part, "nodes", {"name", "children", "translation", "rotation", "scale", "matrix"});
    copy_array(whole, part, "skins", {"joints"});
    copy_array(whole, part, "animations", {"name", "channels", "samplers"});
    return part.dump();
}

GltfContainer with_changes(const GltfContainer& file, std::span<const std::string_view> buffers,
                           const GltfChanges& changes, const fs::path& from, const fs::path& to, bool binary)
try {
    Asset asset{parse(from, file.json), {}, 0};
    asset.open_lists();
    if (binary)
        settle_binary(asset, buffers);
    else
        settle_text(asset, buffers, from, to);
    settle_images(asset, from, to, binary);
    add_keys(asset, changes);
    add_weights(asset, changes.weights);
    Json& list = asset.list("buffers");
    list[asset.buffer]["byteLength"] = asset.bytes.size();
    if (!binary && asset.bytes.empty()) list.erase(asset.buffer);
    if (!binary && !asset.bytes.empty()) list[asset.buffer]["uri"] = data_uri(asset.bytes);
    if (binary && asset.bytes.empty() && buffers.empty()) list.clear();
    asset.drop_empty_lists();
    GltfContainer out;
    out.json = asset.document.dump();
    out.is_binary = binary;
    if (binary) {
        out.bytes = std::move(asset.bytes);
        out.other_chunks = file.other_chunks;
    }
    return out;
} catch (const Json::exception& error) {
    throw InputError(from, fmt::format("is not sound glTF: {}", cause_of(error)));
}

}  // namespace swivel::formats

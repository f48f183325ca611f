// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_edit.h"

#include <cstdint>

#include "tools/formats/gltf_json.h"
#include "tools/formats/gltf_keys.h"
#include "tools/formats/gltf_uri.h"

namespace swivel::formats {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

// Buffers of a .gltf: the chunk of a GLB moves into the text, and what lies in files is used from there.
void settle_text(GltfAsset& asset, std::span<const std::string_view> buffers)
{
    Json& list = asset.list("buffers");
    for (std::size_t n = 0; n < list.size(); ++n)
        if (!list[n].contains("uri")) list[n]["uri"] = data_uri_of(buffers[n]);
    asset.buffer = list.size();
    list.push_back({{"byteLength", 0}});
}

// What names a part of a buffer, itself or in an extension of its own, names it in the chunk now.
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

}  // namespace

GltfContainer with_changes(const GltfContainer& file, std::span<const std::string_view> buffers,
                           const GltfChanges& changes, const fs::path& from, const fs::path& to, bool binary)
{
    GltfAsset asset;
    asset.document = gltf_document(from, file.json);
    if (binary)
        settle_binary(asset, buffers);
    else
        settle_text(asset, buffers);
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
    asset.drop_empty_lists();
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

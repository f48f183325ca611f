// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_builder.h"

#include <algorithm>

namespace swivel::formats {
namespace {

using Json = nlohmann::json;

constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;

template <class Number>
std::string_view bytes_of(std::span<const Number> values)
{
    return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};  // little-endian, as glTF's are
}

std::size_t add(Json& list, Json element)
{
    list.push_back(std::move(element));
    return list.size() - 1;
}

const char* type_of(std::size_t width)
{
    return width == 1 ? "SCALAR" : width == 2 ? "VEC2" : width == 3 ? "VEC3" : width == 4 ? "VEC4" : "MAT4";
}

std::size_t add_accessor(GltfBuilder& gltf, std::size_t view, int component, std::size_t count, std::size_t width)
{
    return add(gltf.json["accessors"],
               {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type_of(width)}});
}

}  // namespace

std::size_t add_view(GltfBuilder& gltf, std::string_view bytes, GltfUse use)
{
    gltf.bytes.resize((gltf.bytes.size() + 3) / 4 * 4, '\0');
    Json view{{"buffer", 0}, {"byteOffset", gltf.bytes.size()}, {"byteLength", bytes.size()}};
    if (use != GltfUse::none) view["target"] = static_cast<int>(use);
    gltf.bytes += bytes;
    return add(gltf.json["bufferViews"], std::move(view));
}

std::size_t add_floats(GltfBuilder& gltf, std::span<const float> values, std::size_t width, GltfUse use)
{
    const std::size_t accessor =
        add_accessor(gltf, add_view(gltf, bytes_of(values), use), kFloat, values.size() / width, width);
    if (width > 3) return accessor;
    std::vector<float> least(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(width)), greatest = least;
    for (std::size_t n = 0; n < values.size(); ++n) {
        least[n % width] = std::min(least[n % width], values[n]);
        greatest[n % width] = std::max(greatest[n % width], values[n]);
    }
    gltf.json["accessors"][accessor]["min"] = least;
    gltf.json["accessors"][accessor]["max"] = greatest;
    return accessor;
}

std::size_t add_indices(GltfBuilder& gltf, std::span<const std::uint32_t> values)
{
    const std::size_t view = add_view(gltf, bytes_of(values), GltfUse::indices);
    return add_accessor(gltf, view, kUnsignedInt, values.size(), 1);
}

std::size_t add_joints(GltfBuilder& gltf, std::span<const std::uint16_t> values)
{
    const std::size_t view = add_view(gltf, bytes_of(values), GltfUse::vertices);
    return add_accessor(gltf, view, kUnsignedShort, values.size() / 4, 4);
}

GltfContainer container_of(GltfBuilder gltf)
{
    gltf.bytes.resize((gltf.bytes.size() + 3) / 4 * 4, '\0');
    if (!gltf.bytes.empty()) gltf.json["buffers"] = {{{"byteLength", gltf.bytes.size()}}};
    GltfContainer container;
    container.json = gltf.json.dump(-1, ' ', false, Json::error_handler_t::replace);
    container.bytes = std::move(gltf.bytes);
    container.is_binary = true;
    return container;
}

}  // namespace swivel::formats

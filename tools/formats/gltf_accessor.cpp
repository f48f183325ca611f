// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_accessor.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "tools/formats/error.h"
#include "tools/formats/gltf_element.h"

namespace swivel::formats {
namespace {

[[noreturn]] void refuse(const GltfData& data, const std::string& cause) { throw InputError(data.path, cause); }

double component(const char* at, int type, bool is_normalized)
{
    const auto read = [&](auto zero, double full) {
        std::memcpy(&zero, at, sizeof zero);
        const auto value = static_cast<double>(zero);
        return is_normalized ? std::max(value / full, -1.0) : value;
    };
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return read(std::int8_t{}, 127);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return read(std::uint8_t{}, 255);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return read(std::int16_t{}, 32767);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return read(std::uint16_t{}, 65535);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return read(std::uint32_t{}, 1);
        default:  // float: read_view() lets no other pass
            return read(float{}, 1);
    }
}

// `count` elements of `width` components in a buffer view, checked to lie in it.
std::vector<double> read_view(const GltfData& data, int view_index, std::size_t offset, std::size_t count,
                              std::size_t width, int type, bool is_normalized)
{
    const tinygltf::BufferView& view = element(data.path, data.model.bufferViews, view_index, "buffer view");
    const std::string_view bytes = element(data.path, data.buffers, view.buffer, "buffer");
    const auto size =
        static_cast<std::size_t>(std::max(tinygltf::GetComponentSizeInBytes(static_cast<unsigned>(type)), 0));
    const bool is_legal = (type >= TINYGLTF_COMPONENT_TYPE_BYTE && type <= TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) ||
                          type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT || type == TINYGLTF_COMPONENT_TYPE_FLOAT;
    if (!is_legal)
        refuse(data,
               fmt::format("component type {} of an accessor in buffer view {} does not exist", type, view_index));
    const std::size_t stride = view.byteStride > 0 ? view.byteStride : size * width;
    const bool fits = view.byteOffset <= bytes.size() && view.byteLength <= bytes.size() - view.byteOffset &&
                      offset <= view.byteLength && count <= bytes.size() &&
                      (count == 0 || (count - 1) * stride + size * width <= view.byteLength - offset);
    if (!fits)
        refuse(data,
               fmt::format("an accessor reads beyond the end of buffer view {}; the file is cut short", view_index));
    std::vector<double> values;
    values.reserve(count * width);
    for (std::size_t n = 0; n < count * width; ++n)
        values.push_back(component(bytes.data() + view.byteOffset + offset + n / width * stride + n % width * size,
                                   type, is_normalized));
    return values;
}

// Puts a sparse accessor's own elements into `values`.
void patch(const GltfData& data, int index, std::size_t width, std::vector<double>& values)
{
    const tinygltf::Accessor& at = data.model.accessors[static_cast<std::size_t>(index)];
    const auto count = static_cast<std::size_t>(std::max(at.sparse.count, 0));
    const auto offset = [](int bytes) { return static_cast<std::size_t>(std::max(bytes, 0)); };
    const auto places = read_view(data, at.sparse.indices.bufferView, offset(at.sparse.indices.byteOffset), count, 1,
                                  at.sparse.indices.componentType, false);
    const auto patches = read_view(data, at.sparse.values.bufferView, offset(at.sparse.values.byteOffset), count, width,
                                   at.componentType, at.normalized);
    for (std::size_t n = 0; n < count; ++n) {
        if (!(places[n] >= 0 && places[n] < static_cast<double>(at.count)))
            refuse(data, fmt::format("a sparse index of accessor {} is out of its range", index));
        std::copy_n(patches.begin() + static_cast<std::ptrdiff_t>(n * width), width,
                    values.begin() + static_cast<std::ptrdiff_t>(places[n]) * static_cast<std::ptrdiff_t>(width));
    }
}

}  // namespace

std::vector<double> read_accessor(const GltfData& data, int index, int type, std::size_t expected)
{
    const tinygltf::Accessor& at = element(data.path, data.model.accessors, index, "accessor");
    if (at.type != type) refuse(data, fmt::format("accessor {} of an animation has the wrong type", index));
    const auto width = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<unsigned>(type)));
    if (expected > 0 && at.count != expected)
        refuse(data, fmt::format("accessor {} and its times have different numbers of keys: {} elements, {} are needed",
                                 index, at.count, expected));
    if (expected == 0 && at.bufferView < 0)
        refuse(data, fmt::format("accessor {} of an animation's times has no buffer view", index));
    if (at.count == 0 || at.count > std::size_t{1} << 28)
        refuse(data, fmt::format("accessor {} of an animation has {} keys", index, at.count));
    std::vector<double> values(at.bufferView < 0 ? at.count * width : 0);
    if (at.bufferView >= 0)
        values = read_view(data, at.bufferView, at.byteOffset, at.count, width, at.componentType, at.normalized);
    if (at.sparse.isSparse) patch(data, index, width, values);
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
        refuse(data, fmt::format("accessor {} holds a number that is not finite", index));
    return values;
}

}  // namespace swivel::formats

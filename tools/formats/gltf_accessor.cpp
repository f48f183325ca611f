// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/formats/error.h"
#include "tools/formats/gltf_json.h"

namespace swivel::formats {
namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(const GltfData& data, const std::string& cause)
{
    throw InputError(data.path, cause + "; export the file again");
}

// A component type of the specification, by its number there.
struct Component {
    int type;
    std::size_t size;
    double full;  // what a normalised one stands for 1 with
    double (*read)(const char* at);
};

template <class Number>
double read_as(const char* at)
{
    Number value;
    std::memcpy(&value, at, sizeof value);
    return static_cast<double>(value);
}

constexpr Component kComponents[] = {{5120, 1, 127, read_as<std::int8_t>},    {5121, 1, 255, read_as<std::uint8_t>},
                                     {5122, 2, 32767, read_as<std::int16_t>}, {5123, 2, 65535, read_as<std::uint16_t>},
                                     {5125, 4, 1, read_as<std::uint32_t>},    {5126, 4, 1, read_as<float>}};

std::size_t size_in(const Json& object, const char* member) { return object.value(member, std::size_t{0}); }

// `count` elements of `width` components, at the buffer view and offset of `at`, checked to lie there.
std::vector<double> read_view(const GltfData& data, const Json& at, std::size_t count, std::size_t width, int type,
                              bool is_normalized)
{
    const int view_index = at.at("bufferView");
    const Json& view =
        element(data.path, list_in(data.document, "bufferViews"), view_index, "an accessor's buffer view");
    const std::string_view bytes =
        element(data.path, data.buffers, view.at("buffer").get<int>(), "a buffer view's buffer");
    const Component* const kind = std::find_if(std::begin(kComponents), std::end(kComponents),
                                               [&](const Component& c) { return c.type == type; });
    if (kind == std::end(kComponents))
        refuse(data,
               fmt::format("component type {} of an accessor in buffer view {} does not exist", type, view_index));
    const std::size_t stride = view.value("byteStride", kind->size * width), begin = size_in(view, "byteOffset");
    const std::size_t length = size_in(view, "byteLength"), offset = size_in(at, "byteOffset");
    const bool fits = begin <= bytes.size() && length <= bytes.size() - begin && offset <= length &&
                      count <= bytes.size() &&
                      (count == 0 || (count - 1) * stride + kind->size * width <= length - offset);
    if (!fits)
        refuse(data,
               fmt::format("an accessor reads beyond the end of buffer view {}; the file is cut short", view_index));
    std::vector<double> values;
    values.reserve(count * width);
    for (std::size_t n = 0; n < count * width; ++n) {
        const double value = kind->read(bytes.data() + begin + offset + n / width * stride + n % width * kind->size);
        values.push_back(is_normalized ? std::max(value / kind->full, -1.0) : value);
    }
    return values;
}

// Puts a sparse accessor's own elements into `values`.
void patch(const GltfData& data, int index, const Json& at, std::size_t width, std::vector<double>& values)
{
    const Json& sparse = at.at("sparse");
    const Json& indices = sparse.at("indices");
    const std::size_t count = sparse.at("count");
    const auto places = read_view(data, indices, count, 1, indices.at("componentType"), false);
    const auto patches =
        read_view(data, sparse.at("values"), count, width, at.at("componentType"), at.value("normalized", false));
    for (std::size_t n = 0; n < count; ++n) {
        if (!(places[n] >= 0 && places[n] * static_cast<double>(width) < static_cast<double>(values.size())))
            refuse(data, fmt::format("a sparse index of accessor {} is out of its range", index));
        std::copy_n(patches.begin() + static_cast<std::ptrdiff_t>(n * width), width,
                    values.begin() + static_cast<std::ptrdiff_t>(places[n]) * static_cast<std::ptrdiff_t>(width));
    }
}

}  // namespace

std::vector<double> read_accessor(const GltfData& data, int index, std::size_t width, std::size_t expected)
{
    const Json& at = element(data.path, list_in(data.document, "accessors"), index, "an animation's accessor");
    const bool has_view = at.contains("bufferView");
    const std::size_t count = at.at("count");
    if (at.at("type") != (width == 1 ? "SCALAR" : width == 3 ? "VEC3" : "VEC4"))
        refuse(data, fmt::format("accessor {} of an animation has the wrong type", index));
    if (expected > 0 && count != expected)
        refuse(data, fmt::format("accessor {} and its times have different numbers of keys: {} elements, {} are needed",
                                 index, count, expected));
    if (expected == 0 && !has_view)
        refuse(data, fmt::format("accessor {} of an animation's times has no buffer view", index));
    if (count == 0 || count > std::size_t{1} << 28)
        refuse(data, fmt::format("accessor {} of an animation has {} keys", index, count));
    std::vector<double> values(has_view ? 0 : count * width);
    if (has_view) values = read_view(data, at, count, width, at.at("componentType"), at.value("normalized", false));
    if (at.contains("sparse")) patch(data, index, at, width, values);
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
        refuse(data, fmt::format("accessor {} holds a number that is not finite", index));
    return values;
}

}  // namespace swivel::formats

// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/formats/error.h"
#include "tools/formats/printable.h"

namespace swivel::formats {
namespace {

using Json = nlohmann::json;

// The type that a member must have.
struct Kind {
    const char* wanted;
    bool (*accepts)(const Json& value);
};

// glTF's whole numbers have no fraction, not even .0; strict readers take others for missing.
bool is_whole(const Json& value, std::uint64_t max)
{
    return value.is_number_integer() && (value.is_number_unsigned() || value.get<std::int64_t>() >= 0) &&
           value.get<std::uint64_t>() <= max;
}
bool is_index(const Json& value) { return is_whole(value, INT32_MAX); }

// Numbers in the range of floats, like those of accessors: squares and products of some are still finite doubles.
bool is_float(const Json& value) { return value.is_number() && std::abs(value.get<double>()) <= double{FLT_MAX}; }
template <std::size_t count>
bool is_floats(const Json& value)
{
    return value.is_array() && value.size() == count && std::all_of(value.begin(), value.end(), is_float);
}
bool is_indices(const Json& value) { return value.is_array() && std::all_of(value.begin(), value.end(), is_index); }
bool is_stride(const Json& value) { return is_whole(value, 252) && value.get<int>() >= 4 && value.get<int>() % 4 == 0; }
bool is_version_2(const Json& value) { return value.is_string() && value.get<std::string>().starts_with("2."); }
bool is_objects(const Json& value)
{
    return value.is_array() &&
           std::all_of(value.begin(), value.end(), [](const Json& each) { return each.is_object(); });
}

constexpr Kind kIndex{"a whole number from 0 to 2147483647", is_index},
    kSize{"a whole number of bytes", [](const Json&value) { return is_whole(value, std::uint64_t{1} << 53); }},
    kText{"a text", [](const Json&value) { return value.is_string(); }},
    kTruth{"true or false", [](const Json&value) { return value.is_boolean(); }},
    kObject{"an object", [](const Json&value) { return value.is_object(); }}, kObjects{"a list of objects", is_objects},
    kIndices{"a list of nodes", is_indices}, kVector{"a list of 3 numbers that floats can hold", is_floats<3>},
    kRotation{"a list of 4 numbers that floats can hold", is_floats<4>},
    kMatrix{"a list of 16 numbers that floats can hold", is_floats<16>},
    kStride{"a multiple of 4 from 4 to 252", is_stride}, kVersion{"\"2.0\"", is_version_2};

// A member of the object, or of each object of the list, at `owner`.
struct Member {
    std::string_view owner, name;
    const Kind& kind;
    bool is_needed = false;
};
const Member kMembers[] = {
    {"", "asset", kObject, true},
    {"/asset", "version", kVersion, true},
    {"", "nodes", kObjects},
    {"/nodes", "name", kText},
    {"/nodes", "children", kIndices},
    {"/nodes", "skin", kIndex},
    {"/nodes", "translation", kVector},
    {"/nodes", "rotation", kRotation},
    {"/nodes", "scale", kVector},
    {"/nodes", "matrix", kMatrix},
    {"", "skins", kObjects},
    {"/skins", "joints", kIndices},
    {"/skins", "skeleton", kIndex},
    {"/skins", "inverseBindMatrices", kIndex},
    {"", "animations", kObjects},
    {"/animations", "name", kText},
    {"/animations", "channels", kObjects},
    {"/animations/channels", "sampler", kIndex, true},
    {"/animations/channels", "target", kObject, true},
    {"/animations/channels/target", "node", kIndex},
    {"/animations/channels/target", "path", kText, true},
    {"/animations", "samplers", kObjects},
    {"/animations/samplers", "input", kIndex, true},
    {"/animations/samplers", "output", kIndex, true},
    {"/animations/samplers", "interpolation", kText},
    {"", "accessors", kObjects},
    {"/accessors", "bufferView", kIndex},
    {"/accessors", "byteOffset", kSize},
    {"/accessors", "componentType", kIndex, true},
    {"/accessors", "count", kIndex, true},
    {"/accessors", "type", kText, true},
    {"/accessors", "normalized", kTruth},
    {"/accessors", "sparse", kObject},
    {"/accessors/sparse", "count", kIndex, true},
    {"/accessors/sparse", "indices", kObject, true},
    {"/accessors/sparse/indices", "bufferView", kIndex, true},
    {"/accessors/sparse/indices", "byteOffset", kSize},
    {"/accessors/sparse/indices", "componentType", kIndex, true},
    {"/accessors/sparse", "values", kObject, true},
    {"/accessors/sparse/values", "bufferView", kIndex, true},
    {"/accessors/sparse/values", "byteOffset", kSize},
    {"", "bufferViews", kObjects},
    {"/bufferViews", "buffer", kIndex, true},
    {"/bufferViews", "byteLength", kSize, true},
    {"/bufferViews", "byteOffset", kSize},
    {"/bufferViews", "byteStride", kStride},
    {"", "buffers", kObjects},
    {"/buffers", "byteLength", kSize, true},
    {"/buffers", "uri", kText},
};

// owner: of the table; place: of the object, the same with the numbers of elements.
void check_object(const std::filesystem::path& path, const std::string& owner, const std::string& place,
                  const Json& object)
{
    for (const Member& member : kMembers) {
        if (member.owner != owner) continue;
        const auto found = object.find(member.name);
        const bool is_there = found != object.end();
        const std::string below = fmt::format("/{}", member.name);
        if (is_there ? !member.kind.accepts(*found) : member.is_needed)
            throw InputError(path,
                             fmt::format("{} is bad: {} is needed, not {}; export the file again", place + below,
                                         member.kind.wanted, is_there ? printable(found->dump(), 60) : "nothing"));
        if (is_there && &member.kind == &kObject) check_object(path, owner + below, place + below, *found);
        for (std::size_t n = 0; is_there && &member.kind == &kObjects && n < found->size(); ++n)
            check_object(path, owner + below, fmt::format("{}{}/{}", place, below, n), (*found)[n]);
    }
}

}  // namespace

void check_members(const std::filesystem::path& path, const Json& document) { check_object(path, "", "", document); }

}  // namespace swivel::formats

// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_buffers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "tools/formats/error.h"
#include "tools/formats/gltf_json.h"
#include "tools/formats/gltf_uri.h"
#include "tools/formats/printable.h"

namespace swivel::formats {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{8} << 30;  // of all buffers

// A buffer being read, and its name in messages.
struct Buffer {
    const fs::path& path;
    std::size_t number;
    std::uintmax_t size;

    [[noreturn]] void refuse(const std::string& cause) const
    {
        throw InputError(path, fmt::format("buffer {} {}", number, cause));
    }
    void require(std::uintmax_t found, const std::string& place) const
    {
        if (found < size)
            refuse(
                fmt::format("has {} bytes by its byteLength and {} in {}; the file is cut short", size, found, place));
    }
};

// A buffer's address; null: it has none.
const std::string* uri_of(const nlohmann::json& buffer)
{
    const auto found = buffer.find("uri");
    return found == buffer.end() ? nullptr : &found->get_ref<const std::string&>();
}

// The file at a buffer's address. Refuses one that is missing, outside of the folder, unreadable or too short.
fs::path file_of(const Buffer& buffer, const std::string& uri)
{
    const std::string shown = printable(uri, 100);
    const fs::path named = file_at(uri, buffer.path);
    if (named.empty())
        buffer.refuse(fmt::format("lies at '{}'; only addresses relative to the file itself are read", shown));
    std::error_code failed;
    if (!fs::is_regular_file(named, failed))
        buffer.refuse(fmt::format("lies in '{}', and there is no such file relative to this one; put it there", shown));
    // Links followed: whoever made the file must not be able to put any other file of this machine into the output.
    const fs::path file = fs::canonical(named, failed);
    const fs::path folder = failed ? fs::path() : fs::canonical(fs::absolute(buffer.path).parent_path(), failed);
    const fs::path way = failed ? fs::path() : file.lexically_relative(folder);
    if (way.empty() || *way.begin() == "..")
        buffer.refuse(fmt::format("lies in '{}', outside the file's own folder; put it beside the file", shown));
    const std::uintmax_t size = fs::file_size(file, failed);
    if (failed || !std::ifstream(file, std::ios::binary))
        buffer.refuse(fmt::format("lies in '{}', which cannot be read; check its permissions", shown));
    buffer.require(size, fmt::format("'{}'", shown));
    return file;
}

std::string bytes_in_file(const Buffer& buffer, const std::string& uri)
{
    std::ifstream in(file_of(buffer, uri), std::ios::binary);
    std::string bytes(buffer.size, '\0');
    if (!in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
        buffer.refuse(fmt::format("lies in '{}', which cannot be read; check its permissions", printable(uri, 100)));
    return bytes;
}

// The number of bytes to read from each file, by address. Several buffers may share a file.
std::map<std::string, std::uintmax_t> sizes_of_files(const fs::path& path, const nlohmann::json& list)
{
    std::map<std::string, std::uintmax_t> sizes;
    for (std::size_t n = 0; n < list.size(); ++n) {
        const Buffer buffer{path, n, list[n].at("byteLength").get<std::uintmax_t>()};
        const std::string* const uri = uri_of(list[n]);
        if (!uri || is_data_uri(*uri)) continue;  // no more than the file itself holds
        file_of(buffer, *uri);
        sizes[*uri] = std::max(sizes[*uri], buffer.size);
    }
    std::uintmax_t total = 0;
    for (const auto& [uri, size] : sizes) {
        if (size > kMaxBytes - total) throw InputError(path, "its buffers come to more than 8 GiB; split it");
        total += size;
    }
    return sizes;
}

using Json = nlohmann::json;

[[noreturn]] void refuse(const GltfData& data, const std::string& cause)
{
    throw InputError(data.path, cause + "; export the file again");
}

// A component type of the specification, by its number there.
struct Component {
    int type;
    std::size_t size;
    double full;  // the integer that a normalised component has for 1
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

GltfBuffers read_gltf_buffers(const fs::path& path, const nlohmann::json& document, GltfContainer& container)
{
    GltfBuffers buffers;
    const auto list = document.find("buffers");
    if (list == document.end()) return buffers;
    const auto keep = [&](std::string bytes) {
        return buffers.contents.emplace_back(std::make_shared<const std::string>(std::move(bytes)));
    };
    const std::map<std::string, std::uintmax_t> sizes = sizes_of_files(path, *list);
    std::map<std::string, std::shared_ptr<const std::string>> read;
    for (const auto& each : *list) {
        const Buffer buffer{path, buffers.bytes.size(), each.at("byteLength").get<std::uintmax_t>()};
        const std::string* const uri = uri_of(each);
        std::shared_ptr<const std::string> content;
        if (uri && is_data_uri(*uri)) {
            std::optional<std::string> bytes = bytes_in_uri(*uri);
            if (!bytes) buffer.refuse("has an uri that is no base64; export it with a .bin file or as .glb");
            buffer.require(bytes->size(), "its uri");
            content = keep(std::move(*bytes));
        } else if (uri) {
            content = read[*uri];
            if (!content) content = read[*uri] = keep(bytes_in_file({path, buffer.number, sizes.at(*uri)}, *uri));
        } else {
            if (!container.is_binary || buffer.number > 0) buffer.refuse("has no uri; export the file again");
            buffer.require(container.bytes.size(), "the GLB's chunk");
            content = keep(std::move(container.bytes));
        }
        buffers.bytes.push_back(std::string_view(*content).substr(0, buffer.size));
    }
    return buffers;
}

std::vector<double> read_accessor(const GltfData& data, int index, std::size_t width, std::size_t expected,
                                  bool is_skin)
{
    const std::string owner = is_skin ? "a skin" : "an animation";
    const Json& at = element(data.path, list_in(data.document, "accessors"), index, (owner + "'s accessor").c_str());
    const bool has_view = at.contains("bufferView");
    const std::size_t count = at.at("count");
    if (at.at("type") != accessor_type(width))
        refuse(data, fmt::format("accessor {} of {} has the wrong type", index, owner));
    const bool may_be_more = is_skin && has_view;
    if (expected > 0 && (count < expected || (count > expected && !may_be_more)))
        refuse(data, fmt::format("accessor {} and {} have different numbers of {}: {} elements, {} are needed", index,
                                 is_skin ? "its skin" : "its times", is_skin ? "joints" : "keys", count, expected));
    if (expected == 0 && !has_view)
        refuse(data, fmt::format("accessor {} of an animation's times has no buffer view", index));
    if (count == 0 || count > std::size_t{1} << 28)
        refuse(data, fmt::format("accessor {} of {} has {} keys", index, owner, count));
    std::vector<double> values(has_view ? 0 : count * width);
    if (has_view) values = read_view(data, at, count, width, at.at("componentType"), at.value("normalized", false));
    if (at.contains("sparse")) patch(data, index, at, width, values);
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
        refuse(data, fmt::format("accessor {} holds a number that is not finite", index));
    return values;
}

}  // namespace swivel::formats

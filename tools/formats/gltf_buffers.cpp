// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_buffers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "tools/formats/error.h"
#include "tools/formats/gltf_uri.h"
#include "tools/formats/printable.h"

namespace swivel::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = std::uintmax_t{8} << 30;  // of all buffers

// A buffer on its way in, and how messages call it.
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

// The file at a buffer's address, which has the bytes, as far as can be known without reading it.
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

// How many bytes are needed of each file, by its address; several buffers may share one.
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
        if (size > kMostBytes - total) throw InputError(path, "its buffers come to more than 8 GiB; split it");
        total += size;
    }
    return sizes;
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

}  // namespace swivel::formats

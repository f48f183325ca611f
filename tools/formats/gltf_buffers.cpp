// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_buffers.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "tools/formats/error.h"
#include "tools/formats/gltf_uri.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

namespace fs = std::filesystem;

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

std::string bytes_in_text(const Buffer& buffer, const std::string& uri)
{
    std::vector<unsigned char> bytes;
    std::string mime;
    if (!tinygltf::DecodeDataURI(&bytes, mime, uri, 0, false))
        buffer.refuse("has an uri that is no base64 of a known kind; export it with a .bin file or as .glb");
    buffer.require(bytes.size(), "its uri");
    return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(buffer.size)};
}

std::string bytes_in_file(const Buffer& buffer, const std::string& uri)
{
    const std::string shown = printable(uri, 100);
    const fs::path file = file_at(uri, buffer.path);
    if (file.empty())
        buffer.refuse(fmt::format("lies at '{}'; only addresses relative to the file itself are read", shown));
    std::error_code failed;
    if (!fs::is_regular_file(file, failed))
        buffer.refuse(fmt::format("lies in '{}', and there is no such file relative to this one", shown));
    buffer.require(fs::file_size(file, failed), fmt::format("'{}'", shown));
    std::string bytes(buffer.size, '\0');
    std::ifstream in(file, std::ios::binary);
    if (!in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
        buffer.refuse(fmt::format("lies in '{}', which cannot be read", shown));
    return bytes;
}

}  // namespace

std::vector<std::string> read_gltf_buffers(const fs::path& path, const nlohmann::ordered_json& document,
                                           const GltfContainer& container)
{
    std::vector<std::string> buffers;
    const auto list = document.find("buffers");
    if (list == document.end()) return buffers;
    for (const auto& each : *list) {
        const Buffer buffer{path, buffers.size(), each.at("byteLength").get<std::uintmax_t>()};
        const std::string uri = each.value("uri", "");
        if (is_data_uri(uri)) {
            buffers.push_back(bytes_in_text(buffer, uri));
        } else if (each.contains("uri")) {
            buffers.push_back(bytes_in_file(buffer, uri));
        } else {
            if (!container.is_binary || buffer.number > 0) buffer.refuse("has no uri");
            buffer.require(container.bytes.size(), "the GLB's chunk");
            buffers.push_back(container.bytes.substr(0, buffer.size));
        }
    }
    return buffers;
}

}  // namespace swivel::formats

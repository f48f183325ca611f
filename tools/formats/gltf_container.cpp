// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_container.h"

#include <fmt/format.h>

#include <cstdint>
#include <stdexcept>

#include "tools/formats/error.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

constexpr std::string_view kMagic = "glTF";
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;  // "JSON", "BIN\0"

std::uint32_t word_at(std::string_view text, std::size_t at)
{
    std::uint32_t word = 0;
    for (std::size_t n = 4; n-- > 0;) word = word << 8 | static_cast<unsigned char>(text[at + n]);
    return word;
}

void append_word(std::string& text, std::size_t word)
{
    for (int shift = 0; shift < 32; shift += 8) text += static_cast<char>(word >> shift & 0xff);
}

void append_chunk(std::string& glb, std::uint32_t type, std::string_view content, char padding)
{
    append_word(glb, (content.size() + 3) / 4 * 4);
    append_word(glb, type);
    glb += content;
    while (glb.size() % 4 != 0) glb += padding;
}

[[noreturn]] void refuse(const std::filesystem::path& path, std::string_view cause)
{
    throw InputError(path, fmt::format("{}; export the file again", cause));
}

GltfContainer split(const std::filesystem::path& path, std::string_view file)
{
    if (file.size() < 20) refuse(path, "a GLB cut short");
    if (const std::uint32_t version = word_at(file, 4); version != 2)
        refuse(path, fmt::format("a GLB of version {}; only 2 is read", version));
    const std::size_t size = word_at(file, 8);
    if (size > file.size() || size < 20)
        refuse(path, fmt::format("the GLB says it has {} bytes and has {}", size, file.size()));
    GltfContainer container;
    container.is_binary = true;
    std::size_t at = 12;
    for (std::size_t chunk = 0; at + 8 <= size; ++chunk) {
        const std::size_t length = word_at(file, at);
        const std::uint32_t type = word_at(file, at + 4);
        if (length > size - at - 8) refuse(path, fmt::format("chunk {} of the GLB runs beyond its end", chunk));
        const std::string_view content = file.substr(at + 8, length);
        if (chunk == 0 && type != kJsonChunk) refuse(path, "the GLB does not start with its JSON");
        if (chunk == 0) container.json = trimmed(content);
        if (chunk == 1 && type == kBinChunk)
            container.bytes = content;
        else if (chunk > 0)
            container.other_chunks += file.substr(at, 8 + length);
        at += 8 + length;
    }
    return container;
}

}  // namespace

GltfContainer read_gltf_container(const std::filesystem::path& path)
{
    return gltf_container_of(path, read_bytes(path));
}

GltfContainer gltf_container_of(const std::filesystem::path& path, std::string file)
{
    if (file.starts_with(kMagic)) return split(path, file);
    GltfContainer container;
    container.json = std::move(file);
    return container;
}

std::string glb_of(const GltfContainer& container)
{
    const std::string &json = container.json, &bytes = container.bytes;
    std::string glb(kMagic);
    append_word(glb, 2);
    const std::size_t chunks = 8 + (json.size() + 3) / 4 * 4 + (bytes.empty() ? 0 : 8 + (bytes.size() + 3) / 4 * 4) +
                               container.other_chunks.size();
    if (12 + chunks > UINT32_MAX) throw std::length_error("a GLB holds 4 GiB at most");
    append_word(glb, 12 + chunks);
    glb.reserve(12 + chunks);
    append_chunk(glb, kJsonChunk, json, ' ');
    if (!bytes.empty()) append_chunk(glb, kBinChunk, bytes, '\0');
    glb += container.other_chunks;
    return glb;
}

std::string base64_of(std::string_view bytes)
{
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        std::uint32_t bits = 0;
        for (std::size_t n = 0; n < 3; ++n)
            bits = bits << 8 | (at + n < bytes.size() ? static_cast<unsigned char>(bytes[at + n]) : 0u);
        for (std::size_t n = 0; n < 4; ++n) text += at + n <= bytes.size() ? kDigits[bits >> (18 - 6 * n) & 63u] : '=';
    }
    return text;
}

}  // namespace swivel::formats

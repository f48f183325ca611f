// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_container.h"

#include <fmt/format.h>

#include <algorithm>
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

// glb: what is read of it so far.
GltfContainer read_glb(const std::filesystem::path& path, std::FILE* file, std::string glb)
{
    if (glb.size() < 12) refuse(path, "a GLB cut short");
    if (const std::uint32_t version = word_at(glb, 4); version != 2)
        refuse(path, fmt::format("a GLB of version {}; only 2 is read", version));
    const std::size_t size = word_at(glb, 8);
    if (size < 20) refuse(path, fmt::format("the GLB says it has {} bytes", size));
    append_bytes(path, file, size - std::min(size, glb.size()), glb);
    if (glb.size() < size) refuse(path, fmt::format("the GLB says it has {} bytes and has {}", size, glb.size()));
    glb.resize(size);
    GltfContainer container;
    container.is_binary = true;
    for (std::size_t chunk = 0, at = 12; at + 8 <= size; ++chunk) {
        const std::size_t length = word_at(glb, at), type = word_at(glb, at + 4);
        if (length > size - at - 8) refuse(path, fmt::format("chunk {} of the GLB runs beyond its end", chunk));
        if (chunk == 0 && type != kJsonChunk) refuse(path, "the GLB does not start with its JSON");
        if (chunk == 0)
            container.json = glb.substr(at + 8, length);
        else if (chunk == 1 && type == kBinChunk)
            container.bytes = glb.substr(at + 8, length);
        else
            container.other_chunks += glb.substr(at, 8 + length);
        at += 8 + length;
    }
    container.json.resize(container.json.find_last_not_of(kBlanks) + 1);
    return container;
}

}  // namespace

bool is_gltf_begin(std::string_view begin)
{
    return begin.starts_with(kMagic) || trimmed(without_byte_order_mark(begin)).starts_with('{');
}

GltfContainer read_gltf_container(const std::filesystem::path& path)
{
    return read_gltf_container(path, open_text(path).get(), {});
}

GltfContainer read_gltf_container(const std::filesystem::path& path, std::FILE* file, std::string begin)
{
    if (begin.size() < 12) append_bytes(path, file, 12 - begin.size(), begin);
    if (begin.empty()) throw InputError(path, "is empty; check how it was written");
    if (begin.starts_with(kMagic)) return read_glb(path, file, std::move(begin));
    begin.erase(0, begin.size() - without_byte_order_mark(begin).size());
    if (const std::string_view start = trimmed(begin); !start.empty() && start[0] != '{')
        throw InputError(path, "is not glTF: it starts neither with 'glTF' nor with '{'");
    GltfContainer container;
    container.json = std::move(begin);
    append_rest(path, file, container.json, "cut it, or write it as .glb");
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

}  // namespace swivel::formats

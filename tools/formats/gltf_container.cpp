// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_container.h"

#include <fmt/format.h>

#include <array>
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

// A GLB on its way in: what was read of it, and what its header lets one read.
class GlbReader {
public:
    GlbReader(const std::filesystem::path& path, std::FILE* file, std::string begin)
        : path_(path), file_(file), begin_(std::move(begin))
    {
    }

    GltfContainer read()
    {
        const std::string head = take(12);
        if (head.size() < 12) refuse(path_, "a GLB cut short");
        if (const std::uint32_t version = word_at(head, 4); version != 2)
            refuse(path_, fmt::format("a GLB of version {}; only 2 is read", version));
        size_ = word_at(head, 8);
        if (size_ < 20) refuse(path_, fmt::format("the GLB says it has {} bytes", size_));
        GltfContainer container;
        container.is_binary = true;
        for (std::size_t chunk = 0; at_ + 8 <= size_; ++chunk) read_chunk(container, chunk);
        return container;
    }

private:
    // Fewer bytes only at the end of the file.
    std::string take(std::size_t count)
    {
        std::string bytes = begin_.substr(0, count);
        begin_.erase(0, bytes.size());
        append_bytes(path_, file_, count - bytes.size(), bytes);
        at_ += bytes.size();
        return bytes;
    }
    std::string require(std::size_t count)
    {
        std::string bytes = take(count);
        if (bytes.size() < count) refuse(path_, fmt::format("the GLB says it has {} bytes and has {}", size_, at_));
        return bytes;
    }
    void read_chunk(GltfContainer& container, std::size_t chunk)
    {
        const std::string head = require(8);
        const std::size_t length = word_at(head, 0);
        const std::uint32_t type = word_at(head, 4);
        if (length > size_ - at_) refuse(path_, fmt::format("chunk {} of the GLB runs beyond its end", chunk));
        if (chunk == 0 && type != kJsonChunk) refuse(path_, "the GLB does not start with its JSON");
        std::string content = require(length);
        if (chunk == 0) {
            container.json = std::move(content);
            container.json.resize(container.json.find_last_not_of(kBlanks) + 1);
        } else if (chunk == 1 && type == kBinChunk) {
            container.bytes = std::move(content);
        } else {
            container.other_chunks += head + content;
        }
    }

    const std::filesystem::path& path_;
    std::FILE* file_;
    std::string begin_;
    std::size_t at_ = 0, size_ = 0;
};

}  // namespace

GltfContainer read_gltf_container(const std::filesystem::path& path)
{
    return read_gltf_container(path, open_text(path).get(), {});
}

GltfContainer read_gltf_container(const std::filesystem::path& path, std::FILE* file, std::string begin)
{
    if (begin.size() < 12) append_bytes(path, file, 12 - begin.size(), begin);
    if (begin.empty()) throw InputError(path, "is empty; check how it was written");
    if (begin.starts_with(kMagic)) return GlbReader(path, file, std::move(begin)).read();
    if (const std::string_view start = trimmed(begin); !start.empty() && start[0] != '{')
        throw InputError(path, "is not glTF: it starts neither with 'glTF' nor with '{'");
    GltfContainer container;
    container.json = std::move(begin);
    append_rest(path, file, container.json);
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

namespace {
constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
}

std::string base64_of(std::string_view bytes)
{
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

std::optional<std::string> bytes_of_base64(std::string_view text)
{
    for (int n = 0; n < 2 && text.ends_with('='); ++n) text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;
    std::array<std::int8_t, 256> value;
    value.fill(-1);
    for (std::size_t n = 0; n < kDigits.size(); ++n)
        value[static_cast<unsigned char>(kDigits[n])] = static_cast<std::int8_t>(n);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const std::int8_t digit = value[static_cast<unsigned char>(text[at])];
        if (digit < 0) return std::nullopt;
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        if (at % 4 > 0) bytes += static_cast<char>(bits >> (6 - 2 * (at % 4)) & 0xff);
    }
    return bytes;
}

}  // namespace swivel::formats

// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_uri.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <system_error>

namespace swivel::formats {
namespace {

namespace fs = std::filesystem;

bool is_alphanumeric(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }
bool is_hex(char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; }

// RFC 3986: letters, digits and + - . before a colon.
bool has_scheme(const std::string& uri)
{
    std::size_t at = 0;
    while (at < uri.size() && (is_alphanumeric(uri[at]) || std::strchr("+-.", uri[at]))) ++at;
    return at > 0 && at < uri.size() && uri[at] == ':';
}

std::string unescaped(const std::string& uri)
{
    std::string name;
    for (std::size_t at = 0; at < uri.size(); ++at) {
        const bool is_escape = uri[at] == '%' && at + 2 < uri.size() && is_hex(uri[at + 1]) && is_hex(uri[at + 2]);
        name += is_escape ? static_cast<char>(std::stoi(uri.substr(at + 1, 2), nullptr, 16)) : uri[at];
        if (is_escape) at += 2;
    }
    return name;
}

// Whether it is an address relative to the file that it stands in: of no scheme, and no path from the root.
bool is_relative(const std::string& uri) { return !has_scheme(uri) && !fs::path(unescaped(uri)).is_absolute(); }

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// RFC 4648, with padding.
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

// With or without padding.
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

}  // namespace

bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }

std::optional<DataUri> data_of(std::string_view uri)
{
    constexpr std::string_view kBegin = "data:", kEnd = ";base64";
    const std::size_t comma = uri.find(',');
    const std::string_view head = uri.substr(0, comma);
    if (comma == std::string_view::npos || !head.starts_with(kBegin) || !head.ends_with(kEnd)) return std::nullopt;
    const std::string_view kind = head.substr(kBegin.size(), head.size() - kBegin.size() - kEnd.size());
    std::optional<std::string> bytes = bytes_of_base64(uri.substr(comma + 1));
    if (!bytes) return std::nullopt;
    return DataUri{std::string(kind.substr(0, kind.find(';'))), *std::move(bytes)};
}

std::string data_uri_of(std::string_view bytes) { return "data:application/octet-stream;base64," + base64_of(bytes); }

fs::path file_at(const std::string& uri, const fs::path& beside)
{
    const std::string name = unescaped(uri);
    const bool has_end = name.find('\0') != std::string::npos;  // the system would take it for the name's end
    if (!is_relative(uri) || name.empty() || has_end) return {};
    return beside.parent_path() / name;
}

std::string moved_uri(const std::string& uri, const fs::path& from, const fs::path& to)
{
    std::error_code failed;
    const auto folder = [&](const fs::path& file) {
        return fs::weakly_canonical(fs::absolute(file).parent_path(), failed);
    };
    const fs::path way = folder(from).lexically_relative(folder(to));
    if (!is_relative(uri) || failed || way.empty() || way == ".") return uri;
    std::string moved;
    for (const char c : way.generic_string() + '/')
        moved += is_alphanumeric(c) || std::strchr("-._~/", c) ? std::string(1, c)
                                                               : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    return moved + uri;
}

}  // namespace swivel::formats

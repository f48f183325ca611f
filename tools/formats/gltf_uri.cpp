// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_uri.h"

#include <fmt/format.h>

#include <cctype>
#include <cstring>
#include <system_error>

#include "tools/formats/base64.h"

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

// Whether an address is relative to its file: without a scheme and without a path from the root.
bool is_relative(const std::string& uri) { return !has_scheme(uri) && !fs::path(unescaped(uri)).is_absolute(); }

}  // namespace

bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }

std::optional<std::string> bytes_in_uri(std::string_view uri)
{
    const std::size_t comma = uri.find(',');
    if (!is_data_uri(uri) || !uri.substr(0, comma).ends_with(";base64") || comma == uri.npos) return std::nullopt;
    return bytes_of_base64(uri.substr(comma + 1));
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

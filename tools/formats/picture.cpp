// SPDX-License-Identifier: MIT
#include "tools/formats/picture.h"

#include <cstdint>
#include <fstream>
#include <iterator>
#include <system_error>

namespace swivel::formats {

std::string_view picture_kind(std::string_view bytes)
{
    if (bytes.starts_with("\x89PNG")) return "image/png";
    if (bytes.starts_with("\xff\xd8\xff")) return "image/jpeg";
    if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "image/webp";
    if (bytes.starts_with("\xabKTX 20\xbb")) return "image/ktx2";
    return {};
}

std::string picture_at(const std::filesystem::path& path)
{
    constexpr std::uintmax_t kLargest = 512u << 20;
    std::error_code failed;
    if (!std::filesystem::is_regular_file(path, failed) || std::filesystem::file_size(path, failed) > kLargest ||
        failed)
        return {};
    std::ifstream in(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
}

}  // namespace swivel::formats

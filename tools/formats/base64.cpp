// SPDX-License-Identifier: MIT
#include "tools/formats/base64.h"

#include <array>
#include <cstdint>

namespace swivel::formats {

namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

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

// SPDX-License-Identifier: MIT
#include "tools/formats/printable.h"

#include <fmt/format.h>

namespace swivel::formats {
namespace {

struct Character {
    unsigned code;
    std::size_t size;  // in bytes
};

// The first character of UTF-8; a byte that begins none is a character by itself. Overlong forms count as the character
// that they encode, because some terminals accept them.
Character first_character(std::string_view text)
{
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(text[at]); };
    const unsigned first = byte(0);
    const std::size_t size = first < 0xC0 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF8 ? 4 : 1;
    if (size == 1 || size > text.size()) return {first, 1};
    unsigned code = first & (0x7Fu >> size);
    for (std::size_t n = 1; n < size; ++n) {
        if ((byte(n) & 0xC0) != 0x80) return {first, 1};
        code = code << 6 | (byte(n) & 0x3F);
    }
    return {code, size};
}

// Control characters (Unicode's category Cc) and its property Bidi_Control.
bool is_obeyed(unsigned code)
{
    return code < 0x20 || (code >= 0x7F && code <= 0x9F) || code == 0x061C || code == 0x200E || code == 0x200F ||
           (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

// A byte that begins no character, an overlong form, half of a UTF-16 pair and a number beyond Unicode are no UTF-8.
bool is_utf8(std::string_view text)
{
    constexpr unsigned kLeastCodes[] = {0, 0, 0x80, 0x800, 0x10000};  // by size
    while (!text.empty()) {
        const auto [code, size] = first_character(text);
        if (code < kLeastCodes[size] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return false;
        if (size == 1 && code >= 0x80) return false;
        text.remove_prefix(size);
    }
    return true;
}

}  // namespace

std::string_view take_printable(std::string_view& rest, EscapeRoom& room) noexcept
{
    const auto [code, size] = first_character(rest);
    const std::string_view character = rest.substr(0, size);
    rest.remove_prefix(size);
    if (!is_obeyed(code)) return character;
    constexpr const char* digits = "0123456789abcdef";
    const bool is_byte = size == 1 && code != 0x7F;  // U+007F may stand in JSON, which knows \u alone
    const std::size_t digit_count = is_byte ? 2 : 4;
    room = {'\\', is_byte ? 'x' : 'u'};
    for (std::size_t n = 0; n < digit_count; ++n) room[2 + n] = digits[code >> 4 * (digit_count - 1 - n) & 0xF];
    return {room.data(), 2 + digit_count};
}

std::string printable(std::string_view text, std::size_t max)
{
    std::string out;
    EscapeRoom room;
    for (; !text.empty() && max > 0; --max) out += take_printable(text, room);
    return text.empty() ? out : out + "...";
}

bool is_plain_name(std::string_view name)
{
    return !name.empty() && name.find_first_of(",\"") == name.npos && is_utf8(name) &&
           printable(name, name.npos) == name;
}

std::string printable_lines(std::string_view text)
{
    std::string out;
    out.reserve(text.size());
    EscapeRoom room;
    while (!text.empty()) {
        const bool is_end = text[0] == '\n';
        out += is_end ? text.substr(0, 1) : take_printable(text, room);
        if (is_end) text.remove_prefix(1);
    }
    return out;
}

}  // namespace swivel::formats

#pragma once
// SPDX-License-Identifier: MIT
// Bytes as base64 text, RFC 4648.

#include <optional>
#include <string>
#include <string_view>

namespace swivel::formats {

// With padding.
std::string base64_of(std::string_view bytes);

// With or without padding; nothing if the text is no base64.
std::optional<std::string> bytes_of_base64(std::string_view text);

}  // namespace swivel::formats

#pragma once
// SPDX-License-Identifier: MIT
// Pictures that belong to a glTF file, as bytes: which kinds there are, and how they are read from files. Decodes none.

#include <filesystem>
#include <string>
#include <string_view>

namespace swivel::formats {

// The MIME type by the first bytes, of PNG, JPEG, WebP and KTX2; empty: none of these. glTF itself has the first two,
// the others by extensions.
std::string_view picture_kind(std::string_view bytes);

// A picture's bytes; none where they cannot be read, of what is no plain file (a device has no end), and of what is
// larger than 512 MiB, as no picture is.
std::string picture_at(const std::filesystem::path& path);

}  // namespace swivel::formats

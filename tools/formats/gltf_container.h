#pragma once
// SPDX-License-Identifier: MIT
// The two shapes of a glTF 2.0 file: JSON text, or a GLB of the same text and a chunk of bytes. Knows nothing of what
// the text says.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace swivel::formats {

struct GltfContainer {
    std::string json;          // as it stands in the file, without padding
    std::string bytes;         // the GLB's binary chunk, padding included
    std::string other_chunks;  // what comes after it, chunk headers included
    bool is_binary = false;    // read from a GLB
};

// Reads a file of either shape, told apart by its first bytes, not by its suffix. Throws InputError for a file that
// cannot be read, is empty, is of glTF 1.0, or whose chunks run
// beyond its end. Bytes after the length that a GLB gives for itself are not read.
GltfContainer read_gltf_container(const std::filesystem::path& path);

// The same of a file that is in memory. path: what messages call it.
GltfContainer gltf_container_of(const std::filesystem::path& path, std::string file);

// A GLB of it, chunks padded to four bytes. Throws std::length_error beyond the format's 4 GiB.
std::string glb_of(const GltfContainer& container);

// `bytes` as RFC 4648 base64, with padding.
std::string base64_of(std::string_view bytes);

}  // namespace swivel::formats

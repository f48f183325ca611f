#pragma once
// SPDX-License-Identifier: MIT
// The two shapes of a glTF 2.0 file: JSON text, or a GLB of the same text and a chunk of bytes. Knows nothing of what
// the text says.

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace swivel::formats {

struct GltfContainer {
    std::string json;          // as it stands in the file, without a byte order mark and padding
    std::string bytes;         // the GLB's binary chunk, padding included
    std::string other_chunks;  // what comes after it, chunk headers included
    bool is_binary = false;    // read from a GLB
};

// Whether a file that begins so has one of these shapes.
bool is_gltf_begin(std::string_view begin);

// Reads a file of either shape, told apart by its first bytes, not by its suffix. Throws InputError for a file that
// cannot be read, is neither shape, is of glTF 1.0, or whose chunks run beyond its end. Of a GLB it reads the bytes
// that the GLB's header counts, and of a text 2 GiB at most: a device may have no end. Holds a text once and a GLB
// twice.
GltfContainer read_gltf_container(const std::filesystem::path& path);

// The same of an open file of which `begin` is read. path: what messages call it.
GltfContainer read_gltf_container(const std::filesystem::path& path, std::FILE* file, std::string begin);

// A GLB of it, chunks padded to four bytes. Throws std::length_error beyond the format's 4 GiB.
std::string glb_of(const GltfContainer& container);

}  // namespace swivel::formats

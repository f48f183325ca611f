#pragma once
// SPDX-License-Identifier: MIT
// The two shapes of a glTF 2.0 file: JSON text, or a GLB of the same text and a chunk of bytes. Does not read the JSON.

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

// Whether a file with this beginning has one of these shapes.
bool is_gltf_begin(std::string_view begin);

// Reads a file of either shape, told apart by its first bytes, not by its suffix. Throws InputError for a file that
// cannot be read, is neither shape, is of glTF 1.0, or whose chunks run beyond its end. Reads as many bytes as a GLB's
// header says, or 2 GiB of text at most, because a device may have no end. Holds a text once and a GLB twice.
GltfContainer read_gltf_container(const std::filesystem::path& path);

// The same for an open file whose first bytes are `begin`. path: its name in messages.
GltfContainer read_gltf_container(const std::filesystem::path& path, std::FILE* file, std::string begin);

// A GLB of it, chunks padded to four bytes. Throws std::length_error beyond the format's 4 GiB.
std::string glb_of(const GltfContainer& container);

}  // namespace swivel::formats

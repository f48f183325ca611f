#pragma once
// SPDX-License-Identifier: MIT
// The numbers of a glTF file's accessors: of any component type, normalised or not, strided, sparse. Owns every check
// that they lie in the file; does not know what they mean.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace tinygltf {
class Model;
}

namespace swivel::formats {

// What accessors lie in; borrowed.
struct GltfData {
    const std::filesystem::path& path;  // of the file, for messages
    const tinygltf::Model& model;       // its accessors and buffer views
    std::span<const std::string_view> buffers;
};

// The components of an accessor, element after element. Normalised integers become the numbers that they stand for.
// type: the TINYGLTF_TYPE_ that it must have. expected: how many elements there must be, so that no file makes more
// room than its keys need. 0: any number, but they must then be bytes of the file. Throws InputError for an accessor
// that does not exist, has another type or count, or reads beyond its buffer view, and for numbers that are not finite.
std::vector<double> read_accessor(const GltfData& data, int index, int type, std::size_t expected);

}  // namespace swivel::formats

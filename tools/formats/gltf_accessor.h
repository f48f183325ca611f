#pragma once
// SPDX-License-Identifier: MIT
// The numbers of a glTF file's accessors: of any component type, normalised or not, strided, sparse. Owns every check
// that they lie in the file; does not know what they mean.

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace swivel::formats {

// What accessors lie in; borrowed. The document is one that check_members() has passed.
struct GltfData {
    const std::filesystem::path& path;  // of the file, for messages
    const nlohmann::json& document;
    std::span<const std::string_view> buffers;
};

// The components of an accessor, element after element. Normalised integers become the numbers that they stand for.
// width: 1, 3 or 4, for the SCALAR, VEC3 or VEC4 that it must be. expected: how many elements there must be, so that no
// file makes more room than its keys need. 0: any number, but they must then be bytes of the file. Throws InputError
// for
// - an accessor that does not exist, or has another type or count;
// - one that reads beyond its buffer view;
// - numbers that are not finite.
std::vector<double> read_accessor(const GltfData& data, int index, std::size_t width, std::size_t expected);

}  // namespace swivel::formats

#pragma once
// SPDX-License-Identifier: MIT
// Reads a glTF file's buffers from the GLB's chunk, from the text, or from files beside it, and from nowhere else.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/gltf_container.h"

namespace swivel::formats {

struct GltfBuffers {
    std::vector<std::string_view> bytes;                       // of each buffer, in `contents`, which copies share
    std::vector<std::shared_ptr<const std::string>> contents;  // fewer where buffers lie in one file
};

// Every buffer of a document that check_members() has passed, cut to its stated length.
// path: of the glTF file. container: its chunk becomes the first buffer and is empty then. Throws InputError for
// - a buffer without bytes, or with too few;
// - an address that is not relative;
// - a file outside the glTF file's folder, links followed;
// - more than 8 GiB in files.
// Reads plain files only, each address once; allocates what the buffers say they hold and the files do.
GltfBuffers read_gltf_buffers(const std::filesystem::path& path, const nlohmann::json& document,
                              GltfContainer& container);

// The context of accessors; borrowed. The document has passed check_members().
struct GltfData {
    const std::filesystem::path& path;  // of the file, for messages
    const nlohmann::json& document;
    std::span<const std::string_view> buffers;
};

// The components of an accessor, element after element. Normalised integers become the numbers that they stand for.
// width: see accessor_type(). expected: how many elements there must be, so that no file makes more room than its keys
// need. 0: any number, but they must then be bytes of the file. is_skin: it is a skin's instead of an animation's, and
// may have more elements, if they are bytes of the file. Throws InputError for
// - an accessor that does not exist, or has another type or count;
// - one that reads beyond its buffer view;
// - numbers that are not finite.
std::vector<double> read_accessor(const GltfData& data, int index, std::size_t width, std::size_t expected,
                                  bool is_skin = false);

}  // namespace swivel::formats

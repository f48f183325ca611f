#pragma once
// SPDX-License-Identifier: MIT
// A glTF document made from nothing: JSON beside one buffer that grows. Owns how numbers become accessors; knows
// neither skeletons nor where the numbers come from.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "tools/formats/gltf_container.h"

namespace swivel::formats {

struct GltfBuilder {
    nlohmann::json json;  // all but `buffers`; members stay where they are when others are added
    std::string bytes;    // of buffer 0
};

// What a buffer view is for, as the graphics API is told.
enum class GltfUse : std::uint16_t { none = 0, vertices = 34962, indices = 34963 };

// Copies bytes into the buffer, at a multiple of four; returns the number of their new buffer view.
std::size_t add_view(GltfBuilder& gltf, std::string_view bytes, GltfUse use);

// New accessors, by number. width: components of an element, 1, 2, 3, 4 or 16; the values are a whole number of
// elements, at least one. Where `use` is none or vertices, and an element has up to three components, the accessor
// gets its least and greatest values, which positions and key times must have.
std::size_t add_floats(GltfBuilder& gltf, std::span<const float> values, std::size_t width, GltfUse use);
std::size_t add_indices(GltfBuilder& gltf, std::span<const std::uint32_t> values);
std::size_t add_joints(GltfBuilder& gltf, std::span<const std::uint16_t> values);  // four for each vertex

// The whole as a GLB's two parts. Text that is no UTF-8 has its bad bytes replaced.
GltfContainer container_of(GltfBuilder gltf);

}  // namespace swivel::formats

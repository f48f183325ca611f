#pragma once
// SPDX-License-Identifier: MIT
// Skin weights. glTF asks that those of a vertex, in all sets of a primitive together, add up to 1; many exporters
// round them apart. Owns that rule and what takes the place of weights that break it.

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "tools/formats/gltf_accessor.h"

namespace swivel::formats {

// The weights of one run of vertices, which primitives may share, with those that did not add up to 1 mended.
struct GltfWeights {
    struct Primitive {
        std::size_t mesh, primitive;
    };
    std::vector<Primitive> primitives;     // all that have these weights
    std::vector<std::vector<float>> sets;  // for WEIGHTS_0, WEIGHTS_1 and so on: 4 for each vertex
    std::size_t mended_count = 0;          // vertices; above 0
};

// The primitives of `document` that need new weights, and these weights. Weights are divided by their sum. A vertex of
// zeros follows its first joint, as in three.js. A vertex that adds up, or has a negative weight, keeps its own. Never
// throws for what a file says. Weights that cannot be read (compressed, broken, of no legal type) are left alone, and
// so are those beyond the first GiB. While it looks, it takes 16 bytes for each vertex and set, and 32 for each vertex.
// It keeps the 16 of those that it mends.
std::vector<GltfWeights> mended_weights(const GltfData& data, const nlohmann::ordered_json& document);

}  // namespace swivel::formats

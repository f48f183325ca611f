// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_weights.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "tools/formats/error.h"

namespace swivel::formats {
namespace {

using Json = nlohmann::ordered_json;
using Sets = std::vector<std::vector<float>>;

constexpr std::size_t kMostBytes = std::size_t{1} << 30;

// Accessors of a primitive's WEIGHTS_0, WEIGHTS_1 and so on; none where they are compressed or no plain indices.
std::vector<int> weights_of(const Json& primitive)
{
    std::vector<int> accessors;
    if (!primitive.is_object()) return {};
    const auto extensions = primitive.find("extensions");
    if (extensions != primitive.end() && extensions->contains("KHR_draco_mesh_compression")) return {};
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object()) return {};
    for (auto at = attributes->find("WEIGHTS_0"); at != attributes->end();
         at = attributes->find(fmt::format("WEIGHTS_{}", accessors.size()))) {
        if (!at->is_number_unsigned() || at->get<std::uint64_t>() > INT32_MAX) return {};
        accessors.push_back(at->get<int>());
    }
    return accessors;
}

bool is_legal(const tinygltf::Accessor& accessor)
{
    const int type = accessor.componentType;
    return type == TINYGLTF_COMPONENT_TYPE_FLOAT ||
           (accessor.normalized &&
            (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT));
}

std::optional<Sets> read_sets(const GltfData& data, const std::vector<int>& accessors)
try {
    Sets sets;
    std::size_t bytes = 0, count = 0;
    for (const std::string& buffer : data.buffers) bytes += buffer.size();
    for (const int index : accessors) {
        const tinygltf::Accessor& accessor = data.model.accessors.at(static_cast<std::size_t>(index));
        if (sets.empty()) count = accessor.count;
        // Vertices have at least positions: a file cannot have more than bytes.
        if (!is_legal(accessor) || accessor.count != count || count == 0 || count > bytes) return {};
        const std::vector<double> values = read_accessor(data, index, TINYGLTF_TYPE_VEC4, count);
        sets.emplace_back(values.begin(), values.end());
    }
    return sets;
} catch (const InputError&) {
    return {};
} catch (const std::out_of_range&) {
    return {};
}

// Whether a vertex' weights add up as Khronos' validator counts: in floats, component by component through all sets,
// and to within 2e-7 for each that is not 0.
bool adds_up(const Sets& sets, std::size_t vertex)
{
    float sum = 0;
    double tolerance = 0;
    for (std::size_t n = 4 * vertex; n < 4 * vertex + 4; ++n)
        for (const auto& set : sets) {
            sum += set[n];
            tolerance += set[n] != 0 ? 2e-7 : 0;
        }
    return std::abs(static_cast<double>(sum) - 1) <= tolerance;
}

// Divides a vertex' weights by their sum. n quotients are off by 2^-25 each at most and so are the n - 1 sums of two,
// or by 2^-24 where above 1: less than 9e-8 n together, so that the result adds up.
bool mend(Sets& sets, std::size_t vertex)
{
    if (adds_up(sets, vertex)) return false;
    double sum = 0;
    for (const auto& set : sets)
        for (std::size_t n = 4 * vertex; n < 4 * vertex + 4; ++n) {
            if (set[n] < 0) return false;
            sum += static_cast<double>(set[n]);
        }
    if (sum == 0) sets[0][4 * vertex] = 1;
    for (auto& set : sets)
        for (std::size_t n = 4 * vertex; n < 4 * vertex + 4 && sum > 0; ++n)
            set[n] = static_cast<float>(static_cast<double>(set[n]) / sum);
    return true;
}

// The mended weights found so far.
struct Mended {
    std::vector<GltfWeights> weights;
    std::map<std::vector<int>, std::optional<std::size_t>>
        known;  // by accessors, in `weights`; those that are well: none
    std::size_t room = kMostBytes;

    std::optional<std::size_t> look_at(const GltfData& data, const std::vector<int>& accessors)
    {
        std::optional<Sets> sets = read_sets(data, accessors);
        if (!sets) return {};
        GltfWeights found;
        for (std::size_t vertex = 0; vertex < sets->front().size() / 4; ++vertex)
            found.mended_count += mend(*sets, vertex);
        const std::size_t size = sets->size() * sets->front().size() * sizeof(float);
        if (found.mended_count == 0 || size > room) return {};
        room -= size;
        found.sets = std::move(*sets);
        weights.push_back(std::move(found));
        return weights.size() - 1;
    }
    void add(const GltfData& data, const std::vector<int>& accessors, GltfWeights::Primitive primitive)
    {
        const auto [place, is_new] = known.try_emplace(accessors);
        if (is_new) place->second = look_at(data, accessors);
        if (place->second) weights[*place->second].primitives.push_back(primitive);
    }
};

const Json& list(const Json& owner, const char* name)
{
    static const Json none = Json::array();
    if (!owner.is_object()) return none;
    const auto found = owner.find(name);
    return found != owner.end() && found->is_array() ? *found : none;
}

}  // namespace

std::vector<GltfWeights> mended_weights(const GltfData& data, const Json& document)
{
    Mended mended;
    const Json& meshes = list(document, "meshes");
    for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
        const Json& primitives = list(meshes[mesh], "primitives");
        for (std::size_t n = 0; n < primitives.size(); ++n)
            if (const std::vector<int> accessors = weights_of(primitives[n]); !accessors.empty())
                mended.add(data, accessors, {mesh, n});
    }
    return std::move(mended.weights);
}

}  // namespace swivel::formats

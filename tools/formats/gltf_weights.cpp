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
#include <string_view>
#include <utility>

#include "tools/formats/error.h"

namespace swivel::formats {
namespace {

using Json = nlohmann::ordered_json;
using Sets = std::vector<std::vector<float>>;

constexpr std::size_t kMostBytes = std::size_t{1} << 30;  // as floats, of all that is looked at

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

// How many vertices all these sets have; 0: they do not agree, or are not legal.
std::size_t vertex_count_of(const GltfData& data, const std::vector<int>& accessors)
{
    const std::vector<tinygltf::Accessor>& all = data.model.accessors;
    const auto at = [&](int index) { return static_cast<std::size_t>(index); };
    std::size_t bytes = 0;
    for (const std::string_view buffer : data.buffers) bytes += buffer.size();
    const std::size_t count = at(accessors[0]) < all.size() ? all[at(accessors[0])].count : 0;
    const bool is_sound = std::all_of(accessors.begin(), accessors.end(), [&](int index) {
        return at(index) < all.size() && is_legal(all[at(index)]) && all[at(index)].count == count;
    });
    return is_sound && count <= bytes ? count : 0;  // vertices have at least positions, so not more than bytes
}

// As floats; takes what they take from `room`, and has none where that is too small.
std::optional<Sets> read_sets(const GltfData& data, const std::vector<int>& accessors, std::size_t& room)
try {
    const std::size_t count = vertex_count_of(data, accessors), set_size = 4 * sizeof(float) * count;
    if (count == 0 || accessors.size() > room / set_size) return {};
    room -= accessors.size() * set_size;
    Sets sets;
    for (const int index : accessors) {
        const std::vector<double> values = read_accessor(data, index, TINYGLTF_TYPE_VEC4, count);
        sets.emplace_back(values.begin(), values.end());
    }
    return sets;
} catch (const InputError&) {
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

// Divides a vertex' weights by their sum. Each of n quotients is off by 2^-25 at most. So is each of their n - 1 sums,
// or by 2^-24 where it is above 1. Together that is less than 9e-8 n, so the result adds up.
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
    // By accessors, in `weights`; those that are well: none.
    std::map<std::vector<int>, std::optional<std::size_t>> known;
    std::size_t room = kMostBytes;

    std::optional<std::size_t> look_at(const GltfData& data, const std::vector<int>& accessors)
    {
        std::optional<Sets> sets = read_sets(data, accessors, room);
        if (!sets) return {};
        GltfWeights found;
        for (std::size_t vertex = 0; vertex < sets->front().size() / 4; ++vertex)
            found.mended_count += mend(*sets, vertex);
        if (found.mended_count == 0) return {};
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

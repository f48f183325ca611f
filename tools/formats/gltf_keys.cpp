// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_keys.h"

#include <algorithm>
#include <map>
#include <optional>

namespace swivel::formats {
namespace {

using Json = nlohmann::json;

constexpr int kFloat = 5126;  // glTF's componentType

// How many members of the document name each accessor, or each buffer view.
using Uses = std::map<std::size_t, int>;

void count(const Json& value, Uses& uses)
{
    if (value.is_number_unsigned()) ++uses[value.get<std::size_t>()];
}

// Extensions name accessors and buffer views by the same members.
void count_uses(const Json& value, Uses& accessors, Uses& views)
{
    if (value.is_object()) {
        for (const auto& [name, member] : value.items()) {
            if (name == "bufferView") count(member, views);
            if (name == "input" || name == "output" || name == "indices" || name == "inverseBindMatrices")
                count(member, accessors);
            if (name == "attributes" && member.is_object())
                for (const Json& each : member) count(each, accessors);
            if (name == "targets" && member.is_array())
                for (const Json& target : member)
                    for (const Json& each : target) count(each, accessors);
            count_uses(member, accessors, views);
        }
    } else if (value.is_array()) {
        for (const Json& each : value) count_uses(each, accessors, views);
    }
}

// An animated node must not have a matrix.
void take_matrix_apart(Json& node, const GltfChanges::Track& track)
{
    if (!node.contains("matrix")) return;
    node.erase("matrix");
    const Eigen::Quaterniond& q = track.rotation;
    node["translation"] = {track.translation.x(), track.translation.y(), track.translation.z()};
    node["rotation"] = {q.x(), q.y(), q.z(), q.w()};
    node["scale"] = {track.scale.x(), track.scale.y(), track.scale.z()};
}

bool is_rotation_of(const Json& channel, int node)
{
    const Json& target = channel.at("target");
    return target.at("path") == "rotation" && target.value("node", -1) == node;
}

class KeyWriter {
public:
    KeyWriter(GltfAsset& asset, Json& animation, const GltfChanges& changes)
        : asset_(asset), changes_(changes), channels_(animation["channels"]), samplers_(animation["samplers"])
    {
        count_uses(*asset.document, accessor_uses_, view_uses_);
    }

    void write()
    {
        for (const GltfChanges::Track& track : changes_.tracks) {
            take_matrix_apart(asset_.list("nodes")[static_cast<std::size_t>(track.node)], track);
            places_.push_back(place_of(track.node));
        }
        for (const auto& [accessor, uses] : accessor_uses_)
            if (is_free(accessor)) --view_uses_[view_of(accessor)];
        for (std::size_t n = 0; n < places_.size(); ++n) {
            const GltfChanges::Track& track = changes_.tracks[n];
            Json& sampler = samplers_[places_[n].sampler];
            sampler["input"] = times(places_[n].input);
            sampler["interpolation"] = track.is_stepped ? "STEP" : "LINEAR";
            sampler["output"] = rotations(places_[n].output, track.xyzw);
        }
    }

private:
    // Where a track's keys go: a sampler, and the accessors that it had and nobody else may need.
    struct Place {
        std::size_t sampler;
        std::optional<std::size_t> input, output;
    };

    // The sampler of the node's rotation, unless other channels use it, too; else a new one.
    Place place_of(int node)
    {
        const auto is_its = [&](const Json& channel) { return is_rotation_of(channel, node); };
        const auto channel = std::find_if(channels_.begin(), channels_.end(), is_its);
        const std::size_t next = samplers_.size();
        if (channel == channels_.end()) {
            channels_.push_back({{"sampler", next}, {"target", {{"node", node}, {"path", "rotation"}}}});
            samplers_.push_back(Json::object());
            return {next, {}, {}};
        }
        const std::size_t old = channel->at("sampler");
        const auto users = std::count_if(channels_.begin(), channels_.end(),
                                         [&](const Json& each) { return each.at("sampler") == old; });
        if (users > 1) {
            (*channel)["sampler"] = next;
            samplers_.push_back(Json::object());
            return {next, {}, {}};
        }
        const Place place{old, samplers_[old].at("input"), samplers_[old].at("output")};
        --accessor_uses_[*place.input];
        --accessor_uses_[*place.output];
        return place;
    }

    // A sparse accessor has more buffer views than one, and stays.
    bool is_free(std::size_t accessor)
    {
        const auto uses = accessor_uses_.find(accessor);
        const Json& at = asset_.list("accessors");
        return uses != accessor_uses_.end() && uses->second == 0 && accessor < at.size() &&
               at[accessor].contains("bufferView") && !at[accessor].contains("sparse");
    }
    std::size_t view_of(std::size_t accessor) { return asset_.list("accessors")[accessor].at("bufferView"); }

    // Puts an element into a list, in the place of a free one if there is one, whose own name it keeps. Its index.
    std::size_t put(const char* list, std::optional<std::size_t> place, Json element)
    {
        Json& all = asset_.list(list);
        if (!place) {
            all.push_back(std::move(element));
            return all.size() - 1;
        }
        for (const char* member : {"name", "extras"})
            if (all[*place].contains(member)) element[member] = all[*place][member];
        all[*place] = std::move(element);
        return *place;
    }
    // Puts an accessor of floats, whose buffer view is `view` unless there is a free one to put it into.
    std::size_t put_accessor(std::optional<std::size_t> old, const Json& view, std::size_t count, const char* type)
    {
        if (old && !is_free(*old)) old.reset();
        std::optional<std::size_t> free_view;
        if (old && view_uses_[view_of(*old)] == 0) free_view = view_of(*old);
        const std::size_t at = put("bufferViews", free_view, view);
        view_uses_[at] = 1;
        const Json accessor{{"bufferView", at}, {"componentType", kFloat}, {"count", count}, {"type", type}};
        const std::size_t placed = put("accessors", old, accessor);
        accessor_uses_[placed] = 1;
        return placed;
    }
    std::size_t rotations(std::optional<std::size_t> old, std::span<const float> xyzw)
    {
        const std::string_view bytes(reinterpret_cast<const char*>(xyzw.data()), xyzw.size_bytes());
        return put_accessor(old, asset_.add_bytes(bytes), xyzw.size() / 4, "VEC4");
    }
    // One accessor for all tracks, and for those that had one of their own another one in its place.
    std::size_t times(std::optional<std::size_t> old)
    {
        const std::vector<float>& all = changes_.times;
        if (old && std::find(times_.begin(), times_.end(), *old) != times_.end()) return *old;
        if (!times_.empty() && !(old && is_free(*old))) return times_.front();
        if (times_.empty()) times_view_ = asset_.add_bytes({reinterpret_cast<const char*>(all.data()), 4 * all.size()});
        const std::size_t at = put_accessor(old, times_view_, all.size(), "SCALAR");
        asset_.list("accessors")[at]["min"] = {all.front()};
        asset_.list("accessors")[at]["max"] = {all.back()};
        times_.push_back(at);
        return at;
    }

    GltfAsset& asset_;
    const GltfChanges& changes_;
    Json &channels_, &samplers_;
    Uses accessor_uses_, view_uses_;
    std::vector<Place> places_;
    std::vector<std::size_t> times_;  // accessors of the new times
    Json times_view_;
};

}  // namespace

Json& GltfAsset::list(const char* name)
{
    Json& found = (*document)[name];
    if (!found.is_array()) found = Json::array();
    return found;
}

void GltfAsset::drop_empty_lists()
{
    for (const char* name : {"buffers", "bufferViews", "accessors"})
        if (list(name).empty()) document->erase(name);
}

Json GltfAsset::add_bytes(std::string_view content)
{
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    const Json view{{"buffer", buffer}, {"byteOffset", bytes.size()}, {"byteLength", content.size()}};
    bytes += content;
    return view;
}

void add_keys(GltfAsset& asset, const GltfChanges& changes)
{
    if (changes.tracks.empty()) return;
    Json& animations = asset.list("animations");
    const int at = changes.animation;
    if (at < 0) animations.push_back({{"name", "swivel"}});
    Json& animation = at < 0 ? animations.back() : animations[static_cast<std::size_t>(at)];
    for (const char* name : {"channels", "samplers"})
        if (!animation.contains(name)) animation[name] = Json::array();
    KeyWriter(asset, animation, changes).write();
}

}  // namespace swivel::formats

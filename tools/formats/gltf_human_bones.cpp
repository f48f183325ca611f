// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_human_bones.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/formats/error.h"
#include "tools/formats/printable.h"

namespace swivel::formats {
namespace {

using Json = nlohmann::json;

struct HumanBones {
    const std::filesystem::path& path;
    std::size_t node_count;
    std::map<std::string, int> nodes = {};

    [[noreturn]] void refuse(const std::string& place, const char* wanted) const
    {
        throw InputError(path, fmt::format("{} is not {}; export the file again", place, wanted));
    }
    void add(const std::string& place, const Json& bone, const std::string& name)
    {
        const auto node = bone.find("node");
        if (node == bone.end() || !node->is_number_unsigned() || node->get<std::uint64_t>() >= node_count)
            refuse(place + "/node", "a node of the file");
        if (!nodes.emplace(name, node->get<int>()).second) refuse(place, "the only bone of its name");
    }
    // What lies at `members` below each other; nothing where one is missing.
    const Json* find(const Json& document, std::initializer_list<const char*> members) const
    {
        const Json* at = &document;
        std::string place;
        for (const char* member : members) {
            if (!at->is_object()) refuse(place, "an object");
            const auto found = at->find(member);
            if (found == at->end()) return nullptr;
            at = &*found;
            place += '/';
            place += member;
        }
        return at;
    }
};

}  // namespace

std::map<std::string, int> read_human_bones(const std::filesystem::path& path, const Json& document)
{
    const auto nodes = document.find("nodes");
    HumanBones bones{path, nodes == document.end() ? 0 : nodes->size()};
    if (const Json* all = bones.find(document, {"extensions", "VRMC_vrm", "humanoid", "humanBones"})) {
        const std::string place = "/extensions/VRMC_vrm/humanoid/humanBones";
        if (!all->is_object()) bones.refuse(place, "an object");
        for (const auto& [name, bone] : all->items()) {
            const std::string at = place + '/' + printable(name);
            if (!bone.is_object()) bones.refuse(at, "an object");
            bones.add(at, bone, name);
        }
    } else if (const Json* list = bones.find(document, {"extensions", "VRM", "humanoid", "humanBones"})) {
        const std::string place = "/extensions/VRM/humanoid/humanBones";
        if (!list->is_array()) bones.refuse(place, "a list");
        for (std::size_t n = 0; n < list->size(); ++n) {
            const Json& bone = (*list)[n];
            const std::string at = fmt::format("{}/{}", place, n);
            const bool has_name = bone.is_object() && bone.contains("bone") && bone["bone"].is_string();
            if (!has_name) bones.refuse(at + "/bone", "a bone's name");
            bones.add(at, bone, bone["bone"]);
        }
    }
    return bones.nodes;
}

}  // namespace swivel::formats

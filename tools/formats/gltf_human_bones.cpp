// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_human_bones.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/formats/error.h"
#include "tools/formats/printable.h"

namespace swivel::formats {

std::map<std::string, int> read_human_bones(const std::filesystem::path& path, const nlohmann::json& document)
{
    using Json = nlohmann::json;
    std::map<std::string, int> bones;
    const std::size_t node_count = document.at("nodes").size();
    const auto add = [&](const Json& bone, const Json& name) {
        const bool is_sound = bone.is_object() && name.is_string() && bone.contains("node") &&
                              bone["node"].is_number_unsigned() && bone["node"].get<std::uint64_t>() < node_count;
        if (!is_sound || !bones.emplace(name.get<std::string>(), bone["node"].get<int>()).second)
            throw InputError(path, fmt::format("its humanBones do not name each bone once, with a node of the file, at "
                                               "{}: {}; export the file again",
                                               printable(name.dump()), printable(bone.dump(), 60)));
    };
    const Json::json_pointer newer("/extensions/VRMC_vrm/humanoid/humanBones"),
        older("/extensions/VRM/humanoid/humanBones");
    if (document.contains(newer)) {
        for (const auto& [name, bone] : document[newer].items()) add(bone, name);
    } else if (document.contains(older)) {
        for (const Json& bone : document[older])
            add(bone, bone.is_object() && bone.contains("bone") ? bone["bone"] : Json());
    }
    return bones;
}

}  // namespace swivel::formats

// SPDX-License-Identifier: MIT
#include "tests/gltf_rig.h"

#include <cstdint>
#include <string_view>

namespace swivel::test {

GltfRig::GltfRig()
    : json({{"asset", {{"version", "2.0"}, {"generator", "swivel test"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", nlohmann::json::array()}}}},
            {"nodes", nlohmann::json::array()}})
{
}

int GltfRig::add(const std::string& name, int parent, const Eigen::Vector3d& translation,
                 const Eigen::Quaterniond& rotation, const Eigen::Vector3d& scale)
{
    const int node = static_cast<int>(json["nodes"].size());
    nlohmann::json at = {{"translation", {translation.x(), translation.y(), translation.z()}},
                         {"rotation", {rotation.x(), rotation.y(), rotation.z(), rotation.w()}}};
    if (!name.empty()) at["name"] = name;
    if (scale != Eigen::Vector3d::Ones()) at["scale"] = {scale.x(), scale.y(), scale.z()};
    json["nodes"].push_back(at);
    auto& siblings =
        parent < 0 ? json["scenes"][0]["nodes"] : json["nodes"][static_cast<std::size_t>(parent)]["children"];
    siblings.push_back(node);
    return node;
}

int GltfRig::add_animation(const std::string& name)
{
    json["animations"].push_back(
        {{"name", name}, {"channels", nlohmann::json::array()}, {"samplers", nlohmann::json::array()}});
    return static_cast<int>(json["animations"].size()) - 1;
}

int GltfRig::add_accessor(const std::vector<float>& values, const char* type, std::size_t width)
{
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", 4 * values.size()}});
    bytes.append(reinterpret_cast<const char*>(values.data()), 4 * values.size());
    nlohmann::json accessor = {{"bufferView", json["bufferViews"].size() - 1},
                               {"componentType", 5126},
                               {"count", values.size() / width},
                               {"type", type}};
    if (width == 1) {
        accessor["min"] = {values.front()};
        accessor["max"] = {values.back()};
    }
    json["accessors"].push_back(accessor);
    return static_cast<int>(json["accessors"].size()) - 1;
}

void GltfRig::add_keys(int animation, int node, const char* path, const std::vector<float>& times,
                       const std::vector<float>& values, const char* kind)
{
    auto& at = json["animations"][static_cast<std::size_t>(animation)];
    const bool is_rotation = std::string_view(path) == "rotation";
    at["channels"].push_back({{"sampler", at["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
    const int input = add_accessor(times, "SCALAR", 1);
    const int output = add_accessor(values, is_rotation ? "VEC4" : "VEC3", is_rotation ? 4 : 3);
    at["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", kind}});
}

void GltfRig::write(const fs::path& path) const
{
    nlohmann::json whole = json;
    const bool is_binary = path.extension() == ".glb";
    if (!bytes.empty()) whole["buffers"] = {{{"byteLength", bytes.size()}}};
    if (!bytes.empty() && !is_binary) {
        whole["buffers"][0]["uri"] = path.stem().string() + ".bin";
        spill(path.parent_path() / (path.stem().string() + ".bin"), bytes);
    }
    spill(path, is_binary ? glb(whole.dump(), bytes) : whole.dump(1));
}

std::string GltfRig::glb(std::string text, std::string chunk)
{
    const auto word = [](std::size_t value) {
        const auto number = static_cast<std::uint32_t>(value);
        return std::string(reinterpret_cast<const char*>(&number), 4);
    };
    text.resize((text.size() + 3) / 4 * 4, ' ');
    chunk.resize((chunk.size() + 3) / 4 * 4, '\0');
    const std::string tail = chunk.empty() ? "" : word(chunk.size()) + word(0x004E4942) + chunk;
    return "glTF" + word(2) + word(20 + text.size() + tail.size()) + word(text.size()) + word(0x4E4F534A) + text + tail;
}

}  // namespace swivel::test

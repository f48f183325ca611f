// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_nodes.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "tools/formats/error.h"
#include "tools/formats/gltf_json.h"
#include "tools/formats/printable.h"

namespace swivel::formats {
namespace {

using Json = nlohmann::json;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// The numbers of a node's member, `rest` where it has none. Those there are have the count that check_members() asks.
template <class Numbers>
Numbers numbers_of(const Json& node, const char* member, Numbers rest)
{
    if (const auto found = node.find(member); found != node.end())
        for (Eigen::Index n = 0; n < rest.size(); ++n)
            rest.data()[n] = (*found)[static_cast<std::size_t>(n)].template get<double>();
    return rest;
}

struct Nodes {
    const std::filesystem::path& path;
    const Json& list;

    [[noreturn]] void refuse(const std::string& cause) const
    {
        throw InputError(path, cause + "; export the file again");
    }
    void take_apart(const Json& node, Joint& joint) const;
    void read_transform(const Json& node, Joint& joint) const;
    std::vector<int> parents() const;
};

void Nodes::take_apart(const Json& node, Joint& joint) const
{
    const Eigen::Matrix4d whole = numbers_of(node, "matrix", Eigen::Matrix4d());  // column after column in both
    Eigen::Matrix3d linear = whole.topLeftCorner<3, 3>();
    joint.offset = whole.topRightCorner<3, 1>();
    joint.rest_scale = linear.colwise().norm();
    if (!(joint.rest_scale.minCoeff() > 0)) refuse(fmt::format("the matrix of node {} is singular", joint.number));
    if (linear.determinant() < 0) joint.rest_scale = -joint.rest_scale;
    linear = linear * joint.rest_scale.cwiseInverse().asDiagonal();
    const Eigen::Matrix3d skew = linear.transpose() * linear - Eigen::Matrix3d::Identity();
    joint.is_sheared = skew.cwiseAbs().maxCoeff() > 1e-5;
    joint.rest_rotation = Quaterniond(linear).normalized();
}

void Nodes::read_transform(const Json& node, Joint& joint) const
{
    if (node.contains("matrix")) return take_apart(node, joint);
    joint.offset = numbers_of(node, "translation", joint.offset);
    joint.rest_scale = numbers_of(node, "scale", joint.rest_scale);
    const Quaterniond rotation(numbers_of(node, "rotation", joint.rest_rotation.coeffs()));
    if (!(rotation.norm() > 1e-6)) refuse(fmt::format("node {} has a zero rotation", joint.number));
    joint.rest_rotation = rotation.normalized();
}

std::vector<int> Nodes::parents() const
{
    std::vector<int> parent(list.size(), -1);
    for (std::size_t n = 0; n < list.size(); ++n)
        for (const Json& each : list_in(list[n], "children")) {
            const int child = each;
            element(path, list, child, "a child node");
            if (parent[static_cast<std::size_t>(child)] >= 0)
                refuse(fmt::format("node {} is the child of two nodes", child));
            parent[static_cast<std::size_t>(child)] = static_cast<int>(n);
        }
    return parent;
}

// The joint of each node; all but what the file says of bones.
std::vector<int> add_joints(const Nodes& nodes, Clip& clip)
{
    const std::vector<int> parent = nodes.parents();
    std::vector<int> joint_of(parent.size(), -1), open;
    for (std::size_t n = parent.size(); n-- > 0;)
        if (parent[n] < 0) open.push_back(static_cast<int>(n));
    while (!open.empty()) {
        const int number = open.back();
        open.pop_back();
        const auto n = static_cast<std::size_t>(number);
        const Json& node = nodes.list[n];
        Joint joint;
        joint.name = node.value("name", "");
        if (joint.name.empty()) joint.name = fmt::format("#{}", n);
        joint.number = number;
        joint.parent = parent[n] < 0 ? -1 : joint_of[static_cast<std::size_t>(parent[n])];
        nodes.read_transform(node, joint);
        joint_of[n] = static_cast<int>(clip.joints.size());
        clip.joints.push_back(std::move(joint));
        if (const auto children = node.find("children"); children != node.end())
            open.insert(open.end(), children->rbegin(), children->rend());
    }
    if (clip.joints.size() != parent.size()) nodes.refuse("nodes are each other's children, in a circle");
    return joint_of;
}

// What a VRM file says: the node of each human bone, by VRM's names ("leftUpperArm"), from VRM 1.0 or else 0.x.
std::map<std::string, int> read_human_bones(const std::filesystem::path& path, const Json& document)
{
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

}  // namespace

std::vector<int> read_nodes(const std::filesystem::path& path, const Json& document, Clip& clip)
{
    const auto list = document.find("nodes");
    if (list == document.end() || list->empty())
        throw InputError(path, "it has no nodes, so no skeleton; export it with its skeleton");
    const std::vector<int> joint_of = add_joints({path, *list}, clip);
    if (const auto skins = document.find("skins"); skins != document.end() && !skins->empty()) {
        for (Joint& joint : clip.joints) joint.is_bone = false;
        for (const Json& skin : *skins)
            for (const Json& node : list_in(skin, "joints")) {
                element(path, joint_of, node, "a skin's node");
                clip.joints[static_cast<std::size_t>(joint_of[node.get<std::size_t>()])].is_bone = true;
            }
    }
    for (const auto& [name, node] : read_human_bones(path, document))
        clip.human_bones[name] = joint_of[static_cast<std::size_t>(node)];
    return joint_of;
}

}  // namespace swivel::formats

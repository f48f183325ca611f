// SPDX-License-Identifier: MIT
// The writer edits the text itself (see gltf_edit.h). So untouched values stay as they are, and buffers stay byte for
// byte. The document lives while the file is read, and again while it is written: it is many times as large as the
// text.
#include "tools/formats/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "tools/formats/error.h"
#include "tools/formats/gltf_buffers.h"
#include "tools/formats/gltf_json.h"
#include "tools/formats/gltf_uri.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::formats {

namespace {

using Json = nlohmann::json;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// The numbers of a node's member, or `rest` if it is missing. check_members() has checked their count.
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

// Adds a joint for each node, parents first. Returns the joint of each node.
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

// The node of each human bone in a VRM file, by VRM's names ("leftUpperArm"), from VRM 1.0 or else 0.x.
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

// Fills the joints of a clip, parents first and children in the file's order, and its human bones. Returns the joint of
// each node. document: one that check_members() has passed. Throws InputError for
// - nodes that do not exist, have two parents, or stand in a circle;
// - a file without nodes;
// - transforms that turn or scale to nothing.
// Takes time in proportion to the nodes, however they hang on each other.
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

using Eigen::Vector4d;

[[noreturn]] void refuse(const GltfFile& file, const std::string& cause) { throw InputError(file.path, cause); }

int choose_animation(const GltfFile& file, const std::string& wanted)
{
    const auto& names = file.animation_names;
    if (wanted.empty()) return names.empty() ? -1 : 0;
    const auto named = std::count(names.begin(), names.end(), wanted);
    if (named == 1) return static_cast<int>(std::find(names.begin(), names.end(), wanted) - names.begin());
    const auto index = parse_integer(wanted);
    if (named == 0 && index && *index >= 0 && *index < static_cast<std::int64_t>(names.size()))
        return static_cast<int>(*index);
    std::string all;
    for (std::size_t n = 0; n < names.size() && n < 20; ++n)
        all += fmt::format("{}{} {}", n ? ", " : "", n, printable(names[n]));
    refuse(file, named > 1 ? fmt::format("{} animations are called '{}'; give the index", named, printable(wanted))
                 : names.empty() ? std::string("it has no animation; leave out --clip to use its rest pose")
                                 : fmt::format("it has no animation '{}'; it has {}", printable(wanted),
                                               printable(all, kMaxQuoted)));
}

Interpolation interpolation_of(const GltfFile& file, const Json& from)
{
    const std::string name = from.value("interpolation", "LINEAR");
    if (name == "STEP") return Interpolation::step;
    if (name == "CUBICSPLINE") return Interpolation::cubic;
    if (name != "LINEAR")
        refuse(file, fmt::format("interpolation '{}' is unknown; export the file again", printable(name)));
    return Interpolation::linear;
}

GltfSampler read_sampler(const GltfFile& file, const Json& document, const Json& from, bool is_rotation)
{
    const GltfData data{file.path, document, file.buffers};
    const int input = from.at("input"), output = from.at("output");
    GltfSampler sampler;
    sampler.interpolation = interpolation_of(file, from);
    sampler.time = read_accessor(data, input, 1, 0);
    for (std::size_t n = 1; n < sampler.time.size(); ++n)
        if (!(sampler.time[n] > sampler.time[n - 1]))
            refuse(file, fmt::format("times in accessor {} do not grow; export the file again", input));
    const std::size_t width = is_rotation ? 4 : 3;
    const std::size_t each = sampler.interpolation == Interpolation::cubic ? 3 : 1;
    const auto values = read_accessor(data, output, width, each * sampler.time.size());
    for (std::size_t n = 0; n < values.size(); n += width) {
        Vector4d value = Vector4d::Zero();
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(n), width, value.data());
        const bool is_key = each == 1 || n / width % 3 == 1;
        if (is_rotation && is_key && !(value.norm() > 1e-6))
            refuse(file, fmt::format("accessor {} holds a zero rotation; export the file again", output));
        sampler.value.push_back(value);
    }
    return sampler;
}

// Samplers of the animation that are in use, each once: by accessors, interpolation, and whether of rotations. Many
// channels may share one, and many samplers the same accessors.
class Samplers {
public:
    explicit Samplers(std::size_t max_bytes) : max_bytes_(max_bytes) {}

    // Its place in file.samplers.
    std::size_t place(GltfFile& file, const Json& document, const Json& from, bool is_rotation)
    {
        const auto [at, is_new] = places_.try_emplace(
            {from.at("input").get<int>(), from.at("output").get<int>(), interpolation_of(file, from), is_rotation},
            file.samplers.size());
        if (!is_new) return at->second;
        const GltfSampler& sampler = file.samplers.emplace_back(read_sampler(file, document, from, is_rotation));
        // Times and a half: sample() has them all in one list, as floats.
        bytes_ += 3 * sampler.time.size() * sizeof(float) + sampler.value.size() * sizeof(Vector4d);
        if (bytes_ > max_bytes_)
            refuse(file, fmt::format("the keys of animation {} come to more than {:g} GiB; cut it", file.animation,
                                     gibibytes(max_bytes_)));
        return at->second;
    }

private:
    std::map<std::tuple<int, int, Interpolation, bool>, std::size_t> places_;
    std::size_t bytes_ = 0;
    std::size_t max_bytes_;
};

constexpr std::array<std::string_view, 3> kPaths = {"translation", "rotation", "scale"};  // by GltfPath

// Channels of KHR_animation_pointer may move nodes, too.
void refuse_pointer_to_node(const GltfFile& file, const Json& channel)
{
    const Json::json_pointer where("/target/extensions/KHR_animation_pointer/pointer");
    if (!channel.contains(where) || !channel.at(where).is_string()) return;
    const std::string to = channel.at(where).get<std::string>();
    for (const std::string_view path : kPaths)
        if (to.starts_with("/nodes/") && to.ends_with(fmt::format("/{}", path)))
            refuse(file, fmt::format("animation {} moves {} by KHR_animation_pointer, which is not read; export "
                                     "the motion of nodes as plain channels",
                                     file.animation, printable(to, 80)));
}

void read_channels(GltfFile& file, const Json& document, const std::vector<int>& joint_of)
{
    const Json& animation = list_in(document, "animations")[static_cast<std::size_t>(file.animation)];
    std::set<std::pair<int, GltfPath>> seen;
    Samplers samplers(file.choice.max_pose_bytes);
    for (const Json& from : list_in(animation, "channels")) {
        refuse_pointer_to_node(file, from);
        const Json& target = from.at("target");
        const std::string path = target.at("path");
        const auto known = std::ranges::find(kPaths, path);
        if (!target.contains("node") || known == kPaths.end()) continue;
        GltfChannel channel;
        channel.joint = element(file.path, joint_of, target.at("node"), "a channel's node");
        channel.path = static_cast<GltfPath>(known - kPaths.begin());
        if (!seen.emplace(channel.joint, channel.path).second)
            refuse(file, fmt::format("two channels of animation {} are for the {} of node {}; glTF allows one",
                                     file.animation, path, target.at("node").get<int>()));
        const Json& sampler =
            element(file.path, list_in(animation, "samplers"), from.at("sampler"), "a channel's sampler");
        channel.sampler = samplers.place(file, document, sampler, channel.path == GltfPath::rotation);
        file.channels.push_back(channel);
    }
}

std::vector<std::filesystem::path> files_beside(const std::filesystem::path& path, const Json& document)
{
    std::vector<std::filesystem::path> files;
    for_each_uri(document, [&](const Json& object) {
        const auto& uri = object.at("uri").get_ref<const std::string&>();
        if (!is_data_uri(uri)) files.push_back(file_at(uri, path));
    });
    std::erase(files, std::filesystem::path());  // addresses that name no file
    return files;
}

}  // namespace

GltfFile read_gltf(const std::filesystem::path& path, const GltfChoice& choice)
{
    return read_gltf(path, read_gltf_container(path), choice);
}

GltfFile read_gltf(const std::filesystem::path& path, GltfContainer container, const GltfChoice& choice)
{
    GltfFile file;
    file.path = path;
    file.choice = choice;
    file.container = std::move(container);
    const Json document = gltf_document(path, file.container.json);
    file.files_beside = files_beside(path, document);
    GltfBuffers buffers = read_gltf_buffers(path, document, file.container);
    file.buffers = std::move(buffers.bytes);
    file.contents = std::move(buffers.contents);
    const std::vector<int> joint_of = read_nodes(path, document, file.clip);
    for (const Json& animation : list_in(document, "animations"))
        file.animation_names.push_back(animation.value("name", ""));
    file.animation = choose_animation(file, choice.animation);
    if (file.animation >= 0) read_channels(file, document, joint_of);
    return file;
}

}  // namespace swivel::formats

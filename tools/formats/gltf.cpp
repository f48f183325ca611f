// SPDX-License-Identifier: MIT
// tinygltf reads a reduced document (skeleton_json()), without images and meshes. It gets no buffers either: it would
// look for them in the current folder, too, and wants files of exactly a buffer's length. It does not write, because it
// would drop or reorder what it does not know. The writer edits the text itself. So untouched values stay as they are,
// and buffers stay byte for byte.
#include "tools/formats/gltf.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "tools/formats/error.h"
#include "tools/formats/gltf_accessor.h"
#include "tools/formats/gltf_buffers.h"
#include "tools/formats/gltf_element.h"
#include "tools/formats/gltf_frames.h"
#include "tools/formats/gltf_human_bones.h"
#include "tools/formats/gltf_json.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector4d;

[[noreturn]] void refuse(const GltfFile& file, const std::string& cause) { throw InputError(file.path, cause); }

// Nodes, skins, animations and what these refer to, but no bytes.
tinygltf::Model load(const std::filesystem::path& path, const nlohmann::ordered_json& document)
{
    const std::string json = skeleton_json(document);
    tinygltf::TinyGLTF loader;
    tinygltf::Model model;
    std::string error, warning;
    bool is_read = false;
    try {
        is_read = loader.LoadASCIIFromString(&model, &error, &warning, json.data(), static_cast<unsigned>(json.size()),
                                             std::string());
    } catch (const std::exception& thrown) {
        error = thrown.what();
    }
    if (is_read) return model;
    std::replace(error.begin(), error.end(), '\n', ' ');
    throw InputError(path, fmt::format("is not sound glTF: {}", printable(trimmed(error), 200)));
}

// ---- the skeleton

// A node's matrix, of 16 numbers as check_members() has seen, taken apart.
void take_apart(const GltfFile& file, const std::vector<double>& matrix, Joint& joint)
{
    const Eigen::Map<const Eigen::Matrix4d> whole(matrix.data());  // column after column in both
    Eigen::Matrix3d linear = whole.topLeftCorner<3, 3>();
    joint.offset = whole.topRightCorner<3, 1>();
    joint.rest_scale = linear.colwise().norm();
    if (!(joint.rest_scale.minCoeff() > 0))
        refuse(file, fmt::format("the matrix of node {} is singular", joint.number));
    if (linear.determinant() < 0) joint.rest_scale = -joint.rest_scale;
    linear = linear * joint.rest_scale.cwiseInverse().asDiagonal();
    const Eigen::Matrix3d skew = linear.transpose() * linear - Eigen::Matrix3d::Identity();
    joint.is_sheared = skew.cwiseAbs().maxCoeff() > 1e-5;
    joint.rest_rotation = Quaterniond(linear).normalized();
}

void read_transform(const GltfFile& file, const tinygltf::Node& node, Joint& joint)
{
    if (!node.matrix.empty()) return take_apart(file, node.matrix, joint);
    if (!node.translation.empty()) joint.offset = Vector3d(node.translation.data());
    if (!node.scale.empty()) joint.rest_scale = Vector3d(node.scale.data());
    if (!node.rotation.empty()) {
        const Quaterniond rotation(Vector4d(node.rotation.data()));
        if (!(rotation.norm() > 1e-6)) refuse(file, fmt::format("node {} has a zero rotation", joint.number));
        joint.rest_rotation = rotation.normalized();
    }
}

std::vector<int> parents_of(const GltfFile& file, const tinygltf::Model& model)
{
    std::vector<int> parent(model.nodes.size(), -1);
    for (std::size_t n = 0; n < model.nodes.size(); ++n)
        for (const int child : model.nodes[n].children) {
            element(file.path, model.nodes, child, "node");
            if (parent[static_cast<std::size_t>(child)] >= 0)
                refuse(file, fmt::format("node {} is the child of two nodes", child));
            parent[static_cast<std::size_t>(child)] = static_cast<int>(n);
        }
    return parent;
}

// The clip's joints, parents first, children in the file's order; the joint of each node.
std::vector<int> read_nodes(GltfFile& file, const tinygltf::Model& model)
{
    const std::vector<int> parent = parents_of(file, model);
    std::vector<int> joint_of(model.nodes.size(), -1), open;
    for (std::size_t n = model.nodes.size(); n-- > 0;)
        if (parent[n] < 0) open.push_back(static_cast<int>(n));
    while (!open.empty()) {
        const int number = open.back();
        open.pop_back();
        const auto n = static_cast<std::size_t>(number);
        const tinygltf::Node& node = model.nodes[n];
        Joint joint;
        joint.name = node.name.empty() ? fmt::format("#{}", n) : node.name;
        joint.number = number;
        joint.parent = parent[n] < 0 ? -1 : joint_of[static_cast<std::size_t>(parent[n])];
        joint.is_bone = model.skins.empty();
        read_transform(file, node, joint);
        joint_of[n] = static_cast<int>(file.clip.joints.size());
        file.clip.joints.push_back(std::move(joint));
        open.insert(open.end(), node.children.rbegin(), node.children.rend());
    }
    if (file.clip.joints.size() != model.nodes.size()) refuse(file, "nodes are each other's children, in a circle");
    for (const tinygltf::Skin& skin : model.skins)
        for (const int node : skin.joints) {
            element(file.path, model.nodes, node, "node");
            file.clip.joints[static_cast<std::size_t>(joint_of[static_cast<std::size_t>(node)])].is_bone = true;
        }
    return joint_of;
}

// ---- the animation

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
                                 : fmt::format("it has no animation '{}'; it has {}", printable(wanted), all));
}

Interpolation interpolation_of(const GltfFile& file, const tinygltf::AnimationSampler& from)
{
    if (from.interpolation == "STEP") return Interpolation::step;
    if (from.interpolation == "CUBICSPLINE") return Interpolation::cubic;
    if (!from.interpolation.empty() && from.interpolation != "LINEAR")
        refuse(file, fmt::format("interpolation '{}' is unknown", printable(from.interpolation)));
    return Interpolation::linear;
}

GltfSampler read_sampler(const GltfFile& file, const tinygltf::Model& model, const tinygltf::AnimationSampler& from,
                         bool is_rotation)
{
    const GltfData data{file.path, model, file.buffers};
    GltfSampler sampler;
    sampler.interpolation = interpolation_of(file, from);
    sampler.time = read_accessor(data, from.input, TINYGLTF_TYPE_SCALAR, 0);
    for (std::size_t n = 1; n < sampler.time.size(); ++n)
        if (!(sampler.time[n] > sampler.time[n - 1]))
            refuse(file, fmt::format("times in accessor {} do not grow", from.input));
    const std::size_t width = is_rotation ? 4 : 3;
    const std::size_t each = sampler.interpolation == Interpolation::cubic ? 3 : 1;
    const auto values = read_accessor(data, from.output, is_rotation ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3,
                                      each * sampler.time.size());
    for (std::size_t n = 0; n < values.size(); n += width) {
        Vector4d value = Vector4d::Zero();
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(n), width, value.data());
        const bool is_key = each == 1 || n / width % 3 == 1;
        if (is_rotation && is_key && !(value.norm() > 1e-6))
            refuse(file, fmt::format("accessor {} holds a zero rotation", from.output));
        sampler.value.push_back(value);
    }
    return sampler;
}

// Samplers of the animation that are in use, each once: by accessors, interpolation, and whether of rotations. Many
// channels may share one, and many samplers the same accessors.
class Samplers {
public:
    explicit Samplers(std::size_t most_bytes) : most_bytes_(most_bytes) {}

    // Its place in file.samplers.
    std::size_t place(GltfFile& file, const tinygltf::Model& model, const tinygltf::AnimationSampler& from,
                      bool is_rotation)
    {
        const auto [at, is_new] = places_.try_emplace(
            {from.input, from.output, interpolation_of(file, from), is_rotation}, file.samplers.size());
        if (!is_new) return at->second;
        const GltfSampler& sampler = file.samplers.emplace_back(read_sampler(file, model, from, is_rotation));
        // Times twice: sample_frames() has them all in one list.
        bytes_ += 2 * sampler.time.size() * sizeof(double) + sampler.value.size() * sizeof(Vector4d);
        if (bytes_ > most_bytes_)
            refuse(file, fmt::format("the keys of animation {} come to more than {:g} GiB; cut it", file.animation,
                                     gibibytes(most_bytes_)));
        return at->second;
    }

private:
    std::map<std::tuple<int, int, Interpolation, bool>, std::size_t> places_;
    std::size_t bytes_ = 0;
    std::size_t most_bytes_;
};

// Channels of KHR_animation_pointer may move nodes, too.
void refuse_pointers_to_nodes(const GltfFile& file, const nlohmann::ordered_json& document)
{
    const nlohmann::ordered_json::json_pointer where("/target/extensions/KHR_animation_pointer/pointer");
    const auto& animation = document.at("animations").at(static_cast<std::size_t>(file.animation));
    if (!animation.contains("channels")) return;
    for (const auto& channel : animation.at("channels")) {
        if (!channel.contains(where) || !channel.at(where).is_string()) continue;
        const std::string to = channel.at(where).get<std::string>();
        for (const char* path : {"/translation", "/rotation", "/scale"})
            if (to.starts_with("/nodes/") && to.ends_with(path))
                refuse(file, fmt::format("animation {} moves {} by KHR_animation_pointer, which is not read; export "
                                         "the motion of nodes as plain channels",
                                         file.animation, printable(to, 80)));
    }
}

void read_channels(GltfFile& file, const tinygltf::Model& model, const std::vector<int>& joint_of,
                   const GltfChoice& choice)
{
    const tinygltf::Animation& animation = model.animations[static_cast<std::size_t>(file.animation)];
    std::set<std::pair<int, GltfPath>> seen;
    Samplers samplers(choice.most_pose_bytes);
    for (const tinygltf::AnimationChannel& from : animation.channels) {
        const auto is = [&](const char* path) { return from.target_path == path; };
        if (from.target_node < 0 || !(is("translation") || is("rotation") || is("scale"))) continue;
        element(file.path, model.nodes, from.target_node, "node");
        GltfChannel channel;
        channel.joint = joint_of[static_cast<std::size_t>(from.target_node)];
        channel.path = is("rotation") ? GltfPath::rotation : is("scale") ? GltfPath::scale : GltfPath::translation;
        if (!seen.emplace(channel.joint, channel.path).second)
            refuse(file, fmt::format("two channels of animation {} are for the {} of node {}; glTF allows one",
                                     file.animation, from.target_path, from.target_node));
        channel.sampler = samplers.place(file, model, element(file.path, animation.samplers, from.sampler, "sampler"),
                                         channel.path == GltfPath::rotation);
        file.channels.push_back(channel);
    }
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
    file.container = std::move(container);
    const nlohmann::ordered_json document = gltf_document(path, file.container.json);
    file.files_beside = files_beside(path, document);
    GltfBuffers buffers = read_gltf_buffers(path, document, file.container);
    file.buffers = std::move(buffers.bytes);
    file.contents = std::move(buffers.contents);
    const tinygltf::Model model = load(path, document);
    const std::vector<int> joint_of = read_nodes(file, model);
    if (file.clip.joints.empty()) refuse(file, "it has no nodes, so no skeleton");
    for (const auto& [name, node] : read_human_bones(path, document))
        file.clip.human_bones[name] = joint_of[static_cast<std::size_t>(node)];
    for (const tinygltf::Animation& animation : model.animations) file.animation_names.push_back(animation.name);
    file.animation = choose_animation(file, choice.animation);
    if (file.animation >= 0) {
        refuse_pointers_to_nodes(file, document);
        read_channels(file, model, joint_of, choice);
    }
    sample_frames(file, choice);
    file.weights = mended_weights({file.path, model, file.buffers}, document);
    return file;
}

}  // namespace swivel::formats

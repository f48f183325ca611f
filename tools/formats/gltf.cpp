// SPDX-License-Identifier: MIT
// tinygltf reads a reduced document (skeleton_json()), so that neither images nor meshes get in the way and nothing is
// decoded that no pose needs. It does not write: it would drop or reorder what it does not know. The writer edits the
// text itself, so that untouched values stay as they are and buffers stay byte for byte.
#include "tools/formats/gltf.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <set>
#include <stdexcept>
#include <utility>

#include "tools/formats/error.h"
#include "tools/formats/gltf_frames.h"
#include "tools/formats/gltf_json.h"
#include "tools/formats/output_file.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector4d;

[[noreturn]] void refuse(const GltfFile& file, const std::string& cause) { throw InputError(file.path, cause); }

template <class Element>
const Element& element(const GltfFile& file, const std::vector<Element>& list, int index, const char* name)
{
    if (index < 0 || static_cast<std::size_t>(index) >= list.size())
        refuse(file, fmt::format("{} {} does not exist; there are {}", name, index, list.size()));
    return list[static_cast<std::size_t>(index)];
}

bool all_finite(const std::vector<double>& values)
{
    return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

// ---- the text and the buffers

tinygltf::Model load(GltfFile& file)
{
    GltfContainer part = file.container;
    part.json = skeleton_json(file.path, file.container.json);
    part.other_chunks.clear();
    const std::string glb = part.is_binary ? glb_of(part) : std::string();
    const std::string folder = file.path.parent_path().string();
    tinygltf::TinyGLTF loader;
    tinygltf::Model model;
    std::string error, warning;
    bool is_read = false;
    try {
        is_read = part.is_binary ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                               reinterpret_cast<const unsigned char*>(glb.data()),
                                                               static_cast<unsigned>(glb.size()), folder)
                                 : loader.LoadASCIIFromString(&model, &error, &warning, part.json.data(),
                                                              static_cast<unsigned>(part.json.size()), folder);
    } catch (const std::exception& thrown) {
        error = thrown.what();
    }
    if (!is_read) {
        std::replace(error.begin(), error.end(), '\n', ' ');
        refuse(file, fmt::format("is not sound glTF: {}", printable(trimmed(error), 200)));
    }
    for (const tinygltf::Buffer& buffer : model.buffers)
        file.buffers.emplace_back(buffer.data.begin(), buffer.data.end());
    return model;
}

// ---- accessors

double component(const char* at, int type, bool is_normalized)
{
    const auto read = [&](auto zero, double full) {
        std::memcpy(&zero, at, sizeof zero);
        const auto value = static_cast<double>(zero);
        return is_normalized ? std::max(value / full, -1.0) : value;
    };
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return read(std::int8_t{}, 127);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return read(std::uint8_t{}, 255);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return read(std::int16_t{}, 32767);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return read(std::uint16_t{}, 65535);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return read(std::uint32_t{}, 1);
        default:  // float: read_view() lets no other pass
            return read(float{}, 1);
    }
}

// `count` elements of `width` components in a buffer view, checked to lie in it.
std::vector<double> read_view(const GltfFile& file, const tinygltf::Model& model, int view_index, std::size_t offset,
                              std::size_t count, std::size_t width, int type, bool is_normalized)
{
    const tinygltf::BufferView& view = element(file, model.bufferViews, view_index, "buffer view");
    const auto& bytes = element(file, model.buffers, view.buffer, "buffer").data;
    const auto size =
        static_cast<std::size_t>(std::max(tinygltf::GetComponentSizeInBytes(static_cast<unsigned>(type)), 0));
    const bool is_legal = (type >= TINYGLTF_COMPONENT_TYPE_BYTE && type <= TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) ||
                          type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT || type == TINYGLTF_COMPONENT_TYPE_FLOAT;
    if (!is_legal)
        refuse(file,
               fmt::format("component type {} of an accessor in buffer view {} does not exist", type, view_index));
    const std::size_t stride = view.byteStride > 0 ? view.byteStride : size * width;
    const bool fits = view.byteOffset <= bytes.size() && view.byteLength <= bytes.size() - view.byteOffset &&
                      offset <= view.byteLength && count <= bytes.size() &&
                      (count == 0 || (count - 1) * stride + size * width <= view.byteLength - offset);
    if (!fits)
        refuse(file,
               fmt::format("an accessor reads beyond the end of buffer view {}; the file is cut short", view_index));
    std::vector<double> values;
    values.reserve(count * width);
    for (std::size_t n = 0; n < count * width; ++n)
        values.push_back(component(reinterpret_cast<const char*>(bytes.data()) + view.byteOffset + offset +
                                       n / width * stride + n % width * size,
                                   type, is_normalized));
    return values;
}

// expected: how many elements there must be, so that no file makes more room than its keys need; 0: any number, but
// then they must be bytes of the file.
std::vector<double> read_accessor(const GltfFile& file, const tinygltf::Model& model, int index, int type,
                                  std::size_t expected)
{
    const tinygltf::Accessor& at = element(file, model.accessors, index, "accessor");
    if (at.type != type) refuse(file, fmt::format("accessor {} of an animation has the wrong type", index));
    const auto width = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<unsigned>(type)));
    if (expected > 0 && at.count != expected)
        refuse(file, fmt::format("accessor {} and its times have different numbers of keys: {} elements, {} are needed",
                                 index, at.count, expected));
    if (expected == 0 && at.bufferView < 0)
        refuse(file, fmt::format("accessor {} of an animation's times has no buffer view", index));
    if (at.count == 0 || at.count > std::size_t{1} << 28)
        refuse(file, fmt::format("accessor {} of an animation has {} keys", index, at.count));
    std::vector<double> values(at.bufferView < 0 ? at.count * width : 0);
    if (at.bufferView >= 0)
        values = read_view(file, model, at.bufferView, at.byteOffset, at.count, width, at.componentType, at.normalized);
    if (at.sparse.isSparse) {
        const auto count = static_cast<std::size_t>(std::max(at.sparse.count, 0));
        const auto offset = [](int bytes) { return static_cast<std::size_t>(std::max(bytes, 0)); };
        const auto places = read_view(file, model, at.sparse.indices.bufferView, offset(at.sparse.indices.byteOffset),
                                      count, 1, at.sparse.indices.componentType, false);
        const auto patches = read_view(file, model, at.sparse.values.bufferView, offset(at.sparse.values.byteOffset),
                                       count, width, at.componentType, at.normalized);
        for (std::size_t n = 0; n < count; ++n) {
            if (!(places[n] >= 0 && places[n] < static_cast<double>(at.count)))
                refuse(file, fmt::format("a sparse index of accessor {} is out of its range", index));
            std::copy_n(patches.begin() + static_cast<std::ptrdiff_t>(n * width), width,
                        values.begin() + static_cast<std::ptrdiff_t>(places[n]) * static_cast<std::ptrdiff_t>(width));
        }
    }
    if (!all_finite(values)) refuse(file, fmt::format("accessor {} holds a number that is not finite", index));
    return values;
}

// ---- the skeleton

// A node's matrix taken apart.
void take_apart(const GltfFile& file, const std::vector<double>& matrix, Joint& joint)
{
    if (matrix.size() != 16 || !all_finite(matrix)) refuse(file, fmt::format("node {} has a bad matrix", joint.number));
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
    const auto check = [&](const std::vector<double>& values, std::size_t size, const char* name) {
        if (!values.empty() && (values.size() != size || !all_finite(values)))
            refuse(file, fmt::format("node {} has a bad {}", joint.number, name));
        return !values.empty();
    };
    if (!node.matrix.empty()) return take_apart(file, node.matrix, joint);
    if (check(node.translation, 3, "translation")) joint.offset = Vector3d(node.translation.data());
    if (check(node.scale, 3, "scale")) joint.rest_scale = Vector3d(node.scale.data());
    if (check(node.rotation, 4, "rotation")) {
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
            element(file, model.nodes, child, "node");
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
            element(file, model.nodes, node, "node");
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

GltfSampler read_sampler(const GltfFile& file, const tinygltf::Model& model, const tinygltf::AnimationSampler& from,
                         GltfPath path)
{
    GltfSampler sampler;
    if (from.interpolation == "STEP")
        sampler.interpolation = Interpolation::step;
    else if (from.interpolation == "CUBICSPLINE")
        sampler.interpolation = Interpolation::cubic;
    else if (!from.interpolation.empty() && from.interpolation != "LINEAR")
        refuse(file, fmt::format("interpolation '{}' is unknown", printable(from.interpolation)));
    sampler.time = read_accessor(file, model, from.input, TINYGLTF_TYPE_SCALAR, 0);
    for (std::size_t n = 1; n < sampler.time.size(); ++n)
        if (!(sampler.time[n] > sampler.time[n - 1]))
            refuse(file, fmt::format("times in accessor {} do not grow", from.input));
    const bool is_rotation = path == GltfPath::rotation;
    const std::size_t width = is_rotation ? 4 : 3;
    const std::size_t each = sampler.interpolation == Interpolation::cubic ? 3 : 1;
    const auto values = read_accessor(file, model, from.output, is_rotation ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3,
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

void read_channels(GltfFile& file, const tinygltf::Model& model, const std::vector<int>& joint_of)
{
    const tinygltf::Animation& animation = model.animations[static_cast<std::size_t>(file.animation)];
    std::set<std::pair<int, GltfPath>> seen;
    for (const tinygltf::AnimationChannel& from : animation.channels) {
        const auto is = [&](const char* path) { return from.target_path == path; };
        if (from.target_node < 0 || !(is("translation") || is("rotation") || is("scale"))) continue;
        element(file, model.nodes, from.target_node, "node");
        GltfChannel channel;
        channel.joint = joint_of[static_cast<std::size_t>(from.target_node)];
        channel.path = is("rotation") ? GltfPath::rotation : is("scale") ? GltfPath::scale : GltfPath::translation;
        if (!seen.emplace(channel.joint, channel.path).second)
            refuse(file, fmt::format("two channels of animation {} are for the {} of node {}; glTF allows one",
                                     file.animation, from.target_path, from.target_node));
        channel.sampler =
            read_sampler(file, model, element(file, animation.samplers, from.sampler, "sampler"), channel.path);
        file.channels.push_back(std::move(channel));
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
    const tinygltf::Model model = load(file);
    const std::vector<int> joint_of = read_nodes(file, model);
    if (file.clip.joints.empty()) refuse(file, "it has no nodes, so no skeleton");
    for (const tinygltf::Animation& animation : model.animations) file.animation_names.push_back(animation.name);
    file.animation = choose_animation(file, choice.animation);
    if (file.animation >= 0) read_channels(file, model, joint_of);
    sample_frames(file, choice.rate);
    return file;
}

}  // namespace swivel::formats

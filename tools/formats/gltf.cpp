// SPDX-License-Identifier: MIT
// The writer edits the text itself (see gltf_edit.h). So untouched values stay as they are, and buffers stay byte for
// byte. The document lives while the file is read, and again while it is written: it is many times as large as the
// text.
#include "tools/formats/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "tools/formats/error.h"
#include "tools/formats/gltf_accessor.h"
#include "tools/formats/gltf_buffers.h"
#include "tools/formats/gltf_json.h"
#include "tools/formats/gltf_nodes.h"
#include "tools/formats/gltf_uri.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

using Json = nlohmann::json;
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
                                               printable(all, kMostQuoted)));
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
    explicit Samplers(std::size_t most_bytes) : most_bytes_(most_bytes) {}

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
void refuse_pointer_to_node(const GltfFile& file, const Json& channel)
{
    const Json::json_pointer where("/target/extensions/KHR_animation_pointer/pointer");
    if (!channel.contains(where) || !channel.at(where).is_string()) return;
    const std::string to = channel.at(where).get<std::string>();
    for (const char* path : {"/translation", "/rotation", "/scale"})
        if (to.starts_with("/nodes/") && to.ends_with(path))
            refuse(file, fmt::format("animation {} moves {} by KHR_animation_pointer, which is not read; export "
                                     "the motion of nodes as plain channels",
                                     file.animation, printable(to, 80)));
}

void read_channels(GltfFile& file, const Json& document, const std::vector<int>& joint_of)
{
    const Json& animation = list_in(document, "animations")[static_cast<std::size_t>(file.animation)];
    std::set<std::pair<int, GltfPath>> seen;
    Samplers samplers(file.choice.most_pose_bytes);
    for (const Json& from : list_in(animation, "channels")) {
        refuse_pointer_to_node(file, from);
        const Json& target = from.at("target");
        const std::string path = target.at("path");
        if (!target.contains("node") || !(path == "translation" || path == "rotation" || path == "scale")) continue;
        GltfChannel channel;
        channel.joint = element(file.path, joint_of, target.at("node"), "a channel's node");
        channel.path = path == "rotation" ? GltfPath::rotation
                       : path == "scale"  ? GltfPath::scale
                                          : GltfPath::translation;
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

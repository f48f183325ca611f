// SPDX-License-Identifier: MIT
#include "tools/formats/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tools/formats/error.h"
#include "tools/formats/gltf_edit.h"
#include "tools/formats/gltf_json.h"
#include "tools/formats/output_file.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

using Eigen::Quaterniond;

// Keys of one node. Each rotation is in the hemisphere of the one before, and the first in that of the rest pose, so
// that readers that do not look for the shorter arc take it, too.
GltfChanges::Track track_of(int node, const UnkeyedPose& rest, const JointKeys& keys)
{
    GltfChanges::Track track{node, {}, {}, false, rest};
    Quaterniond before = rest.rotation;
    for (const Quaterniond& rotation : keys.rotation) {
        Quaterniond key = rotation.normalized();
        if (key.dot(before) < 0) key.coeffs() = -key.coeffs();
        for (const double part : key.coeffs()) track.xyzw.push_back(static_cast<float>(part));
        before = key;
    }
    for (const Eigen::Vector3d& place : keys.translation)
        for (const double part : place) track.xyz.push_back(static_cast<float>(part));
    return track;
}

std::vector<float> even_times(const NewFrames& frames)
{
    std::vector<float> times;
    for (std::size_t n = 0; n < frames.count; ++n)
        times.push_back(static_cast<float>(static_cast<double>(n) * frames.frame_time));
    return times;
}

// Joints with new keys whose own rotations move, and whether they move by steps.
std::map<int, bool> steps_of(const GltfFile& file, std::span<const JointKeys> keys)
{
    std::map<int, bool> steps;
    for (const GltfChannel& channel : file.channels) {
        const GltfSampler& sampler = file.samplers[channel.sampler];
        const bool has_keys = std::ranges::find(keys, channel.joint, &JointKeys::joint) != keys.end();
        if (has_keys && channel.path == GltfPath::rotation && is_moving(sampler))
            steps[channel.joint] = sampler.interpolation == Interpolation::step;
    }
    return steps;
}

std::vector<GltfChanges::Track> tracks_of(const GltfFile& file, std::span<const JointKeys> keys)
{
    std::vector<GltfChanges::Track> tracks;
    for (const JointKeys& each : keys) {
        require_can_key(file, each.joint);
        const Joint& joint = joint_at(file.clip, each.joint);
        tracks.push_back(track_of(joint.number, pose_without_keys(joint), each));
    }
    return tracks;
}

// The new joint's node. Skins bind it where it is at rest.
GltfChanges::NewNode node_of(const GltfFile& file, const NewJoint& joint)
{
    Eigen::Affine3d parent_w = Eigen::Affine3d::Identity();
    for (int above = joint_at(file.clip, joint.below).parent; above >= 0; above = joint_at(file.clip, above).parent) {
        const UnkeyedPose rest = pose_without_keys(joint_at(file.clip, above));
        parent_w = Eigen::Translation3d(rest.offset) * rest.rotation * Eigen::Scaling(rest.scale) * parent_w;
    }
    return {joint.name, static_cast<std::size_t>(joint_at(file.clip, joint.below).number), parent_w.inverse().matrix()};
}

std::string glb_named(const std::filesystem::path& path, const GltfContainer& container)
{
    try {
        return glb_of(container);
    } catch (const std::length_error& error) {
        throw InputError(is_standard_stream(path) ? "standard output" : path, error.what());
    }
}

void write_changes(const std::filesystem::path& path, const GltfFile& file, const GltfChanges& changes,
                   std::optional<bool> binary)
{
    const bool is_glb = binary.value_or(lower_suffix(path) != ".gltf");
    OutputFile out(path);
    const GltfContainer written = with_changes(file.container, file.buffers, changes, file.path, path, is_glb);
    out.write(is_glb ? glb_named(path, written) : written.json);
    out.commit();
}

}  // namespace

void require_can_key(const GltfFile& file, int joint)
{
    const Joint& at = joint_at(file.clip, joint);
    if (at.is_sheared)
        throw InputError(file.path, fmt::format("the matrix of node {} is sheared, so it cannot have keys; remove the "
                                                "shear where the rig was made",
                                                at.number));
}

void write_gltf(const std::filesystem::path& path, const GltfFile& file, std::span<const JointKeys> keys,
                const std::optional<NewFrames>& frames, std::optional<bool> binary,
                const std::optional<NewJoint>& above)
{
    GltfChanges changes{file.times, {}, file.animation, {}, {}};
    if (frames) {
        changes.times = even_times(*frames);
        changes.name = frames->name;
    }
    require_keys(file.clip, keys, changes.times.size());
    changes.tracks = tracks_of(file, keys);
    const std::map<int, bool> steps = frames ? std::map<int, bool>() : steps_of(file, keys);
    const bool all_step = !steps.empty() && std::ranges::all_of(steps, [](const auto& each) { return each.second; });
    for (std::size_t n = 0; n < keys.size(); ++n) {  // a joint that did not move goes as all others do
        const auto own = steps.find(keys[n].joint);
        changes.tracks[n].is_stepped = own == steps.end() ? all_step : own->second;
    }
    if (above) {
        const auto below = std::ranges::find(keys, above->below, &JointKeys::joint) - keys.begin();
        const UnkeyedPose rest{Eigen::Vector3d::Zero(), Quaterniond::Identity(), Eigen::Vector3d::Ones()};
        changes.node = node_of(file, *above);
        changes.tracks.push_back(track_of(static_cast<int>(file.clip.joints.size()), rest,
                                          {above->below, above->rotation, above->translation}));
        changes.tracks.back().is_stepped = changes.tracks[static_cast<std::size_t>(below)].is_stepped;
    }
    write_changes(path, file, changes, binary);
}

std::string figure_glb(const GltfFile& file)
{
    if (!gltf_document(file.path, file.container.json).contains("meshes")) return {};
    GltfChanges changes;
    changes.drops_animations = true;
    return glb_named(file.path, with_changes(file.container, file.buffers, changes, file.path, file.path, true));
}

void write_gltf_crowd(const std::filesystem::path& path, const GltfFile& file,
                      std::span<const GltfCharacter> characters, const NewFrames& frames)
{
    GltfChanges changes{even_times(frames), {}, file.animation, frames.name, {}};
    for (const GltfCharacter& each : characters) {
        require_keys(file.clip, each.keys, frames.count);
        changes.figures.push_back({each.name, each.place, each.size, each.rotation, tracks_of(file, each.keys)});
    }
    write_changes(path, file, changes, {});
}

}  // namespace swivel::formats

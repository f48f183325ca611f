// SPDX-License-Identifier: MIT
#include "tools/formats/gltf.h"

#include <fmt/format.h>

#include <set>
#include <stdexcept>

#include "tools/formats/error.h"
#include "tools/formats/gltf_edit.h"
#include "tools/formats/output_file.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

using Eigen::Quaterniond;

const Joint& joint_at(const GltfFile& file, int joint) { return file.clip.joints[static_cast<std::size_t>(joint)]; }

// Keys of one joint, each on the side of the one before: a reader that does not look for the shorter arc gets it too.
GltfChanges::Track track_of(const GltfFile& file, const JointKeys& keys)
{
    const Joint& joint = joint_at(file, keys.joint);
    GltfChanges::Track track{joint.number, {}, {}, false, joint.offset, joint.rest_scale, joint.rest_rotation};
    Quaterniond before = joint.rest_rotation;
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

// Which of the joints move by keys of rotation, and which of those by steps.
struct Movers {
    std::set<int> all, by_steps;
};

Movers movers_of(const GltfFile& file, const std::set<int>& joints)
{
    Movers movers;
    for (const GltfChannel& channel : file.channels) {
        const GltfSampler& sampler = file.samplers[channel.sampler];
        if (channel.path != GltfPath::rotation || !joints.contains(channel.joint) || !is_moving(sampler)) continue;
        movers.all.insert(channel.joint);
        if (sampler.interpolation == Interpolation::step) movers.by_steps.insert(channel.joint);
    }
    return movers;
}

}  // namespace

void require_can_key(const GltfFile& file, int joint)
{
    const Joint& at = joint_at(file, joint);
    if (at.is_sheared)
        throw InputError(file.path, fmt::format("the matrix of node {} is sheared, so it cannot have keys; remove the "
                                                "shear where the rig was made",
                                                at.number));
}

void write_gltf(const std::filesystem::path& path, const GltfFile& file, std::span<const JointKeys> keys,
                const std::optional<NewFrames>& frames, std::optional<bool> binary)
{
    GltfChanges changes{file.times, {}, file.animation, {}};
    if (frames) {
        changes.times = even_times(*frames);
        changes.name = frames->name;
    }
    require_keys(file.clip, keys, changes.times.size());
    std::set<int> joints;
    for (const JointKeys& each : keys) {
        require_can_key(file, each.joint);
        joints.insert(each.joint);
        changes.tracks.push_back(track_of(file, each));
    }
    const Movers movers = frames ? Movers{} : movers_of(file, joints);
    for (std::size_t n = 0; n < keys.size(); ++n)  // one that had no keys that move goes as all others do
        changes.tracks[n].is_stepped = movers.all.contains(keys[n].joint)
                                           ? movers.by_steps.contains(keys[n].joint)
                                           : !movers.all.empty() && movers.by_steps == movers.all;
    const bool is_glb = binary.value_or(lower_suffix(path) != ".gltf");
    OutputFile out(path);
    const GltfContainer written = with_changes(file.container, file.buffers, changes, file.path, path, is_glb);
    try {
        if (is_glb)
            out.write(glb_of(written));
        else
            out.write(written.json);
    } catch (const std::length_error& error) {
        throw InputError(is_standard_stream(path) ? "standard output" : path, error.what());
    }
    out.commit();
}

}  // namespace swivel::formats

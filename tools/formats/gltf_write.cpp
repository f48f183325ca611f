// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "tools/formats/error.h"
#include "tools/formats/gltf.h"
#include "tools/formats/gltf_json.h"
#include "tools/formats/output_file.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

using Eigen::Quaterniond;

void check_override(const GltfFile& file, const RotationOverride& change, std::set<int>& seen)
{
    if (change.joint < 0 || static_cast<std::size_t>(change.joint) >= file.clip.joints.size())
        throw std::invalid_argument("write_gltf: no such joint");
    if (!seen.insert(change.joint).second) throw std::invalid_argument("write_gltf: two overrides for one joint");
    if (change.rotation.size() != file.clip.frame_count)
        throw std::invalid_argument("write_gltf: an override needs one rotation per frame");
    for (const Quaterniond& rotation : change.rotation)
        if (!(rotation.norm() > 0) || !std::isfinite(rotation.norm()))
            throw std::invalid_argument("write_gltf: a rotation is zero or not finite");
}

// Keys of one joint, each on the side of the one before: a reader that does not look for the shorter arc gets it too.
GltfKeys::Track track_of(const GltfFile& file, const RotationOverride& change)
{
    const Joint& joint = file.clip.joints[static_cast<std::size_t>(change.joint)];
    GltfKeys::Track track{joint.number, {}, joint.offset, joint.rest_scale, joint.rest_rotation};
    Quaterniond before = joint.rest_rotation;
    for (const Quaterniond& rotation : change.rotation) {
        Quaterniond key = rotation.normalized();
        if (key.dot(before) < 0) key.coeffs() = -key.coeffs();
        for (const double part : key.coeffs()) track.xyzw.push_back(static_cast<float>(part));
        before = key;
    }
    return track;
}

// Whether the overridden joints moved, and only by steps.
bool moved_by_steps(const GltfFile& file, const std::set<int>& joints)
{
    bool steps = false;
    for (const GltfChannel& channel : file.channels) {
        if (channel.path != GltfPath::rotation || !joints.contains(channel.joint) || !is_moving(channel.sampler))
            continue;
        if (channel.sampler.interpolation != Interpolation::step) return false;
        steps = true;
    }
    return steps;
}

}  // namespace

void write_gltf(const std::filesystem::path& path, const GltfFile& file, std::span<const RotationOverride> overrides)
{
    GltfKeys keys;
    std::set<int> joints;
    for (const RotationOverride& change : overrides) {
        check_override(file, change, joints);
        const Joint& joint = file.clip.joints[static_cast<std::size_t>(change.joint)];
        if (joint.is_sheared)
            throw InputError(file.path, fmt::format("the matrix of node {} is sheared, so it cannot have keys; remove "
                                                    "the shear where the rig was made",
                                                    joint.number));
        keys.tracks.push_back(track_of(file, change));
    }
    keys.times = file.times;
    keys.animation = file.animation;
    keys.is_stepped = moved_by_steps(file, joints);
    const bool binary = lower_suffix(path) != ".gltf";
    OutputFile out(path);
    const GltfContainer written = with_keys(file.container, file.buffers, keys, file.path, path, binary);
    try {
        out.write(binary ? glb_of(written) : written.json);
    } catch (const std::length_error& error) {
        throw InputError(path, error.what());
    }
    out.commit();
}

}  // namespace swivel::formats

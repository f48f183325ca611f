// SPDX-License-Identifier: MIT
#include "tests/fuzz/gltf_of_bytes.h"

#include <cmath>
#include <cstdint>

#include "tests/fuzz/check_clip.h"
#include "tools/formats/gltf.h"
#include "tools/formats/gltf_container.h"
#include "tools/formats/text.h"

namespace swivel::fuzz {

using namespace formats;
using Eigen::Quaterniond;

namespace {

// Tiny files must not take long. Of keys that are read again there are up to 60 times as many, by the rate of frames.
constexpr std::size_t kMostPoseBytes = 1 << 20;

// Frames are those of the last joint and of all above it, so that other joints have keys in between.
GltfFile read_sampled(const std::filesystem::path& path, const GltfChoice& choice)
{
    GltfFile file = read_gltf(path, choice);
    SWIVEL_REQUIRE(file.clip.frame_count == 0 && !file.clip.joints.empty());
    for (const auto& [name, joint] : file.clip.human_bones)
        SWIVEL_REQUIRE(joint >= 0 && static_cast<std::size_t>(joint) < file.clip.joints.size());
    const int last[] = {static_cast<int>(file.clip.joints.size()) - 1};
    sample(file, last);
    return file;
}

void check_channels(const GltfFile& file)
{
    for (const GltfChannel& channel : file.channels) {
        SWIVEL_REQUIRE(channel.joint >= 0 && static_cast<std::size_t>(channel.joint) < file.clip.joints.size());
        SWIVEL_REQUIRE(channel.sampler < file.samplers.size());
    }
    for (const GltfSampler& sampler : file.samplers) {
        const std::size_t each = sampler.interpolation == Interpolation::cubic ? 3 : 1;
        SWIVEL_REQUIRE(!sampler.time.empty() && sampler.value.size() == each * sampler.time.size());
        for (std::size_t n = 1; n < sampler.time.size(); ++n) SWIVEL_REQUIRE(sampler.time[n - 1] < sampler.time[n]);
        for (const Eigen::Vector4d& value : sampler.value) SWIVEL_REQUIRE(value.allFinite());
    }
}

void check_file(const GltfFile& file)
{
    check_clip(file.clip);
    SWIVEL_REQUIRE(file.times.size() == file.clip.frame_count);
    for (const float time : file.times) SWIVEL_REQUIRE(std::isfinite(time));
    for (std::size_t n = 1; n < file.times.size(); ++n) SWIVEL_REQUIRE(file.times[n - 1] < file.times[n]);
    SWIVEL_REQUIRE(file.animation >= -1 && file.animation < static_cast<int>(file.animation_names.size()));
    check_channels(file);
}

// The joint's rotation in `file` at a time, by its own keys.
Quaterniond rotation_at(const GltfFile& file, int joint, float time)
{
    for (const GltfChannel& channel : file.channels)
        if (channel.joint == joint && channel.path == GltfPath::rotation)
            return sample_rotation(file.samplers[channel.sampler], static_cast<double>(time));
    return file.clip.joints[static_cast<std::size_t>(joint)].rest_rotation;
}

// Nothing new written: all is as it was.
void check_copy(const GltfFile& file, const std::filesystem::path& to, const GltfChoice& choice)
{
    write_gltf(to, file, {});
    const GltfFile again = read_sampled(to, choice);
    SWIVEL_REQUIRE(again.times == file.times);
    SWIVEL_REQUIRE(again.clip.translation == file.clip.translation && again.clip.scale == file.clip.scale);
    SWIVEL_REQUIRE(again.clip.rotation.size() == file.clip.rotation.size());
    for (std::size_t n = 0; n < file.clip.rotation.size(); ++n)
        SWIVEL_REQUIRE(again.clip.rotation[n].coeffs() == file.clip.rotation[n].coeffs());
}

// Its own rotations as new ones: to the rounding of floats, they are what is read.
void check_new_keys(const GltfFile& file, const std::filesystem::path& to)
{
    std::vector<std::vector<Quaterniond>> rotations(file.clip.joints.size());
    std::vector<JointKeys> overrides;
    for (std::size_t n = 0; n < rotations.size(); ++n) {
        if (file.clip.joints[n].is_sheared) continue;
        rotations[n] = rotations_of(file.clip, n);
        overrides.push_back({static_cast<int>(n), rotations[n]});
    }
    write_gltf(to, file, overrides);
    if (overrides.empty()) return;
    const GltfFile again = read_sampled(to, {std::to_string(std::max(file.animation, 0)), 0, 64 * kMostPoseBytes});
    check_file(again);
    SWIVEL_REQUIRE(again.clip.joints.size() == file.clip.joints.size());
    for (const JointKeys& change : overrides)
        for (std::size_t frame = 0; frame < file.times.size(); ++frame)
            SWIVEL_REQUIRE(rotation_at(again, change.joint, file.times[frame]).angularDistance(change.rotation[frame]) <
                           1e-6);
}

// rate: of the frames.
void check_gltf(const std::filesystem::path& path, const std::filesystem::path& written, double rate)
{
    const GltfChoice choice{"", rate, kMostPoseBytes};
    const auto file = read_or_refuse([&] { return read_sampled(path, choice); });
    if (!file) return;
    check_file(*file);
    for (const char* name : {"out.gltf", "out.glb"}) {
        check_copy(*file, written / name, choice);
        check_new_keys(*file, written / name);
    }
}

// A container reads back as it was, its bytes padded.
void check_container(const std::filesystem::path& path, const GltfContainer& container)
{
    const GltfContainer again = read_gltf_container(path);
    const std::string json = container.json.substr(0, container.json.find_last_not_of(kBlanks) + 1);
    SWIVEL_REQUIRE(again.is_binary && again.json == json && again.other_chunks.empty());
    SWIVEL_REQUIRE(again.bytes.starts_with(container.bytes) && again.bytes.size() < container.bytes.size() + 4);
}

}  // namespace

void check_gltf_of(Bytes bytes, const ScratchFolder& folder)
{
    const std::string_view text = Bytes(bytes).rest();
    if (is_gltf_begin(text.substr(0, 4096))) return check_gltf(folder.spill("in.gltf", text), folder.path, 0);
    const double rate = bytes.take<std::uint8_t>();
    GltfContainer container;
    container.json = bytes.take_text(bytes.take<std::uint16_t>());
    container.bytes = bytes.rest();
    const std::filesystem::path path = folder.spill("in.glb", glb_of(container));
    check_container(path, container);
    check_gltf(path, folder.path, rate);
}

}  // namespace swivel::fuzz

// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/formats/error.h"

namespace swivel::formats {
namespace {

constexpr double kDefaultRate = 60, kRestFrameTime = 1.0 / 30;
constexpr double kPoseBytes = 8.0 * 1024 * 1024 * 1024;

// Every time at which some channel has a key, each once.
std::vector<double> key_times(const GltfFile& file)
{
    std::vector<double> times;
    for (const GltfChannel& channel : file.channels)
        times.insert(times.end(), channel.sampler.time.begin(), channel.sampler.time.end());
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

// The number of equal steps from the first time to the last that meet every time, to 2% of a step; 0: there is none.
// Times are floats, which late in a long clip are that coarse. A step is at least a microsecond.
double steps_of_grid(const std::vector<double>& times)
{
    const double begin = times.front(), length = times.back() - begin;
    double smallest = length;
    for (std::size_t n = 1; n < times.size(); ++n) {
        const double gap = times[n] - times[n - 1];
        if (gap > 1e-6) smallest = std::min(smallest, gap);
    }
    const double steps = std::round(length / smallest);
    for (const double time : times) {
        const double place = (time - begin) / length * steps;
        if (std::abs(place - std::round(place)) > 0.02) return 0;
    }
    return steps;
}

// Frame times as floats, as they will be written; on a grid the keys' own.
std::vector<float> frame_times(const GltfFile& file, double rate)
{
    const std::vector<double> keys = key_times(file);
    if (keys.empty()) return {0};
    const double begin = keys.front(), length = keys.back() - begin;
    if (length == 0) return {static_cast<float>(begin)};
    const double grid = rate > 0 ? 0 : steps_of_grid(keys);
    const double steps = grid > 0 ? grid : std::max(std::round(length * (rate > 0 ? rate : kDefaultRate)), 1.0);
    if (!((steps + 1) * static_cast<double>(file.clip.joints.size()) * sizeof(Eigen::Quaterniond) <= kPoseBytes))
        throw InputError(file.path, fmt::format("the animation has {:.0f} frames of {} joints, more than 8 GiB; cut it",
                                                steps + 1, file.clip.joints.size()));
    std::vector<float> times;
    for (double step = 0; step <= steps; ++step) {
        double time = begin + length * step / steps;
        const auto key = std::lower_bound(keys.begin(), keys.end(), time - 0.02 * length / steps);
        if (grid > 0 && key != keys.end() && *key <= time + 0.02 * length / steps) time = *key;
        const auto rounded = static_cast<float>(time);
        if (times.empty() || rounded > times.back()) times.push_back(rounded);
    }
    return times;
}

// Rest poses in every frame, and a column for each joint whose translation or scale has keys.
void lay_out(GltfFile& file)
{
    Clip& clip = file.clip;
    const std::size_t joint_count = clip.joints.size();
    clip.track_count = clip.scale_track_count = 0;
    for (const GltfChannel& channel : file.channels) {
        Joint& joint = clip.joints[static_cast<std::size_t>(channel.joint)];
        if (channel.path == GltfPath::translation && joint.track < 0)
            joint.track = static_cast<int>(clip.track_count++);
        if (channel.path == GltfPath::scale && joint.scale_track < 0)
            joint.scale_track = static_cast<int>(clip.scale_track_count++);
    }
    clip.rotation.resize(clip.frame_count * joint_count);
    clip.translation.resize(clip.frame_count * clip.track_count);
    clip.scale.resize(clip.frame_count * clip.scale_track_count);
    for (std::size_t n = 0; n < clip.rotation.size(); ++n)
        clip.rotation[n] = clip.joints[n % joint_count].rest_rotation;
}

void fill(GltfFile& file, const GltfChannel& channel)
{
    Clip& clip = file.clip;
    const auto at = static_cast<std::size_t>(channel.joint);
    const Joint& joint = clip.joints[at];
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const double time = static_cast<double>(file.times[frame]);
        if (channel.path == GltfPath::rotation) {
            const Eigen::Quaterniond rotation = sample_rotation(channel.sampler, time);
            if (!(std::abs(rotation.norm() - 1) < 1e-6))
                throw InputError(file.path, fmt::format("the rotation of node {} passes through zero at {:.4g} s",
                                                        joint.number, time));
            clip.rotation[frame * clip.joints.size() + at] = rotation;
        } else if (channel.path == GltfPath::translation) {
            clip.translation[frame * clip.track_count + static_cast<std::size_t>(joint.track)] =
                sample_vector(channel.sampler, time);
        } else {
            clip.scale[frame * clip.scale_track_count + static_cast<std::size_t>(joint.scale_track)] =
                sample_vector(channel.sampler, time);
        }
    }
}

}  // namespace

void sample_frames(GltfFile& file, double rate)
{
    file.times = frame_times(file, rate);
    Clip& clip = file.clip;
    clip.frame_count = file.times.size();
    clip.frame_time = clip.frame_count > 1 ? static_cast<double>(file.times.back() - file.times.front()) /
                                                 static_cast<double>(clip.frame_count - 1)
                                           : kRestFrameTime;
    lay_out(file);
    for (const GltfChannel& channel : file.channels) fill(file, channel);
}

}  // namespace swivel::formats

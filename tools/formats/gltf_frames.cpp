// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/formats/error.h"

namespace swivel::formats {
namespace {

constexpr double kDefaultRate = 60, kRestFrameTime = 1.0 / 30;
// Keys this far apart are frames: films and exporters have 24 a second, and curves are lost between.
constexpr double kWidestStep = 1.0 / 24, kWidestCurveStep = 1.0 / 60;
constexpr double kFinestStep = 1.0 / 1000;  // what lies closer is no rate, but keys apart by chance
constexpr double kSlack = 0.02;             // of a step: times are floats, which late in a long clip are that coarse

// Every time at which some channel has a key, each once.
std::vector<double> key_times(const GltfFile& file)
{
    std::vector<double> times;
    for (const GltfSampler& sampler : file.samplers)
        times.insert(times.end(), sampler.time.begin(), sampler.time.end());
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

// Times up to this far apart are one to a grid: a jump is two keys a float's last digit apart, and what exporters
// reckon is off by some.
double jump_width(const std::vector<double>& times)
{
    const auto latest = static_cast<float>(std::max(std::abs(times.front()), std::abs(times.back())));
    return std::max(1e-6, 4 * static_cast<double>(std::nextafter(latest, HUGE_VALF) - latest));
}

// The number of equal steps from the first time to the last that meet every time; 0: there is none, or steps are
// smaller than kFinestStep.
double steps_of_grid(const std::vector<double>& times)
{
    const double begin = times.front(), length = times.back() - begin, jump = jump_width(times);
    double smallest = length;
    for (std::size_t n = 1; n < times.size(); ++n) {
        const double gap = times[n] - times[n - 1];
        if (gap > jump) smallest = std::min(smallest, gap);
    }
    if (smallest < (1 - kSlack) * kFinestStep) return 0;
    const double steps = std::round(length / smallest);
    for (const double time : times) {
        const double place = (time - begin) / length * steps;
        if (std::abs(place - std::round(place)) > kSlack) return 0;
    }
    return steps;
}

// How far apart frames may be for what is between keys to be seen. By steps nothing is; what moves evenly asks for
// frames because a limb that follows it to a target does not turn evenly.
double widest_step(const GltfFile& file)
{
    double step = std::numeric_limits<double>::infinity();
    for (const GltfSampler& sampler : file.samplers) {
        if (sampler.interpolation == Interpolation::step || !is_moving(sampler)) continue;
        step = std::min(step, sampler.interpolation == Interpolation::cubic ? kWidestCurveStep : kWidestStep);
    }
    return (1 + kSlack) * step;
}

// Frames: places in time, with so many equal parts between each two.
struct Division {
    double steps, parts;
    bool is_grid;  // the places are the keys' grid; else the first key and the last
};

Division divide(const GltfFile& file, const std::vector<double>& keys, double rate)
{
    const double length = keys.back() - keys.front();
    const double grid = rate > 0 ? 0 : steps_of_grid(keys);
    if (grid == 0) return {1, std::max(std::round(length * (rate > 0 ? rate : kDefaultRate)), 1.0), false};
    const double step = length / grid;
    return {grid, step <= widest_step(file) ? 1 : std::ceil(step * kDefaultRate - kSlack), true};
}

std::size_t frame_bytes(const Clip& clip)
{
    return clip.joints.size() * sizeof(Eigen::Quaterniond) +
           (clip.track_count + clip.scale_track_count) * sizeof(Eigen::Vector3d);
}

// Frame times as floats, as they will be written; keys on a grid are met as they are.
std::vector<float> frame_times(const GltfFile& file, const GltfChoice& choice)
{
    const std::vector<double> keys = key_times(file);
    if (keys.empty()) return {0};
    const double begin = keys.front(), length = keys.back() - begin;
    if (length == 0) return {static_cast<float>(begin)};
    const Division division = divide(file, keys, choice.rate);
    const double frames = division.steps * division.parts + 1;
    if (!(frames * static_cast<double>(frame_bytes(file.clip)) <= static_cast<double>(choice.most_pose_bytes)))
        throw InputError(file.path,
                         fmt::format("the animation has {:.0f} frames of {} joints, more than {:g} GiB; cut it", frames,
                                     file.clip.joints.size(), gibibytes(choice.most_pose_bytes)));
    const auto place = [&](double step) {
        const double time = begin + length * step / division.steps, slack = kSlack * length / division.steps;
        const auto key = std::lower_bound(keys.begin(), keys.end(), time - slack);
        return division.is_grid && key != keys.end() && *key <= time + slack ? *key : time;
    };
    std::vector<float> times = {static_cast<float>(begin)};
    for (double step = 0; step < division.steps; ++step) {
        const double from = place(step), to = place(step + 1);
        for (double part = 1; part <= division.parts; ++part) {
            const auto time =
                static_cast<float>(part < division.parts ? from + (to - from) * part / division.parts : to);
            if (time > times.back()) times.push_back(time);
        }
    }
    return times;
}

// A column for each joint whose translation or scale has keys.
void count_tracks(GltfFile& file)
{
    Clip& clip = file.clip;
    for (const GltfChannel& channel : file.channels) {
        Joint& joint = clip.joints[static_cast<std::size_t>(channel.joint)];
        if (channel.path == GltfPath::translation) joint.track = static_cast<int>(clip.track_count++);
        if (channel.path == GltfPath::scale) joint.scale_track = static_cast<int>(clip.scale_track_count++);
    }
}

// Room for all, and rest poses in every frame.
void lay_out(Clip& clip)
{
    clip.rotation.resize(clip.frame_count * clip.joints.size());
    clip.translation.resize(clip.frame_count * clip.track_count);
    clip.scale.resize(clip.frame_count * clip.scale_track_count);
    for (std::size_t n = 0; n < clip.rotation.size(); ++n)
        clip.rotation[n] = clip.joints[n % clip.joints.size()].rest_rotation;
}

void fill(GltfFile& file, const GltfChannel& channel)
{
    Clip& clip = file.clip;
    const auto at = static_cast<std::size_t>(channel.joint);
    const Joint& joint = clip.joints[at];
    const GltfSampler& sampler = file.samplers[channel.sampler];
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const double time = static_cast<double>(file.times[frame]);
        if (channel.path == GltfPath::rotation) {
            const Eigen::Quaterniond rotation = sample_rotation(sampler, time);
            if (!(std::abs(rotation.norm() - 1) < 1e-6))
                throw InputError(file.path, fmt::format("the rotation of node {} passes through zero at {:.4g} s",
                                                        joint.number, time));
            clip.rotation[frame * clip.joints.size() + at] = rotation;
        } else if (channel.path == GltfPath::translation) {
            clip.translation[frame * clip.track_count + static_cast<std::size_t>(joint.track)] =
                sample_vector(sampler, time);
        } else {
            clip.scale[frame * clip.scale_track_count + static_cast<std::size_t>(joint.scale_track)] =
                sample_vector(sampler, time);
        }
    }
}

}  // namespace

void sample_frames(GltfFile& file, const GltfChoice& choice)
{
    count_tracks(file);
    file.times = frame_times(file, choice);
    Clip& clip = file.clip;
    clip.frame_count = file.times.size();
    // In double: the difference of two floats may be more than a float holds.
    const double seconds = static_cast<double>(file.times.back()) - static_cast<double>(file.times.front());
    clip.frame_time = clip.frame_count > 1 ? seconds / static_cast<double>(clip.frame_count - 1) : kRestFrameTime;
    lay_out(clip);
    for (const GltfChannel& channel : file.channels) fill(file, channel);
}

}  // namespace swivel::formats

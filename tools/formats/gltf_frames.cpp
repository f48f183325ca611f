// SPDX-License-Identifier: MIT
// Frames of a glTF animation: the times they are at, and the skeleton's local poses there. Knows no JSON.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "tools/formats/error.h"
#include "tools/formats/gltf.h"
#include "tools/formats/limits.h"

namespace swivel::formats {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector4d;

// Two neighbouring keys and how far between them a time is, 0 to 1; twice the same key at and beyond the ends.
struct Span {
    std::size_t from, to;
    double share, seconds;
};

Span span_at(const GltfSampler& sampler, double time)
{
    const std::vector<double>& times = sampler.time;
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    if (after == times.begin()) return {0, 0, 0, 0};
    const auto from = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end()) return {from, from, 0, 0};
    const double seconds = times[from + 1] - times[from];
    return {from, from + 1, (time - times[from]) / seconds, seconds};
}

const Vector4d& key(const GltfSampler& sampler, std::size_t n)
{
    return sampler.value[sampler.interpolation == Interpolation::cubic ? 3 * n + 1 : n];
}

Vector4d spline(const GltfSampler& sampler, const Span& at)
{
    const double t = at.share, t2 = t * t, t3 = t2 * t;
    const Vector4d &out_tangent = sampler.value[3 * at.from + 2], &in_tangent = sampler.value[3 * at.to];
    return (2 * t3 - 3 * t2 + 1) * key(sampler, at.from) + at.seconds * (t3 - 2 * t2 + t) * out_tangent +
           (3 * t2 - 2 * t3) * key(sampler, at.to) + at.seconds * (t3 - t2) * in_tangent;
}

// The sampler's vector at a time: the first three components.
Eigen::Vector3d sample_vector(const GltfSampler& sampler, double time)
{
    const Span at = span_at(sampler, time);
    const Vector4d &from = key(sampler, at.from), &to = key(sampler, at.to);
    if (at.share == 0 || sampler.interpolation == Interpolation::step) return from.head<3>();
    if (sampler.interpolation == Interpolation::cubic) return spline(sampler, at).head<3>();
    return ((1 - at.share) * from + at.share * to).head<3>();
}

constexpr double kRestFrameTime = 1.0 / 30;
constexpr double kSlack = 0.01;  // of a step: times are floats, which late in a long clip are that coarse

// Marks the joints that move the limbs: their own and all above.
std::vector<bool> joints_to(const Clip& clip, std::span<const int> limb_joints)
{
    std::vector<bool> is_needed(clip.joints.size());
    for (int joint : limb_joints)
        for (; joint >= 0 && !is_needed[static_cast<std::size_t>(joint)]; joint = joint_at(clip, joint).parent)
            is_needed[static_cast<std::size_t>(joint)] = true;
    return is_needed;
}

void require_room(const GltfFile& file, double frames)
{
    const Clip& clip = file.clip;
    const std::size_t bytes = clip.joints.size() * sizeof(Eigen::Quaterniond) +
                              (clip.track_count + clip.scale_track_count) * sizeof(Eigen::Vector3d);
    if (frames * static_cast<double>(bytes) <= static_cast<double>(file.choice.max_pose_bytes)) return;
    throw InputError(file.path, fmt::format("the animation has {:.0f} frames of {} joints, more than {:g} GiB; cut it "
                                            "or give a lower --fps",
                                            frames, clip.joints.size(), gibibytes(file.choice.max_pose_bytes)));
}

// Every time at which one of these joints has a key, each once.
std::vector<float> key_times(const GltfFile& file, const std::vector<bool>& is_needed)
{
    std::set<std::size_t> samplers;
    for (const GltfChannel& channel : file.channels)
        if (is_needed[static_cast<std::size_t>(channel.joint)]) samplers.insert(channel.sampler);
    std::vector<float> times;
    for (const std::size_t sampler : samplers)
        for (const double time : file.samplers[sampler].time) times.push_back(static_cast<float>(time));
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

// Evenly from the animation's first key to its last.
std::vector<float> even_times(const GltfFile& file)
{
    if (file.samplers.empty()) return {};
    double begin = file.samplers[0].time.front(), end = file.samplers[0].time.back();
    for (const GltfSampler& sampler : file.samplers) {
        begin = std::min(begin, sampler.time.front());
        end = std::max(end, sampler.time.back());
    }
    const double steps = end > begin ? std::max(std::round((end - begin) * file.choice.rate), 1.0) : 0;
    require_room(file, steps + 1);
    std::vector<float> times = {static_cast<float>(begin)};
    for (double step = 1; step <= steps; ++step) {
        const auto time = static_cast<float>(begin + (end - begin) * step / steps);
        if (time > times.back()) times.push_back(time);  // floats may be too coarse for the rate
    }
    return times;
}

// The step between frames; 0 where they are uneven.
double frame_time_of(const std::vector<float>& times)
{
    if (times.size() < 2) return kRestFrameTime;
    // In double: the difference of two floats may be more than a float holds.
    const auto begin = static_cast<double>(times.front());
    const double step = (static_cast<double>(times.back()) - begin) / static_cast<double>(times.size() - 1);
    for (std::size_t n = 0; n < times.size(); ++n)
        if (std::abs(static_cast<double>(times[n]) - begin - step * static_cast<double>(n)) > kSlack * step) return 0;
    return step;
}

// A column for each joint whose translation or scale has keys.
void count_tracks(GltfFile& file)
{
    Clip& clip = file.clip;
    clip.track_count = clip.scale_track_count = 0;
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
                throw InputError(file.path, fmt::format("the rotation of node {} passes through zero at {:.4g} s; "
                                                        "export its keys as LINEAR",
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

void require_solvable(const GltfFile& file, const Joint& joint, const JointPose& pose_w, const std::string& when)
{
    const double place = pose_w.position.cwiseAbs().maxCoeff(), scale = pose_w.scale;
    if (!(place <= kMaxNorm))
        throw InputError(file.path, fmt::format("node {} is {:.3g} from the origin {}; swivel solves up to {:g}; "
                                                "make the figure smaller",
                                                joint.number, place, when, kMaxNorm));
    if (!(scale <= kMaxNorm) || (scale > 0 && scale < 1 / kMaxNorm))
        throw InputError(file.path, fmt::format("node {} is {:.3g} times its size {}; swivel solves {:g} to {:g}; "
                                                "correct its scale",
                                                joint.number, scale, when, 1 / kMaxNorm, kMaxNorm));
}

// The joints of limbs, and those above, in the world.
void require_solvable(const GltfFile& file, const std::vector<bool>& is_needed)
{
    const Clip& clip = file.clip;
    std::vector<JointPose> pose_w(clip.joints.size());
    const auto check = [&](const std::string& when, const auto& local) {
        for (std::size_t n = 0; n < pose_w.size(); ++n) {
            if (!is_needed[n]) continue;
            const int parent = clip.joints[n].parent;
            pose_w[n] = parent < 0 ? local(n) : pose_w[static_cast<std::size_t>(parent)] * local(n);
            require_solvable(file, clip.joints[n], pose_w[n], when);
        }
    };
    check("at rest", [&](std::size_t n) { return local_rest_pose(clip.joints[n]); });
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
        check(fmt::format("in frame {}", frame), [&](std::size_t n) { return local_pose(clip, frame, n); });
}

}  // namespace

Eigen::Quaterniond sample_rotation(const GltfSampler& sampler, double time)
{
    const Span at = span_at(sampler, time);
    const Quaterniond from = Quaterniond(key(sampler, at.from)).normalized();
    if (at.share == 0 || sampler.interpolation == Interpolation::step) return from;
    if (sampler.interpolation == Interpolation::cubic) return Quaterniond(spline(sampler, at)).normalized();
    return from.slerp(at.share, Quaterniond(key(sampler, at.to)).normalized()).normalized();
}

bool is_moving(const GltfSampler& sampler)
{
    const bool is_cubic = sampler.interpolation == Interpolation::cubic;
    for (std::size_t n = 1; n < sampler.time.size(); ++n) {
        if (key(sampler, n) != key(sampler, 0)) return true;
        if (is_cubic && !(sampler.value[3 * n - 1].isZero(0) && sampler.value[3 * n].isZero(0))) return true;
    }
    return false;
}

void sample(GltfFile& file, std::span<const int> limb_joints)
{
    const std::vector<bool> is_needed = joints_to(file.clip, limb_joints);
    count_tracks(file);
    file.times = file.choice.rate > 0 ? even_times(file) : key_times(file, is_needed);
    if (file.times.empty()) file.times = {0};
    Clip& clip = file.clip;
    clip.frame_count = file.times.size();
    require_room(file, static_cast<double>(clip.frame_count));
    clip.frame_time = frame_time_of(file.times);
    lay_out(clip);
    for (const GltfChannel& channel : file.channels) fill(file, channel);
    require_solvable(file, is_needed);
}

}  // namespace swivel::formats

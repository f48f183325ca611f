// SPDX-License-Identifier: MIT
#include "tools/crowd/clip_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/formats/printable.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using formats::Clip;
using formats::Joint;

constexpr double kSame = 1e-3;  // of the longest bone, of a scale, and of a rotation at rest

// Frames beside each other are so alike that a normalised blend turns as evenly as a slerp.
Eigen::Quaterniond blended(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b, double share)
{
    const double sign = a.dot(b) < 0 ? -1 : 1;
    return Eigen::Quaterniond((1 - share) * a.coeffs() + sign * share * b.coeffs()).normalized();
}

// The clip at a time, in frames: between two of them a blend.
void append_between(Clip& to, const Clip& from, double time)
{
    const auto at = static_cast<std::size_t>(time), next = std::min(at + 1, from.frame_count - 1);
    const double share = time - static_cast<double>(at);
    const auto mixed = [share](const Vector3d& a, const Vector3d& b) { return Vector3d((1 - share) * a + share * b); };
    const std::size_t joints = from.joints.size(), tracks = from.track_count, scales = from.scale_track_count;
    for (std::size_t n = 0; n < joints; ++n) {
        const Eigen::Quaterniond& rotation = from.rotation[at * joints + n];
        to.rotation.push_back(share == 0 ? rotation : blended(rotation, from.rotation[next * joints + n], share));
    }
    for (std::size_t n = 0; n < tracks; ++n)
        to.translation.push_back(mixed(from.translation[at * tracks + n], from.translation[next * tracks + n]));
    for (std::size_t n = 0; n < scales; ++n)
        to.scale.push_back(mixed(from.scale[at * scales + n], from.scale[next * scales + n]));
    ++to.frame_count;
}

void append(Clip& to, const Clip& from, const ClipPart& part, const Vector3d& way)
{
    to.translation.resize(to.translation.size() + part.count * to.track_count);
    to.scale.resize(to.scale.size() + part.count * to.scale_track_count);
    for (std::size_t frame = part.first; frame < part.first + part.count; ++frame, ++to.frame_count)
        for (std::size_t n = 0; n < to.joints.size(); ++n) {
            const Joint& joint = to.joints[n];
            to.rotation.push_back(from.rotation[frame * from.joints.size() + n]);
            if (joint.track >= 0)
                to.translation[to.frame_count * to.track_count + static_cast<std::size_t>(joint.track)] =
                    formats::local_translation(from, frame, n) + (joint.parent < 0 ? way : Vector3d(0, 0, 0));
            if (joint.scale_track >= 0)
                to.scale[to.frame_count * to.scale_track_count + static_cast<std::size_t>(joint.scale_track)] =
                    formats::local_scale(from, frame, n);
        }
}

}  // namespace

std::string difference_of(const Clip& clip, const Clip& other)
{
    if (clip.joints.size() != other.joints.size())
        return fmt::format("it has {} joints, not {}", other.joints.size(), clip.joints.size());
    double longest = 0;
    for (const Joint& joint : clip.joints) longest = std::max(longest, joint.parent < 0 ? 0 : joint.offset.norm());
    for (std::size_t n = 0; n < clip.joints.size(); ++n) {
        const Joint &a = clip.joints[n], &b = other.joints[n];
        if (a.name != b.name || a.parent != b.parent)
            return fmt::format("joint {} is {}, not {}", n, formats::joint_path(other, static_cast<int>(n)),
                               formats::joint_path(clip, static_cast<int>(n)));
        const bool has_offset = a.parent >= 0 && (a.track < 0 || b.track < 0);
        const formats::UnkeyedPose rest_a = pose_without_keys(a), rest_b = pose_without_keys(b);
        if ((has_offset && (rest_a.offset - rest_b.offset).norm() > kSame * longest) ||
            !rest_a.scale.isApprox(rest_b.scale, kSame) || rest_a.rotation.angularDistance(rest_b.rotation) > kSame)
            return fmt::format("joint {} has another rest pose", printable_name(b));
    }
    return {};
}

Clip joined(std::span<const Clip> clips, int body)
{
    Clip to = frames_of(clips[0], {});
    to.track_count = to.scale_track_count = 0;
    for (std::size_t n = 0; n < to.joints.size(); ++n) {
        bool moves = to.joints[n].parent < 0, scales = false;
        for (const Clip& clip : clips)
            moves = moves || clip.joints[n].track >= 0, scales = scales || clip.joints[n].scale_track >= 0;
        to.joints[n].track = moves ? static_cast<int>(to.track_count++) : -1;
        to.joints[n].scale_track = scales ? static_cast<int>(to.scale_track_count++) : -1;
    }
    const auto begin_of = [&](const Clip& clip) {
        const Vector3d place = formats::world_pose(clip, 0)[static_cast<std::size_t>(body)].position;
        return Vector3d(place.x(), floor_of(clip, clip.frame_count), place.z());
    };
    const Vector3d begin = begin_of(clips[0]);
    for (const Clip& clip : clips) append(to, clip, {0, clip.frame_count, 0}, begin - begin_of(clip));
    return to;
}

Clip paced(const Clip& clip, std::vector<ClipPart>& parts, std::span<const double> speeds, std::size_t frames)
{
    Clip to = frames_of(clip, {});
    for (std::size_t n = 0; n < parts.size(); ++n) {
        const ClipPart from = parts[n];
        const auto round = static_cast<std::size_t>(std::ceil(static_cast<double>(from.starts) / speeds[n]));
        ClipPart& part = parts[n];
        part.pace = frames > 0 ? static_cast<double>(from.starts) / static_cast<double>(round) : speeds[n];
        part.first = to.frame_count;
        part.count =
            frames > 0 ? frames + round : static_cast<std::size_t>(static_cast<double>(from.count - 1) / part.pace) + 1;
        part.starts = frames > 0 ? round : part.count;
        for (std::size_t frame = 0; frame < part.count; ++frame)
            append_between(to, clip, static_cast<double>(from.first) + static_cast<double>(frame) * part.pace);
    }
    return to;
}

double floor_of(const Clip& clip, std::size_t frame_count)
{
    std::vector<double> lowest;
    std::vector<formats::JointPose> pose_w(clip.joints.size());
    for (std::size_t frame = 0; frame < frame_count; ++frame) {
        formats::world_pose(clip, frame, pose_w);
        const auto height = [](const formats::JointPose& joint) { return joint.position.y(); };
        lowest.push_back(height(*std::ranges::min_element(pose_w, {}, height)));
    }
    return quantile(std::move(lowest), 0.25);
}

Clip frames_of(const Clip& clip, const ClipPart& part)
{
    Clip to;
    to.joints = clip.joints, to.human_bones = clip.human_bones, to.frame_time = clip.frame_time;
    to.track_count = clip.track_count, to.scale_track_count = clip.scale_track_count;
    append(to, clip, part, Vector3d::Zero());
    return to;
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
#include "tools/formats/clip.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

// Takes `name`, and the slash before it, off the end of `path`; false if the path ends otherwise.
bool take_last_name(std::string_view& path, std::string_view name, bool is_root)
{
    if (!path.ends_with(name)) return false;
    path.remove_suffix(name.size());
    if (is_root) return path.empty();
    if (!path.ends_with('/')) return false;
    path.remove_suffix(1);
    return true;
}

bool has_path(const Clip& clip, int joint, std::string_view path)
{
    for (; joint >= 0; joint = joint_at(clip, joint).parent) {
        const Joint& last = joint_at(clip, joint);
        if (!take_last_name(path, last.name, last.parent < 0)) return false;
    }
    return path.empty();
}

// Chains the poses that `next` gives for each joint, against its parent, to poses in the world.
template <class Next>
void chain_up(const Clip& clip, std::span<JointPose> pose_w, const Next& next)
{
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
        const int parent = clip.joints[joint].parent;
        const JointPose local = next(joint);
        pose_w[joint] = parent < 0 ? local : pose_w[static_cast<std::size_t>(parent)] * local;
    }
}

// A joint's pose against its parent, from translation, rotation and scale.
JointPose pose_of(const Joint& joint, const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation,
                  const Eigen::Vector3d& scale)
{
    JointPose pose{translation, rotation};
    if (joint.is_sheared) pose.unevenness = std::numeric_limits<double>::infinity();
    if (scale == Eigen::Vector3d::Ones()) return pose;
    const Eigen::Vector3d size = scale.cwiseAbs();
    pose.scale = size.mean();
    if (!joint.is_sheared && size.maxCoeff() > 0) pose.unevenness = 1 - size.minCoeff() / size.maxCoeff();
    pose.mirrored = scale.x() * scale.y() * scale.z() < 0;
    // The signs are a mirror in x, or none, and then half a turn about an axis, or none: the one that keeps its sign.
    const Eigen::Array3d sign(pose.mirrored == (scale.x() < 0) ? 1 : -1, scale.y() < 0 ? -1 : 1,
                              scale.z() < 0 ? -1 : 1);
    if ((sign < 0).any()) pose.rotation = rotation * Eigen::Quaterniond(0, sign[0] > 0, sign[1] > 0, sign[2] > 0);
    return pose;
}

}  // namespace

std::string printable_name(const Joint& joint) { return printable(joint.name, 80); }

Eigen::Vector3d mirrored(const Eigen::Vector3d& v) { return {-v.x(), v.y(), v.z()}; }
Eigen::Quaterniond mirrored(const Eigen::Quaterniond& q) { return {q.w(), q.x(), -q.y(), -q.z()}; }

JointPose operator*(const JointPose& outer, const JointPose& inner)
{
    JointPose pose;
    pose.position = to_outer(outer, inner.position);
    pose.rotation = outer.rotation * (outer.mirrored ? mirrored(inner.rotation) : inner.rotation);
    pose.scale = outer.scale * inner.scale;
    pose.mirrored = outer.mirrored != inner.mirrored;
    pose.unevenness = outer.unevenness + inner.unevenness;
    return pose;
}

Eigen::Vector3d to_outer(const JointPose& pose, const Eigen::Vector3d& point)
{
    return pose.position + pose.scale * (pose.rotation * (pose.mirrored ? mirrored(point) : point));
}

Eigen::Vector3d to_inner(const JointPose& pose, const Eigen::Vector3d& point)
{
    const Eigen::Vector3d turned = pose.rotation.conjugate() * (point - pose.position) / pose.scale;
    return pose.mirrored ? mirrored(turned) : turned;
}

Eigen::Vector3d local_translation(const Clip& clip, std::size_t frame, std::size_t joint)
{
    const Joint& at = clip.joints[joint];
    if (at.track < 0) return at.offset;
    return clip.translation[frame * clip.track_count + static_cast<std::size_t>(at.track)];
}

Eigen::Vector3d local_scale(const Clip& clip, std::size_t frame, std::size_t joint)
{
    const Joint& at = clip.joints[joint];
    if (at.scale_track < 0) return at.rest_scale;
    return clip.scale[frame * clip.scale_track_count + static_cast<std::size_t>(at.scale_track)];
}

JointPose local_pose(const Clip& clip, std::size_t frame, std::size_t joint)
{
    return pose_of(clip.joints[joint], local_translation(clip, frame, joint),
                   clip.rotation[frame * clip.joints.size() + joint], local_scale(clip, frame, joint));
}

JointPose local_rest_pose(const Joint& joint)
{
    return pose_of(joint, joint.offset, joint.rest_rotation, joint.rest_scale);
}

void keep_frames(Clip& clip, std::size_t frame_count)
{
    clip.frame_count = frame_count;
    clip.rotation.resize(frame_count * clip.joints.size());
    clip.translation.resize(frame_count * clip.track_count);
    clip.scale.resize(frame_count * clip.scale_track_count);
}

void world_pose(const Clip& clip, std::size_t frame, std::span<JointPose> pose_w)
{
    assert(pose_w.size() == clip.joints.size() && frame < clip.frame_count);
    chain_up(clip, pose_w, [&](std::size_t joint) { return local_pose(clip, frame, joint); });
}

std::vector<JointPose> world_pose(const Clip& clip, std::size_t frame)
{
    std::vector<JointPose> pose_w(clip.joints.size());
    world_pose(clip, frame, pose_w);
    return pose_w;
}

std::vector<JointPose> rest_pose(const Clip& clip)
{
    std::vector<JointPose> pose_w(clip.joints.size());
    chain_up(clip, pose_w, [&](std::size_t joint) { return local_rest_pose(clip.joints[joint]); });
    return pose_w;
}

std::vector<int> find_joints(const Clip& clip, std::string_view name_or_path)
{
    std::vector<int> found;
    const bool is_number = name_or_path.starts_with('#');
    const auto number = is_number ? parse_integer(name_or_path.substr(1)) : std::nullopt;
    for (int joint = 0; joint < static_cast<int>(clip.joints.size()); ++joint) {
        const Joint& at = joint_at(clip, joint);
        const bool has_number = number && *number == at.number;
        if (has_number || at.name == name_or_path || has_path(clip, joint, name_or_path)) found.push_back(joint);
    }
    return found;
}

std::vector<int> child_joints(const Clip& clip, int joint)
{
    std::vector<int> children;
    for (int child = 0; child < static_cast<int>(clip.joints.size()); ++child) {
        if (joint_at(clip, child).parent == joint) children.push_back(child);
    }
    return children;
}

std::string joint_path(const Clip& clip, int joint)
{
    std::vector<std::string_view> names;
    for (; joint >= 0; joint = joint_at(clip, joint).parent) names.push_back(joint_at(clip, joint).name);
    std::ranges::reverse(names);
    return joined(names, "/");
}

}  // namespace swivel::formats

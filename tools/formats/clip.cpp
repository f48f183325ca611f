// SPDX-License-Identifier: MIT
#include "tools/formats/clip.h"

#include <cassert>

namespace swivel::formats {
namespace {

const Joint& joint_at(const Clip& clip, int joint) { return clip.joints[static_cast<std::size_t>(joint)]; }

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

}  // namespace

Eigen::Vector3d local_translation(const Clip& clip, std::size_t frame, std::size_t joint)
{
    const Joint& at = clip.joints[joint];
    if (at.track < 0) return at.offset;
    return clip.translation[frame * clip.track_count + static_cast<std::size_t>(at.track)];
}

void world_pose(const Clip& clip, std::size_t frame, std::span<JointPose> pose_w)
{
    const std::size_t joint_count = clip.joints.size();
    assert(pose_w.size() == joint_count && frame < clip.frame_count);
    for (std::size_t joint = 0; joint < joint_count; ++joint) {
        const int parent = clip.joints[joint].parent;
        const Eigen::Vector3d translation = local_translation(clip, frame, joint);
        const Eigen::Quaterniond& rotation = clip.rotation[frame * joint_count + joint];
        if (parent < 0) {
            pose_w[joint] = {translation, rotation};
        } else {
            const JointPose& from = pose_w[static_cast<std::size_t>(parent)];
            pose_w[joint] = {from.position + from.rotation * translation, from.rotation * rotation};
        }
    }
}

std::vector<JointPose> world_pose(const Clip& clip, std::size_t frame)
{
    std::vector<JointPose> pose_w(clip.joints.size());
    world_pose(clip, frame, pose_w);
    return pose_w;
}

std::vector<Eigen::Vector3d> rest_positions(const Clip& clip)
{
    std::vector<Eigen::Vector3d> position_w;
    position_w.reserve(clip.joints.size());
    for (const Joint& joint : clip.joints) {
        const bool is_root = joint.parent < 0;
        const Eigen::Vector3d from_w =
            is_root ? Eigen::Vector3d(0, 0, 0) : position_w[static_cast<std::size_t>(joint.parent)];
        position_w.push_back(from_w + joint.offset);
    }
    return position_w;
}

std::vector<int> find_joints(const Clip& clip, std::string_view name_or_path)
{
    std::vector<int> found;
    for (int joint = 0; joint < static_cast<int>(clip.joints.size()); ++joint) {
        if (joint_at(clip, joint).name == name_or_path || has_path(clip, joint, name_or_path)) found.push_back(joint);
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
    std::string path = joint_at(clip, joint).name;
    for (int up = joint_at(clip, joint).parent; up >= 0; up = joint_at(clip, up).parent) {
        path = joint_at(clip, up).name + '/' + path;
    }
    return path;
}

}  // namespace swivel::formats

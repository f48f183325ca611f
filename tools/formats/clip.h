#pragma once
// SPDX-License-Identifier: MIT
// A moving skeleton in memory, whatever file it came from: joints, and one local rotation per frame and joint.
// Lengths are the file's unit, quaternions are Hamilton's and turn child coordinates into the parent's:
// x_parent = translation + rotation * (scale * x_child), scale by component. Knows no file and no solver.

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace swivel::formats {

// A joint's pose in its file, where it has no keys.
struct UnkeyedPose {
    Eigen::Vector3d offset;
    Eigen::Quaterniond rotation;
    Eigen::Vector3d scale;
};

struct Joint {
    std::string name;  // need not be unique, may hold blanks
    int parent = -1;   // index in Clip::joints, always smaller than the joint's own; -1: a root
    // The rest pose, relative to the parent: from its origin, in its axes. BVH rests without rotation or scale.
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    Eigen::Quaterniond rest_rotation = Eigen::Quaterniond::Identity();  // unit
    Eigen::Vector3d rest_scale = Eigen::Vector3d::Ones();               // may be negative: a mirror
    std::optional<UnkeyedPose> unkeyed{};  // set if the rest pose above was taken from a frame instead of the file
    bool is_sheared = false;               // the file's matrix has shear, which these three lack
    int track = -1;                        // column in Clip::translation; -1: the joint never leaves its offset
    int scale_track = -1;                  // column in Clip::scale; -1: always rest_scale
    std::optional<Eigen::Vector3d> end{};  // BVH's End Site, as an offset: where the joint's bone ends
    int number = -1;                       // its place in the file's own list, written "#12"
    bool is_bone = true;                   // false: the file says which nodes are joints of a skin, and this is none
};

struct Clip {
    std::vector<Joint> joints;
    std::map<std::string, int> human_bones;  // joints that the file itself names, by VRM's names: "leftUpperArm";
                                             // empty: none
    double frame_time = 0;                   // seconds between frames; 0: frames lie at uneven times
    std::size_t frame_count = 0;
    std::size_t track_count = 0;               // joints that move against their parent; often the root alone
    std::vector<Eigen::Quaterniond> rotation;  // local, unit; [frame * joints.size() + joint]
    std::vector<Eigen::Vector3d> translation;  // local, takes the place of offset; [frame * track_count + track]
    std::size_t scale_track_count = 0;         // joints whose scale changes
    std::vector<Eigen::Vector3d> scale;        // takes the place of rest_scale; [frame * scale_track_count + track]
};

// joint: 0 to joints.size()-1, as parents and find_joints() count; unchecked.
inline const Joint& joint_at(const Clip& clip, int joint) { return clip.joints[static_cast<std::size_t>(joint)]; }

// A joint's pose in the file if it has no keys.
inline UnkeyedPose pose_without_keys(const Joint& joint)
{
    return joint.unkeyed ? *joint.unkeyed : UnkeyedPose{joint.offset, joint.rest_rotation, joint.rest_scale};
}

// A joint's name for a message: one line, not too long.
std::string printable_name(const Joint& joint);

// A joint's pose in another space, mostly the world: x_w = position + scale * (rotation * x), where x is first mirrored
// in its own x if `mirrored`. So a rotation stays a rotation below a mirror.
struct JointPose {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    double scale = 1;       // above 0; 0 where a joint at or above is scaled to nothing
    bool mirrored = false;  // an odd number of mirrors at and above
    // How much the factors of scale along a joint's axes differ, as a share of the largest; those of all joints at and
    // above, added up. `scale` is their mean. Infinite at or below a sheared matrix.
    double unevenness = 0;
};

// The position of a joint in a pose. joint: 0 to pose.size()-1; unchecked.
inline const Eigen::Vector3d& position_of(std::span<const JointPose> pose, int joint)
{
    return pose[static_cast<std::size_t>(joint)].position;
}

// v, or a rotation, mirrored in x.
Eigen::Vector3d mirrored(const Eigen::Vector3d& v);
Eigen::Quaterniond mirrored(const Eigen::Quaterniond& q);

// `inner`, a pose in the space of `outer`, in the space around `outer`.
JointPose operator*(const JointPose& outer, const JointPose& inner);

// Brings a point from the pose's space to the space around it.
Eigen::Vector3d to_outer(const JointPose& pose, const Eigen::Vector3d& point);
// Brings a point from the space around the pose to its own. The scale must not be 0.
Eigen::Vector3d to_inner(const JointPose& pose, const Eigen::Vector3d& point);

// A joint's translation against its parent in one frame: its track where it has one, else its offset.
// joint: 0 to joints.size()-1; frame: 0 to frame_count-1; unchecked, here and below.
Eigen::Vector3d local_translation(const Clip& clip, std::size_t frame, std::size_t joint);
// The same of its scale.
Eigen::Vector3d local_scale(const Clip& clip, std::size_t frame, std::size_t joint);

// A joint's whole pose against its parent: translation, rotation and scale.
JointPose local_pose(const Clip& clip, std::size_t frame, std::size_t joint);
// The same at rest.
JointPose local_rest_pose(const Joint& joint);

// Drops all but the first frames. frame_count: at most the clip's.
void keep_frames(Clip& clip, std::size_t frame_count);

// Forward kinematics: every joint of one frame in world space, in double.
// pose_w: joints.size() elements, all written; must not overlap the clip.
// Allocates nothing; any number of threads may read one clip; one quaternion product and one rotation a joint.
void world_pose(const Clip& clip, std::size_t frame, std::span<JointPose> pose_w);

// The same in a vector of its own.
std::vector<JointPose> world_pose(const Clip& clip, std::size_t frame);

// Every joint in world space in the rest pose.
std::vector<JointPose> rest_pose(const Clip& clip);

// All joints with this name, path or number ("#12"), in the clip's order. There may be several, because names may
// repeat.
std::vector<int> find_joints(const Clip& clip, std::string_view name_or_path);

// The direct children of a joint, in the clip's order; of -1, the roots. Looks at every joint.
std::vector<int> child_joints(const Clip& clip, int joint);

// Names from the root down to the joint, with slashes between: "Hips/Spine/LeftArm".
std::string joint_path(const Clip& clip, int joint);

}  // namespace swivel::formats

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

// What a file has a joint without keys at.
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
    std::optional<UnkeyedPose> unkeyed{};  // where the rest pose above is not the file's but was taken from a frame
    bool is_sheared = false;               // the file's matrix is more than these three say
    int track = -1;                        // column in Clip::translation; -1: the joint never leaves its offset
    int scale_track = -1;                  // column in Clip::scale; -1: always rest_scale
    std::optional<Eigen::Vector3d> end{};  // BVH's End Site, as an offset: where the joint's bone ends
    int number = -1;      // what the file calls it besides its name, "#12": its place in the file's own list
    bool is_bone = true;  // false: the file says which nodes are joints of a skin, and this is none
};

struct Clip {
    std::vector<Joint> joints;
    std::map<std::string, int> human_bones;  // what the file itself says of joints, by VRM's names: "leftUpperArm";
                                             // empty: it says nothing
    double frame_time = 0;                   // seconds between frames; 0: frames lie at uneven times
    std::size_t frame_count = 0;
    std::size_t track_count = 0;               // joints that move against their parent; often the root alone
    std::vector<Eigen::Quaterniond> rotation;  // local, unit; [frame * joints.size() + joint]
    std::vector<Eigen::Vector3d> translation;  // local, takes the place of offset; [frame * track_count + track]
    std::size_t scale_track_count = 0;         // joints whose scale changes
    std::vector<Eigen::Vector3d> scale;        // takes the place of rest_scale; [frame * scale_track_count + track]
};

// joint: 0 to joints.size()-1, as parents and find_joints() count; the caller answers for it.
inline const Joint& joint_at(const Clip& clip, int joint) { return clip.joints[static_cast<std::size_t>(joint)]; }

// Where a joint is in the file if it has no keys.
inline UnkeyedPose pose_without_keys(const Joint& joint)
{
    return joint.unkeyed ? *joint.unkeyed : UnkeyedPose{joint.offset, joint.rest_rotation, joint.rest_scale};
}

// A joint's name for a message: one line, not too long.
std::string printable_name(const Joint& joint);

// Where a joint is in another space, mostly the world: x_w = position + scale * (rotation * x), with x mirrored in its
// own x before that if `mirrored`. So a rotation stays a rotation below a mirror.
struct JointPose {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    double scale = 1;       // above 0; 0 where a joint at or above is scaled to nothing
    bool mirrored = false;  // an odd number of mirrors at and above
    // How much the factors of scale along a joint's axes differ, as a share of the largest; those of all joints at and
    // above, added up. `scale` is their mean. Infinite at or below a sheared matrix.
    double unevenness = 0;
};

// Where a joint of a pose is. joint: 0 to pose.size()-1; the caller answers for it.
inline const Eigen::Vector3d& position_of(std::span<const JointPose> pose, int joint)
{
    return pose[static_cast<std::size_t>(joint)].position;
}

// v with its x turned over, and the same turn seen in that mirror.
Eigen::Vector3d mirrored(const Eigen::Vector3d& v);
Eigen::Quaterniond mirrored(const Eigen::Quaterniond& q);

// A joint's own pose against its parent, from what files store.
JointPose local_pose(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation,
                     const Eigen::Vector3d& scale);

// `inner`, given in the space of `outer`, in the space that `outer` is given in.
JointPose operator*(const JointPose& outer, const JointPose& inner);

// A point given in the pose's space, in the space the pose is given in; and back (scale not 0).
Eigen::Vector3d to_outer(const JointPose& pose, const Eigen::Vector3d& point);
Eigen::Vector3d to_inner(const JointPose& pose, const Eigen::Vector3d& point);

// A joint's translation against its parent in one frame: its track where it has one, else its offset.
// joint: 0 to joints.size()-1; frame: 0 to frame_count-1; here and below the caller answers for them.
Eigen::Vector3d local_translation(const Clip& clip, std::size_t frame, std::size_t joint);

// The whole of it: translation, rotation and scale; and the same at rest.
JointPose local_pose(const Clip& clip, std::size_t frame, std::size_t joint);
JointPose local_rest_pose(const Joint& joint);

// Keeps the first frames alone; frame_count: at most the clip's.
void keep_frames(Clip& clip, std::size_t frame_count);

// Forward kinematics: every joint of one frame in world space, in double.
// pose_w: joints.size() elements, all written; must not overlap the clip.
// Allocates nothing; any number of threads may read one clip; one quaternion product and one rotation a joint.
void world_pose(const Clip& clip, std::size_t frame, std::span<JointPose> pose_w);

// The same in a vector of its own.
std::vector<JointPose> world_pose(const Clip& clip, std::size_t frame);

// Every joint in world space in the rest pose.
std::vector<JointPose> rest_pose(const Clip& clip);

// All joints of this name, of this path or, written "#12", of this number, in the clip's order; none, or several where
// names repeat: the caller decides.
std::vector<int> find_joints(const Clip& clip, std::string_view name_or_path);

// The direct children of a joint, in the clip's order; of -1, the roots. Looks at every joint.
std::vector<int> child_joints(const Clip& clip, int joint);

// Names from the root down to the joint, with slashes between: "Hips/Spine/LeftArm".
std::string joint_path(const Clip& clip, int joint);

}  // namespace swivel::formats

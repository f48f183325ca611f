#pragma once
// SPDX-License-Identifier: MIT
// A moving skeleton in memory, whatever file it came from: joints, and one local rotation per frame and joint.
// Lengths are the file's unit, quaternions are Hamilton's and turn child coordinates into the parent's:
// x_parent = translation + rotation * x_child. Knows no file and no solver.

#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace swivel::formats {

struct Joint {
    std::string name;  // need not be unique, may hold blanks
    int parent = -1;   // index in Clip::joints, always smaller than the joint's own; -1: a root
    // From the parent's origin, in the parent's axes. The rest pose is these, with no rotation.
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    int track = -1;  // column in Clip::translation; -1: the joint never leaves its offset
};

struct Clip {
    std::vector<Joint> joints;
    double frame_time = 0;  // seconds, above 0
    std::size_t frame_count = 0;
    std::size_t track_count = 0;               // joints that move against their parent; often the root alone
    std::vector<Eigen::Quaterniond> rotation;  // local, unit; [frame * joints.size() + joint]
    std::vector<Eigen::Vector3d> translation;  // local, takes the place of offset; [frame * track_count + track]
};

// Where a joint is in world space: x_w = position + rotation * x_joint.
struct JointPose {
    Eigen::Vector3d position;
    Eigen::Quaterniond rotation;
};

// A joint's translation against its parent in one frame: its track where it has one, else its offset.
// joint: 0 to joints.size()-1; frame: 0 to frame_count-1; here and below the caller answers for them.
Eigen::Vector3d local_translation(const Clip& clip, std::size_t frame, std::size_t joint);

// Forward kinematics: every joint of one frame in world space, in double.
// pose_w: joints.size() elements, all written; must not overlap the clip.
// Allocates nothing; any number of threads may read one clip; one quaternion product and one rotation a joint.
void world_pose(const Clip& clip, std::size_t frame, std::span<JointPose> pose_w);

// The same in a vector of its own.
std::vector<JointPose> world_pose(const Clip& clip, std::size_t frame);

// World positions of all joints in the rest pose: sums of offsets, no rotation, no track.
std::vector<Eigen::Vector3d> rest_positions(const Clip& clip);

// All joints of this name or of this path, in the clip's order; none, or several where names repeat: the caller
// decides.
std::vector<int> find_joints(const Clip& clip, std::string_view name_or_path);

// The direct children of a joint, in the clip's order; of -1, the roots. Looks at every joint.
std::vector<int> child_joints(const Clip& clip, int joint);

// Names from the root down to the joint, with slashes between: "Hips/Spine/LeftArm".
std::string joint_path(const Clip& clip, int joint);

}  // namespace swivel::formats

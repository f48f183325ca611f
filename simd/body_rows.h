// SPDX-License-Identifier: MIT
//
// The memory that a run of bodies is worked in, and the plan of a crowd's skeleton: which joints some group needs, in
// an order in which parents come first.
#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/fields.h"

namespace swivel {

// The rows of a joint, by the first of each value.
enum JointRow : std::uint32_t {
    kLocalRow,                  // its rotation, relative to its parent: as it comes, later as it goes
    kTurnRow = kLocalRow + 4,   // its rotation as it comes, in the world
    kPlaceRow = kTurnRow + 4,   // its place as it comes, from the root's place
    kScaleRow = kPlaceRow + 3,  // the same, in the world
    kAxesRow = kScaleRow + 1,   // of poses of matrices: the axes in the order of the caller's memory
    kJointRows = kAxesRow + 9
};
// What a group's limb hands on from stage to stage, besides the rows of its strip.
enum PosedRow : std::uint32_t {
    kLengthsRow,                         // of the bones, in the parent's unit
    kUpperFromArmRow = kLengthsRow + 2,  // as in a binding
    kElbowParentFromArmRow = kUpperFromArmRow + 4,
    kForeFromArmRow = kElbowParentFromArmRow + 4,
    kWristParentFromArmRow = kForeFromArmRow + 4,
    kRootRow =
        kWristParentFromArmRow + 4,  // the root's place in the world; 0 where positions in rows are from the root
    kPosedRows = kRootRow + 3
};
// A block has the rows of the group that is being solved, then those of all joints.
constexpr std::uint32_t joint_row(std::uint32_t joint) { return kPosedRows + joint * kJointRows; }
constexpr std::size_t body_block_floats(std::uint32_t joint_count)
{
    return std::size_t{joint_row(joint_count)} * kLanes;
}

// A joint that is needed. Joint 0 is the root, which the others hang below. It has no parent.
struct BodyJoint {
    std::uint32_t skeleton_joint;  // of the skeleton; of the root it means nothing
    std::uint32_t parent;          // among the needed ones, and before this one
    std::uint32_t is_turned;       // whether a group's limb has it, so that its local rotation is needed later
    float translation[3];          // at rest
};
// The joints of a group's limb, among the needed ones.
struct BodyLimb {
    std::uint32_t parent, shoulder, elbow_parent, elbow, wrist_parent, wrist;
    float hinge[3];  // in the shoulder joint's frame

    // The rows of what carries the arm frame to the parents of elbow and wrist.
    std::uint32_t elbow_parent_row() const
    {
        return elbow_parent == shoulder ? kUpperFromArmRow : kElbowParentFromArmRow;
    }
    std::uint32_t wrist_parent_row() const { return wrist_parent == elbow ? kForeFromArmRow : kWristParentFromArmRow; }
};

// A block of bodies, of which some are there.
struct BodyBlock {
    float* rows;
    std::uint32_t first;  // its first body
    std::uint32_t lanes;  // bits of those that are chosen; at least one
};
// What forward kinematics needs of a crowd and a pose.
struct BodyPlan {
    const BodyJoint* joints;
    std::uint32_t joint_count;
    const swivel_pose* pose;  // whole
};

}  // namespace swivel

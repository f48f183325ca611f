// SPDX-License-Identifier: MIT
//
// The memory that a run of bodies is worked in, and the plan of a crowd's skeleton: which joints some group needs, in
// an order in which parents come first.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/group_rules.h"
#include "simd/fields.h"

namespace swivel {

// The rows of a joint, by the first of each value. Joints that no limb turns have only those before the local rotation.
enum JointRow : std::uint32_t {
    kTurnRow,                    // its rotation as it comes, in the world
    kPlaceRow = kTurnRow + 4,    // its place as it comes, from the root's place
    kScaleRow = kPlaceRow + 3,   // the same, in the world
    kLocalRow = kScaleRow + 1,   // its rotation, relative to its parent: as it comes, later as it goes
    kAxesRow = kLocalRow + 4,    // of local matrices: the axes in the order of the caller's memory
    kMotionRow = kAxesRow,       // once these are written: the turn that a solve gave it and all below it,
    kShiftRow = kMotionRow + 4,  // and the place that the root's goes to in it; both in the body's space. A limb's
                                 // count from where looks above it have moved it, a look's from the incoming pose
    kJointRows = kAxesRow + 9
};
// The values that a group's limb hands on from stage to stage, besides the rows of its strip.
enum PosedRow : std::uint32_t {
    kLengthsRow,                         // of the bones, in the parent's unit
    kUpperFromArmRow = kLengthsRow + 2,  // as in a binding
    kElbowParentFromArmRow = kUpperFromArmRow + 4,
    kForeFromArmRow = kElbowParentFromArmRow + 4,
    kWristParentFromArmRow = kForeFromArmRow + 4,
    kTwistInRow = kWristParentFromArmRow + 4,  // the incoming hand's twist about the forearm: cos and sin of its half
    kKeptRow = kTwistInRow + 2,                // 1 where the limb keeps its pose, else 0
    kReachRow = kKeptRow + 1,                  // from shoulder to wrist as it comes, in the parent's unit
    // The body itself:
    kRootRow,                 // the root's place in the world, as shifted; 0 where positions in rows are from the root
    kTimeRow = kRootRow + 3,  // since the last solve
    kWeightRow,               // how much of its corrections counts, where the pose says so
    kRootFromSupportRow,      // the root's place from the support's, along the world's axes
    kSupportRow = kRootFromSupportRow + 3,  // the support's rotation
    kSpanRow = kSupportRow + 4,             // the shifts from which all limbs reach: low, high, and 1 if there are any
    kShiftedRow = kSpanRow + 3,             // by what the root is shifted, in the world
    kPosedRows = kShiftedRow + 3
};
// Behind the rows of all joints lie the values that stages hand on from group to group, or from pass to pass. A limb
// whose goal the library makes (kLibraryGoal) has:
enum GoalRow : std::uint32_t {
    kGoalPlaceRow,  // from the root's place before it is shifted; where it is linked, after that
    kGoalHandRow = kGoalPlaceRow + 3,
    kGoalFlagsRow = kGoalHandRow + 4,   // bits
    kGoalOwnRow = kGoalFlagsRow + 1,    // 1 where it is the pose's own
    kGoalResultsRow = kGoalOwnRow + 1,  // the results that stand only if no later stage finds bad input
    kGoalRows = kGoalResultsRow + 44
};
// A frame that limbs are linked to, from the root's place as shifted: of a hand, or of a prop.
enum HeldRow : std::uint32_t {
    kHeldTurnRow,
    kHeldPlaceRow = kHeldTurnRow + 4,
    kHeldScaleRow = kHeldPlaceRow + 3,  // of places in it
    kHeldRows = kHeldScaleRow + 1
};
// Behind a prop's frame: which holder alone says where it is, -1 for none; and of each holder where it has the prop,
// and how far its arm gets.
inline constexpr std::uint32_t kMaxHolders = 2;
enum HolderRow : std::uint32_t {
    kHolderTurnRow,
    kHolderPlaceRow = kHolderTurnRow + 4,
    kHolderWristRow = kHolderPlaceRow + 3,  // in the prop's frame
    kHolderShoulderRow = kHolderWristRow + 3,
    kHolderReachRow = kHolderShoulderRow + 3,
    kHolderNearRow = kHolderReachRow + 1,  // and no nearer than this
    kHolderRows = kHolderNearRow + 1
};
inline constexpr std::uint32_t kLeadHandRow = kHeldRows, kHoldersRow = kLeadHandRow + 1,
                               kPropRows = kHoldersRow + kMaxHolders * kHolderRows;
// A block has the rows of the group that is being solved, then those of all joints: first the root's.
inline constexpr std::uint32_t kRootJoint = kPosedRows;
constexpr std::uint32_t joint_row_count(bool is_turned) { return is_turned ? kJointRows : std::uint32_t{kLocalRow}; }
// A joint that is written goes through these rows, once its limb is done with them: its rotation and its place, or the
// numbers of its matrix.
enum OutRow : std::uint32_t { kOutTurnRow, kOutPlaceRow = kOutTurnRow + 4, kOutRows = 12 };
static_assert(std::uint32_t{kOutRows} <= kKeptRow);

// A joint that is needed, by the first rows of its own and of others. The first one is the root, which the others hang
// below. It has no parent.
struct BodyJoint {
    std::uint32_t skeleton_joint;  // of the skeleton; of the root it means nothing
    std::uint32_t row, parent;     // the parent comes before it
    std::uint32_t mover;           // the joint of a limb that it moves with: it, or the next one above that is turned.
                                   // 0: none, or one of a look, which moves the rows themselves
    std::uint32_t is_turned;       // whether a limb or look turns it, so that its local rotation is needed later
    float translation[3];          // at rest
};
// A joint of the skeleton that moves with one that a limb or look turns. look: the mover of the first joint of the
// limb, by a look; 0: none, or the mover is a look's.
struct MovedJoint {
    std::uint32_t skeleton_joint, mover, look;
};
// A needed joint that moves with a look: its first row, and the number of the look's joint that moves it.
struct FollowingJoint {
    std::uint32_t row, number;
};
// A joint that a limb or look turns. above: the mover of its parent.
struct TurnedJoint {
    std::uint32_t skeleton_joint, row, parent, above;
};
inline constexpr std::uint32_t kMaxTurned = 4 + SWIVEL_MAX_TWIST_BONES;
static_assert(kMaxLookJoints == SWIVEL_MAX_LOOK_JOINTS && kMaxLookJoints <= kMaxTurned);
// The joints that a limb or look moves.
struct GroupJoints {
    TurnedJoint turned[kMaxTurned];  // an upper one first
    std::uint32_t turned_count;
    std::uint32_t above;        // the joint of a look that moves the first of them; 0: none
    std::uint32_t above_group;  // that look's group
    const MovedJoint* moved;    // these joints and all below them, but those that move with another group's
    std::uint32_t moved_count;
    const FollowingJoint* following;  // the needed joints that move with a look, but its own
    std::uint32_t following_count;
};

// A twist bone, by its first row and its parent's.
struct TwistBone {
    std::uint32_t row, parent;
    float rest[4];  // its local rotation at rest
};
// A limb is linked to a prop, or to another limb's hand.
struct LinkPlan {
    std::uint32_t row;     // the first row of its frame
    std::uint32_t group;   // its group
    bool is_prop;          // if so:
    std::uint32_t holder;  // the first row of what the limb asks of it
    std::uint32_t number;  // the limb's place among its holders
};
// A body's limb.
struct BodyLimb {
    std::uint32_t parent, shoulder, elbow_parent, elbow, wrist_parent, wrist;  // its joints, by their first rows
    TwistBone twist_bones[SWIVEL_MAX_TWIST_BONES];
    float hinge[3];            // in the shoulder joint's frame
    float clavicle_rest[4];    // the parent's local rotation at rest, where it is a clavicle
    std::uint32_t goal;        // the first row of its goal, where the library makes it
    std::uint32_t hand_frame;  // the first row of its hand's frame, with SWIVEL_WITH_HAND_TRANSFORM
    float per_ahead;           // 1/s: 1 / the lookahead of the crowd's shift, with SWIVEL_WITH_NEXT_TARGET
    PlantRules plant;          // where it is planted
    GroundRules ground;        // where it stands on ground
    LinkPlan link;             // where it is linked

    // The rows of what carries the arm frame to the parents of elbow and wrist.
    std::uint32_t elbow_parent_row() const
    {
        return elbow_parent == shoulder ? kUpperFromArmRow : kElbowParentFromArmRow;
    }
    std::uint32_t wrist_parent_row() const { return wrist_parent == elbow ? kForeFromArmRow : kWristParentFromArmRow; }
};
struct PropPlan {
    std::uint32_t frame;  // the first row of its frame
    std::uint32_t joint;  // the first row of its joint; 0: none
    std::uint32_t holder_count;
    float max_move;  // in limb lengths of its first holder
};
struct ShiftPlan {
    float drop, rise;  // in limb lengths of the first limb that is to fit
    SpringRule spring;
};
// The plan of a group of bodies. Each of the last four members is for groups of one kind.
struct GroupPlan {
    float up[3];         // the crowd's, of unit length
    float rest_length;   // of both bones: a planted limb's, or those of the first limb that a shift or prop serves
    GroupJoints joints;  // a shift and a prop have none
    BodyLimb limb;
    LookRules look;
    PropPlan prop;
    ShiftPlan shift;
};

// Where a number of a joint's matrix lies in the caller's memory, in bytes.
constexpr std::size_t entry_offset(swivel_pose_form form, std::size_t row, std::size_t column)
{
    const std::size_t numbers =
        form == SWIVEL_MATRIX_ROWS ? 4 * row + column : (form == SWIVEL_MATRIX_COLUMNS ? 4 : 3) * column + row;
    return numbers * sizeof(float);
}
// Where a body has a joint's value, in bytes.
constexpr std::size_t offset_of(const swivel_joint_values& values, std::uint32_t joint)
{
    return values.offsets ? values.offsets[joint] : joint * values.joint_stride;
}

// A block of bodies, of which some are there.
struct BodyBlock {
    float* rows;
    std::uint32_t first;  // its first body
    std::uint32_t lanes;  // bits of those that are chosen; at least one
};
// The part of a crowd and a pose that forward kinematics needs.
struct BodyPlan {
    const BodyJoint* joints;
    std::uint32_t joint_count;
    const swivel_pose* pose;  // whole
};

}  // namespace swivel

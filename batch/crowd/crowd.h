// SPDX-License-Identifier: MIT
//
// A crowd in memory: one arena, laid out at creation, with the crowd itself, its groups and their rows. And masks of
// its lanes.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "batch/crowd/group_def.h"
#include "include/swivel/swivel_bodies.h"
#include "simd/body_rows.h"
#include "simd/kernels.h"
#include "simd/rows.h"
#include "simd/strip_rows.h"

namespace swivel {

struct Group {
    std::uint32_t first_block, block_count, limb_count;
    swivel_features asked;     // by the caller
    swivel_features features;  // these, those that they bring, and the library's own bits
    bool keeps_pose;           // SWIVEL_KEEP_POSE
    swivel_euler_order shoulder_order, wrist_order;
    std::uint32_t input_row_count, result_row_count;
    std::uint16_t first_row[kFieldCount];  // of each field, among input or result rows
    float *input, *results;                // rows
    swivel_binding binding;
    const swivel_region* region;    // with SWIVEL_WITH_REGION: in the arena
    HalfLine half_line;             // with SWIVEL_POLE_HALF_LINE
    StageList stages[kPassCount];   // of each pass
    GroupPlan plan;                 // in a crowd of bodies
    std::size_t body_block_floats;  // floats of a block of bodies in a workspace
};

// Whether an origin is subtracted from a group's position. It is not for a prop on a joint, which lies in the joint's
// frame.
inline bool has_origin(const Group& group, swivel_field field)
{
    return has_origin(group.features, field) && !(field == SWIVEL_PROP_POSITION && group.plan.prop.joint != 0);
}

}  // namespace swivel

struct swivel_crowd {
    static constexpr std::uint64_t kAlive = 0x6c6576697773;  // "swivel"
    std::uint64_t alive;                                     // until it is destroyed: see use.h
    mutable std::atomic<std::int32_t> users;
    std::uint32_t group_count, block_count;
    std::size_t block_bytes;  // of a block's rows, on average
    swivel::Group* groups;
    void* arena;
    std::size_t arena_bytes;
    void (*release)(void* memory, std::size_t bytes, void* user);  // null: the caller keeps the memory
    void* user;
    alignas(16) unsigned char schedule[64];  // the scheduler's state between solves (schedule.cpp)
    float* urgency;                          // of each block, where the caller keeps none (budget.cpp)
    std::uint8_t* done;                      // a byte for each block, of a solve on threads (schedule.cpp)
    std::uint32_t strip_blocks;              // of a workspace; 0: it has no whole limbs
    std::uint32_t workspace_count;
    float* workspaces;
    const swivel::BodyJoint* joints;  // the joints that some group needs
    std::uint32_t joint_count;        // 0: free limbs
    std::uint32_t body_row_count;     // of a block of bodies in a workspace
    std::atomic<std::uint64_t> busy;  // a bit for each workspace that a call is using
    // The suspicious time step that swivel_explain() warns of, in s; below 0: none. It is that of the last solve's
    // first body, if above 1, or if 0 while the results went over the pose.
    std::atomic<float> doubted_time;
    // The number of limbs reset since the last solve of poses, and of consecutive solves with all bodies reset.
    std::atomic<std::uint32_t> reset_limbs, solves_anew;
    std::atomic<std::uint32_t> pose_notes;  // of the last solve's pose: see PoseNote
};

namespace swivel {

inline constexpr float kNoDoubt = -1;  // swivel_crowd::doubted_time
// What swivel_explain() knows of the pose that bodies were solved with last. A time that bodies do not share has
// neither of the first two.
enum PoseNote : std::uint32_t {
    kTimeIsGood = 1,
    kTimeIsBad = 2,
    kHasSupport = 4,
    kHasWeight = 8,
    kHasDoubleRoot = 16,
    kHasRootRotation = 32,
    kHasRootScale = 64,
    kHasJointScales = 128,  // or matrices, which may have scales
    kIsUnknown = 256,       // the job left out bodies or groups, whose last pose may have been another
};
// The notes of a pose that is not known, which may have everything.
inline constexpr std::uint32_t kUnknownPose =
    kHasSupport | kHasWeight | kHasDoubleRoot | kHasRootRotation | kHasRootScale | kHasJointScales | kIsUnknown;

// A group with any of these features has whole limbs.
inline constexpr swivel_features kLimbFeatures = ~(kFormulaFeatures | SWIVEL_POLE_DIRECTION);

inline constexpr std::size_t kArenaAlignment = 64;   // of its memory, and of a workspace that the caller brings
inline constexpr std::uint32_t kMaxWorkspaces = 64;  // of a crowd
// The size of a workspace: a strip of this many blocks, and as many blocks of bodies if joints are needed.
inline std::size_t workspace_floats(std::uint32_t strip_blocks, std::uint32_t body_row_count)
{
    return strip_blocks * (kStripBlockFloats + std::size_t{body_row_count} * kLanes);
}
// A crowd's workspace, or null.
inline StripMemory strip_memory(const swivel_crowd& crowd, float* workspace)
{
    return {workspace, crowd.strip_blocks,
            crowd.body_row_count > 0 && workspace ? workspace + crowd.strip_blocks * kStripBlockFloats : nullptr};
}

// How many groups have lanes of their own. In a crowd of bodies all groups share the first one's.
inline std::uint32_t lane_group_count(const swivel_crowd& crowd)
{
    return crowd.joint_count > 0 ? 1 : crowd.group_count;
}

// The place in the crowd's list of joints of the one whose rows begin at `row`.
inline std::uint32_t joint_at(const swivel_crowd& crowd, std::uint32_t row)
{
    const BodyJoint* const at =
        std::lower_bound(crowd.joints, crowd.joints + crowd.joint_count, row,
                         [](const BodyJoint& joint, std::uint32_t wanted) { return joint.row < wanted; });
    return static_cast<std::uint32_t>(at - crowd.joints);
}

// Masks of a crowd's lanes have one bit for each lane. A word of 32 bits covers two blocks.
using LaneMask = std::uint32_t;  // of one block: the low SWIVEL_LANES bits
inline constexpr LaneMask kAllLanes = (1u << SWIVEL_LANES) - 1;

inline LaneMask lanes_of(const std::uint32_t* words, std::uint32_t block)
{
    return words[block / 2] >> block % 2 * SWIVEL_LANES & kAllLanes;
}

inline void add_lanes(std::uint32_t* words, std::uint32_t block, LaneMask lanes)
{
    words[block / 2] |= lanes << block % 2 * SWIVEL_LANES;
}

// The number of limbs in a block of a group; the block's other lanes are padding. block: counted within the group.
inline std::uint32_t limb_count_of(const Group& group, std::uint32_t block)
{
    const std::uint32_t left = group.limb_count - block * SWIVEL_LANES;
    return left < SWIVEL_LANES ? left : std::uint32_t{SWIVEL_LANES};
}
// The lanes of those limbs.
inline LaneMask lanes_of_limbs(const Group& group, std::uint32_t block)
{
    return kAllLanes >> (SWIVEL_LANES - limb_count_of(group, block));
}
// The lanes of those limbs that a mask of the crowd chooses; null chooses all.
inline LaneMask chosen_limbs(const Group& group, std::uint32_t block, const std::uint32_t* mask)
{
    const LaneMask limbs = lanes_of_limbs(group, block);
    return mask ? lanes_of(mask, group.first_block + block) & limbs : limbs;
}

// Words of a mask with a bit for each lane.
inline std::uint32_t mask_word_count(std::uint32_t block_count) { return (block_count + 1) / 2; }
// Words of a mask with a bit for each group.
inline std::uint32_t group_word_count(std::uint32_t group_count) { return (group_count + 31) / 32; }

// Bytes of the arena. The def must be valid, and full_def() must have filled it.
std::uint64_t crowd_bytes(const swivel_crowd_def& def);
// Lays a crowd out in an arena of crowd_bytes(def), aligned to 64, with swivel_crowd_create()'s inputs.
// Results are zeros until rest() gives them a pose.
swivel_crowd* place_crowd(const swivel_crowd_def& def, void* arena);
// Makes a group whose rows begin at `rows`, block_bytes() for each block. It gets neither its region and half-line nor
// its part in a body, and its results stay as they are.
void place_group(const GroupDef& def, std::uint32_t first_block, char* rows, Group& group);

}  // namespace swivel

// SPDX-License-Identifier: MIT
//
// A crowd in memory. It has one arena, laid out when the crowd is created: the crowd itself, its groups, and the rows
// of each.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "include/swivel/swivel_bodies.h"
#include "simd/body_rows.h"
#include "simd/kernels.h"
#include "simd/rows.h"
#include "simd/strip_rows.h"

namespace swivel {

struct Group {
    std::uint32_t first_block, block_count, limb_count;
    swivel_features asked;     // by the caller
    swivel_features features;  // the same, with what these bring and the library's own bits
    bool keeps;                // SWIVEL_KEEP_POSE
    swivel_euler_order shoulder_order, wrist_order;
    std::uint32_t input_row_count, result_row_count;
    std::uint16_t first_row[kFieldCount];  // of each field, among input or result rows
    float *input, *results;                // rows
    swivel_binding binding;
    const swivel_region* region;    // with SWIVEL_WITH_REGION: in the arena
    StageList stages[kPassCount];   // of each pass
    BodyLimb limb;                  // if it is of bodies
    std::size_t body_block_floats;  // the same: of a block of bodies in a workspace
};

// Whether a group counts a position from an origin. A prop on a joint has its place in the joint's frame.
inline bool has_origin(const Group& group, swivel_field field)
{
    return has_origin(group.features, field) && !(field == SWIVEL_PROP_POSITION && group.limb.prop.joint != 0);
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
    alignas(16) unsigned char schedule[64];  // what threads remember from one solve to the next (schedule.cpp)
    float* urgency;                          // of each block, where the caller keeps none (budget.cpp)
    std::uint8_t* done;                      // a byte for each block, of a solve on threads (schedule.cpp)
    std::uint32_t strip_blocks;              // of a workspace; 0: it has no whole limbs
    std::uint32_t workspace_count;
    float* workspaces;
    const swivel::BodyJoint* joints;  // of bodies: those that some group needs
    std::uint32_t joint_count;        // 0: free limbs
    std::uint32_t body_row_count;     // of a block of bodies in a workspace
    std::atomic<std::uint64_t> busy;  // a bit for each workspace that a call is using
    // Below 0, or what swivel_explain() warns of: the time in s of the first body of the last solve, if that is above
    // 1, or if it is 0 and the solve wrote its results over the pose.
    std::atomic<float> doubted_time;
    // The limbs that were reset since the last solve of poses, and how many solves in a row began with all bodies
    // reset.
    std::atomic<std::uint32_t> reset_limbs, solves_anew;
};

namespace swivel {

inline constexpr float kNoDoubt = -1;  // swivel_crowd::doubted_time

// With any of these features, a group's limbs are whole limbs.
inline constexpr swivel_features kLimbFeatures = ~(kFormulaFeatures | SWIVEL_POLE_DIRECTION);

inline constexpr std::uint32_t kMaxWorkspaces = 64;  // of a crowd
// A workspace: a strip of so many blocks, and the same blocks of bodies, if joints are needed.
inline std::size_t workspace_floats(std::uint32_t strip_blocks, std::uint32_t body_row_count)
{
    return strip_blocks * (kStripBlockFloats + std::size_t{body_row_count} * kLanes);
}
inline StripMemory strip_memory(float* workspace, std::uint32_t strip_blocks, std::uint32_t body_row_count)
{
    return {workspace, strip_blocks,
            body_row_count > 0 && workspace ? workspace + strip_blocks * kStripBlockFloats : nullptr};
}

// The groups that have lanes of their own: in a crowd of bodies the first one's are those of all.
inline std::uint32_t lane_group_count(const swivel_crowd& crowd)
{
    return crowd.joint_count > 0 ? 1 : crowd.group_count;
}

// Words of one bit for each lane; and of one for each group.
inline std::uint32_t mask_word_count(std::uint32_t block_count) { return (block_count + 1) / 2; }
inline std::uint32_t group_word_count(std::uint32_t group_count) { return (group_count + 31) / 32; }

// Bytes of the arena. The def must be valid, and full_def() must have filled it.
std::uint64_t crowd_bytes(const swivel_crowd_def& def);
// Lays a crowd out in arena, which is aligned to 64 and crowd_bytes(def) long: inputs as swivel_crowd_create() says.
// Results are zeros until rest() gives them a pose.
swivel_crowd* place_crowd(const swivel_crowd_def& def, void* arena);

}  // namespace swivel

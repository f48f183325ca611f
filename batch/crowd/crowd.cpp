// SPDX-License-Identifier: MIT
#include "batch/crowd/crowd.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>
#include <span>

#include "batch/crowd/plan.h"
#include "batch/crowd/rig.h"
#include "batch/crowd/streams.h"
#include "batch/refusal/sized.h"
#include "include/swivel/swivel_regions.h"
#include "simd/float_env.h"
#include "simd/rows.h"

namespace swivel {

namespace {

constexpr std::uint64_t aligned(std::uint64_t bytes)
{
    return (bytes + kArenaAlignment - 1) / kArenaAlignment * kArenaAlignment;
}

std::uint32_t blocks_in(const GroupDef& group) { return (group.limb_count - 1) / SWIVEL_LANES + 1; }

std::uint64_t group_row_bytes(const GroupDef& group)
{
    return aligned(std::uint64_t{blocks_in(group)} * block_bytes(group.features));
}

// Blocks of bodies in a workspace: about as many as fit a level 2 cache of 256 KiB with their poses.
std::uint32_t body_run_blocks(std::uint32_t row_count)
{
    constexpr std::size_t kRunBytes = 128 * 1024;
    const std::size_t blocks = kRunBytes / (row_count * kRowBytes);
    return static_cast<std::uint32_t>(std::clamp<std::size_t>(blocks, 1, kStripBlocks));
}

// Gives out aligned places in an arena, one after the other. Without memory it only counts bytes.
class Arena {
public:
    explicit Arena(void* memory) : memory_(static_cast<char*>(memory)) {}
    template <class T>
    T* take(std::uint64_t count)
    {
        T* const place = memory_ ? reinterpret_cast<T*>(memory_ + bytes_) : nullptr;
        bytes_ += aligned(count * sizeof(T));
        return place;
    }
    std::uint64_t bytes() const { return bytes_; }

private:
    char* memory_;
    std::uint64_t bytes_ = 0;  // also of a crowd that is too large for any memory
};

// The places of a crowd's parts in its arena.
struct Layout {
    std::uint32_t block_count = 0, strip_blocks = 0;
    BodySize bodies{};
    std::uint64_t row_bytes = 0, bytes;  // of all groups' rows; of everything
    swivel_crowd* crowd;
    Group* groups;
    swivel_region* regions;
    BodyJoint* joints;
    MovedJoint* moved;
    FollowingJoint* following;
    float* urgency;
    std::uint8_t* done;
    float* workspaces;
    SkeletonJoint* skeleton_joints;  // for the plan alone, where the workspaces will be
    char* rows;

    Layout(const swivel_crowd_def& def, void* memory)
    {
        std::uint64_t region_count = 0;
        for (std::uint32_t g = 0; g < def.group_count; ++g) {
            const GroupDef group = group_at(def, g);
            block_count = def.skeleton ? blocks_in(group) : block_count + blocks_in(group);
            row_bytes += group_row_bytes(group);
            region_count += group.features & SWIVEL_WITH_REGION ? 1 : 0;
            if (group.features & kLimbFeatures)
                strip_blocks = std::max(strip_blocks, std::min(blocks_in(group), kStripBlocks));
        }
        if (def.skeleton) {
            bodies = body_size(def);
            strip_blocks = std::min(strip_blocks, body_run_blocks(bodies.row_count));
        }
        Arena arena(memory);
        crowd = arena.take<swivel_crowd>(1);
        groups = arena.take<Group>(def.group_count);
        regions = arena.take<swivel_region>(region_count);
        joints = arena.take<BodyJoint>(bodies.joint_count);
        moved = arena.take<MovedJoint>(bodies.skeleton_joint_count);
        following = arena.take<FollowingJoint>(bodies.following_count);
        urgency = arena.take<float>(block_count);
        done = arena.take<std::uint8_t>(block_count);
        const std::uint64_t workspace_bytes =
            std::uint64_t{def.workspace_count} * workspace_floats(strip_blocks, bodies.row_count) * sizeof(float);
        char* const shared = arena.take<char>(std::max(workspace_bytes, skeleton_joint_bytes()));
        workspaces = reinterpret_cast<float*>(shared);
        skeleton_joints = reinterpret_cast<SkeletonJoint*>(shared);
        rows = arena.take<char>(row_bytes);
        bytes = arena.bytes();
    }
    std::uint64_t skeleton_joint_bytes() const
    {
        return std::uint64_t{bodies.skeleton_joint_count} * sizeof(SkeletonJoint);
    }
};

// Fills every lane, padding included, with an ordinary arm and neutral inputs.
void fill_inputs(const Group& group)
{
    for (std::uint32_t block = 0; block < group.block_count; ++block) {
        float* row = group.input + row_offset(std::size_t{block} * SWIVEL_LANES, group.input_row_count, 0);
        for (std::size_t f = 0; f < kInputCount; ++f)
            for (std::uint32_t c = 0; c < field_row_count(group.features, kFields[f].field); ++c)
                row = std::fill_n(row, std::size_t{SWIVEL_LANES}, kFields[f].start[c]);
    }
}

// Gives a group's limbs NaN for inputs without a sensible default. Until the caller gives them, a body's pose does, or
// they are bad input.
void unknown_inputs(const Group& group)
{
    constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
    float unknown[kMaxComponents];
    std::fill_n(unknown, kMaxComponents, kUnknown);
    for (const FieldRow& row : kFields) {
        const bool is_unknown =
            may_be_missing(row, group.features) || (row.field == SWIVEL_POLE && (group.features & kBody));
        if (!is_unknown || field_row_count(group.features, row.field) == 0) continue;
        const bool is_bound = row.field == SWIVEL_LENGTHS && (group.features & SWIVEL_JOINTS);
        copy_in(rows_of(group, row.field), 0, group.limb_count, {is_bound ? group.binding.lengths : unknown, 0});
    }
}

}  // namespace

void place_group(const GroupDef& def, std::uint32_t first_block, char* rows, Group& group)
{
    group.first_block = first_block;
    group.block_count = blocks_in(def);
    group.limb_count = def.limb_count;
    group.asked = def.asked;
    group.features = def.features;
    group.keeps_pose = def.on_bad_input == SWIVEL_KEEP_POSE;
    for (std::size_t pass = 0; pass < kPassCount; ++pass)
        group.stages[pass] = StageList(def.features, static_cast<Pass>(pass));
    group.shoulder_order = static_cast<swivel_euler_order>(def.shoulder_order);
    group.wrist_order = static_cast<swivel_euler_order>(def.wrist_order);
    group.input_row_count = input_row_count(def.features);
    group.result_row_count = result_row_count(def.features);
    for (std::size_t f = 0; f < kFieldCount; ++f)
        group.first_row[f] = static_cast<std::uint16_t>(field_first_row(def.features, kFields[f].field));
    group.input = reinterpret_cast<float*>(rows);
    group.results = reinterpret_cast<float*>(rows + std::size_t{group.block_count} * group.input_row_count * kRowBytes);
    if (!(def.features & kBody)) group.binding = element(&def.binding, 0, swivel_default_binding());
    fill_inputs(group);
    unknown_inputs(group);
}

std::uint64_t crowd_bytes(const swivel_crowd_def& def) { return Layout(def, nullptr).bytes; }

swivel_crowd* place_crowd(const swivel_crowd_def& def, void* arena)
{
    const FloatEnv env;
    Layout layout(def, arena);
    std::memset(arena, 0, static_cast<std::size_t>(layout.bytes));
    swivel_crowd* const crowd = new (layout.crowd) swivel_crowd{};
    crowd->alive = swivel_crowd::kAlive;
    crowd->doubted_time = kNoDoubt;
    crowd->group_count = def.group_count;
    crowd->block_count = layout.block_count;
    crowd->block_bytes = static_cast<std::size_t>(layout.row_bytes / layout.block_count);
    crowd->groups = layout.groups;
    crowd->arena = arena;
    crowd->arena_bytes = static_cast<std::size_t>(layout.bytes);
    crowd->urgency = layout.urgency;
    crowd->done = layout.done;
    crowd->strip_blocks = layout.strip_blocks;
    crowd->workspace_count = def.workspace_count;
    crowd->workspaces = layout.workspaces;
    crowd->joint_count = layout.bodies.joint_count;
    crowd->body_row_count = layout.bodies.row_count;
    JointPlan plan{};
    if (def.skeleton) {
        plan = plan_joints(def, layout.bodies, layout.skeleton_joints, layout.joints);
        crowd->joints = layout.joints;
    }
    std::span<MovedJoint> moved(layout.moved, layout.bodies.skeleton_joint_count);
    std::span<FollowingJoint> following(layout.following, static_cast<std::size_t>(layout.bodies.following_count));
    std::uint32_t first_block = 0, own_rows = layout.bodies.first_own_row;
    for (std::uint32_t g = 0; g < def.group_count; ++g) {
        const GroupDef group_def = group_at(def, g);
        Group& group = *new (crowd->groups + g) Group{};
        if (group_def.features & SWIVEL_WITH_REGION)
            group.region = new (layout.regions++) swivel_region(*group_def.region);
        place_group(group_def, first_block, layout.rows, group);
        if (def.skeleton) {
            if (group_def.joints) group.binding = body_binding(def, group_def);
            group.body_block_floats = std::size_t{crowd->body_row_count} * kLanes;
            group.plan.limb = plan_limb(plan, group_def, group.binding);
            group.plan.joints = plan_moved(plan, g, group_def, moved, following);
            plan_group(def, group_def, group.plan);
        }
        if (group_def.features & SWIVEL_POLE_HALF_LINE) {
            const bool is_bound = group_def.features & (SWIVEL_JOINTS | kBody);
            group.half_line = half_line(behind_in_arm(group_def.pole_behind, is_bound ? &group.binding : nullptr));
        }
        moved = moved.subspan(group.plan.joints.moved_count);
        following = following.subspan(group.plan.joints.following_count);
        own_rows = plan_own_rows(group_def.features, own_rows, group.plan);
        if (!def.skeleton) first_block += blocks_in(group_def);
        layout.rows += group_row_bytes(group_def);
    }
    if (def.skeleton) plan_links(def, plan, *crowd);
    // The plan is over, and workspaces start with zeros.
    std::memset(layout.workspaces, 0, static_cast<std::size_t>(layout.skeleton_joint_bytes()));
    return crowd;
}

}  // namespace swivel

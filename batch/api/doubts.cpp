// SPDX-License-Identifier: MIT
#include "batch/api/doubts.h"

#include <bit>
#include <optional>

#include "batch/crowd/streams.h"
#include "simd/float_env.h"

namespace swivel {

namespace {

// The first body that a job solves, or nullopt if it solves none.
std::optional<std::uint32_t> first_body(const Work& work)
{
    for (std::uint32_t block = work.blocks.first; block < work.blocks.first + work.blocks.count; ++block)
        if (const LaneMask bits = chosen_limbs(work.crowd.groups[0], block, work.mask))
            return block * SWIVEL_LANES + static_cast<std::uint32_t>(std::countr_zero(bits));
    return std::nullopt;
}

// Counts the solves in a row that began with all bodies reset.
void note_resets(swivel_crowd& crowd)
{
    const std::uint32_t reset = crowd.reset_limbs.exchange(0, std::memory_order_relaxed);
    if (reset >= crowd.groups[0].limb_count)
        crowd.solves_anew.fetch_add(1, std::memory_order_relaxed);
    else
        crowd.solves_anew.store(0, std::memory_order_relaxed);
}

// The first body's time in seconds if it is doubted: above a second, or 0 where the results replace the pose. Else
// kNoDoubt.
float doubted_time(const Work& work, const swivel_pose& pose)
{
    const std::optional<std::uint32_t> body = first_body(work);
    if (!body || !pose.time.data) return kNoDoubt;
    const auto time = value_at<float>(pose.time, *body);
    const bool is_in_place = !pose.results.data || pose.results.data == pose.rotations.data;
    return time > 1 || (time == 0 && is_in_place) ? time : kNoDoubt;
}

// Whether a job solves all bodies and all their groups. A mask counts as one that leaves bodies out.
bool covers_crowd(const Work& work)
{
    if (work.mask || work.blocks.count < work.crowd.block_count) return false;
    for (std::uint32_t g = 0; g < work.crowd.group_count; ++g)
        if (!is_named(work.groups, g)) return false;
    return true;
}

// The bits of PoseNote.
std::uint32_t notes_of(const Work& work, const swivel_pose& pose)
{
    if (!covers_crowd(work)) return kUnknownPose;
    std::uint32_t notes = 0;
    const bool is_shared = pose.time.stride == 0 || work.crowd.groups[0].limb_count == 1;
    if (pose.time.data && is_shared) {
        const auto time = value_at<float>(pose.time, 0);
        notes |= time >= 0 && time <= 1e15f ? kTimeIsGood : kTimeIsBad;
    }
    if (pose.support_position.data || pose.support_rotation.data) notes |= kHasSupport;
    if (pose.weight.data) notes |= kHasWeight;
    if (pose.root_is_double) notes |= kHasDoubleRoot;
    if (pose.root_rotation.data) notes |= kHasRootRotation;
    if (pose.root_scale.data) notes |= kHasRootScale;
    if (pose.scales.data || pose.form != SWIVEL_ROTATIONS) notes |= kHasJointScales;
    return notes;
}

}  // namespace

void note_doubts(const Work& work)
{
    const FloatEnv env;  // a time may be anything
    note_resets(work.crowd);
    const swivel_pose pose = full_pose(work.pose);
    work.crowd.doubted_time.store(doubted_time(work, pose), std::memory_order_relaxed);
    work.crowd.pose_notes.store(notes_of(work, pose), std::memory_order_relaxed);
}

}  // namespace swivel

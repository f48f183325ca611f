// SPDX-License-Identifier: MIT
//
// Bodies, run after run. A run is some blocks of bodies. Their poses are copied into a workspace, forward kinematics
// finds their limbs, every group's limbs are solved, and the joints go back, while all of it is in a near cache.
#include <algorithm>

#include "batch/pose.h"
#include "batch/share.h"
#include "simd/float_env.h"

namespace swivel {

namespace {

// One job's way through runs.
struct Runs {
    const Work& work;
    const swivel_pose pose = full_pose(work.pose);
    const StripMemory strip{work.strip.rows, work.strip.block_count, work.strip.bodies, &pose};
    const std::size_t block_floats = std::size_t{work.crowd.body_row_count} * kLanes;

    // Calls take(block) for the blocks of a run that have chosen bodies.
    template <class Take>
    void for_each_block(GroupBlocks run, const Take& take) const
    {
        const Group& any = work.crowd.groups[0];
        for (std::uint32_t n = 0; n < run.count; ++n) {
            const std::uint32_t block = run.first + n;
            const LaneMask lanes = work.mask ? chosen_limbs(any, block, work.mask) : lanes_of_limbs(any, block);
            if (lanes != 0) take(BodyBlock{strip.bodies + n * block_floats, block * SWIVEL_LANES, lanes});
        }
    }
    void solve(GroupBlocks run) const
    {
        const swivel_crowd& crowd = work.crowd;
        bool is_any_named = false;
        for_each_named(run, [&](const Group&, std::uint32_t) { is_any_named = true; });
        if (!is_any_named) return;
        const BodyPlan plan{crowd.joints, crowd.joint_count, &pose};
        for_each_block(run, [&](const BodyBlock& block) { work.kernels.bodies.forward(plan, block); });
        if (work.frames)
            for_each_named(run, [&](const Group& group, std::uint32_t n) {
                share(group, run, n, [&](const Share& of) { of.copy_in(work.mask, run); });
            });
        for (const swivel_features kind : {swivel_features{0}, kNoLimb})  // what limbs ask for, before it is given
            for_each_named(run, [&](const Group& group, std::uint32_t) {
                if ((group.features & kNoLimb) == kind) prepare_group(work.kernels, group, run, strip, work.mask);
            });
        for_each_named(run, [&](const Group& group, std::uint32_t n) {
            solve_group(work.kernels, group, run, strip, work.from_memory, work.mask);
            if (work.frames) share(group, run, n, [&](const Share& of) { of.copy_out(work.mask, run); });
            for_each_block(run,
                           [&](const BodyBlock& block) { pose_out(work.kernels.bodies, plan, group.limb, block); });
        });
        if (gives_joints(pose)) for_each_block(run, [&](const BodyBlock& block) { give_joints(plan, block); });
    }

private:
    void give_joints(const BodyPlan& plan, const BodyBlock& block) const
    {
        for (std::uint32_t g = 0; g < work.crowd.group_count; ++g)
            if (!is_named(work.groups, g)) stay(work.crowd.groups[g].limb, block);
        joints_out(work.kernels.bodies, plan, block);
    }
    // Calls take(group, n) for each group that is named; n counts them.
    template <class Take>
    void for_each_named(GroupBlocks run, const Take& take) const
    {
        for_each_group(work.crowd, work.groups, {run.first, run.count},
                       [&](const Group& group, GroupBlocks, std::uint32_t n) { take(group, n); });
    }
    // Calls copy(share) with the nth frame's part of a run.
    template <class Copy>
    void share(const Group& group, GroupBlocks run, std::uint32_t n, const Copy& copy) const
    {
        swivel_frame frame = frame_at(work.frames, n);
        frame.origin = origin_of(pose);
        Stream streams[kMostStreams];
        Share of;
        of.set({&group, run, frame}, run.count, streams);
        copy(of);
    }
};

}  // namespace

std::uint32_t run_count(const Work& work)
{
    return (work.blocks.count + work.crowd.strip_blocks - 1) / work.crowd.strip_blocks;
}

void solve_runs(const Work& work, std::uint32_t first, std::uint32_t end)
{
    const FloatEnv env;
    const Runs runs{work};
    const std::uint32_t blocks = work.crowd.strip_blocks;
    for (std::uint32_t run = first; run < end; ++run)
        runs.solve({work.blocks.first + run * blocks, std::min(blocks, work.blocks.count - run * blocks)});
}

}  // namespace swivel

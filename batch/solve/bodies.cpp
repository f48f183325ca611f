// SPDX-License-Identifier: MIT
//
// Bodies, run after run. A run is some blocks of bodies. Their poses are copied into a workspace, forward kinematics
// finds their limbs, every group's limbs are solved, and the joints go back, while all of it is in a near cache.
#include <algorithm>
#include <bit>

#include "batch/crowd/streams.h"
#include "batch/solve/pose.h"
#include "batch/solve/share.h"
#include "simd/float_env.h"

namespace swivel {

namespace {

// One job's way through runs.
struct Runs {
    const Work& work;
    FloatEnv& env;
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
        if (work.streams)
            for_each_named(run, [&](const Group& group, std::uint32_t n) {
                share(group, run, n, [&](const Share& part) { part.copy_in(work.mask, run); });
            });
        if (work.sample) {
            prepare(run, Pass::probe);
            for_each_named(run, [&](const Group& group, std::uint32_t) { sample(group, run); });
        }
        for (const Pass pass : {Pass::gather, Pass::shift}) prepare(run, pass);
        look(run, plan);
        for (const Pass pass : {Pass::grasp, Pass::hold}) prepare(run, pass);
        for_each_named(run, [&](const Group& group, std::uint32_t n) {
            solve_group(work.kernels, group, run, strip, work.from_memory, work.mask);
            if (work.streams) share(group, run, n, [&](const Share& part) { part.copy_out(work.mask, run); });
            if (group.limb.is_look) return;
            for_each_block(run,
                           [&](const BodyBlock& block) { pose_out(work.kernels.bodies, plan, group.limb, block); });
        });
        if (pose.space == SWIVEL_IN_BODY) carry_unnamed(run, plan);
        if (gives_joints(pose)) for_each_block(run, [&](const BodyBlock& block) { give_joints(plan, block); });
    }

private:
    void prepare(GroupBlocks run, Pass pass) const
    {
        for_each_named(run, [&](const Group& group, std::uint32_t) {
            prepare_group(work.kernels, group, pass, run, strip, work.mask);
        });
    }
    // The looks, one after the other. In the body's space, limbs below count on how all of them move.
    void look(GroupBlocks run, const BodyPlan& plan) const
    {
        for (std::uint32_t g = 0; g < work.crowd.group_count; ++g) {
            const Group& group = work.crowd.groups[g];
            if (!group.limb.is_look) continue;
            const bool is_solved = is_named(work.groups, g);
            if (is_solved) prepare_group(work.kernels, group, Pass::look, run, strip, work.mask);
            for_each_block(run, [&](const BodyBlock& block) {
                if (is_solved)
                    pose_out(work.kernels.bodies, plan, group.limb, block);
                else if (pose.space == SWIVEL_IN_BODY)
                    stay(group.limb, block);
            });
        }
    }
    // Joints in the body's space move with the looks above them, also where their own groups are not solved.
    void carry_unnamed(GroupBlocks run, const BodyPlan& plan) const
    {
        for (std::uint32_t g = 0; g < work.crowd.group_count; ++g) {
            const BodyLimb& limb = work.crowd.groups[g].limb;
            if (is_named(work.groups, g) || !hangs_on_solved(limb)) continue;
            for_each_block(run, [&](const BodyBlock& block) {
                stay(limb, block);
                carry_out(work.kernels.bodies, plan, limb, block);
            });
        }
    }
    bool hangs_on_solved(const BodyLimb& limb) const
    {
        if (limb.above == 0) return false;
        return is_named(work.groups, limb.above_group) || hangs_on_solved(work.crowd.groups[limb.above_group].limb);
    }
    // Asks the caller for the ground below a group's feet.
    void sample(const Group& group, GroupBlocks run) const
    {
        if (!(group.features & SWIVEL_WITH_GROUND)) return;
        constexpr std::size_t kMax = kStripBlocks * SWIVEL_LANES;
        std::uint32_t bodies[kMax];
        float places[kMax][3], grounds[kMax][3], normals[kMax][3];
        std::uint32_t count = 0;
        for_each_block(run, [&](const BodyBlock& block) {
            for (LaneMask lanes = block.lanes; lanes != 0; lanes &= lanes - 1)
                bodies[count++] = block.first + static_cast<std::uint32_t>(std::countr_zero(lanes));
        });
        if (count == 0) return;
        const FieldRows probe = rows_of(group, SWIVEL_PROBE), ground = rows_of(group, SWIVEL_GROUND),
                        normal = rows_of(group, SWIVEL_GROUND_NORMAL);
        for (std::uint32_t n = 0; n < count; ++n) {
            copy_out(probe, bodies[n], 1, {places[n], sizeof places[n]});
            copy_out(ground, bodies[n], 1, {grounds[n], sizeof grounds[n]});
            copy_out(normal, bodies[n], 1, {normals[n], sizeof normals[n]});
        }
        const auto g = static_cast<std::uint32_t>(&group - work.crowd.groups);
        const swivel_probes probes{g, count, bodies, places, grounds, normals};
        {
            const FloatEnv::Outside outside(env);
            work.sample(&probes, work.sample_user);
        }
        for (std::uint32_t n = 0; n < count; ++n) {
            copy_in(ground, bodies[n], 1, {grounds[n], 0});
            copy_in(normal, bodies[n], 1, {normals[n], 0});
        }
    }
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
    // Calls copy(share) with the nth group's part of a run.
    template <class Copy>
    void share(const Group& group, GroupBlocks run, std::uint32_t n, const Copy& copy) const
    {
        swivel_streams given = streams_at(work.streams, n);
        given.origin = origin_of(pose);
        Stream streams[kMaxStreams];
        Share part;
        part.set({&group, run, given}, run.count, streams);
        copy(part);
    }
};

}  // namespace

std::uint32_t run_count(const Work& work)
{
    return (work.blocks.count + work.crowd.strip_blocks - 1) / work.crowd.strip_blocks;
}

void solve_runs(const Work& work, std::uint32_t first, std::uint32_t end)
{
    FloatEnv env;
    const Runs runs{work, env};
    const std::uint32_t blocks = work.crowd.strip_blocks;
    for (std::uint32_t run = first; run < end; ++run)
        runs.solve({work.blocks.first + run * blocks, std::min(blocks, work.blocks.count - run * blocks)});
}

}  // namespace swivel

// SPDX-License-Identifier: MIT
//
// The poses of a strip of bodies are copied into a workspace, and forward kinematics finds their limbs. Then every
// group's limbs are solved, and the joints go back. All of it stays in a near cache.
#include "batch/solve/solve.h"

#include <algorithm>
#include <bit>

#include "batch/crowd/streams.h"
#include "batch/solve/group_copies.h"
#include "simd/float_env.h"

namespace swivel {

namespace {

// Takes a job's bodies through all passes, a strip at a time.
struct BodyStrips {
    const Work& work;
    FloatEnv& env;
    const swivel_pose pose = full_pose(work.pose);
    const StripMemory memory{work.strip.rows, work.strip.block_count, work.strip.bodies, &pose};
    const std::size_t block_floats = std::size_t{work.crowd.body_row_count} * kLanes;

    // Calls take(block) for the blocks of a strip that have chosen bodies.
    template <class Take>
    void for_each_block(GroupBlocks strip, const Take& take) const
    {
        const Group& any = work.crowd.groups[0];
        for (std::uint32_t n = 0; n < strip.count; ++n) {
            const std::uint32_t block = strip.first + n;
            const LaneMask lanes = chosen_limbs(any, block, work.mask);
            if (lanes != 0) take(BodyBlock{memory.bodies + n * block_floats, block * SWIVEL_LANES, lanes});
        }
    }
    void solve(GroupBlocks strip) const
    {
        const swivel_crowd& crowd = work.crowd;
        bool is_any_named = false;
        for_each_named(strip, [&](const Group&, std::uint32_t) { is_any_named = true; });
        if (!is_any_named) return;
        const BodyPlan plan{crowd.joints, crowd.joint_count, &pose};
        for_each_block(strip, [&](const BodyBlock& block) { work.kernels.bodies.forward(plan, block); });
        if (work.streams)
            for_each_named(strip, [&](const Group& group, std::uint32_t n) {
                with_copies(group, strip, n, [&](const GroupCopies& copies) { copies.copy_in(work.mask, strip); });
            });
        if (work.sample) {
            prepare(strip, Pass::probe);
            for_each_named(strip, [&](const Group& group, std::uint32_t) { sample(group, strip); });
        }
        for (const Pass pass : {Pass::gather, Pass::shift}) prepare(strip, pass);
        look(strip, plan);
        for (const Pass pass : {Pass::grasp, Pass::hold}) prepare(strip, pass);
        for_each_named(strip, [&](const Group& group, std::uint32_t n) {
            run_kernels(work.kernels, group, strip, memory, work.exceeds_cache, work.mask);
            if (work.streams)
                with_copies(group, strip, n, [&](const GroupCopies& copies) { copies.copy_out(work.mask, strip); });
            if (group.features & kLook) return;
            for_each_block(strip, [&](const BodyBlock& block) { pose_out(work.kernels.bodies, plan, group, block); });
        });
        if (pose.space == SWIVEL_IN_BODY) carry_unnamed(strip, plan);
        if (gives_joints(pose)) for_each_block(strip, [&](const BodyBlock& block) { give_joints(plan, block); });
    }

private:
    void prepare(GroupBlocks strip, Pass pass) const
    {
        for_each_named(strip, [&](const Group& group, std::uint32_t) {
            prepare_group(work.kernels, group, pass, strip, memory, work.mask);
        });
    }
    // The looks, one after the other. In the body's space, limbs below count on how all of them move.
    void look(GroupBlocks strip, const BodyPlan& plan) const
    {
        for (std::uint32_t g = 0; g < work.crowd.group_count; ++g) {
            const Group& group = work.crowd.groups[g];
            if (!(group.features & kLook)) continue;
            const bool is_solved = is_named(work.groups, g);
            if (is_solved) prepare_group(work.kernels, group, Pass::look, strip, memory, work.mask);
            for_each_block(strip, [&](const BodyBlock& block) {
                if (is_solved)
                    pose_out(work.kernels.bodies, plan, group, block);
                else if (pose.space == SWIVEL_IN_BODY)
                    stay(group, block);
            });
        }
    }
    // Joints in the body's space move with the looks above them, also where their own groups are not solved.
    void carry_unnamed(GroupBlocks strip, const BodyPlan& plan) const
    {
        for (std::uint32_t g = 0; g < work.crowd.group_count; ++g) {
            const Group& group = work.crowd.groups[g];
            if (is_named(work.groups, g) || !hangs_on_solved(work.crowd, work.groups, group)) continue;
            for_each_block(strip, [&](const BodyBlock& block) {
                stay(group, block);
                carry_out(work.kernels.bodies, plan, group, block);
            });
        }
    }
    // Asks the caller for the ground below a group's feet.
    void sample(const Group& group, GroupBlocks strip) const
    {
        if (!(group.features & SWIVEL_WITH_GROUND)) return;
        constexpr std::size_t kMax = kStripBlocks * SWIVEL_LANES;
        std::uint32_t bodies[kMax];
        float places[kMax][3], grounds[kMax][3], normals[kMax][3];
        std::uint32_t count = 0;
        for_each_block(strip, [&](const BodyBlock& block) {
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
            if (!is_named(work.groups, g)) stay(work.crowd.groups[g], block);
        joints_out(work.kernels.bodies, plan, block);
    }
    // Calls take(group, n) for each group that is named; n counts them.
    template <class Take>
    void for_each_named(GroupBlocks strip, const Take& take) const
    {
        for_each_group(work.crowd, work.groups, {strip.first, strip.count},
                       [&](const Group& group, GroupBlocks, std::uint32_t n) { take(group, n); });
    }
    // Calls take(copies) with the copies of the nth group's streams.
    template <class Take>
    void with_copies(const Group& group, GroupBlocks strip, std::uint32_t n, const Take& take) const
    {
        swivel_streams given = streams_at(work.streams, n);
        given.origin = origin_of(pose);
        Stream streams[kMaxStreams];
        GroupCopies copies;
        copies.set({&group, strip, given}, strip.count, streams);
        take(copies);
    }
};

}  // namespace

std::uint32_t strip_count(const Work& work)
{
    return (work.blocks.count + work.crowd.strip_blocks - 1) / work.crowd.strip_blocks;
}

void solve_strips(const Work& work, std::uint32_t first, std::uint32_t end)
{
    FloatEnv env;
    const BodyStrips strips{work, env};
    const std::uint32_t blocks = work.crowd.strip_blocks;
    for (std::uint32_t strip = first; strip < end; ++strip)
        strips.solve({work.blocks.first + strip * blocks, std::min(blocks, work.blocks.count - strip * blocks)});
}

}  // namespace swivel

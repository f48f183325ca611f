// SPDX-License-Identifier: MIT
//
// The promise: a body's bits depend on that body alone. They are the same on every instruction set, in every order of
// bodies, in chunks, on threads, masked, at any distances in memory, and far from the origin. No other byte changes.
#include <catch2/catch.hpp>

#include <algorithm>
#include <numeric>

#include "tests/body_stage.h"
#include "tests/test_isa_scope.h"

namespace {

using namespace swivel;
using namespace swivel::test;

}  // namespace

TEST_CASE("every instruction set gives the same poses")
{
    const IsaScope scope;
    const BodyStage stage(1);
    for (int form = 0; form <= SWIVEL_MATRIX_COLUMNS3; ++form) {
        std::vector<unsigned char> first;
        std::uint64_t digest = 0;
        for (std::uint32_t n = 0; const char* const isa = swivel_isa_at(n); ++n) {
            if (!swivel_isa_runs(isa)) continue;
            check(swivel_use_isa(isa));
            PoseBuffer poses(layout_of(form), stage.bodies);
            Crowd crowd = stage.crowd();
            solve_poses(crowd, poses.view());
            INFO(isa << ", form " << form);
            if (first.empty()) first = poses.bytes, digest = swivel_digest(crowd.get());
            REQUIRE(poses.bytes == first);
            REQUIRE(swivel_digest(crowd.get()) == digest);
        }
    }
}

TEST_CASE("a body's pose does not depend on its neighbours")
{
    const BodyStage stage(2);
    BodyStage other = stage;
    std::vector<std::size_t> order(kStageBodies);
    std::iota(order.begin(), order.end(), 0u);
    Random random{5};
    for (std::size_t n = kStageBodies; n > 1; --n)
        std::swap(order[n - 1], order[random.below(static_cast<std::uint32_t>(n))]);
    for (std::size_t n = 0; n < kStageBodies; ++n) {
        other.bodies[n] = stage.bodies[order[n]];
        other.weights[n] = stage.weights[order[n]];
        for (std::size_t g = 0; g < stage.goals.size(); ++g) other.goals[g][n] = stage.goals[g][order[n]];
    }
    PoseBuffer poses(layout_of(SWIVEL_ROTATIONS), stage.bodies), others(layout_of(SWIVEL_ROTATIONS), other.bodies);
    Crowd crowd = stage.crowd(), moved = other.crowd();
    solve_poses(crowd, poses.view());
    solve_poses(moved, others.view());
    // Joints that no limb turns keep their bytes, those in between among them.
    const PoseBuffer before(layout_of(SWIVEL_ROTATIONS), stage.bodies);
    std::vector<bool> is_turned(stage.skeleton.size());
    for (const BodyLimbJoints& limb : stage.skeleton.limbs)
        is_turned[limb.shoulder] = is_turned[limb.elbow] = is_turned[limb.wrist] = true;
    for (std::size_t n = 0; n < kStageBodies; ++n)
        for (std::size_t joint = 0; joint < is_turned.size(); ++joint) {
            const std::size_t at = n * poses.body_stride + joint * 16;
            REQUIRE((std::memcmp(&poses.bytes[at], &before.bytes[at], 16) == 0) == !is_turned[joint]);
        }
    for (std::size_t n = 0; n < kStageBodies; ++n) REQUIRE(pose_bits(others, n) == pose_bits(poses, order[n]));
}

TEST_CASE("poses may lie 16 bytes to 4 KiB apart, joint by joint or body by body")
{
    const BodyStage stage(3);
    PoseBuffer poses(layout_of(SWIVEL_ROTATIONS), stage.bodies);
    Crowd crowd = stage.crowd();
    solve_poses(crowd, poses.view());
    const std::size_t joints = stage.skeleton.size();
    for (const std::size_t stride : {std::size_t{0}, std::size_t{4096}, poses.body_stride + 4}) {
        // Without a stride: all bodies' first joints side by side, then all their second joints, from the last on.
        std::vector<std::size_t> offsets(joints);
        for (std::size_t joint = 0; joint < joints; ++joint)
            offsets[joint] = (joints - 1 - joint) * 16 * (stride == 0 ? kStageBodies : 1);
        const std::size_t step = stride == 0 ? 16 : stride;
        std::vector<unsigned char> bytes(kStageBodies * std::max(step, joints * 16) + joints * 16, 0xa5);
        for (std::size_t n = 0; n < kStageBodies; ++n)
            for (std::size_t joint = 0; joint < joints; ++joint)
                std::memcpy(&bytes[n * step + offsets[joint]], &stage.bodies[n].rotations[joint], 16);
        PoseBuffer apart(layout_of(SWIVEL_ROTATIONS), stage.bodies);  // translations, scales and roots
        swivel_pose pose = apart.view();
        pose.rotations = {bytes.data(), step, 0, offsets.data()};
        Crowd again = stage.crowd();
        solve_poses(again, pose);
        for (std::size_t n = 0; n < kStageBodies; ++n)
            for (std::size_t joint = 0; joint < joints; ++joint)
                REQUIRE(std::memcmp(&bytes[n * step + offsets[joint]], &poses.bytes[n * poses.body_stride + joint * 16],
                                    16) == 0);
        REQUIRE(swivel_digest(again.get()) == swivel_digest(crowd.get()));
    }
}

TEST_CASE("chunks, lists and threads give the same poses")
{
    const BodyStage stage(4, 3000);
    PoseBuffer whole(layout_of(SWIVEL_ROTATIONS), stage.bodies);
    Crowd crowd = stage.crowd();
    solve_poses(crowd, whole.view());  // on threads, as there is enough to do
    SECTION("chunks on this thread")
    {
        PoseBuffer poses(layout_of(SWIVEL_ROTATIONS), stage.bodies);
        Crowd other = stage.crowd();
        const swivel_pose pose = poses.view();
        std::vector<char> memory(swivel_workspace_bytes(other.get()) + 64);
        swivel_job job = swivel_default_job();
        job.pose = &pose;
        job.on_this_thread = 1;
        job.workspace = memory.data() + (64 - reinterpret_cast<std::uintptr_t>(memory.data()) % 64) % 64;
        for (std::uint32_t first = 0; first < swivel_block_count(other.get());) {
            const swivel_blocks blocks{first, std::min(7u, swivel_block_count(other.get()) - first)};
            job.blocks = &blocks;
            check(swivel_solve(other.get(), &job));
            first += blocks.count;
        }
        REQUIRE(poses.bytes == whole.bytes);
        REQUIRE(swivel_digest(other.get()) == swivel_digest(crowd.get()));
    }
    SECTION("a list of bodies; others' memory is not even there")
    {
        PoseBuffer poses(layout_of(SWIVEL_ROTATIONS), stage.bodies);
        Random random{9};
        std::vector<std::uint32_t> list;
        for (std::uint32_t n = 0; n < 3000; ++n)
            if (random.below(3) == 0)
                list.push_back(n);
            else
                std::fill_n(poses.bytes.begin() + static_cast<std::ptrdiff_t>(n * poses.body_stride), poses.body_stride,
                            static_cast<unsigned char>(0xff));
        const std::vector<unsigned char> before = poses.bytes;
        Crowd other = stage.crowd();
        const swivel_pose pose = poses.view();
        const swivel_limbs limbs{list.data(), static_cast<std::uint32_t>(list.size())};
        std::uint32_t solved = 0;
        swivel_job job = swivel_default_job();
        job.pose = &pose;
        job.limbs = &limbs;
        job.solved_count = &solved;
        check(swivel_solve(other.get(), &job));
        REQUIRE(solved == list.size());
        for (std::uint32_t n = 0; n < 3000; ++n) {
            const bool is_chosen = std::ranges::binary_search(list, n);
            const auto& wanted = is_chosen ? whole.bytes : before;
            REQUIRE(std::memcmp(&poses.bytes[n * poses.body_stride], &wanted[n * poses.body_stride],
                                poses.body_stride) == 0);
        }
    }
}

TEST_CASE("doubles far from the origin give the bits of floats near it")
{
    BodyStage stage(6);
    // Of so few digits that doubles far away hold them exactly.
    const auto shorten = [](Float3& v) {
        for (float& x : v) x = std::round(x * 65536) / 65536;
    };
    for (Body& body : stage.bodies) shorten(body.root_position);
    for (std::vector<BodyGoal>& goals : stage.goals)
        for (BodyGoal& goal : goals) shorten(goal.target), shorten(goal.pole);
    PoseBuffer near(layout_of(SWIVEL_ROTATIONS), stage.bodies);
    Crowd crowd = stage.crowd();
    solve_poses(crowd, near.view());

    constexpr double far[3] = {1048576.0 * 64, -1048576.0 * 32, 1048576.0 * 8};
    PoseBuffer poses(layout_of(SWIVEL_ROTATIONS), stage.bodies);
    swivel_pose pose = poses.view();
    struct Doubles {
        double at[3];
    };
    std::vector<Doubles> roots(kStageBodies);
    std::vector<std::vector<Doubles>> targets(stage.goals.size()), poles(stage.goals.size());
    const auto far_from = [&](const Float3& v) {
        return Doubles{{far[0] + double{v[0]}, far[1] + double{v[1]}, far[2] + double{v[2]}}};
    };
    for (std::size_t n = 0; n < kStageBodies; ++n) {
        roots[n] = far_from(stage.bodies[n].root_position);
        for (std::size_t g = 0; g < stage.goals.size(); ++g) {
            targets[g].push_back(far_from(stage.goals[g][n].target));
            poles[g].push_back(far_from(stage.goals[g][n].pole));
        }
    }
    std::vector<std::array<swivel_frame_field, 2>> fields;
    std::vector<swivel_frame> frames;
    for (std::size_t g = 0; g < stage.goals.size(); ++g)
        fields.push_back({swivel_frame_field{SWIVEL_TARGET, targets[g].data(), sizeof(Doubles)},
                          swivel_frame_field{SWIVEL_POLE, poles[g].data(), sizeof(Doubles)}});
    for (const auto& of : fields) {
        frames.push_back(swivel_default_frame());
        frames.back().fields = of.data();
        frames.back().field_count = 2;
    }
    pose.root_is_double = 1;
    pose.root_position = {roots.data(), sizeof(Doubles)};
    swivel_job job = swivel_default_job();
    job.pose = &pose;
    job.frames = frames.data();
    Crowd other = stage.crowd();
    check(swivel_solve(other.get(), &job));
    REQUIRE(swivel_digest(other.get()) == swivel_digest(crowd.get()));
    for (std::size_t n = 0; n < kStageBodies; ++n) REQUIRE(pose_bits(poses, n) == pose_bits(near, n));
}

TEST_CASE("results may go elsewhere, and the pose stays as it is")
{
    const BodyStage stage(7);
    for (int form = 0; form <= SWIVEL_MATRIX_COLUMNS3; ++form) {
        PoseBuffer in_place(layout_of(form), stage.bodies), from(layout_of(form), stage.bodies),
            to(layout_of(form), stage.bodies);
        const std::vector<unsigned char> before = from.bytes;
        Crowd crowd = stage.crowd(), other = stage.crowd();
        solve_poses(crowd, in_place.view());
        swivel_pose pose = from.view();
        pose.results = to.view().rotations;
        solve_poses(other, pose);
        REQUIRE(from.bytes == before);
        REQUIRE(to.bytes == in_place.bytes);
    }
}

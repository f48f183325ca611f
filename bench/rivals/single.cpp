// SPDX-License-Identifier: MIT
//
// One arm at a time on glm: problem P, and whole frames from and to pose buffers. Compiled once for each level.
// Flattened, so that no function of glm stays in the object for another level's linker to pick.
#include "bench/rivals/level.h"
#include "bench/rivals/two_bone.h"

namespace bench::SWIVEL_LEVEL {

namespace {

glm::vec3 vec3(const float* v) { return {v[0], v[1], v[2]}; }
glm::quat quat(const float (&q)[4]) { return {q[3], q[0], q[1], q[2]}; }

void store(const glm::quat& q, float (&to)[4]) { to[0] = q.x, to[1] = q.y, to[2] = q.z, to[3] = q.w; }

}  // namespace

[[gnu::flatten]] void solve_single(const SingleArm* arms, SinglePose* poses, std::size_t count)
{
    for (std::size_t n = 0; n < count; ++n) {
        const SingleArm& arm = arms[n];
        const TwoBone solved = solve_two_bone(vec3(arm.target), vec3(arm.pole), arm.upper, arm.fore);
        store(solved.shoulder, poses[n].shoulder);
        poses[n].cos_half = std::cos(solved.flexion / 2);
        poses[n].sin_half = std::sin(solved.flexion / 2);
        poses[n].flags = solved.flags;
    }
}

[[gnu::flatten]] void solve_frame(const FrameView& frame)
{
    for (std::size_t n = 0; n < frame.character_count; ++n)
        for (std::size_t side = 0; side < kArms; ++side) {
            const CharacterPose& world = frame.world[n];
            const auto& goal = frame.goals[n].arm[side];
            const Rig& rig = frame.rigs[side];

            const glm::quat parent_from_arm = quat(rig.parent_from_arm);
            const glm::quat arm_from_world = glm::conjugate(quat(world.chest.rotation) * parent_from_arm);
            const glm::vec3 shoulder_w = vec3(world.arm[side].shoulder.position);
            const float shrink = 1 / world.chest.scale[0];
            const glm::vec3 target = arm_from_world * (vec3(goal.wrist) - shoulder_w) * shrink;
            const glm::vec3 pole = arm_from_world * (vec3(goal.pole) - shoulder_w) * shrink;

            const TwoBone solved = solve_two_bone(target, pole, rig.upper, rig.fore);
            const glm::quat elbow = glm::angleAxis(-solved.flexion, glm::vec3(1, 0, 0));
            const glm::quat upper_from_arm = quat(rig.upper_from_arm), fore_from_arm = quat(rig.fore_from_arm);
            auto& local = frame.local[n].arm[side];
            store(parent_from_arm * solved.shoulder * glm::conjugate(upper_from_arm), local.shoulder.rotation);
            store(upper_from_arm * elbow * glm::conjugate(fore_from_arm), local.elbow.rotation);
        }
}

}  // namespace bench::SWIVEL_LEVEL

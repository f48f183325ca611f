// SPDX-License-Identifier: MIT
//
// A whole frame by ozz-animation's IKTwoBoneJob, as its users run it: one job an arm, on the joints' matrices, then
// both corrections times the joints' local rotations. Compiled once for each level, from the sources in SWIVEL_OZZ_DIR
// and with the flags of its own build, -O3, beside -march. Each level has its own namespace, so that the linker cannot
// take another level's code.
#define SWIVEL_JOINED_NAME(a, b) a##b
#define SWIVEL_JOINED(a, b) SWIVEL_JOINED_NAME(a, b)
#define ozz SWIVEL_JOINED(ozz_, SWIVEL_LEVEL)
#include <ozz/base/maths/simd_quaternion.h>
#include <src/animation/runtime/ik_two_bone_job.cc>

#include "bench/rivals/level.h"

namespace bench::SWIVEL_LEVEL {

namespace {

namespace math = ozz::math;

static_assert(sizeof(math::Float4x4) == sizeof(Matrix));
inline const math::Float4x4* matrix(const Matrix& m) { return reinterpret_cast<const math::Float4x4*>(&m); }

inline void turn(const float (&before)[4], const math::SimdQuaternion& correction, float (&after)[4])
{
    const math::SimdQuaternion local{math::simd_float4::LoadPtrU(before)};
    math::StorePtrU((local * correction).xyzw, after);
}

}  // namespace

[[gnu::flatten]] void solve_frame_ozz(const FrameView& frame, const OzzView& given)
{
    for (std::size_t n = 0; n < frame.character_count; ++n)
        for (std::size_t side = 0; side < kArms; ++side) {
            const auto& joints = given.models[n].arm[side];
            const auto& goal = frame.goals[n].arm[side];
            const auto& before = given.before[n].arm[side];
            auto& local = frame.local[n].arm[side];
            math::SimdQuaternion start, mid;
            ozz::animation::IKTwoBoneJob job;
            job.target = math::simd_float4::LoadPtrU(goal.wrist);
            job.pole_vector = math::simd_float4::LoadPtrU(goal.pole) - matrix(joints.shoulder)->cols[3];
            job.mid_axis = math::simd_float4::LoadPtrU(given.mid_axes[side]);
            job.start_joint = matrix(joints.shoulder);
            job.mid_joint = matrix(joints.elbow);
            job.end_joint = matrix(joints.wrist);
            job.start_joint_correction = &start;
            job.mid_joint_correction = &mid;
            if (!job.Run()) continue;
            turn(before.shoulder.rotation, start, local.shoulder.rotation);
            turn(before.elbow.rotation, mid, local.elbow.rotation);
        }
}

}  // namespace bench::SWIVEL_LEVEL

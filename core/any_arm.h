// SPDX-License-Identifier: MIT
//
// One arm in the arm frame, by the same two ways as the kernels take, for tests and swivel_verify(). The plain formula
// solves it where it holds. Any other arm is solved as a whole limb without further features, which kernels do in
// stages (simd/stages.h).
#pragma once

#include "core/limb_bones.h"
#include "core/solve_arm.h"
#include "core/wish.h"
#include "core/wrist_goal.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
ArmPose<T> solve_as_limb(const ArmGoal<T>& arm)
{
    constexpr swivel_features no_features = 0;
    LimbGoal<T> goal{};
    goal.arm = arm;
    WishGoal<T> wish_goal{};
    wish_goal.pole = arm.pole;
    const Mask<T> valid = is_valid(arm);
    const WristLine<T> target = wrist_line(arm.wrist);
    const PlacedBones<T, Hinge<T>> bones = place_bones(no_features, goal, target.wanted);
    const LimbNormal<T> wish = limb_normal(no_features, wish_goal, target.line);
    const Word<T> flags = bones.flags | wish.flags | word_where(target.on_shoulder, SWIVEL_SWIVEL_UNDEFINED);
    return {select(valid, lifted(target.line, wish.normal, bones.lift), one<T>()), select(valid, bones.cos_half, T(1)),
            select(valid, bones.sin_half, T(0)), select(valid, flags, word<T>(SWIVEL_BAD_INPUT)), valid};
}

// For one arm: T is float or double.
template <class T>
ArmPose<T> solve_arm(const ArmGoal<T>& goal)
{
    const PlainArm<T> plain = solve_plain(goal);
    return plain.holds ? plain.pose : solve_as_limb(goal);
}

}  // namespace swivel::inline SWIVEL_ISA

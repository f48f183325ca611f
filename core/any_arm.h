// SPDX-License-Identifier: MIT
//
// One arm in the arm frame, by the same two ways as the kernels take, for tests and swivel_verify(). The plain formula
// solves it where it holds. Any other arm is solved as a whole limb without features (limb.h).
#pragma once

#include "core/limb.h"
#include "core/solve_arm.h"

namespace swivel::inline SWIVEL_ISA {

// For one arm: T is float or double.
template <class T>
ArmPose<T> solve_arm(const ArmGoal<T>& goal)
{
    const PlainArm<T> plain = solve_plain(goal);
    if (plain.holds) return plain.pose;
    LimbGoal<T> limb{};
    limb.arm = goal;
    return solve_limb<false>(LimbUse{}, limb, true).arm;
}

}  // namespace swivel::inline SWIVEL_ISA

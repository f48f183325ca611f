// SPDX-License-Identifier: MIT
//
// Any arm in the arm frame, as kernels solve it: by the plain formula where it holds, else as a whole limb that uses
// nothing else. Degenerate and extreme arms are answered there (limb.h).
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

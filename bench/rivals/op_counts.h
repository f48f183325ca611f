// SPDX-License-Identifier: MIT
//
// What an arm costs, counted, and what that takes at least on a machine whose limits are known.
#pragma once

#include <algorithm>

#include "bench/rivals/machine.h"

namespace bench {

struct OpCounts {
    int roots = 0, divisions = 0, multiplications = 0;
    int additions = 0;    // and subtractions
    int comparisons = 0;  // of numbers
    int selects = 0;      // and all else that moves bits: signs, masks, flags

    int flops() const { return roots + divisions + multiplications + additions; }
    OpCounts& operator+=(const OpCounts& more)
    {
        roots += more.roots, divisions += more.divisions, multiplications += more.multiplications;
        additions += more.additions, comparisons += more.comparisons, selects += more.selects;
        return *this;
    }
};

// Operations of problem P, as kernels do it, on an ordinary arm: solve_arm() and the choice of the quaternion's sign.
OpCounts count_ops();
// Those of a production limb (production_limb.h) whose wish its limits allow: the formulas of its features, the
// parent's frame and the skeleton's joints. Checks of the inputs as they are given do not count.
OpCounts count_production_ops();
// Those of a body of character B (bodies.h) in two stages: forward kinematics of the joints that its limbs need, and
// its limbs, from the frames of their joints to new local rotations. Hands have goals, elbows keep their side.
struct BodyOps {
    OpCounts forward, limbs;
};
BodyOps count_body_ops();
// Those of a foot that stands on a support that is not turned, between two changes; and of a body's shift for two
// capped legs.
struct FeetOps {
    OpCounts plant, fit;
};
FeetOps count_feet_ops();
// Those of a look: spine, chest, neck and head turn to a target, eased, and the joints of both arms come along.
OpCounts count_look_ops();
// The sum over the stages of character C (character.h): all joints, two planted feet on ground, the body's shift, the
// look, the rifle's arm, the one that holds its grip, and the legs.
OpCounts count_character_ops();

// The least nanoseconds an arm for a kernel with these operations. The divider works on one root or division at a time.
// All other operations share the multipliers and adders. Comparisons, selects, loads and stores count as free.
struct PortBound {
    double divider_ns, arithmetic_ns;

    double ns() const { return std::max(divider_ns, arithmetic_ns); }
};
inline PortBound port_bound(const OpCounts& ops, const IsaLimits& limits)
{
    return {(ops.roots * limits.root_ns + ops.divisions * limits.division_ns) / limits.lanes,
            (ops.multiplications + ops.additions) / limits.flops_per_ns};
}

}  // namespace bench

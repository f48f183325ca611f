// SPDX-License-Identifier: MIT
#include "tools/crowd/limb_setups.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using formats::PoleKind;

void put(const Vector3d& v, double (&to)[3])
{
    for (int n = 0; n < 3; ++n) to[n] = v[n];
}

// The plan as the formula of goals takes it.
goal_plan goal_plan_of(const LimbPlan& plan, const Limb& limb)
{
    const auto as_solved = [&](const Vector3d& v) { return limb.mirrored ? formats::mirrored(v) : v; };
    goal_plan goals{};
    if (plan.target_point) put(as_solved(*plan.target_point), goals.target_point);
    put(as_solved(plan.target_offset), goals.target_offset);
    put(plan.effector, goals.effector);
    if (plan.pole_fixed) put(as_solved(*plan.pole_fixed), goals.pole_fixed);
    goals.has_target_point = plan.target_point.has_value();
    goals.has_pole_fixed = plan.pole_fixed.has_value();
    goals.pole = plan.pole == PoleKind::point    ? GOAL_POLE_POINT
                 : plan.pole == PoleKind::normal ? GOAL_POLE_NORMAL
                                                 : GOAL_POLE_DIRECTION;
    goals.hand_is_local = plan.has(SWIVEL_WITH_AIM);
    goals.is_mirrored = limb.mirrored;
    return goals;
}

}  // namespace

std::vector<LimbSetup> limb_setups(std::span<const Limb> limbs, const CrowdPlan& plan)
{
    std::vector<LimbSetup> setups;
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        const LimbPlan& limb = plan.limbs[n];
        setups.push_back({limbs[n].bound, limb.features, limb.shoulder_order, limb.wrist_order, limb.fields,
                          limb.priority, goal_plan_of(limb, limbs[n])});
    }
    return setups;
}

}  // namespace swivel::tools

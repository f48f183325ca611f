// SPDX-License-Identifier: MIT
#include "tools/crowd/carry_plan.h"

#include <algorithm>

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// Of arms: the box is held with bent elbows, in front of the belly.
constexpr double kSize[] = {0.65, 0.5, 0.5}, kPlace[] = {0, -0.5, 0.65};
constexpr double kPalm[] = {0.09, 0,
                            -0.15};  // a hand lies along the side: its wrist is beside it, and behind the middle

std::vector<Limb> arms_of(std::span<const Limb> limbs)
{
    std::vector<Limb> arms;
    std::ranges::copy_if(limbs, std::back_inserter(arms),
                         [](const Limb& limb) { return limb.name.kind == formats::LimbKind::arm; });
    return arms;
}

int chest_of(const formats::Clip& clip, std::span<const Limb> arms)
{
    const int first = joint_at(clip, arms[0].upper()).parent;
    return first < 0 ? first : fork_of(clip, first, arms[1].upper());
}

}  // namespace

bool can_carry(const formats::Clip& clip, std::span<const Limb> limbs)
{
    const std::vector<Limb> arms = arms_of(limbs);
    if (arms.size() != 2) return false;
    const int chest = chest_of(clip, arms);
    return chest >= 0 && rest_pose(clip)[static_cast<std::size_t>(chest)].scale > 0;
}

CarryPlan plan_carry(const formats::Clip& clip, std::span<const Limb> limbs, double share,
                     const std::optional<Vector3d>& size, const std::optional<Vector3d>& place, const Vector3d& up_w,
                     const Vector3d& faces_w)
{
    const std::vector<Limb> arms = arms_of(limbs);
    const std::vector<formats::JointPose> rest = rest_pose(clip);
    const auto at = [&](int joint) { return rest[static_cast<std::size_t>(joint)]; };
    double length = 0;
    for (const Limb& arm : arms) length += 0.5 * (double{arm.bound.lengths[0]} + double{arm.bound.lengths[1]});
    Eigen::Matrix3d axes_w;
    axes_w << up_w.cross(faces_w), up_w, faces_w;
    CarryPlan plan;
    plan.share = share;
    plan.size = size.value_or(length * Vector3d(kSize));
    plan.place = place.value_or(length * Vector3d(kPlace));
    plan.chest = chest_of(clip, arms);
    plan.palm = length * Vector3d(kPalm);
    const formats::JointPose chest = at(plan.chest);
    const Vector3d shoulders = 0.5 * (at(arms[0].upper()).position + at(arms[1].upper()).position);
    plan.middle = chest.rotation.conjugate() * (shoulders + axes_w * plan.place - chest.position) / chest.scale;
    plan.turn = chest.rotation.conjugate() * Quaterniond(axes_w);
    return plan;
}

Vector3d carrying_wrist(const CarryPlan& plan, formats::LimbName arm, std::span<const formats::JointPose> pose_w)
{
    const formats::JointPose& chest = pose_w[static_cast<std::size_t>(plan.chest)];
    Vector3d wrist = 0.5 * plan.size.x() * Vector3d::UnitX() + plan.palm;
    if (arm.side == formats::Side::right) wrist.x() = -wrist.x();
    return chest.position + chest.rotation * Vector3d(chest.scale * plan.middle + plan.turn * wrist);
}

}  // namespace swivel::tools

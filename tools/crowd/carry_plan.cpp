// SPDX-License-Identifier: MIT
#include "tools/crowd/carry_plan.h"

#include <algorithm>

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// In arm lengths: the box is held with bent elbows, in front of the belly.
constexpr double kSize[] = {0.65, 0.5, 0.5}, kPlace[] = {0, -0.5, 0.65};
// A hand lies along the side: its wrist is beside it, and behind the middle.
constexpr double kPalm[] = {0.09, 0, -0.15};

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

std::string why_not_carry(const formats::Clip& clip, std::span<const Limb> limbs)
{
    const std::vector<Limb> arms = arms_of(limbs);
    if (arms.size() != 2)
        return "takes both arms, and not both are solved; write limbs = \"arms\" or \"all\" in [crowd], see swivel rig "
               "FILE";
    const int chest = chest_of(clip, arms);
    if (chest < 0) return "goes along with the joint where both arms meet, and there is none; give the arms one";
    if (rest_pose(clip)[static_cast<std::size_t>(chest)].scale == 0)
        return "goes along with the joint where both arms meet, and that has no size; give it one";
    return {};
}

CarryPlan plan_carry(const formats::Clip& clip, std::span<const Limb> limbs, const formats::CarrySettings& asked,
                     double shortest, const Vector3d& up_w, const Vector3d& faces_w)
{
    std::vector<Limb> arms = arms_of(limbs);
    if (arms[1].name < arms[0].name) std::swap(arms[0], arms[1]);  // the left one first
    const std::vector<formats::JointPose> rest = rest_pose(clip);
    const auto at = [&](int joint) { return rest[static_cast<std::size_t>(joint)]; };
    double length = 0;
    for (const Limb& arm : arms) length += 0.5 * (double{arm.bound.lengths[0]} + double{arm.bound.lengths[1]});
    length *= shortest;
    Eigen::Matrix3d axes_w;
    axes_w << up_w.cross(faces_w), up_w, faces_w;
    const Vector3d left = at(arms[0].upper()).position, right = at(arms[1].upper()).position;
    CarryPlan plan;
    plan.share = asked.share;
    plan.size = asked.size ? asked.size->value : Vector3d(length * Vector3d(kSize));
    plan.place = asked.place ? asked.place->value : Vector3d(length * Vector3d(kPlace));
    plan.palm = length * Vector3d(kPalm);
    plan.left = axes_w.col(0).dot(left - right) < 0 ? -1 : 1;
    plan.chest = chest_of(clip, arms);
    const formats::JointPose chest = at(plan.chest);
    const Vector3d place(plan.left * plan.place.x(), plan.place.y(), plan.place.z());
    plan.middle = chest.rotation.conjugate() * (0.5 * (left + right) + axes_w * place - chest.position) / chest.scale;
    plan.turn = chest.rotation.conjugate() * Quaterniond(axes_w);
    return plan;
}

Vector3d carrying_wrist(const CarryPlan& plan, formats::LimbName arm, std::span<const formats::JointPose> pose_w)
{
    const formats::JointPose& chest = pose_w[static_cast<std::size_t>(plan.chest)];
    Vector3d wrist = 0.5 * plan.size.x() * Vector3d::UnitX() + plan.palm;
    wrist.x() *= arm.side == formats::Side::left ? plan.left : -plan.left;
    return chest.position + chest.rotation * Vector3d(chest.scale * plan.middle + plan.turn * wrist);
}

}  // namespace swivel::tools

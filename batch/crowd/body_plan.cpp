// SPDX-License-Identifier: MIT
#include <algorithm>

#include "batch/crowd/joint_plan.h"

namespace swivel {

namespace {

GroundRules ground_rules(const swivel_ground& ground)
{
    const double cos = ground.cos_max;  // of the whole angle
    return {.given = ground,
            .cos_half_max = static_cast<float>(sqrt(0.5 + 0.5 * cos)),
            .sin_half_max = static_cast<float>(sqrt(0.5 - 0.5 * cos)),
            .lift = spring_rule(ground.half_life)};
}

LookRules look_rules(const swivel_look_def& look)
{
    LookRules rules{};
    double left = 0;
    for (std::uint32_t n = look.joint_count; n-- > 0;) {
        left += double(look.share[n]);
        const double cos = look.cos_max[n];  // of the whole angle
        rules.joint[n] = {static_cast<float>(look.share[n] / left), static_cast<float>(sqrt(0.5 + 0.5 * cos)),
                          static_cast<float>(sqrt(0.5 - 0.5 * cos))};
    }
    rules.fade = {look.cos_none, static_cast<float>(1 / (double(look.cos_full) - look.cos_none)), look.fade_distance};
    const Vector<double> axis = normalise(vector<double>(look.axis[0], look.axis[1], look.axis[2]));
    for (std::size_t c = 0; c < 3; ++c) rules.eye[c] = look.eye[c], rules.axis[c] = static_cast<float>(axis.c[c]);
    rules.rate = look.rate;
    return rules;
}

// The first group with a feature, which must exist.
GroupDef first_with(const swivel_crowd_def& def, swivel_features feature)
{
    std::uint32_t g = 0;
    while (!(unlinked_group(def, g).features & feature)) ++g;
    return unlinked_group(def, g);
}
float rest_length(const swivel_crowd_def& def, const GroupDef& group)
{
    const swivel_binding binding = body_binding(def, group);
    return binding.lengths[0] + binding.lengths[1];
}

}  // namespace

void plan_group(const swivel_crowd_def& def, const GroupDef& group, GroupPlan& plan)
{
    constexpr double kLongest = 1e15;
    const Vector<double> up = normalise(vector<double>(def.up[0], def.up[1], def.up[2]));
    for (std::size_t c = 0; c < 3; ++c) plan.up[c] = static_cast<float>(up.c[c]);
    plan.limb.plant = plant_rules(group.plant);
    plan.shift = {group.shift.drop, group.shift.rise, spring_rule(group.shift.half_life)};
    if (group.features & SWIVEL_WITH_NEXT_TARGET) {
        const float ahead = first_with(def, kShift).shift.lookahead;
        plan.limb.per_ahead = static_cast<float>(std::min(1 / double(ahead), kLongest));
    }
    if (group.features & (SWIVEL_WITH_PLANT | kShift))
        plan.rest_length = rest_length(def, group.features & kShift ? first_with(def, SWIVEL_WITH_PELVIS_FIT) : group);
    if (group.features & SWIVEL_WITH_GROUND) plan.limb.ground = ground_rules(group.ground);
    plan.prop.max_move = group.prop.max_move;
    if (group.features & kLook) plan.look = look_rules(group.look);
}

void plan_links(const swivel_crowd_def& def, const JointPlan& plan, swivel_crowd& crowd)
{
    for (std::uint32_t g = 0; g < crowd.group_count; ++g) {
        const GroupDef group = unlinked_group(def, g);
        GroupPlan& planned = crowd.groups[g].plan;
        if (group.features & kProp && group.prop.joint >= 0) planned.prop.joint = plan.first_row_of(group.prop.joint);
        if (!(group.features & SWIVEL_WITH_LINK)) continue;
        GroupPlan& held = crowd.groups[group.link].plan;
        LinkPlan& link = planned.limb.link;
        link.group = group.link;
        link.is_prop = crowd.groups[group.link].features & kProp;
        link.row = link.is_prop ? held.prop.frame : held.limb.hand_frame;
        if (!link.is_prop) continue;
        if (held.prop.holder_count == 0) held.rest_length = rest_length(def, group);
        link.number = held.prop.holder_count++;
        link.holder = held.prop.frame + kHoldersRow + link.number * kHolderRows;
    }
}

swivel_binding body_binding(const swivel_crowd_def& def, const GroupDef& group)
{
    RestLimb limb;
    swivel_binding binding = swivel_default_binding();
    rest_limb(skeleton_of(def), joints_of(group), limb);
    bind(limb, binding);
    return binding;
}

}  // namespace swivel

// SPDX-License-Identifier: MIT
#include "batch/crowd/group_def.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "batch/crowd/body_joints.h"
#include "batch/refusal/sized.h"
#include "batch/refusal/status.h"

namespace swivel {

namespace {

swivel_group_def def_at(const swivel_crowd_def& def, std::uint32_t g)
{
    return element(def.groups, g, swivel_default_group_def());
}

constexpr swivel_features twist_bones(std::uint32_t count)
{
    return std::min<std::uint32_t>(count, SWIVEL_MAX_TWIST_BONES) * kOneTwistBone;
}

// The members that both kinds of limbs have.
template <class Limb>
void take_limb(const Limb& limb, GroupDef& group)
{
    group.asked = limb.features;
    group.features |= limb.features & kPublicFeatures;
    group.on_bad_input = number_of(limb.on_bad_input);
    group.shoulder_order = number_of(limb.shoulder_order);
    group.wrist_order = number_of(limb.wrist_order);
    group.region = limb.region;
    std::copy(std::begin(limb.pole_behind), std::end(limb.pole_behind), group.pole_behind);
}

bool is_linked_to(const swivel_crowd_def& def, std::uint32_t g)
{
    for (std::uint32_t other = 0; other < def.group_count; ++other) {
        const GroupDef group = unlinked_group(def, other);
        if (group.features & SWIVEL_WITH_LINK && group.link == g) return true;
    }
    return false;
}

// The size of a group's definition, if it is given.
template <class Def>
swivel_status check_size_of(std::uint32_t g, const char* what, const Def* def)
{
    if (!def) return SWIVEL_OK;
    char name[48];
    std::snprintf(name, sizeof name, "group %u: %s def", g, what);
    return check_size<Def>(name, size_of(def));
}

swivel_status check_group_def(const swivel_crowd_def& def, std::uint32_t g)
{
    const swivel_group_def group = def_at(def, g);
    const bool is_of_bodies = group.body_limb || group.look || group.prop || group.shift;
    const int given = (group.limb != nullptr) + (group.body_limb != nullptr) + (group.look != nullptr) +
                      (group.prop != nullptr) + (group.shift != nullptr);
    if (given != 1)
        return refuse("group %u has %d definitions; give one: limb, body_limb, look, prop or shift", g, given);
    if (is_of_bodies && !def.skeleton)
        return refuse("group %u is of bodies, but the crowd def has no skeleton; give it", g);
    if (!is_of_bodies && def.skeleton)
        return refuse(
            "group %u is of free limbs, but the crowd def has a skeleton; give a body_limb, or leave the skeleton out",
            g);
    swivel_status status = check_size_of(g, "limb", group.limb);
    if (status == SWIVEL_OK && group.limb)
        if (const std::uint32_t count = element(group.limb, 0, swivel_default_limb_def(0)).twist_bone_count;
            count > SWIVEL_MAX_TWIST_BONES)
            status = refuse("group %u: twist_bone_count is %u; it is 0 to %d", g, count, int{SWIVEL_MAX_TWIST_BONES});
    if (status == SWIVEL_OK) status = check_size_of(g, "body limb", group.body_limb);
    if (status == SWIVEL_OK) status = check_size_of(g, "look", group.look);
    if (status == SWIVEL_OK && group.look)
        status = check_reserved("look def", element(group.look, 0, swivel_default_look_def()));
    if (status == SWIVEL_OK) status = check_size_of(g, "prop", group.prop);
    if (status == SWIVEL_OK) status = check_size_of(g, "shift", group.shift);
    return status;
}

}  // namespace

GroupDef default_group()
{
    GroupDef group{};
    group.binding = swivel_default_binding();
    group.on_bad_input = SWIVEL_KEEP_POSE;
    group.link = UINT32_MAX;
    group.plant = swivel_default_plant();
    group.ground = swivel_default_ground();
    group.look = swivel_default_look_def();
    group.prop = swivel_default_prop_def();
    group.shift = swivel_default_shift_def();
    return group;
}

GroupDef unlinked_group(const swivel_crowd_def& def, std::uint32_t g)
{
    const swivel_group_def given = def_at(def, g);
    GroupDef group = default_group();
    if (given.limb) {
        const swivel_limb_def limb = element(given.limb, 0, swivel_default_limb_def(0));
        take_limb(limb, group);
        group.features |= twist_bones(limb.twist_bone_count);
        group.limb_count = limb.limb_count;
        group.binding = limb.binding;
        return group;
    }
    group.features = kOfBodies;
    group.limb_count = def.body_count;
    if (given.body_limb) {
        const swivel_body_limb_def limb = element(given.body_limb, 0, swivel_default_body_limb_def(nullptr));
        take_limb(limb, group);
        group.joints = limb.joints;
        group.link = limb.link;
        group.plant = limb.plant;
        group.ground = limb.ground;
        if (limb.joints) group.features |= twist_bones(joints_of(group).twist_bone_count);
        if (limb.features & (SWIVEL_WITH_PLANT | SWIVEL_WITH_LINK)) group.features |= kLibraryGoal;
    }
    if (given.look) group.features |= kLook, group.look = element(given.look, 0, swivel_default_look_def());
    if (given.prop) group.features |= kProp, group.prop = element(given.prop, 0, swivel_default_prop_def());
    if (given.shift) group.features |= kShift, group.shift = element(given.shift, 0, swivel_default_shift_def());
    return group;
}

GroupDef group_at(const swivel_crowd_def& def, std::uint32_t g)
{
    GroupDef group = unlinked_group(def, g);
    if (def.skeleton && group.features & SWIVEL_WITH_HAND && is_linked_to(def, g))
        group.features |= SWIVEL_WITH_HAND_TRANSFORM;
    return group;
}

swivel_status check_group_defs(const swivel_crowd_def& def)
{
    swivel_status status = check_size<swivel_group_def>("the first group def", size_of(def.groups));
    for (std::uint32_t g = 0; g < def.group_count && status == SWIVEL_OK; ++g) {
        status = check_element("group def", def.groups, g);
        if (status == SWIVEL_OK) status = check_group_def(def, g);
    }
    return status;
}

}  // namespace swivel

// SPDX-License-Identifier: MIT
#include <cstdio>
#include <cstring>
#include <string_view>

#include "batch/crowd/body_joints.h"
#include "batch/refusal/status.h"
#include "core/arm.h"

namespace swivel {

namespace {

// Fails with the last error's line, after the name of a group or the skeleton.
swivel_status fail_in(const char* what, swivel_status status)
{
    constexpr char call[] = "swivel_bind_joints: ";
    char line[256];
    std::snprintf(line, sizeof line, "%s", last_error());
    const bool names_call = std::strncmp(line, call, sizeof call - 1) == 0;
    return fail(status, "%s: %s", what, line + (names_call ? sizeof call - 1 : 0));
}

// Checks a group's constants against the table's bounds. Numbers for joints that a look lacks may be any.
swivel_status check_constants(std::uint32_t g, const GroupDef& group, std::string_view structure)
{
    for (const ConstantRow& row : constants()) {
        if (structure != row.structure) continue;
        const float* const values = values_of(group, row);
        const std::uint32_t count = row.is_of_each_joint() ? group.look.joint_count : row.count;
        for (std::uint32_t n = 0; n < count; ++n) {
            if (values[n] >= row.min && values[n] <= row.max) continue;
            char which[16] = "";
            if (row.count > 1) std::snprintf(which, sizeof which, "[%u]", n);
            return refuse("group %u, %s.%s%s is %g; it is %g to %g", g, row.structure, row.name, which,
                          double(values[n]), double(row.min), double(row.max));
        }
    }
    return SWIVEL_OK;
}
swivel_status check_plant(std::uint32_t g, const GroupDef& group)
{
    const swivel_status status = check_constants(g, group, "plant");
    if (status == SWIVEL_OK && group.plant.unlock_radius < group.plant.lock_radius)
        return refuse("group %u, plant.unlock_radius is %g, less than plant.lock_radius, %g; let it be no less", g,
                      double(group.plant.unlock_radius), double(group.plant.lock_radius));
    return status;
}

double length2_of(const float (&v)[3]) { return double(v[0]) * v[0] + double(v[1]) * v[1] + double(v[2]) * v[2]; }

// A shift needs limbs WITH_PELVIS_FIT, and these need a shift.
swivel_status check_fits(const swivel_crowd_def& def)
{
    std::uint32_t shifts = 0, limbs = 0, shift = 0, limb = 0;  // how many, and the last of each
    for (std::uint32_t g = 0; g < def.group_count; ++g) {
        const swivel_features features = unlinked_group(def, g).features;
        if (features & kShift && ++shifts > 1)
            return refuse("group %u is a shift, and group %u too; a body has one", g, shift);
        if (features & kShift) shift = g;
        if (features & SWIVEL_WITH_PELVIS_FIT) limb = g, ++limbs;
    }
    if (shifts == 1 && limbs == 0)
        return refuse("group %u is a body's shift, but no limb is SWIVEL_WITH_PELVIS_FIT; add it to one", shift);
    if (shifts == 0 && limbs > 0)
        return refuse("group %u is SWIVEL_WITH_PELVIS_FIT, but no group is a body's shift; add one", limb);
    if (const double length2 = length2_of(def.up); !(length2 >= kTiny2 && length2 <= kHuge2))
        return refuse("crowd def's up is %g, %g, %g; give an axis", double(def.up[0]), double(def.up[1]),
                      double(def.up[2]));
    return SWIVEL_OK;
}

swivel_status check_ground(std::uint32_t g, const GroupDef& group)
{
    const float(&heel)[3] = group.ground.heel;
    if (!(length2_of(heel) <= kHuge2))
        return refuse("group %u, ground.heel is %g, %g, %g; give a place in the wrist's frame", g, double(heel[0]),
                      double(heel[1]), double(heel[2]));
    return check_constants(g, group, "ground");
}

// Checks that a limb is linked to a prop or to an earlier limb with a hand.
swivel_status check_link(const swivel_crowd_def& def, std::uint32_t g)
{
    const GroupDef group = unlinked_group(def, g);
    if (group.link == UINT32_MAX)
        return refuse("group %u is SWIVEL_WITH_LINK, but is linked to none; set its link to a group's number", g);
    if (group.link >= def.group_count)
        return refuse("group %u is linked to group %u, which does not exist; there are %u", g, group.link,
                      def.group_count);
    const swivel_features to = unlinked_group(def, group.link).features;
    if (to & kProp) return SWIVEL_OK;
    if (to & kNoLimb)
        return refuse("group %u is linked to group %u, which is %s and has no hand; link it to a limb or a prop", g,
                      group.link, text_of(kind_of(to)));
    if (group.link >= g)
        return refuse("group %u is linked to group %u, which is solved later; let a limb come after the one it holds",
                      g, group.link);
    if (!(to & SWIVEL_WITH_HAND))
        return refuse("group %u is linked to group %u, which has no hand; add SWIVEL_WITH_HAND to that", g, group.link);
    return SWIVEL_OK;
}
swivel_status check_prop(const swivel_crowd_def& def, const swivel_skeleton& skeleton, std::uint32_t g)
{
    const GroupDef prop_group = unlinked_group(def, g);
    const swivel_prop_def& prop = prop_group.prop;
    std::uint32_t holders = 0;
    for (std::uint32_t other = 0; other < def.group_count; ++other) {
        const GroupDef group = unlinked_group(def, other);
        if (group.features & kLook) continue;  // a look is done before
        holders += group.features & SWIVEL_WITH_LINK && group.link == g;
        if (prop.joint < 0) continue;
        for (const std::uint32_t joint : TurnedJoints(skeleton, group))
            if (is_above(skeleton, joint, static_cast<std::uint32_t>(prop.joint)))
                return refuse("group %u, prop.joint is %d, which group %u moves; link the limbs to that group instead",
                              g, prop.joint, other);
    }
    if (holders == 0 || holders > kMaxHolders)
        return refuse("group %u is a prop, and %u limbs are linked to it; link one or %u", g, holders, kMaxHolders);
    return check_constants(g, prop_group, "prop");
}
swivel_status check_held(const swivel_crowd_def& def, const swivel_skeleton& skeleton)
{
    swivel_status status = SWIVEL_OK;
    for (std::uint32_t g = 0; g < def.group_count && status == SWIVEL_OK; ++g) {
        const swivel_features features = unlinked_group(def, g).features;
        if (features & SWIVEL_WITH_LINK) status = check_link(def, g);
        if (status == SWIVEL_OK && features & kProp) status = check_prop(def, skeleton, g);
    }
    return status;
}

swivel_status check_look_constants(std::uint32_t g, const GroupDef& group)
{
    const swivel_look_def& look = group.look;
    if (const double length2 = length2_of(look.axis); !(length2 >= kTiny2 && length2 <= kHuge2))
        return refuse("group %u, look.axis is %g, %g, %g; give an axis", g, double(look.axis[0]), double(look.axis[1]),
                      double(look.axis[2]));
    if (!(length2_of(look.eye) <= kHuge2))
        return refuse("group %u, look.eye is %g, %g, %g; give a place in the last joint's frame", g,
                      double(look.eye[0]), double(look.eye[1]), double(look.eye[2]));
    if (const swivel_status status = check_constants(g, group, "look"); status != SWIVEL_OK) return status;
    if (!(look.share[look.joint_count - 1] > 0))
        return refuse("group %u, look.share of the last joint is 0; let it be more", g);
    if (!(look.cos_full - look.cos_none >= 1e-3f))
        return refuse("group %u, look.cos_full is %g, look.cos_none %g; they are -1 to 1, and cos_full is 0.001 more",
                      g, double(look.cos_full), double(look.cos_none));
    return SWIVEL_OK;
}
swivel_status check_look(const swivel_skeleton& skeleton, std::uint32_t g, const GroupDef& group)
{
    const swivel_look_def& look = group.look;
    if (look.joint_count == 0 || look.joint_count > SWIVEL_MAX_LOOK_JOINTS)
        return refuse("group %u, look.joint_count is %u; it is 1 to %d", g, look.joint_count,
                      int{SWIVEL_MAX_LOOK_JOINTS});
    for (std::uint32_t n = 0; n < look.joint_count; ++n) {
        const std::uint32_t joint = look.joints[n];
        if (joint >= skeleton.joint_count)
            return refuse("group %u, look.joints[%u] is %u; the skeleton has %u joints", g, n, joint,
                          skeleton.joint_count);
        if (const swivel_status status = check_parents(skeleton, "the chain", joint); status != SWIVEL_OK)
            return fail_in("the skeleton", status);
        if (n > 0 && (joint == look.joints[n - 1] || !is_above(skeleton, look.joints[n - 1], joint)))
            return refuse(
                "group %u, look.joints[%u], joint %u, is not below the one before, joint %u; name them from the body "
                "outwards",
                g, n, joint, look.joints[n - 1]);
    }
    return check_look_constants(g, group);
}

swivel_status check_group_joints(const swivel_crowd_def& def, const swivel_skeleton& skeleton, std::uint32_t g)
{
    const GroupDef group = unlinked_group(def, g);
    if (!(group.features & kNoLimb) && !group.joints)
        return refuse("group %u names no joints; give it those of the body's limb", g);
    if (const std::int32_t joint = group.prop.joint;
        group.features & kProp &&
        (joint < -1 || (joint >= 0 && static_cast<std::uint32_t>(joint) >= skeleton.joint_count)))
        return refuse("group %u, prop.joint is %d; it is -1, or one of the skeleton's %u joints", g, joint,
                      skeleton.joint_count);
    if (group.features & kShift) return check_constants(g, group, "shift");
    if (group.features & kLook) return check_look(skeleton, g, group);
    if (!group.joints) return SWIVEL_OK;
    RestLimb limb;
    swivel_binding binding = swivel_default_binding();
    const swivel_limb_joints joints = joints_of(group);
    swivel_status status = check_size<swivel_limb_joints>("limb joints", size_of(group.joints));
    if (status == SWIVEL_OK) status = check_reserved("limb joints", joints);
    if (status == SWIVEL_OK) status = rest_limb(skeleton, joints, limb);
    if (status == SWIVEL_OK) status = bind(limb, binding);
    if (status == SWIVEL_OK && group.features & SWIVEL_WITH_CLAVICLE && parent_of(skeleton, joints.shoulder) < 0)
        status =
            refuse("the shoulder, joint %u, has no parent that could be its clavicle; leave SWIVEL_WITH_CLAVICLE out",
                   joints.shoulder);
    if (status == SWIVEL_OK) {
        if (group.features & SWIVEL_WITH_PLANT) status = check_plant(g, group);
        if (status == SWIVEL_OK && group.features & SWIVEL_WITH_GROUND) status = check_ground(g, group);
        return status;
    }
    char name[24];
    std::snprintf(name, sizeof name, "group %u", g);
    return fail_in(name, status);
}

// No limb may turn a joint above a joint that another group turns. A look may be above limbs and above later looks.
swivel_status check_apart(const swivel_crowd_def& def, const swivel_skeleton& skeleton, std::uint32_t g)
{
    const GroupDef group = unlinked_group(def, g);
    const TurnedJoints turned(skeleton, group);
    for (std::uint32_t other = 0; other < def.group_count; ++other) {
        if (other == g) continue;
        const GroupDef below = unlinked_group(def, other);
        const bool may_be_above = group.features & kLook && (!(below.features & kLook) || g < other);
        for (const std::uint32_t joint : TurnedJoints(skeleton, below))
            for (const std::uint32_t above : turned)
                if (is_above(skeleton, above, joint) && !(may_be_above && above != joint))
                    return refuse("group %u turns joint %u, which is %s joint %u of group %u; %s", g, above,
                                  above == joint ? "also" : "above", joint, other,
                                  group.features & below.features & kLook && above != joint
                                      ? "let the look that is above come first"
                                      : "a body's limbs hang beside each other, and looks above them");
    }
    return SWIVEL_OK;
}

// Refuses a skeleton in which a needed joint has no valid rest pose.
swivel_status check_needed(const swivel_crowd_def& def, const swivel_skeleton& skeleton)
{
    RestJoint rest;
    std::uint32_t bad = skeleton.joint_count;
    for (std::uint32_t g = 0; g < def.group_count; ++g)
        for (const std::uint32_t end : NeededEnds(unlinked_group(def, g)))
            for (auto at = static_cast<std::int32_t>(end); at >= 0;) {
                const auto joint = static_cast<std::uint32_t>(at);
                if (joint < bad && read_joint(skeleton, joint, rest) != SWIVEL_OK) bad = joint;
                at = parent_of(skeleton, joint);
            }
    return bad < skeleton.joint_count ? read_joint(skeleton, bad, rest) : SWIVEL_OK;
}

// All joints may move with a limb, and the needed ones' translations may be those of poses.
swivel_status check_skeleton(const swivel_crowd_def& def, const swivel_skeleton& skeleton)
{
    swivel_status status = SWIVEL_OK;
    for (std::uint32_t joint = 0; joint < skeleton.joint_count && status == SWIVEL_OK; ++joint)
        status = check_parents(skeleton, "the chain", joint);
    if (status == SWIVEL_OK) status = check_needed(def, skeleton);
    return status == SWIVEL_OK ? status : fail_in("the skeleton", status);
}

}  // namespace

swivel_status check_bodies(const swivel_crowd_def& def)
{
    swivel_status status = check_size<swivel_skeleton>("skeleton", size_of(def.skeleton));
    const swivel_skeleton skeleton = skeleton_of(def);
    if (status == SWIVEL_OK) status = check_reserved("skeleton", skeleton);
    for (std::uint32_t g = 0; g < def.group_count && status == SWIVEL_OK; ++g)
        status = check_group_joints(def, skeleton, g);
    for (std::uint32_t g = 0; g < def.group_count && status == SWIVEL_OK; ++g) status = check_apart(def, skeleton, g);
    if (status == SWIVEL_OK) status = check_fits(def);
    if (status == SWIVEL_OK) status = check_skeleton(def, skeleton);
    return status == SWIVEL_OK ? check_held(def, skeleton) : status;
}

}  // namespace swivel

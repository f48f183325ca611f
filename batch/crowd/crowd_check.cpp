// SPDX-License-Identifier: MIT
//
// The checks of a crowd's definition and of its groups: features, binding, region and half-line. Those of skeletons are
// in body_check.cpp.
#include "batch/crowd/group_def.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <utility>

#include "batch/crowd/crowd.h"
#include "batch/crowd/rig.h"
#include "batch/refusal/sized.h"
#include "batch/refusal/status.h"
#include "batch/region/region.h"
#include "simd/float_env.h"
#include "simd/rows.h"

namespace swivel {

namespace {

constexpr std::uint64_t kMaxLimbs = 1u << 31;

bool is_zero(float x) { return x == 0; }

swivel_status check_binding(std::uint32_t group, const swivel_binding& binding, std::uint32_t twist_bones)
{
    if (std::all_of(std::begin(binding.parent_from_arm), std::end(binding.parent_from_arm), is_zero))
        return refuse("group %u has no binding; make it with swivel_bind_joints()", group);
    if (const swivel_status status = check_size<swivel_binding>("the group's binding", size_of(&binding));
        status != SWIVEL_OK)
        return status;
    if (!is_binding(binding))
        return refuse("group %u's binding holds a quaternion not of unit length; make it with swivel_bind_joints()",
                      group);
    if (std::all_of(std::begin(binding.lengths), std::end(binding.lengths), is_zero))
        return refuse(
            "group %u's binding has bones of length 0; make it with swivel_bind_joints(), or give NaN for lengths that "
            "are written later",
            group);
    if (twist_bones > 0 && binding.twist_bone_count > 0 && binding.twist_bone_count != twist_bones)
        return refuse(
            "group %u's binding has %u twist bones, the group %u; bind that many, or give it as many as are bound",
            group, binding.twist_bone_count, twist_bones);
    return SWIVEL_OK;
}

// These features, those that they need, and those that these need in turn.
constexpr swivel_features with_needs(swivel_features features)
{
    for (std::size_t n = std::size(kFeatures); n-- > 0;)
        if (features & kFeatures[n].feature) features |= kFeatures[n].needs;
    return features;
}
static_assert(
    [] {
        swivel_features before = 0;
        for (const FeatureRow& row : kFeatures) {
            if (row.needs & ~before) return false;
            before |= row.feature;
        }
        return true;
    }(),
    "what a feature needs stands before it, so one pass from the end finds all");

// Names all that the features of a group lack at once.
swivel_status check_needs(std::uint32_t group, swivel_features asked, swivel_features features)
{
    const swivel_features missing = with_needs(asked) & ~features;
    if (missing == 0) return SWIVEL_OK;
    const char* first = nullptr;
    std::uint32_t lacking_count = 0;
    for (const FeatureRow& row : kFeatures)
        if (asked & row.feature && with_needs(row.feature) & missing && lacking_count++ == 0) first = row.name;
    char names[256];
    std::size_t used = 0;
    swivel_features left = missing;
    for (const FeatureRow& row : kFeatures) {
        if (!(left & row.feature)) continue;
        left &= ~row.feature;
        const char* const separator = used == 0 ? "" : left == 0 ? " and " : ", ";
        const int length = std::snprintf(names + used, sizeof names - used, "%sSWIVEL_%s", separator, row.name);
        used = std::min(used + static_cast<std::size_t>(length), sizeof names - 1);
    }
    return refuse("group %u: SWIVEL_%s %s %s; add %s", group, first, lacking_count > 1 ? "and others need" : "needs",
                  names, std::has_single_bit(missing) ? "it" : "them");
}

// Features that the kind of group may have and that go together. features: those asked for, and what the
// library adds.
swivel_status check_features(std::uint32_t group, swivel_features asked, swivel_features features)
{
    if (const swivel_features unknown = asked & ~kKnownFeatures)
        return refuse("group %u asks for unknown features: bits 0x%llx", group,
                      static_cast<unsigned long long>(unknown));
    for (const FeatureRow& row : kFeatures) {
        if (!(asked & row.feature)) continue;
        if (const swivel_kind kind = kind_of(features); !(row.kinds >> kind & 1))
            return refuse("group %u: SWIVEL_%s is not for %s; leave it out", group, row.name, text_of(kind));
        if (const swivel_features excluded = row.excludes & features)
            return refuse("group %u: SWIVEL_%s excludes SWIVEL_%s; leave one out", group, row.name,
                          feature_name(excluded));
    }
    if (const swivel_status status = check_needs(group, asked, features); status != SWIVEL_OK) return status;
    if (twist_bone_count(features) > 0 && !(features & SWIVEL_WITH_HAND))
        return refuse("group %u: twist bones need SWIVEL_WITH_HAND; add it", group);
    return SWIVEL_OK;
}

swivel_status check_group_region(std::uint32_t g, const GroupDef& group)
{
    const bool has = group.features & SWIVEL_WITH_REGION;
    if (has && !group.region) return refuse("group %u: SWIVEL_WITH_REGION needs a region; give it", g);
    if (!has && group.region) return refuse("group %u has a region, but not SWIVEL_WITH_REGION; add it", g);
    if (!has) return SWIVEL_OK;
    char name[24];
    std::snprintf(name, sizeof name, "group %u", g);
    if (const swivel_status status = check_region(name, group.region); status != SWIVEL_OK) return status;
    if (group.region->part_count == 0)
        return refuse("group %u: the region allows nothing; add cones or a polygon to it", g);
    return SWIVEL_OK;
}

// A body's limb with the feature is checked with its joints (body_check.cpp).
swivel_status check_half_line(std::uint32_t g, const GroupDef& group)
{
    const auto& behind = group.pole_behind;
    const bool has = group.features & SWIVEL_POLE_HALF_LINE;
    if (!has && !std::all_of(std::begin(behind), std::end(behind), is_zero))
        return refuse("group %u has a pole_behind, but not SWIVEL_POLE_HALF_LINE; add it", g);
    if (!has || group.features & kBody) return SWIVEL_OK;
    return check_pole_behind(g, behind, group.features & SWIVEL_JOINTS ? &group.binding : nullptr);
}

swivel_status check_group(std::uint32_t g, const GroupDef& group)
{
    if (group.limb_count == 0) return refuse("group %u has no limbs; give at least one", g);
    if (const swivel_status status = check_features(g, group.asked, group.features); status != SWIVEL_OK) return status;
    if (group.on_bad_input > SWIVEL_KEEP_POSE)
        return refuse("group %u: on_bad_input is %u; it is SWIVEL_REST_POSE or SWIVEL_KEEP_POSE", g,
                      group.on_bad_input);
    for (const auto& [order, name] :
         {std::pair{group.shoulder_order, "shoulder_order"}, std::pair{group.wrist_order, "wrist_order"}})
        if (order > SWIVEL_ZYX)
            return refuse("group %u: %s is %u; it is one of SWIVEL_XYZ to SWIVEL_ZYX", g, name, order);
    if (const swivel_status status = check_group_region(g, group); status != SWIVEL_OK) return status;
    if (group.features & SWIVEL_JOINTS)
        if (const swivel_status status = check_binding(g, group.binding, twist_bone_count(group.features));
            status != SWIVEL_OK)
            return status;
    return check_half_line(g, group);
}

}  // namespace

swivel_crowd_def full_def(const swivel_crowd_def* def) { return element(def, 0, swivel_default_crowd_def()); }

swivel_status check_def(const swivel_crowd_def* given)
{
    const FloatEnv env;  // bindings hold floats; the def's callbacks are called later, outside it
    if (!given) return refuse("crowd def is null; start from swivel_default_crowd_def()");
    if (const swivel_status status = check_size<swivel_crowd_def>("crowd def", size_of(given)); status != SWIVEL_OK)
        return status;
    const swivel_crowd_def def = full_def(given);
    if (def.workspace_count > kMaxWorkspaces)
        return refuse("crowd def has %u workspaces, %u are the most; let jobs bring others", def.workspace_count,
                      kMaxWorkspaces);
    if (!def.skeleton && def.body_count > 0)
        return refuse("crowd def has %u bodies, but no skeleton; give it", def.body_count);
    if (def.skeleton && def.body_count == 0)
        return refuse("crowd def has a skeleton, but no bodies; give at least one");
    if (def.group_count == 0 || !def.groups) return refuse("crowd def has no groups; give at least one");
    if (!def.allocate != !def.release) return refuse("crowd def has one of allocate and release; give both or none");
    if (const swivel_status status = check_group_defs(def); status != SWIVEL_OK) return status;
    std::uint64_t limb_count = 0;
    for (std::uint32_t g = 0; g < def.group_count; ++g) {
        const GroupDef group = group_at(def, g);
        if (const swivel_status status = check_group(g, group); status != SWIVEL_OK) return status;
        limb_count += std::uint64_t{group.limb_count} + SWIVEL_LANES;
    }
    if (limb_count > kMaxLimbs) return refuse("more than 2^31 limbs, padding included; use several crowds");
    if (def.skeleton)
        if (const swivel_status status = check_bodies(def); status != SWIVEL_OK) return status;
    if (const std::uint64_t bytes = crowd_bytes(def); bytes > std::uint64_t{PTRDIFF_MAX})  // where pointers are short
        return refuse("a crowd of %llu bytes is beyond what a pointer reaches; use several crowds",
                      static_cast<unsigned long long>(bytes));
    return SWIVEL_OK;
}

}  // namespace swivel

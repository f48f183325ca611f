// SPDX-License-Identifier: MIT
#include "batch/check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <utility>

#include "batch/numbers.h"
#include "batch/rig.h"
#include "batch/sized.h"
#include "batch/status.h"
#include "core/conformal.h"
#include "simd/float_env.h"
#include "simd/rows.h"

namespace swivel {

namespace {

// Features that need another feature, or exclude another one.
struct FeatureRule {
    FeatureSet feature, other;
    bool together;
    const char* text;
};
constexpr FeatureRule kFeatureRules[] = {
    {feature::pole_direction, feature::world, true,
     "SWIVEL_POLE_DIRECTION needs SWIVEL_WORLD; in the arm frame a pole is both"},
    {feature::pole_normal, feature::pole_direction, false,
     "SWIVEL_POLE_NORMAL and SWIVEL_POLE_DIRECTION exclude each other; a pole is one of them"},
    {feature::pole_incoming, feature::pole_direction, false,
     "SWIVEL_POLE_INCOMING and SWIVEL_POLE_DIRECTION exclude each other; with the first there are no poles"},
    {feature::pole_incoming, feature::pole_normal, false,
     "SWIVEL_POLE_INCOMING and SWIVEL_POLE_NORMAL exclude each other; with the first there are no poles"},
    {feature::pole_incoming, feature::incoming, true, "SWIVEL_POLE_INCOMING needs SWIVEL_WITH_INCOMING"},
    {feature::weights, feature::incoming, true,
     "SWIVEL_WITH_WEIGHTS needs SWIVEL_WITH_INCOMING, the pose to blend with"},
    {feature::effector, feature::hand, true, "SWIVEL_WITH_EFFECTOR needs SWIVEL_WITH_HAND, which carries it"},
    {feature::hand_cone, feature::hand, true, "SWIVEL_WITH_HAND_CONE needs SWIVEL_WITH_HAND"},
    {feature::forearm_twist, feature::hand, true, "SWIVEL_WITH_FOREARM_TWIST needs SWIVEL_WITH_HAND"},
    {feature::hand_twist, feature::hand, true, "SWIVEL_WITH_HAND_TWIST needs SWIVEL_WITH_HAND"},
    {feature::wrist_box, feature::hand, true, "SWIVEL_WITH_WRIST_BOX needs SWIVEL_WITH_HAND"},
    {kMostTwistBones * feature::twist_bones, feature::hand, true,
     "SWIVEL_WITH_TWIST_BONES needs SWIVEL_WITH_HAND, whose twist is shared"},
    {feature::aim, feature::weights, false,
     "SWIVEL_WITH_AIM and SWIVEL_WITH_WEIGHTS exclude each other; blend the poses instead"},
    {feature::aim, feature::reach, false,
     "SWIVEL_WITH_AIM and SWIVEL_WITH_REACH exclude each other; an aim's distance is its flexion's"},
    {feature::aim, feature::flexion_limit, false,
     "SWIVEL_WITH_AIM and SWIVEL_WITH_FLEXION_LIMIT exclude each other; give a flexion within the limit"},
    {feature::aim, feature::hand_cone | feature::forearm_twist | feature::hand_twist | feature::wrist_box, false,
     "SWIVEL_WITH_AIM excludes limits of the hand; give a wrist rotation within them"},
    {feature::clavicle, feature::world, true, "SWIVEL_WITH_CLAVICLE needs SWIVEL_WORLD, where the parent joint is"},
    {feature::compact, feature::clavicle, false,
     "SWIVEL_COMPACT and SWIVEL_WITH_CLAVICLE exclude each other; leave one out"},
    {feature::compact, kMostTwistBones* feature::twist_bones, false,
     "SWIVEL_COMPACT and SWIVEL_WITH_TWIST_BONES exclude each other; leave one out"},
    {feature::compact, feature::reach, false, "SWIVEL_COMPACT and SWIVEL_WITH_REACH exclude each other; leave one out"},
    {feature::compact, feature::most_swivel, false,
     "SWIVEL_COMPACT and SWIVEL_WITH_MOST_SWIVEL exclude each other; leave one out"},
};
constexpr std::uint64_t kMostLimbs = 1u << 31;

bool is_zero(float x) { return x == 0; }

swivel_status check_binding(std::uint32_t group, const swivel_binding& binding, std::uint32_t twist_bones)
{
    if (std::all_of(std::begin(binding.parent_from_arm), std::end(binding.parent_from_arm), is_zero))
        return fail(SWIVEL_INVALID_ARGUMENT, "group %u has no binding; make it with swivel_bind()", group);
    if (!is_binding(binding))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "group %u's binding holds a quaternion not of unit length; make it with swivel_bind()", group);
    if (std::all_of(std::begin(binding.lengths), std::end(binding.lengths), is_zero))
        return fail(
            SWIVEL_INVALID_ARGUMENT,
            "group %u's binding has bones of length 0; make it with swivel_bind(), or give NaN for lengths that "
            "are written later",
            group);
    if (twist_bones > 0 && binding.twist_bone_count > 0 && binding.twist_bone_count != twist_bones)
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "group %u's binding has %u twist bones, this crowd has %u; bind that many, or create the crowd "
                    "with as many as are bound",
                    group, binding.twist_bone_count, twist_bones);
    return SWIVEL_OK;
}

}  // namespace

swivel_crowd_def full_def(const swivel_crowd_def* def) { return element(def, 0, swivel_default_crowd_def()); }

swivel_status check(const swivel_crowd_def* given)
{
    const FloatEnv env;  // bindings hold floats; the def's callbacks are called later, outside it
    if (!given) return fail(SWIVEL_INVALID_ARGUMENT, "crowd def is null; start from swivel_default_crowd_def()");
    if (const swivel_status status = check_size<swivel_crowd_def>("crowd def", size_of(given)); status != SWIVEL_OK)
        return status;
    const swivel_crowd_def def = full_def(given);
    if (const FeatureSet unknown = def.features & ~kKnownFeatures)
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "crowd def asks for more than 7 twist bones, or has unknown feature bits: 0x%llx",
                    static_cast<unsigned long long>(unknown));
    for (const FeatureRule& rule : kFeatureRules)
        if ((def.features & rule.feature) && !(def.features & rule.other) == rule.together)
            return fail(SWIVEL_INVALID_ARGUMENT, "%s", rule.text);
    if (def.group_count == 0 || !def.groups)
        return fail(SWIVEL_INVALID_ARGUMENT, "crowd def has no groups; give at least one");
    if (!def.allocate != !def.release)
        return fail(SWIVEL_INVALID_ARGUMENT, "crowd def has one of allocate and release; give both or none");
    for (const auto& [order, name] :
         {std::pair{def.shoulder_order, "shoulder_order"}, std::pair{def.wrist_order, "wrist_order"}})
        if (static_cast<unsigned>(order) > SWIVEL_ZYX)
            return fail(SWIVEL_INVALID_ARGUMENT, "crowd def's %s is %d; it is one of SWIVEL_XYZ to SWIVEL_ZYX", name,
                        static_cast<int>(order));
    if (const swivel_status status = check_size<swivel_group_def>("the first group def", size_of(def.groups));
        status != SWIVEL_OK)
        return status;
    std::uint64_t limb_count = 0;
    for (std::uint32_t g = 0; g < def.group_count; ++g) {
        if (const swivel_status status = check_element("group def", def.groups, g); status != SWIVEL_OK) return status;
        const swivel_group_def group = group_at(def, g);
        if (group.limb_count == 0) return fail(SWIVEL_INVALID_ARGUMENT, "group %u has no limbs; give at least one", g);
        if (def.features & feature::joints)
            if (const swivel_status status = check_binding(g, group.binding, twist_bone_count(def.features));
                status != SWIVEL_OK)
                return status;
        limb_count += std::uint64_t{group.limb_count} + SWIVEL_LANES;
    }
    if (limb_count > kMostLimbs)
        return fail(SWIVEL_INVALID_ARGUMENT, "more than 2^31 limbs, padding included; use several crowds");
    if (const std::uint64_t bytes = crowd_bytes(def); bytes > std::uint64_t{PTRDIFF_MAX})  // where pointers are short
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "a crowd of %llu bytes is beyond what a pointer reaches; use several crowds",
                    static_cast<unsigned long long>(bytes));
    return SWIVEL_OK;
}

swivel_status check(const swivel_crowd* crowd, std::uint32_t group, std::uint32_t first, std::uint32_t limb_count)
{
    if (!crowd) return fail(SWIVEL_INVALID_ARGUMENT, "crowd is null");
    if (group >= crowd->group_count)
        return fail(SWIVEL_INVALID_ARGUMENT, "group %u does not exist; this crowd has %u", group, crowd->group_count);
    const std::uint32_t has = crowd->groups[group].limb_count;
    if (first > has || limb_count > has - first)
        return fail(SWIVEL_INVALID_ARGUMENT, "%u limbs from limb %u on are not all in group %u, which has %u",
                    limb_count, first, group, has);
    return SWIVEL_OK;
}

swivel_status check_stride(std::uint32_t group, const char* name, const void* data, std::size_t stride,
                           std::size_t value_bytes, bool may_repeat)
{
    if (!data) return fail(SWIVEL_INVALID_ARGUMENT, "group %u, %s: data is null", group, name);
    if (stride < value_bytes && !(may_repeat && stride == 0))
        return fail(SWIVEL_INVALID_ARGUMENT, "group %u, %s: stride %zu is smaller than a value, %zu bytes", group, name,
                    stride, value_bytes);
    return SWIVEL_OK;
}

swivel_status check_field(swivel_field field)
{
    return is_field(field) ? SWIVEL_OK : fail(SWIVEL_INVALID_ARGUMENT, "there is no field %d", static_cast<int>(field));
}

swivel_status check_field(const swivel_crowd& crowd, std::uint32_t group, Field field, bool input)
{
    const auto& [name, row_count, needs, without] = layout_of(field);
    if (input && !is_input(field))
        return fail(SWIVEL_INVALID_ARGUMENT, "%s is a result; swivel_write takes input fields", name);
    if (field_component_count(crowd.features, field) != 0) return SWIVEL_OK;
    const FeatureSet wrong = without ? without : needs & ~crowd.features;
    return fail(SWIVEL_INVALID_ARGUMENT, "group %u, %s: not part of this crowd; create it with%s %s", group, name,
                without ? "out" : "", feature_name(wrong));
}

swivel_status check_values(const swivel_crowd& crowd, std::uint32_t group, Field field, const void* data,
                           std::size_t stride, bool input, std::size_t component_bytes)
{
    if (const swivel_status status = check_field(crowd, group, field, input); status != SWIVEL_OK) return status;
    return check_stride(group, name_of(field), data, stride,
                        field_component_count(crowd.features, field) * component_bytes, input);
}

swivel_status check_blocks(const swivel_crowd& crowd, swivel_blocks blocks)
{
    if (blocks.first > crowd.block_count || blocks.count > crowd.block_count - blocks.first)
        return fail(SWIVEL_INVALID_ARGUMENT, "%u blocks from block %u on do not all exist; this crowd has %u",
                    blocks.count, blocks.first, crowd.block_count);
    return SWIVEL_OK;
}

const Isa* usable_isa(swivel_status& status)
{
    const Isa* isa = current_isa();
    if (isa) return isa;
    const char* forced = std::getenv("SWIVEL_FORCE_ISA");
    const bool built = forced && find_isa(forced);
    status = fail(built ? SWIVEL_ISA_UNAVAILABLE : SWIVEL_UNKNOWN_ISA,
                  "SWIVEL_FORCE_ISA=%s names an instruction set that %s; unset it, or see swivel info",
                  forced ? forced : "", built ? "this CPU does not run" : "this build does not have");
    return nullptr;
}

}  // namespace swivel

// SPDX-License-Identifier: MIT
#include "batch/api/check.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "batch/refusal/status.h"
#include "simd/rows.h"

namespace swivel {

swivel_status check(const swivel_crowd& crowd, std::uint32_t group, std::uint32_t first, std::uint32_t limb_count)
{
    if (group >= crowd.group_count)
        return refuse("group %u does not exist; this crowd has %u", group, crowd.group_count);
    const std::uint32_t has = crowd.groups[group].limb_count;
    if (first > has || limb_count > has - first)
        return refuse("%u limbs from limb %u on are not all in group %u, which has %u", limb_count, first, group, has);
    return SWIVEL_OK;
}

swivel_status check_limbs(const swivel_crowd& crowd, std::uint32_t group, const char* call)
{
    if (!(crowd.groups[group].features & kNoLimb)) return SWIVEL_OK;
    return refuse("%s: group %u is %s; name a group of limbs", call, group,
                  text_of(kind_of(crowd.groups[group].features)));
}

swivel_status check_kept(const swivel_crowd& crowd, std::uint32_t group, const char* call)
{
    if (const swivel_status status = check_limbs(crowd, group, call); status != SWIVEL_OK) return status;
    if (crowd.joint_count == 0 || crowd.groups[group].features & SWIVEL_WITH_RECORD) return SWIVEL_OK;
    return refuse("%s: group %u is of bodies; create it with SWIVEL_WITH_RECORD", call, group);
}

swivel_status check_stride(std::uint32_t group, const char* name, std::uint32_t limb_count, const void* data,
                           std::size_t stride, std::size_t value_bytes, bool may_repeat)
{
    if (!data && limb_count > 0) return refuse("group %u, %s: data is null", group, name);
    if (stride < value_bytes && !(may_repeat && stride == 0))
        return refuse("group %u, %s: stride %zu is smaller than a value, %zu bytes", group, name, stride, value_bytes);
    return SWIVEL_OK;
}

swivel_status check_field(swivel_field field)
{
    return is_field(field) ? SWIVEL_OK : refuse("there is no field %d", static_cast<int>(field));
}

swivel_status check_field(const swivel_crowd& crowd, std::uint32_t group, swivel_field field, bool input)
{
    if (const swivel_status status = check_field(field); status != SWIVEL_OK) return status;
    const FieldRow& row = row_of(field);
    if (input && row.kind == SWIVEL_FIELD_RESULT)
        return refuse("%s is a result; swivel_write takes inputs and what is carried", row.name);
    const swivel_features features = crowd.groups[group].features;
    if (field_row_count(features, field) != 0) return SWIVEL_OK;
    const swivel_kind kind = kind_of(features);
    if (kind == SWIVEL_KIND_BODY_LIMB && row.excludes & kBody)
        return refuse("group %u, %s: the pose of a body gives it; leave it out", group, row.name);
    if (!(kinds_of(row) >> kind & 1))
        return refuse("group %u, %s: the group is %s, which has none", group, row.name, text_of(kind));
    const swivel_features missing = row.needs & ~features, with = missing & kPublicFeatures,
                          without = row.excludes & features & kPublicFeatures;
    char what[64] = "a twist_bone_count, or joints that name twist bones";
    if (missing & kLibraryGoal)
        std::snprintf(what, sizeof what, "SWIVEL_WITH_RECORD and SWIVEL_WITH_PLANT or _WITH_LINK");
    else if (with | without)
        std::snprintf(what, sizeof what, "SWIVEL_%s", feature_name(with ? with : without));
    return refuse("group %u, %s: not part of this group; create it with%s %s", group, row.name,
                  missing || !without ? "" : "out", what);
}

swivel_status check_values(const swivel_crowd& crowd, std::uint32_t group, swivel_field field, std::uint32_t limb_count,
                           const void* data, std::size_t stride, bool input, std::size_t component_bytes)
{
    if (const swivel_status status = check_field(crowd, group, field, input); status != SWIVEL_OK) return status;
    const std::uint32_t count = field_row_count(crowd.groups[group].features, field);
    return check_stride(group, name_of(field), limb_count, data, stride, count * component_bytes, input);
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

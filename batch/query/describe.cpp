// SPDX-License-Identifier: MIT
//
// The C entry points that describe features, fields and flags (the table in simd/fields.h) and constants (the table in
// batch/crowd/constants.cpp).
#include <algorithm>
#include <iterator>

#include "batch/api/check.h"
#include "batch/crowd/group_def.h"
#include "simd/rows.h"

using namespace swivel;

int swivel_describe_feature(uint32_t index, swivel_feature_info* info)
{
    if (index >= std::size(kFeatures) || !info) return 0;
    const FeatureRow& row = kFeatures[index];
    *info = {row.feature, row.name, row.needs, row.excludes, row.kinds, 0};
    return 1;
}

int swivel_describe_field(uint32_t index, swivel_field_info* info)
{
    if (index >= std::size(kFields) || !info) return 0;
    const FieldRow& row = kFields[index];
    *info = {.field = row.field,
             .kind = row.kind,
             .name = row.name,
             .range = row.value.words,
             .needs = row.needs & kPublicFeatures,
             .excludes = row.excludes & kPublicFeatures,
             .kinds = kinds_of(row),
             .max_components = max_rows(row.field),
             .is_position = is_position(row.field),
             .reserved = 0};
    return 1;
}

int swivel_describe_constant(uint32_t index, swivel_constant_info* info)
{
    if (index >= constants().size() || !info) return 0;
    const ConstantRow& row = constants()[index];
    *info = {row.structure, row.name, row.unit, row.text, row.offset, row.count, {}, row.min, row.max};
    const GroupDef group = default_group();
    std::copy_n(values_of(group, row), row.count, info->defaults);
    return 1;
}

const char* swivel_flag_name(uint32_t flags)
{
    const uint32_t lowest = flags & (~flags + 1);
    for (const FlagRow& row : kFlags)
        if (row.flag == lowest) return row.name;
    return nullptr;
}

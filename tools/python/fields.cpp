// SPDX-License-Identifier: MIT
#include "tools/python/fields.h"

#include <algorithm>
#include <vector>

#include "tools/python/names.h"

namespace swivel::python {

namespace {

swivel_group_def one_limb()
{
    swivel_chain chain = swivel_default_chain();
    chain.elbow_offset[2] = chain.wrist_offset[2] = chain.bend[1] = 1;
    return group(1, bind(chain));
}

// Whether a crowd can have just these features.
bool go_together(swivel_features features)
{
    const swivel_group_def group = one_limb();
    swivel_crowd_def def = swivel_default_crowd_def();
    def.features = features;
    def.group_count = 1;
    def.groups = &group;
    return swivel_crowd_bytes(&def) > 0;
}

using Table = std::array<FieldNeeds, SWIVEL_RESULT_END>;

// Sets of `more` features on top of `features`, from the table's entry `from` on: what they bring is noted.
void note(Table& table, swivel_features features, std::size_t more, std::size_t from)
{
    if (more > 0) {
        for (std::size_t n = from; n < python::features().size(); ++n)
            note(table, features | static_cast<swivel_features>(python::features()[n].value), more - 1, n + 1);
    } else if (go_together(features)) {
        const auto counts = component_counts(features);
        for (std::size_t field = 0; field < SWIVEL_INPUT_END; ++field)
            if (table[field].component_count == 0) table[field] = {features, counts[field]};
    }
}

Table all_needs()
{
    Table table{};
    const auto known = [&] {
        return std::all_of(table.begin(), table.begin() + SWIVEL_INPUT_END,
                           [](const FieldNeeds& needs) { return needs.component_count > 0; });
    };
    for (std::size_t count = 0; count <= 3 && !known(); ++count) note(table, 0, count, 0);
    return table;
}

}  // namespace

std::array<std::uint32_t, SWIVEL_RESULT_END> component_counts(swivel_features features)
{
    const swivel_group_def group = one_limb();
    const Crowd crowd(features & ~SWIVEL_COMPACT, {&group, 1});
    std::array<std::uint32_t, SWIVEL_RESULT_END> counts{};
    for (const Named& field : fields())
        counts[static_cast<std::size_t>(field.value)] =
            swivel_field_row_count(crowd.get(), static_cast<swivel_field>(field.value));
    return counts;
}

const FieldNeeds& needs_of(swivel_field field)
{
    static const Table table = all_needs();
    return table[field];
}

}  // namespace swivel::python

// SPDX-License-Identifier: MIT
//
// A body's state: the results that its next solve starts from.
#pragma once

#include "batch/crowd/crowd.h"

namespace swivel {

// How many numbers of a result belong to the state of a group's limbs.
inline std::uint32_t state_number_count(const Group& group, const FieldRow& result)
{
    const std::uint32_t count = field_row_count(group.features, result.field);
    if (count > 0 && result.field == SWIVEL_LOOK_TURNS) return 1 + 3 * group.plan.joints.turned_count;
    if (result.kind == SWIVEL_FIELD_CARRIED) return count;
    // A free limb with bad input may keep all of its results but its flags. A body's limb keeps the pose that comes in.
    const bool is_kept = group.keeps_pose && !(group.features & kBody) && result.field != SWIVEL_FLAGS;
    return is_kept ? count : 0;
}

// Calls take(result, first_row, count) for each result of a group that belongs to the state, in the table's order.
template <class Take>
void for_each_state_result(const Group& group, const Take& take)
{
    for (std::size_t f = kInputCount; f < kFieldCount; ++f)
        if (const std::uint32_t count = state_number_count(group, kFields[f]); count > 0)
            take(kFields[f], std::uint32_t{group.first_row[f]}, count);
}

}  // namespace swivel

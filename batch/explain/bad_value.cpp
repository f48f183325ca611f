// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <iterator>

#include "batch/explain/explain.h"
#include "batch/query/limb_value.h"

namespace swivel {

namespace {

// count: of numbers that the group has.
bool is_bad(const LimbValue& value, std::uint32_t count, const FieldRow& row, swivel_features features)
{
    bool is_found = false;
    for_each_part(row, count, [&](ValuePart part, std::uint32_t first) {
        const PartRow& bounds = row_of(part);
        const double size = bounds.count > 1 ? value.length(first, bounds.count) : value[first];
        is_found |= size < bounds.min || size > bounds.max || (std::isnan(size) && !may_be_missing(row, features));
    });
    return is_found;
}
// Whether only stages of bodies read a field. Far ground counts as no ground, so no ground is bad.
bool is_of_bodies(const Group& group, swivel_field field)
{
    if (field == SWIVEL_TARGET || field == SWIVEL_HAND)
        return group.features & SWIVEL_WITH_PLANT || group.plan.limb.link.is_prop;
    if (field == SWIVEL_CLAVICLE) return group.features & kBody;
    return field != SWIVEL_GROUND && !(kinds_of(row_of(field)) & kFreeLimbs);
}

}  // namespace

bool is_bad_in_body(const Group& group, std::uint32_t limb, swivel_field field)
{
    if (!is_input(field) || !is_of_bodies(group, field)) return false;
    const std::uint32_t count = field_row_count(group.features, field);
    return count > 0 && is_bad(LimbValue(group, limb, field), count, row_of(field), group.features);
}
bool is_bad_in_body(const Group& group, std::uint32_t limb)
{
    return std::any_of(std::begin(kFields), std::end(kFields),
                       [&](const FieldRow& row) { return is_bad_in_body(group, limb, row.field); });
}

std::uint32_t add_numbers(const Group& group, std::uint32_t limb, swivel_field field, Text& text)
{
    const LimbValue value(group, limb, field);
    std::uint32_t unknown = 0;
    text.add("%s (", name_of(field));
    for (std::uint32_t c = 0; c < field_row_count(group.features, field); ++c) {
        text.add("%s%g", c == 0 ? "" : ", ", value[c]);
        unknown += std::isnan(value[c]);
    }
    return unknown;
}

bool explain_bad_in_body(const Group& group, std::uint32_t limb, Text& text)
{
    bool is_found = false;
    for (const FieldRow& row : kFields) {
        if (!is_bad_in_body(group, limb, row.field)) continue;
        text.add("%s", is_found ? "; " : "");
        if (add_numbers(group, limb, row.field, text) == 0)
            text.add(") is out of its range, %s", row.value.words);
        else
            text.add(") is not a number");
        is_found = true;
    }
    return is_found;
}

void explain_bad_pose(const swivel_crowd& crowd, unsigned parts, const char* joints, Text& text)
{
    const std::uint32_t notes = crowd.pose_notes.load(std::memory_order_relaxed);
    if (notes & kTimeIsGood) parts &= ~unsigned{kTimeOfPose};
    if (!(notes & kHasSupport)) parts &= ~unsigned{kSupportOfPose};
    if (!(notes & kHasWeight)) parts &= ~unsigned{kWeightOfPose};
    if (parts & kTimeOfPose && notes & kTimeIsBad) parts = kTimeOfPose;
    const struct {
        PosePart part;
        const char* words;
    } names[] = {{kTimeOfPose, "its time"},
                 {kRootOfPose, "the root's place, rotation or scale"},
                 {kSupportOfPose, "its support"},
                 {kWeightOfPose, "its weight"},
                 {kJointsOfPose, joints}};
    if (parts == 0) return text.add("an input that has been written since");
    text.add("in the pose, ");
    bool is_first = true;
    for (const auto& each : names) {
        if (!(parts & each.part)) continue;
        parts &= ~unsigned{each.part};
        text.add("%s%s", is_first ? "" : parts == 0 ? ", or " : ", ", each.words);
        is_first = false;
    }
    text.add(" was not a number or out of its range, unless an input has been written since");
}

}  // namespace swivel

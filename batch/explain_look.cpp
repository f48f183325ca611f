// SPDX-License-Identifier: MIT
#include "batch/explain_look.h"

#include <numbers>

#include "batch/explain_plant.h"
#include "batch/limb_value.h"
#include "core/joint_frame.h"
#include "core/bit_cast.h"

namespace swivel {

namespace {

struct Look {
    const Group& group;
    std::uint32_t limb;
    LimbValue target{group, limb, SWIVEL_LOOK_TARGET}, weight{group, limb, SWIVEL_LOOK_WEIGHT},
        sight{group, limb, SWIVEL_SIGHT}, line{group, limb, SWIVEL_LOOK_LINE};
    std::uint32_t flags = bit_cast<std::uint32_t>(LimbValue(group, limb, SWIVEL_FLAGS).number(0));

    bool has_target() const { return !std::isnan(target.length(0, 3)); }
    Vector<double> to_target() const
    {
        return vector(target[0] - sight[0], target[1] - sight[1], target[2] - sight[2]);
    }
    // Degrees between the line of sight and the target.
    double missed() const
    {
        const Vector<double> axis = vector(sight[3], sight[4], sight[5]), to = to_target();
        return std::atan2(std::sqrt(len2(cross(axis, to))), scalar_product(axis, to)) * 180 / std::numbers::pi;
    }
    void explain_bad(Text& text) const
    {
        text.add("Bad input: ");
        bool is_found = false;
        for (const swivel_field field : {SWIVEL_LOOK_TARGET, SWIVEL_LOOK_WEIGHT}) {
            if (!is_bad_in_body(group, limb, field)) continue;
            const LimbValue value(group, limb, field);
            text.add("%s%s (", is_found ? "; " : "", name_of(field));
            for (std::uint32_t c = 0; c < field_row_count(group.features, field); ++c)
                text.add("%s%g", c == 0 ? "" : ", ", value[c]);
            text.add(") is %s%s", std::isnan(value[0]) ? "not a number; let it be " : "out of its range, ",
                     row_of(field).range);
            is_found = true;
        }
        if (!is_found) text.add("in the pose, its time, the root or a joint was not a number or out of its range");
        text.add(". The joints %s.", group.keeps ? "keep their incoming pose" : "have their rest pose");
    }
    void explain_miss(Text& text) const
    {
        text.add("The line of sight misses the target by %.2f degrees.", missed());
        if (flags & SWIVEL_LIMITED_STEP) text.add(" It turns there at its rate, and is still on its way.");
        if (weight[0] < 1) text.add(" Its look_weight is %.3g.", weight[0]);
        if (flags & SWIVEL_FADED)
            text.add(
                " The look fades, because the target is behind the incoming line of sight or, at %.4g from where that "
                "starts, nearer than near.",
                std::sqrt(len2(to_target())));
        if (flags & SWIVEL_LIMITED_LOOK) text.add(" A joint turns as far as its cone, cos_most, allows.");
        if (!(flags & (SWIVEL_LIMITED_STEP | SWIVEL_FADED | SWIVEL_LIMITED_LOOK)) && weight[0] == 1)
            text.add(
                " The target is nearer to the last joint than all of the line is, so no turn of that joint meets it.");
    }
};

}  // namespace

void explain_look(const Group& group, std::uint32_t limb, Text& text)
{
    const Look look{group, limb};
    if (look.flags & SWIVEL_BAD_INPUT || is_bad_in_body(group, limb)) return look.explain_bad(text);
    if (look.line.length(0, 3) == 0)
        return text.add("It was never solved, or was reset: the next solve looks at once.");
    if (!look.has_target())
        return text.add("It has nothing to look at, because look_target is not a number. %s",
                        look.flags & SWIVEL_LIMITED_STEP ? "Its line of sight turns back at its rate."
                                                         : "The joints have their incoming pose.");
    if (look.weight[0] == 0) return text.add("Its look_weight is 0, so the joints have their incoming pose.");
    if (look.flags & SWIVEL_REACHED) return text.add("The line of sight meets the target.");
    look.explain_miss(text);
}

}  // namespace swivel

// SPDX-License-Identifier: MIT
#include "batch/explain/explain.h"
#include "batch/query/forward.h"
#include "batch/query/limb_value.h"
#include "batch/query/one_limb.h"
#include "core/prop.h"

namespace swivel {

namespace {

Rotor<double> unit_rotor_of(const LimbValue& value, std::uint32_t first = 0)
{
    return normalise(rotor_of(value, first));
}
// Whether a value is given: NaN means that it is not.
bool is_given(const LimbValue& value, std::uint32_t count) { return !std::isnan(value.length(0, count)); }

// A hand that holds a prop, of one body.
struct Holder {
    const Group& group;
    std::uint32_t number, limb;  // number: of the group

    bool has_record() const { return group.features & SWIVEL_WITH_RECORD; }
    bool is_bad() const { return flags_of(group, limb) & SWIVEL_BAD_INPUT || is_bad_in_body(group, limb); }
    // How far it is from its grip.
    double missed() const
    {
        OneLimb one(group);
        one.take(limb);
        return distance_missed(one.group(), 0);
    }
    // The reach of its arm, in the unit of the targets, from its record.
    double length() const
    {
        const LimbValue record(group, limb, SWIVEL_RECORD);
        return record[kRecordScale] * (record[kRecordLengths] + record[kRecordLengths + 1]);
    }
    // Whether its animated hand is known. A record has the arm as the clavicle turned it.
    bool is_known() const { return has_record() && !(group.features & SWIVEL_WITH_CLAVICLE); }
    // Where it has the prop, as it is animated, in the space of the targets.
    HeldFrame<double> held() const
    {
        const LimbValue grip(group, limb, SWIVEL_GRIP);
        return held_by(animated(), {unit_rotor_of(grip, 3), vector_of(grip)});
    }

private:
    HeldFrame<double> animated() const
    {
        const LimbValue record(group, limb, SWIVEL_RECORD), target(group, limb, SWIVEL_TARGET);
        const double scale = record[kRecordScale];
        const auto bone = [&](const Rotor<double>& frame, std::uint32_t n) {
            return sandwich(frame, vector(0.0, 0.0, scale * record[kRecordLengths + n]));
        };
        const Rotor<double> upper = unit_rotor_of(record, kRecordArm) * unit_rotor_of(record, kRecordIncoming),
                            fore = upper * unit_rotor_of(record, kRecordIncoming + 4);
        Vector<double> point = vector_of(record, kRecordShoulder) + bone(upper, 0) + bone(fore, 1);
        if (group.features & SWIVEL_WITH_EFFECTOR)
            point = point +
                    scale * sandwich(incoming_hand(group, limb), vector_of(LimbValue(group, limb, SWIVEL_EFFECTOR)));
        if (is_given(target, 3)) point = vector_of(target);
        return {normalise(wanted_hand(group, limb)), point};
    }
};

// A prop of one body, and its hands.
struct HeldProp {
    const swivel_crowd& crowd;
    const Group& group;
    std::uint32_t limb;
    LimbValue place{group, limb, SWIVEL_PROP_POSITION}, turn{group, limb, SWIVEL_PROP_ROTATION};
    const PropPlan& plan = group.plan.prop;

    bool has_joint() const { return plan.joint != 0; }
    bool is_pair() const { return plan.holder_count > 1; }
    double share() const { return is_pair() ? LimbValue(group, limb, SWIVEL_HAND_BLEND)[0] : 0; }
    double weight() const { return LimbValue(group, limb, SWIVEL_PROP_WEIGHT)[0]; }
    Holder holder(std::uint32_t n) const
    {
        const auto is_holder = [&](const LinkPlan& link) {
            return link.is_prop && &crowd.groups[link.group] == &group && link.number == n;
        };
        std::uint32_t g = 0;
        while (!is_holder(crowd.groups[g].plan.limb.link)) ++g;
        return {crowd.groups[g], g, limb};
    }
    template <class Take>
    void for_each_holder(const Take& take) const
    {
        for (std::uint32_t n = 0; n < plan.holder_count; ++n) take(holder(n));
    }
    // Whether it is known where it would lie if it never moved.
    bool is_known() const
    {
        if (has_joint()) return false;
        return (is_given(place, 3) && weight() == 1) || (holder(0).is_known() && (!is_pair() || holder(1).is_known()));
    }
    Vector<double> unmoved() const
    {
        const double given = is_given(place, 3) ? weight() : 0;
        if (given == 1) return vector_of(place);
        const auto hands = between(holder(0).held(), holder(plan.holder_count - 1).held(), share()).place;
        return given == 0 ? hands : (1 - given) * hands + given * vector_of(place);
    }
    double moved() const
    {
        return std::sqrt(len2(vector_of(LimbValue(group, limb, SWIVEL_PROP_TRANSFORM)) - unmoved()));
    }

    void explain_bad(Text& text) const
    {
        text.add("Bad input: ");
        bool is_found = explain_bad_in_body(group, limb, text);
        for_each_holder([&](const Holder& hand) {
            if (!hand.is_bad()) return;
            text.add("%sthe hand of group %u has some", is_found ? "; " : "", hand.number);
            is_found = true;
        });
        if (!is_found)
            text.add("in the pose, the root%s was not a number or out of its range",
                     has_joint() ? " or the prop's joint" : "");
        text.add(". So its place is not known, and hands on it have bad input, too.");
    }
    // As the hands have it.
    void explain_hands(const char* what, Text& text) const
    {
        const double at = share();
        const Holder first = holder(0), last = holder(plan.holder_count - 1);
        if (at == 0 || at == 1)
            text.add("%s as the hand of group %u has it", what, at == 0 ? first.number : last.number);
        else
            text.add("%s between the hands of groups %u and %u, at %.3g of the way", what, first.number, last.number,
                     at);
    }
    void explain_source(Text& text) const
    {
        const bool has_place = is_given(place, 3), has_turn = is_given(turn, 4);
        if (has_joint()) {
            text.add("It lies as joint %u has it", crowd.joints[joint_at(crowd, plan.joint)].skeleton_joint);
            if (has_place || has_turn)
                text.add(", with the %s that %s written in that joint's frame",
                         !has_turn    ? "place"
                         : !has_place ? "rotation"
                                      : "place and rotation",
                         has_place && has_turn ? "are" : "is");
        } else if (has_place && has_turn) {
            text.add("Its place and rotation are written");
        } else if (has_place) {
            explain_hands("Its place is written, its rotation is", text);
        } else if (has_turn) {
            explain_hands("Its rotation is written, its place is", text);
        } else {
            explain_hands("It lies", text);
        }
        if (weight() < 1 && (has_joint() || has_place || has_turn))
            text.add(", by a weight of %.3g against where the hands have it", weight());
        text.add(". ");
    }
    void explain_move(std::uint32_t flags, Text& text) const
    {
        constexpr double kNone = 1e-5;  // what rounding leaves, in shares of the first arm
        const Holder first = holder(0);
        const double arm = first.has_record() ? first.length() : double{group.plan.rest_length};
        const double way = is_known() ? moved() : 0, max = double{plan.max_move};
        const bool moves = way > kNone * arm;
        if (moves) text.add("It moved by %.4g. ", way);
        if (flags & SWIVEL_REACHED)
            text.add(moves        ? "That is no more than it must for all hands to reach it."
                     : is_known() ? "It need not move: all hands reach it."
                                  : "It moves no further than it must for all hands to reach it.");
        else if (flags & SWIVEL_CLAMPED_NEAR)
            text.add("A grip is nearer to the shoulder than its arm gets, and the prop does not move for that.");
        else if (max > 0)
            text.add("Not all hands reach it, wherever it goes within %.3g limb lengths.", max);
        else
            text.add("It never moves, and not all hands reach it.");
    }
    void explain_misses(Text& text) const
    {
        for_each_holder([&](const Holder& hand) {
            if (hand.is_bad())
                text.add(" The hand of group %u has bad input, so nothing is done for it.", hand.number);
            else if (hand.has_record())
                text.add(" The hand of group %u is %.4g from its grip.", hand.number, hand.missed());
        });
    }
};

}  // namespace

bool holds_bad(const swivel_crowd& crowd, const Group& group, std::uint32_t limb)
{
    const LinkPlan& link = group.plan.limb.link;
    return group.features & SWIVEL_WITH_LINK && flags_of(crowd.groups[link.group], limb) & SWIVEL_BAD_INPUT;
}

void explain_link(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text)
{
    const std::uint32_t g = group.plan.limb.link.group;
    const Group& held = crowd.groups[g];
    const std::uint32_t flags = flags_of(held, limb);
    if (group.plan.limb.link.is_prop) {
        text.add("It holds the prop of group %u%s. ", g,
                 flags & (SWIVEL_CLAMPED_FAR | SWIVEL_CLAMPED_NEAR) ? ", which not all hands reach" : "");
        return;
    }
    text.add("It holds the hand of group %u%s. ", g,
             flags & SWIVEL_BAD_INPUT    ? ", which keeps its pose because its input is bad"
             : !(flags & SWIVEL_REACHED) ? ", which is not at its own target"
                                         : "");
}

void explain_prop(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text)
{
    const HeldProp prop{crowd, group, limb};
    const std::uint32_t flags = flags_of(group, limb);
    if (flags & SWIVEL_BAD_INPUT || is_bad_in_body(group, limb)) return prop.explain_bad(text);
    if (flags == 0) return text.add("It was never solved, so it has no place.");
    prop.explain_source(text);
    prop.explain_move(flags, text);
    prop.explain_misses(text);
}

}  // namespace swivel

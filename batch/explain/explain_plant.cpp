// SPDX-License-Identifier: MIT
#include "batch/explain/explain.h"
#include "batch/query/limb_value.h"
#include "core/group_rules.h"

namespace swivel {

namespace {

// The state that a planted limb carries: the numbers of SWIVEL_PLANT.
struct CarriedPlant {
    enum Bit : unsigned { locked = 1, armed = 2, released = 4, begun = 8 };
    double offset, left;  // in the targets' unit; s
    bool is_moving;       // its target, while the point is locked
    unsigned bits;

    CarriedPlant(const Group& group, std::uint32_t limb)
    {
        const LimbValue plant(group, limb, SWIVEL_PLANT);
        offset = plant.length(3, 3);
        left = plant[9];
        is_moving = is_fading() && plant.length(3, 6) > 0;
        const double number = plant[10];  // anybody may have written it
        bits = number >= 0 && number < 16 ? static_cast<unsigned>(number) : 0;
    }
    bool is(Bit bit) const { return bits & bit; }
    bool is_fading() const { return left > kShortestTime; }
};

double in_ms(double seconds) { return seconds * 1000; }

// A limb of a group that plants. Shares are of its length, as the rules count.
struct PlantedLimb {
    const Group& group;
    std::uint32_t limb;
    const swivel_plant& rules = group.plan.limb.plant.given;
    CarriedPlant state{group, limb};

    bool is_by_motion() const { return group.features & SWIVEL_PLANT_BY_MOTION; }
    float label() const { return LimbValue(group, limb, SWIVEL_CONTACT).number(0); }
    bool is_in_contact() const
    {
        return is_by_motion() ? LimbValue(group, limb, SWIVEL_CONTACT_STATE).number(3) > 0.5f : label() > 0.5f;
    }
    // As the limb's parent is scaled.
    double share(double distance) const
    {
        return distance / (double{group.plan.rest_length} * LimbValue(group, limb, SWIVEL_RECORD)[kRecordScale]);
    }

    void explain_locked(Text& text) const
    {
        if (state.is_moving)
            text.add(
                "It is planted, and its target runs in: it locked %.0f ms ago and comes to rest in %.0f ms, %.4g away.",
                in_ms(double{rules.stop_time} - state.left), in_ms(state.left), state.offset);
        else
            text.add("It is planted, and its target stands.");
        if (!is_by_motion() && !is_in_contact())
            text.add(" Its label of contact is %.3g by now: the next solve releases it.", double{label()});
    }
    void explain_released(bool by_distance, Text& text) const
    {
        if (by_distance)
            text.add(
                "It broke away, though in contact: the animated point was further from where it was locked than "
                "unlock_radius, %.3g limb lengths. It is %.4g from where the point is now.",
                double{rules.unlock_radius}, state.offset);
        else
            text.add("It was just released, because its contact ended: the animated point is %.4g from it.",
                     state.offset);
        if (!by_distance && is_by_motion())
            text.add(" Its motion ends it above %.3g limb lengths a second or %.3g over the root.",
                     double{rules.speed[1]}, double{rules.height[1]});
        text.add(" From the next solve on its target fades back, within %.0f ms.", in_ms(double{rules.release_time}));
    }
    void explain_fading(Text& text) const
    {
        if (state.is_fading())
            text.add("Its target fades back to the animated point: %.4g is left, for %.0f ms.", state.offset,
                     in_ms(state.left));
        else
            text.add("Its target is the animated point.");
    }
    // Why it is not locked.
    void explain_free(Text& text) const
    {
        const bool is_long = share(state.offset) > double{rules.lock_radius};
        if (!is_in_contact() && is_by_motion())
            text.add(
                " Its motion shows no contact, which begins below %.3g limb lengths a second and %.3g over the root.",
                double{rules.speed[0]}, double{rules.height[0]});
        else if (!is_in_contact())
            text.add(" It is not in contact: its label is %.3g, not above 0.5.", double{label()});
        else if (!state.is(CarriedPlant::armed))
            explain_waiting(text);
        else if (!is_long)
            text.add(" It is in contact by now: the next solve locks it.");
        if (is_in_contact() && is_long)
            text.add(" It cannot lock: %.3g limb lengths are left to fade, more than lock_radius, %.3g.",
                     share(state.offset), double{rules.lock_radius});
    }
    void explain_waiting(Text& text) const
    {
        text.add(" It broke away and is still in contact, so it waits to lock until");
        if (rules.relock_speed > 0)
            text.add(" the animation is slower than relock_speed, %.3g limb lengths a second, or",
                     double{rules.relock_speed});
        text.add(" contact ends and begins anew.");
    }
};

}  // namespace

void explain_plant(const Group& group, std::uint32_t limb, std::uint32_t flags, Text& text)
{
    const PlantedLimb planted{group, limb};
    if (!planted.state.is(CarriedPlant::begun)) return text.add("It was reset, so its planted point starts anew. ");
    if (planted.state.is(CarriedPlant::locked)) {
        planted.explain_locked(text);
    } else if (planted.state.is(CarriedPlant::released)) {
        planted.explain_released(flags & SWIVEL_BROKE_AWAY, text);
    } else {
        planted.explain_fading(text);
        planted.explain_free(text);
    }
    if (flags & SWIVEL_CUT) text.add(" Its speed was too high to be eased away and was cut, so its target jumps.");
    text.add(" ");
}

}  // namespace swivel

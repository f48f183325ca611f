// SPDX-License-Identifier: MIT
//
// No row has the shift that a spring seeks. So it is computed again, from the records of the limbs that fit, unless the
// root is turned or joints have scales of their own, which no row has, either.
#include <cmath>
#include <optional>

#include "batch/explain/explain.h"
#include "batch/query/limb_value.h"
#include "batch/query/one_limb.h"
#include "core/fit.h"
#include "core/limb_bones.h"

namespace swivel {

namespace {

// A limb that counts for the shift, as its record has it.
struct FittedLimb {
    const Group& group;
    std::uint32_t limb;
    LimbValue record{group, limb, SWIVEL_RECORD};
    double scale = record[kRecordScale];

    LimbValue value(swivel_field field) const { return {group, limb, field}; }
    bool has(swivel_features feature) const { return group.features & feature; }
    double reach() const
    {
        const double upper = scale * record[kRecordLengths], fore = scale * record[kRecordLengths + 1],
                     bones = upper + fore;
        double far = bones;
        if (has(SWIVEL_WITH_FLEXION_LIMIT))
            far = std::fmin(bent_reach(upper, fore, value(SWIVEL_FLEXION_LIMIT)[0]), far);
        if (!has(SWIVEL_WITH_CAP)) return far;
        const LimbValue cap = value(SWIVEL_CAP);
        const Vector<double> bone = vector(0.0, 0.0, fore),
                             incoming = vector(0.0, 0.0, upper) +
                                        sandwich(normalise(rotor_of(record, kRecordIncoming + 4)), bone);
        return capped_reach<double>({cap[0], cap[1], cap[2], std::sqrt(len2(incoming))}, far, bones).far;
    }
    Rotor<double> hand() const
    {
        if (has(SWIVEL_WITH_PLANT)) return normalise(rotor_of(value(SWIVEL_SOLVED_GOAL), 3));
        return normalise(wanted_hand(group, limb));
    }
    double weight() const
    {
        return value(SWIVEL_PELVIS_FIT_WEIGHT)[0] * (has(SWIVEL_WITH_WEIGHTS) ? value(SWIVEL_WEIGHTS)[0] : 1);
    }
    // The weight of its next target.
    double next_weight() const
    {
        if (!has(SWIVEL_WITH_NEXT_TARGET)) return 0;
        const double near = std::fmax(1 - value(SWIVEL_NEXT_TIME)[0] * double{group.plan.limb.per_ahead}, 0);
        return near * near;
    }
    bool counts() const { return weight() > 0 || next_weight() > 0; }
    // The shifts that it asks for. shift: the body's in the last solve, which its record has.
    ShiftSpan<double> asks(const Vector<double>& up, double shift) const
    {
        Vector<double> point = vector_of(record, kRecordShoulder) - shift * up;
        if (has(SWIVEL_WITH_EFFECTOR)) point = point + scale * sandwich(hand(), vector_of(value(SWIVEL_EFFECTOR)));
        const double far = reach();
        const auto asks_for = [&](const LimbValue& target, double share) {
            return counted(shift_span(Vector<double>(point - vector_of(target)), up, far), share);
        };
        const ShiftSpan<double> present =
            asks_for(value(has(SWIVEL_WITH_PLANT) ? SWIVEL_SOLVED_GOAL : SWIVEL_TARGET), weight());
        if (!has(SWIVEL_WITH_NEXT_TARGET)) return present;
        return present & asks_for(value(SWIVEL_NEXT_TARGET), next_weight());
    }
};

// A body's shift, and where it goes.
struct SoughtShift {
    double at, goal;
    ShiftSpan<double> span;  // the shifts that the limbs ask for
    double seen;             // a shorter way is not worth a word

    bool is_late() const { return std::fabs(goal - at) > seen; }
};

// Whether a limb's record has the shoulder from which the limb asked for a shift. A clavicle, or a look above the limb,
// turns the shoulder only after that. A limb with bad input may have asked for nothing.
bool is_known(const Group& group, std::uint32_t limb)
{
    return group.features & SWIVEL_WITH_RECORD && !(group.features & SWIVEL_WITH_CLAVICLE) &&
           group.plan.joints.above == 0 && !(flags_of(group, limb) & SWIVEL_BAD_INPUT);
}

// Null where it is not known: the root may be turned, or its scale may not be that of the limbs, as after a job for a
// part of the crowd; or it is not known what a limb asked for; or the flags contradict.
std::optional<SoughtShift> sought_shift(const swivel_crowd& crowd, const Group& shift, std::uint32_t limb)
{
    if (crowd.pose_notes.load(std::memory_order_relaxed) & (kHasRootRotation | kHasJointScales)) return std::nullopt;
    const Vector<double> up = vector<double>(shift.plan.up[0], shift.plan.up[1], shift.plan.up[2]);
    const double at = LimbValue(shift, limb, SWIVEL_SHIFT)[0];
    ShiftSpan<double> span{-kAnyShift, kAnyShift, true};
    double length = 0;
    for (std::uint32_t g = 0; g < crowd.group_count; ++g) {
        const Group& group = crowd.groups[g];
        if (!(group.features & SWIVEL_WITH_PELVIS_FIT)) continue;
        if (!is_known(group, limb)) return std::nullopt;
        const FittedLimb fitted{group, limb};
        length = fitted.scale * double{shift.plan.rest_length};  // all limbs have the root's scale
        span = span & fitted.asks(up, at);
    }
    const FittedShift<double> goal =
        fitted_shift(span, LimbValue(shift, limb, SWIVEL_SHIFT_WISH)[0], double{shift.plan.shift.drop} * length,
                     double{shift.plan.shift.rise} * length);
    const bool all_reach = flags_of(shift, limb) & SWIVEL_REACHED;
    if (goal.all_reach != all_reach || !std::isfinite(goal.shift)) return std::nullopt;
    return SoughtShift{at, goal.shift, span, 1e-4 * length};
}

}  // namespace

void explain_shift(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text)
{
    const std::uint32_t flags = flags_of(group, limb);
    const LimbValue shift(group, limb, SWIVEL_SHIFT), wish(group, limb, SWIVEL_SHIFT_WISH);
    if (flags & SWIVEL_BAD_INPUT || is_bad_in_body(group, limb)) {
        text.add("Bad input: ");
        if (!explain_bad_in_body(group, limb, text)) explain_bad_pose(crowd, kTimeOfPose | kRootOfPose, "", text);
        return text.add(". The shift stays as it was.");
    }
    if (flags == 0) return text.add("It was never solved, so it has no shift.");
    if (shift[2] == 0) return text.add("It was reset: the next solve shifts the body at once.");
    // The end of a spring's way has lengths that are rounding, and then denormal ones.
    const double rounding = 1e-7 * double{group.plan.rest_length};
    const auto told = [&](double length) { return std::fabs(length) < rounding ? 0 : length; };
    text.add("The body is shifted by %.4g along up, at %.4g a second", told(shift[0]), told(shift[1]));
    const std::optional<SoughtShift> sought = sought_shift(crowd, group, limb);
    const bool is_late = sought && sought->is_late(), all_reach = flags & SWIVEL_REACHED;
    if (is_late)
        text.add(", and goes to %.4g.", told(sought->goal));
    else
        text.add(sought ? ", which is where it goes." : ".");
    if (all_reach)
        text.add(" All limbs that count reach from %s.", sought ? "there" : "where it goes");
    else
        text.add(" No shift from %.3g limb lengths down to %.3g up lets all limbs that count reach.",
                 double{group.plan.shift.drop}, double{group.plan.shift.rise});
    if (is_late) text.add(" Its spring is late by %.4g", std::fabs(sought->goal - sought->at));
    const bool is_high = is_late && sought->at > sought->span.high, is_low = is_late && sought->at < sought->span.low;
    if (all_reach && (is_high || is_low))
        text.add(", so limbs miss their targets meanwhile. A %s SWIVEL_SHIFT_WISH gives them room",
                 is_high ? "lower" : "higher");
    if (is_late) text.add(".");
    if (wish[0] != 0) text.add(" The wish is %.4g.", wish[0]);
}

void explain_coming_shift(const swivel_crowd& crowd, const Group& fits, std::uint32_t limb, Text& text)
{
    if (!FittedLimb{fits, limb}.counts()) return;
    for (std::uint32_t g = 0; g < crowd.group_count; ++g) {
        const Group& group = crowd.groups[g];
        if (!(group.features & kShift) || flags_of(group, limb) & SWIVEL_BAD_INPUT || is_bad_in_body(group, limb))
            continue;
        if (LimbValue(group, limb, SWIVEL_SHIFT)[2] == 0) continue;  // it was reset
        const std::optional<SoughtShift> sought = sought_shift(crowd, group, limb);
        if (sought && sought->is_late())
            text.add(" It counts for the body's shift, which still goes %s by %.4g.",
                     sought->goal < sought->at ? "down" : "up", std::fabs(sought->goal - sought->at));
    }
}

}  // namespace swivel

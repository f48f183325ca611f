// SPDX-License-Identifier: MIT
//
// Solves the limb again, in a crowd of its own on the stack (explain_probe.h), and says in words what it meets.
#include "batch/explain/explain.h"

#include <array>
#include <cmath>

#include "batch/explain/bad_value.h"
#include "batch/explain/explain_probe.h"
#include "batch/query/limb_value.h"
#include "core/limb_goal.h"

namespace swivel {

namespace {

// Names the lengths of a field's axis and pairs that are not 1.
void explain_lengths(const Probe& probe, swivel_field field, Text& text)
{
    const auto length2 = [&](std::uint32_t first, std::uint32_t count) {
        float sum = 0;  // of floats and in their order, as a solve sums them
        for (std::uint32_t c = first; c < first + count; ++c) sum += probe.value(field, c) * probe.value(field, c);
        return sum;
    };
    std::uint32_t c = 0;
    for (const ValuePart part : row_of(field).value.parts) {
        const PartRow& row = row_of(part);
        const std::uint32_t end = c + row.count, size = row.unit_count;
        for (; size > 0 && c < end; c += size) {
            const float unit2 = length2(c, size);
            if (is_unit2(unit2)) continue;
            if (part == ValuePart::axis)
                text.add(" (its axis is %.8g long)", std::sqrt(double{unit2}));
            else
                text.add(" (its pair %g, %g is %.8g long)", double{probe.value(field, c)},
                         double{probe.value(field, c + 1)}, std::sqrt(double{unit2}));
        }
        c = end;
    }
}

// The numbers of a pose that a body's limb depends on. Joints are numbered as in the skeleton.
std::array<char, 128> pose_words(const swivel_crowd& crowd, const BodyLimb& limb)
{
    std::array<char, 128> words;
    const auto number = [&](std::uint32_t row) { return crowd.joints[joint_at(crowd, row)].skeleton_joint; };
    Text(words).add("a rotation, place or scale of joint %u, %u or %u, of one above or of the root",
                    number(limb.shoulder), number(limb.elbow), number(limb.wrist));
    return words;
}

// Names the inputs that are bad on their own.
void explain_bad_input(Probe& probe, const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text)
{
    text.add("Bad input: ");
    bool is_found = false, is_place_bad = false, is_pose_bad = false;
    const auto found = [&](swivel_field field) {
        text.add("%s", is_found ? "; " : "");
        is_found = true;
        const std::uint32_t unknown = add_numbers(group, limb, field, text);
        if (unknown > 0)
            return text.add(") is not a number%s",
                            unknown < field_row_count(group.features, field) ? "" : ": it may never have been written");
        text.add(") is out of its range, %s", row_of(field).value.words);
        explain_lengths(probe, field, text);
    };
    for (const FieldRow& row : kFields) {
        const swivel_field field = row.field;
        if (row.kind != SWIVEL_FIELD_INPUT) continue;
        if (is_bad_in_body(group, limb, field)) found(field);
        // A goal that the library computes is no input.
        const bool is_goal = field == SWIVEL_TARGET || field == SWIVEL_HAND;
        if (probe.component_count(field) == 0 || (is_goal && group.features & kLibraryGoal)) continue;
        probe.take();
        probe.give_up_all_but(field);
        if (!(probe.solve() & SWIVEL_BAD_INPUT)) continue;
        if (!probe.is_posed(field))
            found(field);
        else if (field == SWIVEL_SHOULDER_POSITION)
            is_place_bad = true;
        else
            is_pose_bad = true;
    }
    if (holds_bad(crowd, group, limb)) {
        text.add("%sgroup %u, which it holds, has bad input", is_found ? "; " : "", group.plan.limb.link.group);
        is_found = true;
    }
    const std::uint32_t notes = crowd.pose_notes.load(std::memory_order_relaxed);
    if (is_place_bad || is_pose_bad) text.add("%sin the pose, ", is_found ? "; " : "");
    // Joints' places are from the root's. So what is bad in joints is not in the shoulder's place alone.
    if (is_pose_bad)
        text.add("%s is not a number or out of its range", pose_words(crowd, group.plan.limb).data());
    else if (is_place_bad)
        text.add("the root's place is not a number or further than 1e15");
    else if (!is_found && group.features & SWIVEL_WITH_PLANT)
        explain_bad_pose(crowd,
                         kTimeOfPose | kSupportOfPose | kWeightOfPose | (notes & kHasDoubleRoot ? kRootOfPose : 0u), "",
                         text);
    else if (!is_found && probe.is_of_body())
        explain_bad_pose(crowd, kWeightOfPose | (notes & kHasWeight && !(notes & kIsUnknown) ? 0u : kJointsOfPose),
                         pose_words(crowd, group.plan.limb).data(), text);
    else if (!is_found)
        text.add("each input is in its range, but not as the parent's rotation and scale have it");
    text.add(". The limb %s.", !group.keeps_pose    ? "has its rest pose"
                               : probe.is_of_body() ? "keeps its incoming pose"
                                                    : "keeps the pose it had");
}

bool has_effector(const Probe& solved)
{
    return solved.component_count(SWIVEL_EFFECTOR) > 0 && !solved.is(SWIVEL_EFFECTOR, {0, 0, 0});
}
// The end of the limb that goes to the target.
const char* end_of(const Probe& solved) { return has_effector(solved) ? "effector" : "wrist"; }

const char* zone_of(const Probe& solved)
{
    return solved.component_count(SWIVEL_CAP) > 0 ? "The eased zone of its cap" : "A soft zone of reach";
}

// reached: the distance from shoulder to wrist; by: its bound. missed() is the distance from the target itself.
void explain_blended_reach(const Probe& solved, std::uint32_t flags, double reached, const char* by, Text& text)
{
    if (flags & (SWIVEL_CLAMPED_FAR | SWIVEL_CLAMPED_NEAR)) {
        const bool is_far = flags & SWIVEL_CLAMPED_FAR;
        text.add("The blended target is %s: the wrist is %.4g from the shoulder, as %s as %s let it.",
                 is_far ? "out of reach" : "too near", reached, is_far ? "far" : "near", by);
    } else if (flags & SWIVEL_SOFTENED) {
        text.add("%s keeps the %s from its blended target.", zone_of(solved), end_of(solved));
    } else {
        text.add("The blended target is reached.");
    }
    text.add(" With a position weight of %.3g, the %s is %.4g from the target itself.",
             double{solved.value(SWIVEL_WEIGHTS, 0)}, end_of(solved), solved.missed());
}

// The bound that the wrist's distance from the shoulder has met.
const char* bound_of(const Probe& solved, std::uint32_t flags, double reached)
{
    if (solved.is(SWIVEL_LENGTHS, {0, 0})) return "bones of no length";
    if (flags & SWIVEL_LIMITED_FLEXION) return "its bones and its flexion limit";
    const bool is_straight = reached >= (1 - 1e-4) * solved.length();  // a thousand times rounding
    return flags & SWIVEL_CLAMPED_FAR && solved.component_count(SWIVEL_CAP) > 0 && !is_straight ? "its cap"
                                                                                                : "its bones";
}

void explain_reach(const Probe& solved, std::uint32_t flags, Text& text)
{
    const double missed = solved.missed();
    const LimbPose pose = solved.pose();
    const double reached = std::sqrt(len2(pose.wrist - pose.shoulder));
    const bool aims = solved.component_count(SWIVEL_AIM) > 0;
    const bool blends = solved.component_count(SWIVEL_WEIGHTS) > 0 && solved.value(SWIVEL_WEIGHTS, 0) < 1;
    const char* const by = bound_of(solved, flags, reached);
    const char* const target = has_effector(solved) ? "The effector's target" : "The target";
    if (blends)
        explain_blended_reach(solved, flags, reached, by, text);
    else if (aims && flags & SWIVEL_CLAMPED_NEAR)
        text.add("The target is too near to aim at with this flexion: the hand's ray passes it by %.4g.", missed);
    else if (aims)
        text.add("The hand aims at the target, to within %.2g of the limb's length.", solved.missed_share());
    else if (flags & SWIVEL_CLAMPED_FAR)
        text.add("%s is %.4g out of reach: the wrist is %.4g from the shoulder, as far as %s let it.", target, missed,
                 reached, by);
    else if (flags & SWIVEL_CLAMPED_NEAR)
        text.add("%s is %.4g too near: the wrist is %.4g from the shoulder, as near as %s let it.", target, missed,
                 reached, by);
    else if (flags & SWIVEL_SOFTENED)
        text.add("%s keeps the %s %.4g from its target.", zone_of(solved), end_of(solved), missed);
    else
        text.add("%s is reached, to within %.2g of the limb's length.", target, solved.missed_share());
    if (flags & SWIVEL_STRETCHED) text.add(" The bones are stretched for it.");
    if (flags & SWIVEL_SWIVEL_UNDEFINED)
        text.add(solved.has(SWIVEL_POLE_HAND)
                     ? " The hand does not say where the elbow goes: it points along the target's line, or that has no "
                       "length."
                 : solved.has(SWIVEL_POLE_HALF_LINE)
                     ? " The target's line has no length or points along pole_behind, where the elbow may go anywhere."
                     : " The pole does not say where the elbow goes: it is of no length or on the target's line.");
    if (solved.is_of_body()) return;
    for (const swivel_field field : {SWIVEL_PARENT_ROTATION, SWIVEL_HAND})
        if (solved.is(field, {0, 0, 0, 1})) text.add(" Its %s is the identity, as limbs start.", name_of(field));
}

// Whether these are one pose. A body's limb is solved from a record, so that its last digits differ. The
// share of the limb is a thousand times rounding, and less than anyone sees. The elbow of a straight limb is only known
// to the root of rounding.
bool is_near(const LimbPose& a, const LimbPose& b)
{
    constexpr double kShare = 1e-4, kElbowShare = 3e-3;
    const double size2 = len2(b.elbow - b.shoulder) + len2(b.wrist - b.elbow);
    const double cos_half = scalar_product(~a.hand, b.hand);
    return len2(a.elbow - b.elbow) <= kElbowShare * kElbowShare * size2 &&
           len2(a.wrist - b.wrist) <= kShare * kShare * size2 && 1 - cos_half * cos_half <= kShare * kShare;
}

// Not inlined, because explain_prop, which also has a limb on the stack, needs the room.
[[gnu::noinline]] void explain_limb(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text)
{
    Probe probe(group, limb);
    const std::uint32_t flags_were = probe.flags();
    if (probe.is_of_body() && flags_were == 0) return text.add("It was never solved, so no pose of it is known.");
    const LimbPose explained = probe.pose();
    const std::uint32_t flags_now = probe.solve();
    // A goal that the library computed is that of the last good solve.
    const bool was_bad = group.features & kLibraryGoal && flags_were & SWIVEL_BAD_INPUT;
    const bool is_kept = was_bad || (group.keeps_pose && flags_now & SWIVEL_BAD_INPUT);
    const bool is_same = probe.is_of_body() ? is_near(explained, probe.pose()) : probe.has_bits_of_limb();
    // At the borders of reach the solver's own flags count: rounding of a record may have others.
    const std::uint32_t flags = is_same && !(flags_now & SWIVEL_BAD_INPUT) ? flags_were : flags_now;
    // Steps change the results from solve to solve, and kept results belong to earlier inputs.
    if (!(group.features & kCarryingFeatures) && !is_kept && !is_same)
        text.add("Its inputs changed since it was solved, or it never was. As they are now: ");
    if (flags & SWIVEL_BAD_INPUT || was_bad || is_bad_in_body(group, limb))
        return explain_bad_input(probe, crowd, group, limb, text);
    if (group.features & SWIVEL_WITH_RECORD) doubt_limb(group, limb, probe, text);
    if (group.features & SWIVEL_WITH_PLANT) explain_plant(group, limb, flags_were, text);
    if (group.features & SWIVEL_WITH_GROUND) explain_ground(group, limb, text);
    if (group.features & SWIVEL_WITH_LINK) explain_link(crowd, group, limb, text);
    explain_reach(probe, flags, text);
    if (group.features & SWIVEL_WITH_PELVIS_FIT && flags & SWIVEL_CLAMPED_FAR)
        explain_coming_shift(crowd, group, limb, text);
    explain_limits(probe, flags_were, flags, text);
}

}  // namespace

void explain(const swivel_crowd& crowd, std::uint32_t g, std::uint32_t limb, Text& text)
{
    const Group& group = crowd.groups[g];
    if (group.features & kShift)
        explain_shift(crowd, group, limb, text);
    else if (group.features & kProp)
        explain_prop(crowd, group, limb, text);
    else if (group.features & kLook)
        explain_look(crowd, group, limb, text);
    else
        explain_limb(crowd, group, limb, text);
}

}  // namespace swivel

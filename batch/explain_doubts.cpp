// SPDX-License-Identifier: MIT
#include "batch/explain_doubts.h"

#include <cmath>

#include "batch/limb_value.h"

namespace swivel {

namespace {

// Lengths that go with the skeleton's bones are wrong where the pose's are in another unit.
void doubt_bones(const Group& group, double posed, Text& text)
{
    const double rest = double{group.binding.lengths[0]} + double{group.binding.lengths[1]};
    if (!(posed > kOtherUnit * rest || kOtherUnit * posed < rest)) return;
    text.add(
        "Warning: its bones are %.4g times as long as the skeleton's. Lengths of swivel_plant and others go with the "
        "skeleton's: give it in the unit of the pose. ",
        posed / rest);
}

// A point that is planted far from its support is known to float precision alone.
void doubt_support(const Group& group, std::uint32_t limb, double length, Text& text)
{
    constexpr double kMost = 1e4, kPrecision = 6e-8;
    const double away = LimbValue(group, limb, SWIVEL_PLANT).length(0, 3);
    if (!(away > kMost * length)) return;
    text.add(
        "Warning: it is planted %.3g away from its support, where floats are good to %.2g, so it slides by as much. "
        "Give swivel_pose.support_position, near the body. ",
        away, kPrecision * away);
}

}  // namespace

bool doubt_solve(const swivel_crowd& crowd, Text& text)
{
    const float time = crowd.time.load(std::memory_order_relaxed);
    if (time > 1)
        text.add("Warning: the last solve had a time of %g seconds. If that is in milliseconds, divide it by 1000.",
                 double{time});
    else if (time == 0 && crowd.is_in_place.load(std::memory_order_relaxed))
        text.add(
            "Warning: the last solve had a time of 0 and wrote its results over the pose. Where nobody animates the "
            "pose between such solves, each corrects the last one's results, and limbs drift. Give "
            "swivel_pose.results.");
    return !text.is_empty();
}

void doubt_limb(const Group& group, std::uint32_t limb, const Probe& solved, Text& text)
{
    constexpr double kLongEffector = 3, kFarTarget = 100, kHighGround = 20;  // limb lengths
    const LimbValue record(group, limb, SWIVEL_RECORD);
    const double bones = record[kRecordLengths] + record[kRecordLengths + 1], length = record[kRecordScale] * bones;
    doubt_bones(group, bones, text);
    if (group.features & SWIVEL_WITH_EFFECTOR)
        if (const double effector = LimbValue(group, limb, SWIVEL_EFFECTOR).length(0, 3);
            effector > kLongEffector * bones)
            text.add(
                "Warning: its effector is %.4g from the wrist joint, but its bones are %.4g long. Give it in their "
                "unit. ",
                effector, bones);
    if (solved.missed() > kFarTarget * length)
        text.add("Warning: its target is %.3g limb lengths away. Is it in another unit, or from another origin? ",
                 solved.missed() / length);
    if (group.features & SWIVEL_WITH_GROUND)
        if (const double lift = LimbValue(group, limb, SWIVEL_LIFT)[0]; std::fabs(lift) > kHighGround * length)
            text.add(
                "Warning: the ground below it is %.4g from the root's level. Is it in another unit, or from another "
                "origin? ",
                std::fabs(lift));
    if (group.features & SWIVEL_WITH_PLANT) doubt_support(group, limb, length, text);
}

}  // namespace swivel

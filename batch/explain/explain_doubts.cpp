// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "batch/explain/explain.h"
#include "batch/explain/explain_probe.h"
#include "batch/query/limb_value.h"

namespace swivel {

namespace {

// The lengths of a limb in the pose: of its bones as they are, and scaled as its parent is.
struct PosedLengths {
    double bones, scaled;
};

// Lengths that go with the skeleton's bones are wrong where the pose's are in another unit.
void doubt_bones(const Group& group, const PosedLengths& posed, Text& text)
{
    const double rest = double{group.binding.lengths[0]} + double{group.binding.lengths[1]};
    if (!(posed.bones > kOtherUnit * rest || kOtherUnit * posed.bones < rest)) return;
    text.add(
        "Warning: its bones are %.4g times as long as the skeleton's. Lengths of swivel_plant and others go with the "
        "skeleton's: give it in the unit of the pose. ",
        posed.bones / rest);
}

// No game has an effector, a target or a ground ten limbs away. lengths: of the limb.
void doubt_distance(const char* what, double lengths, Text& text)
{
    if (lengths > 10 && lengths < std::numeric_limits<double>::infinity())
        text.add("Warning: %s is %.3g limb lengths away. Is it in another unit, or from another origin? ", what,
                 lengths);
}

// A point far from its support is only known as well as floats are there.
void doubt_support(const Group& group, std::uint32_t limb, const PosedLengths& posed, Text& text)
{
    constexpr double kSeen = 5e-4;  // limb lengths: half a millimetre, in each frame
    const double away = LimbValue(group, limb, SWIVEL_PLANT).length(0, 3),
                 rounding = 0.5 * double{std::numeric_limits<float>::epsilon()} * away;
    if (!(rounding > kSeen * posed.scaled)) return;
    text.add(
        "Warning: its point is %.3g from the support that it is planted on, where floats are good to %.2g. It slides "
        "by as much: give swivel_pose.support_position, near the body. ",
        away, rounding);
}

}  // namespace

bool doubt_solve(const swivel_crowd& crowd, Text& text)
{
    const float time = crowd.doubted_time.load(std::memory_order_relaxed);
    const std::uint32_t anew = crowd.solves_anew.load(std::memory_order_relaxed);
    if (time == kNoDoubt && anew < 2) return false;
    if (anew >= 2)
        text.add(
            "Warning: all bodies were reset before each of the last %u solves, so plants, looks and shifts begin anew "
            "in each. swivel_reset() is for teleports.",
            anew);
    else if (time > 0)
        text.add("Warning: the last solve had a time of %g seconds. If that is in milliseconds, divide it by 1000.",
                 double{time});
    else
        text.add(
            "Warning: the last solve had a time of 0 and wrote its results over the pose. Where nobody animates the "
            "pose between such solves, each corrects the last one's results, and limbs drift. Give "
            "swivel_pose.results.");
    return true;
}

void doubt_limb(const Group& group, std::uint32_t limb, const Probe& solved, Text& text)
{
    const LimbValue record(group, limb, SWIVEL_RECORD);
    const double bones = record[kRecordLengths] + record[kRecordLengths + 1];
    const PosedLengths posed{bones, record[kRecordScale] * bones};
    doubt_bones(group, posed, text);
    if (group.features & SWIVEL_WITH_EFFECTOR)
        doubt_distance("its effector", LimbValue(group, limb, SWIVEL_EFFECTOR).length(0, 3) / posed.bones, text);
    if (!(group.features & SWIVEL_WITH_WEIGHTS && solved.value(SWIVEL_WEIGHTS, 0) == 0))
        doubt_distance("its target", solved.missed() / posed.scaled, text);
    if (group.features & SWIVEL_WITH_GROUND)
        doubt_distance("the ground below it", std::fabs(LimbValue(group, limb, SWIVEL_LIFT)[0]) / posed.scaled, text);
    if (group.features & SWIVEL_WITH_PLANT) doubt_support(group, limb, posed, text);
}

}  // namespace swivel

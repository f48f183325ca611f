// SPDX-License-Identifier: MIT
#include "batch/explain/compare_causes.h"

namespace swivel {

Text& Causes::add(const LimbPlaces& ours)
{
    if (count++ > 0) text.add(" Or: ");
    off = limb.in_lengths(limb.worst(ours));
    return text;
}

Text& Causes::add_unsure()
{
    if (count++ > 0) text.add(" Or: ");
    is_sure = false;
    return text;
}

bool Causes::guess(const LimbPlaces& ours, const char* sentence)
{
    if (!limb.agrees(ours)) return false;
    add(ours).add("%s", sentence);
    return true;
}

bool Causes::guess(bool is_possible, const Mistake& mistake)
{
    if (!is_possible) return false;
    Reading how = limb.as_given;
    mistake.make(how);
    return guess(limb.places(limb.joints, how), mistake.sentence);
}

}  // namespace swivel

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "batch/explain/compare.h"
#include "batch/explain/explain.h"

namespace swivel {

namespace {

Text& add_doubt(Causes& causes)
{
    causes.text.add("%s ", causes.count++ > 0 ? "" : "The places agree, but something else is wrong.");
    return causes.text;
}

void doubt_unit(Causes& causes)
{
    const ComparedLimb& limb = causes.limb;
    if (!limb.body.has_translations(limb.as_given)) return;
    Reading how = limb.as_given;
    how.at_rest = true;
    const double at_rest = length(limb.places(limb.joints, how)), posed = length(limb.posed);
    if (at_rest <= kOtherUnit * posed && kOtherUnit * at_rest >= posed) return;
    add_doubt(causes).add(
        "The skeleton's bones are %.4g times as long as the pose's. Lengths that go with the skeleton's, such as those "
        "of swivel_plant, are wrong then. Give the skeleton in the unit of the pose.",
        at_rest / std::max(posed, kTiny));
}

void doubt_time(Causes& causes)
{
    const double time = causes.limb.body.time();
    if (!(time > 1)) return;
    add_doubt(causes).add(
        "The pose's time is %g, which are that many seconds since the last solve. If it is in milliseconds, divide it "
        "by 1000.",
        time);
}

void doubt_bend(Causes& causes)
{
    constexpr double kStraight = 0.94;  // the cosine of 20 degrees
    const ComparedLimb& limb = causes.limb;
    const float(&h)[3] = limb.crowd.groups[limb.group].plan.limb.hinge;
    const Vector<double> upper = limb.posed.at[1] - limb.posed.at[0], fore = limb.posed.at[2] - limb.posed.at[1],
                         hinge = turned(limb.body.rotation(limb.joints.at[0], limb.as_given),
                                        vector<double>(h[0], h[1], h[2])),
                         turn = cross(fore, upper);
    const bool is_straight = scalar_product(upper, fore) > kStraight * std::sqrt(len2(upper) * len2(fore));
    if (is_straight || !(scalar_product(hinge, turn) < 0)) return;
    add_doubt(causes).add(
        "The elbow, joint %u, is bent by %.3g degrees to the other side than the group's `bend` or its rest pose says. "
        "A bend is the direction that flexion carries the forearm towards, in the shoulder joint's frame.",
        limb.named(1), in_degrees(std::atan2(std::sqrt(len2(turn)), scalar_product(upper, fore))));
}

}  // namespace

bool doubt(Causes& causes)
{
    doubt_unit(causes);
    doubt_time(causes);
    doubt_bend(causes);
    return causes.count > 0;
}

}  // namespace swivel

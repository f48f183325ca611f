// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "batch/explain/compare.h"

namespace swivel {

double distance(const Vector<double>& a, const Vector<double>& b) { return std::sqrt(len2(a - b)); }
double length(const LimbPlaces& limb) { return distance(limb.at[0], limb.at[1]) + distance(limb.at[1], limb.at[2]); }

LimbJoints ComparedLimb::joints_of(std::uint32_t other_group) const
{
    const BodyLimb& limb = crowd.groups[other_group].plan.limb;
    return {{joint_at(crowd, limb.shoulder), joint_at(crowd, limb.elbow), joint_at(crowd, limb.wrist)}};
}
LimbPlaces ComparedLimb::places(const LimbJoints& chosen, const Reading& how) const
{
    return {{body.place(chosen.at[0], how), body.place(chosen.at[1], how), body.place(chosen.at[2], how)}};
}

double ComparedLimb::worst(const LimbPlaces& ours) const
{
    double max = 0;
    for (int n = 0; n < 3 && !std::isnan(max); ++n) {
        const double off = distance(ours.at[n], theirs.at[n]);
        if (!(off <= max)) max = off;
    }
    return max;
}
double ComparedLimb::allowed(const LimbPlaces& ours) const
{
    constexpr double kMaxOff = 1e-3;  // in limb lengths, as swivel_explain.h says
    return kMaxOff * std::max(length(ours), length(theirs)) + (pose.root_is_double ? 0 : rounding());
}
double ComparedLimb::rounding() const
{
    constexpr double kRounding = 2e-7;  // as docs/fields.md says
    double size2 = 0;
    for (const Vector<double>& v : theirs.at) size2 = std::max(size2, len2(v));
    return kRounding * std::sqrt(size2);
}
double ComparedLimb::in_lengths(double off) const { return off / std::max(length(theirs), kTiny); }
double ComparedLimb::factor_about(const Vector<double>& centre) const
{
    double across = 0, size = 0;
    for (int n = 0; n < 3; ++n) {
        const Vector<double> way = posed.at[n] - centre;
        across += scalar_product(theirs.at[n] - centre, way);
        size += len2(way);
    }
    return across / size;
}

bool has_same_shape(const ComparedLimb& limb)
{
    for (int n = 0; n < 3; ++n) {
        const int next = (n + 1) % 3;
        const double theirs = distance(limb.theirs.at[n], limb.theirs.at[next]),
                     ours = distance(limb.posed.at[n], limb.posed.at[next]);
        if (!(std::fabs(theirs - ours) <= limb.allowed(limb.posed))) return false;
    }
    return true;
}

namespace {

double hundredths(double x) { return std::round(100 * x) / 100 + 0.0; }  // without -0

void describe_shoulder(const ComparedLimb& limb, Text& text)
{
    const Vector<double> way = limb.theirs.at[0] - limb.posed.at[0];
    if (limb.agrees(moved(limb.posed, [&](const Vector<double>& v) { return v + way; })))
        return text.add(
            "The others are off in the same way. Look at root_position, and at the translations above the shoulder.");
    const Vector<double> root = limb.body.root_place();
    if (const double factor = limb.factor_about(root); limb.agrees(scaled_about(root, factor, limb.posed)))
        return text.add(
            "The places are %.4g times as far from the root as the pose's. Look at root_scale and at scales above the "
            "shoulder.",
            factor);
    text.add("%s Look at the root, and at the joints above the shoulder.",
             has_same_shape(limb) ? "The limb's own shape is right, so it is turned as a whole."
                                  : "The limb's own shape is another, too.");
}

// part: the bone's end, elbow or wrist.
void describe_bone(const ComparedLimb& limb, int part, Text& text)
{
    const char* const bone = part == 1 ? "upper arm" : "forearm";
    const double theirs = distance(limb.theirs.at[part], limb.theirs.at[part - 1]),
                 ours = distance(limb.posed.at[part], limb.posed.at[part - 1]);
    if (std::fabs(theirs - ours) > limb.allowed(limb.posed))
        text.add(
            "Your %s is %.4g long, the pose's %.4g. Look at the translations and scales between joints %u and %u; "
            "without translations bones are as the skeleton rests.",
            bone, theirs, ours, limb.named(part - 1), limb.named(part));
    else
        text.add(
            "The %s is as long as yours, %.4g. Look at the rotations of joint %u and of those between it and joint %u.",
            bone, theirs, limb.named(part - 1), limb.named(part));
}

}  // namespace

void describe_difference(const ComparedLimb& limb, Text& text)
{
    int part = 0;
    while (part < 2 && distance(limb.posed.at[part], limb.theirs.at[part]) <= limb.allowed(limb.posed)) ++part;
    const Vector<double> way = limb.theirs.at[part] - limb.posed.at[part];
    const double off = std::sqrt(len2(way));
    if (!(off <= std::numeric_limits<double>::max()))
        return text.add(
            "The pose has no place of the %s, joint %u: a number of it, of a joint above or of the root is not finite "
            "or out of its range. Look at those rotations, translations and scales.",
            kLimbParts[part], limb.named(part));
    text.add(
        "No usual mistake explains it. The first joint that is off is the %s, joint %u: your place is %.4g from the "
        "pose's, in the direction (%g, %g, %g) of the world. ",
        kLimbParts[part], limb.named(part), off, hundredths(way.c[0] / off), hundredths(way.c[1] / off),
        hundredths(way.c[2] / off));
    if (part == 0)
        describe_shoulder(limb, text);
    else
        describe_bone(limb, part, text);
}

}  // namespace swivel

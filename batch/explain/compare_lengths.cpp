// SPDX-License-Identifier: MIT
#include <cmath>

#include "batch/explain/compare.h"

namespace swivel {

namespace {

constexpr Mistake kNoScale{
    [](Reading& how) { how.root_scale = 0; },
    "Your places are without root_scale. Leave it out of the pose, or scale the character that you look at."};
constexpr Mistake kScaleTwice{[](Reading& how) { how.root_scale = 2; },
                              "Your places have root_scale twice: in its joints and at its root. Leave it out of one."};
constexpr Mistake kAtRest{[](Reading& how) { how.at_rest = true; },
                          "Your places are those of bones as the skeleton rests, but the pose has other translations. "
                          "Leave these out, or look at what changes them."};
constexpr Mistake kUnscaled{[](Reading& how) { how.unscaled = true; },
                            "Your places are those of joints without the pose's scales. Leave these out, or scale the "
                            "character that you look at."};

struct Units {
    double factor;
    const char *small, *large;
};
constexpr Units kUnits[] = {{100, "centimetres", "metres"},     {1000, "millimetres", "metres"},
                            {10, "millimetres", "centimetres"}, {2.54, "centimetres", "inches"},
                            {1 / 0.0254, "inches", "metres"},   {1 / 0.3048, "feet", "metres"},
                            {30.48, "centimetres", "feet"},     {12, "inches", "feet"}};

// Units that are so many times each other.
const Units* units_of(double factor, bool& is_larger)
{
    for (const Units& units : kUnits)
        for (const bool larger : {true, false}) {
            const double wanted = larger ? units.factor : 1 / units.factor;
            if (std::fabs(factor - wanted) > 4e-3 * wanted) continue;
            is_larger = larger;
            return &units;
        }
    return nullptr;
}

// Adds a cause if the factor is one of units, and the caller has the limb at `ours`, where the factor puts it.
bool guess_units(Causes& causes, double factor, const LimbPlaces& ours, const char* these, const char* those,
                 const char* advice)
{
    bool is_larger;
    const Units* const units = units_of(factor, is_larger);
    if (!units || !causes.limb.agrees(ours)) return false;
    causes.add(ours).add("%s are in another unit than %s, such as %s instead of %s: the factor is %s%g. %s", these,
                         those, is_larger ? units->small : units->large, is_larger ? units->large : units->small,
                         is_larger ? "" : "1 / ", units->factor, advice);
    return true;
}
bool guess_units_about(Causes& causes, const Vector<double>& centre, const char* those, const char* advice)
{
    const double factor = causes.limb.factor_about(centre);
    return guess_units(causes, factor, scaled_about(centre, factor, causes.limb.posed), "Your places", those, advice);
}
void guess_root_units(Causes& causes, const Vector<double>& root)
{
    const ComparedLimb& limb = causes.limb;
    const double factor = scalar_product(limb.theirs.at[0] - (limb.posed.at[0] - root), root) / len2(root);
    guess_units(causes, factor, moved(limb.posed, [&](const Vector<double>& v) { return v + (factor - 1) * root; }),
                "Your places and the pose's joints", "root_position", "Give it in the same unit.");
}

}  // namespace

void guess_lengths(Causes& causes)
{
    const ComparedLimb& limb = causes.limb;
    const bool has_scale = limb.pose.root_scale.data;
    if (causes.guess(has_scale, kNoScale)) return;
    causes.guess(has_scale, kScaleTwice);
    causes.guess(limb.pose.translations.data, kAtRest);
    causes.guess(limb.pose.scales.data, kUnscaled);
    if (guess_units_about(causes, vector(0.0, 0.0, 0.0), "the pose", "Give both in one unit.")) return;
    const Vector<double> root = limb.body.root_place();
    if (!(len2(root) > 0)) return;
    guess_units_about(causes, root,
                      limb.body.has_translations(limb.as_given) ? "the pose's translations" : "the skeleton",
                      "Give lengths in the unit of root_position, or give root_scale.");
    guess_root_units(causes, root);
}

}  // namespace swivel

// SPDX-License-Identifier: MIT
//
// To find a rule's effect, it places the foot again without that rule. Slopes are as if the root stood upright, because
// no result says how it is turned. Degrees are for people. Trigonometry is allowed here, because no solve sees it.
#include <algorithm>
#include <cmath>

#include "batch/explain/explain.h"
#include "batch/query/limb_value.h"
#include "batch/query/one_limb.h"
#include "core/ground.h"

namespace swivel {

namespace {

constexpr double kSeen = 0.05;  // degrees: a smaller angle would read 0.0

double degrees_between(const Rotor<double>& a, const Rotor<double>& b)
{
    const Rotor<double> turn = ~a * b;
    const double x = turn.at<kI>(), y = turn.at<kJ>(), z = turn.at<kK>();
    return in_degrees(2 * std::atan2(std::sqrt(x * x + y * y + z * z), std::fabs(turn.at<kScalar>())));
}

struct GroundedFoot {
    const Group& group;
    std::uint32_t limb;
    const GroundRules& rules = group.plan.limb.ground;
    Vector<double> up = vector<double>(group.plan.up[0], group.plan.up[1], group.plan.up[2]);
    GroundPlane<double> ground =
        ground_plane(vector_of(value(SWIVEL_GROUND)), vector_of(value(SWIVEL_GROUND_NORMAL)), up);
    Rotor<double> sent = normalise(wanted_hand(group, limb));

    LimbValue value(swivel_field field) const { return {group, limb, field}; }
    Rotor<double> stood(const GroundRules& by) const
    {
        const double scale = value(SWIVEL_RECORD)[kRecordScale];
        const float(&heel_j)[3] = rules.given.heel;
        const Vector<double> heel = vector<double>(heel_j[0], heel_j[1], heel_j[2]);
        const Foot<double> foot{vector_of(value(SWIVEL_SOLVED_GOAL)), sent};
        return foot_on_ground(ground, ground_plane(ground.place, vector_of(value(SWIVEL_LIFT), kSlope), up), up, foot,
                              scale * (heel - vector_of(value(SWIVEL_EFFECTOR))), scale, value(SWIVEL_GROUND_WEIGHT)[0],
                              by)
            .rotation;
    }

    void explain_lift(Text& text) const
    {
        const LimbValue lift = value(SWIVEL_LIFT);
        text.add("The ground %s its foot by %.4g along up", lift[0] < 0 ? "lowers" : "lifts", std::fabs(lift[0]));
        if (lift[1] != 0) text.add(", at %.4g a second", lift[1]);
        text.add(".");
    }
    void explain_turn(Text& text) const
    {
        GroundRules heel_anywhere = rules;
        heel_anywhere.given.heel_clearance = -1e15f;
        GroundRules any_angle = heel_anywhere;
        any_angle.cos_half_max = 0, any_angle.sin_half_max = 1;
        const Rotor<double> with_ground = stood(heel_anywhere);
        const double turn = degrees_between(sent, with_ground), wanted = degrees_between(sent, stood(any_angle)),
                     lift = degrees_between(with_ground, stood(rules));
        if (wanted > turn + kSeen)
            text.add(" The foot turns by %.1f degrees with the ground, the most that it may, not by %.1f.", turn,
                     wanted);
        else if (turn > kSeen)
            text.add(" The foot turns by %.1f degrees with the ground.", turn);
        if (lift > kSeen)
            text.add(" It turns by %.1f more about its toe, so that its heel stays over the ground.", lift);
    }
};

}  // namespace

void explain_ground(const Group& group, std::uint32_t limb, Text& text)
{
    const GroundedFoot foot{group, limb};
    if (!(len2(foot.ground.place) <= kHuge2)) {
        text.add("No ground is known below its foot, which goes as it is animated. ");
        return;
    }
    if (!foot.ground.exists) {
        text.add("The ground below its foot is %.1f degrees steep and counts as none. ",
                 in_degrees(std::acos(std::clamp(foot.ground.rise, -1.0, 1.0))));
        return;
    }
    if (foot.value(SWIVEL_LIFT)[2] == 0) return;  // it was reset
    foot.explain_lift(text);
    // A planted rotation is not known here: its support may be turned.
    if (!(group.features & SWIVEL_WITH_PLANT_ROTATION)) foot.explain_turn(text);
    text.add(" ");
}

}  // namespace swivel

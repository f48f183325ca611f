// SPDX-License-Identifier: MIT
#include <cmath>

#include "batch/explain/compare.h"

namespace swivel {

namespace {

constexpr Mistake kNoPlace{[](Reading& how) { how.root_place = 0; },
                           "Your places are without root_position: they are from the root, or the pose's joints have "
                           "it, too. Give places in the world, and the root once."};
constexpr Mistake kPlaceTwice{[](Reading& how) { how.root_place = 2; },
                              "Your places have root_position twice. Give places in the world, and the root once."};
constexpr Mistake kNoTurn{[](Reading& how) { how.root_turn = 0; },
                          "Your places are without root_rotation: the pose's joints have it, too, or the character "
                          "that you look at is not turned. Give it once."};
constexpr Mistake kTurnTwice{[](Reading& how) { how.root_turn = 2; },
                             "Your places have root_rotation twice: in the joints and at the root. Give it once."};
constexpr Mistake kInRootFrame{[](Reading& how) { how.root_place = how.root_turn = how.root_scale = 0; },
                               "Your places are in the root's frame, not in the world. Give them in the world, or "
                               "leave the root out of the pose."};
constexpr Mistake kFloats{
    [](Reading& how) { how.root_in_other_numbers = true; },
    "The pose's root_position is in floats, but root_is_double says doubles. Set root_is_double to 0."};
constexpr Mistake kDoubles{
    [](Reading& how) { how.root_in_other_numbers = true; },
    "The pose's root_position is in doubles, but it is read as floats. Set root_is_double to 1."};

// Whether the pose has the limb's parts as far from the root as the caller has them.
bool is_turned_about(const ComparedLimb& limb, const Vector<double>& root)
{
    for (int n = 0; n < 3; ++n)
        if (!(std::fabs(distance(limb.theirs.at[n], root) - distance(limb.posed.at[n], root)) <=
              limb.allowed(limb.posed)))
            return false;
    return true;
}

}  // namespace

void guess_root(Causes& causes)
{
    const swivel_pose& pose = causes.limb.pose;
    const bool has_place = pose.root_position.data, has_turn = pose.root_rotation.data,
               has_scale = pose.root_scale.data;
    bool is_found = causes.guess(has_place, kNoPlace);
    is_found |= causes.guess(has_place, kPlaceTwice);
    if (has_turn && causes.count == 0) {
        is_found |= causes.guess(true, kNoTurn);
        is_found |= causes.guess(true, kTurnTwice);
    }
    causes.guess(!is_found && has_place + has_turn + has_scale > 1, kInRootFrame);
}

void guess_root_numbers(Causes& causes)
{
    const ComparedLimb& limb = causes.limb;
    const bool is_double = limb.pose.root_is_double;
    if (!limb.pose.root_position.data || !(is_double || limb.body.may_have_double_root())) return;
    const Mistake& mistake = is_double ? kFloats : kDoubles;
    Reading how = limb.as_given;
    mistake.make(how);
    const LimbPlaces ours = limb.places(limb.joints, how);
    if (limb.worst(ours) <= limb.allowed(ours) + (is_double ? limb.rounding() : 0))
        causes.add(ours).add("%s", mistake.sentence);
}

void guess_no_root(Causes& causes)
{
    const ComparedLimb& limb = causes.limb;
    const bool has_place = limb.pose.root_position.data, has_turn = limb.pose.root_rotation.data;
    if ((has_place && has_turn) || !has_same_shape(limb)) return;
    const Vector<double> way = limb.theirs.at[0] - limb.posed.at[0];
    const auto add = [&](const char* how) {
        causes.add_unsure().add("Your limb has the shape that the pose gives it. It is %s.", how);
    };
    if (!has_place && limb.agrees(moved(limb.posed, [&](const Vector<double>& v) { return v + way; })))
        add("elsewhere, and the pose gives no root_position. Give it");
    else if (!has_turn && is_turned_about(limb, limb.body.root_place()))
        add("turned about the root, and the pose gives no root_rotation. Give it");
    else if (!has_turn && !has_place)
        add("elsewhere and turned, and the pose gives neither root_position nor root_rotation. Give them");
}

}  // namespace swivel

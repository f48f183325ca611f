// SPDX-License-Identifier: MIT
//
// It looks inside the library, as body_op_counts.cpp does: it runs the formula itself, on numbers that count.
#include "bench/rivals/op_counts.h"

#include <stdexcept>

#include "bench/rivals/counted_values.h"
#include "core/limb.h"
#include "core/solve_arm.h"

namespace bench {

namespace {

// With one of a binding's rotations on either side.
template <class Rotation>
Rotor<Counted> between(const Rotation& q)
{
    return rotor(0.1, 0.2, 0.3, 0.9) * q * rotor(0.2, 0.3, 0.1, 0.9);
}
}  // namespace

OpCounts count_ops()
{
    const swivel::ArmGoal<Counted> goal{vector(0.3, 0.1, 0.4), vector(0.2, -1, 0.1), Counted(0.3), Counted(0.26)};
    tally = {};
    const swivel::Rotor<Counted> shoulder = swivel::solve_plain(goal).pose.shoulder;
    swivel::with_sign_of(shoulder.at<swivel::kScalar>(), shoulder);
    return tally;
}

OpCounts count_production_ops()
{
    swivel::LimbUse use;
    use.hand = use.incoming = use.weights = use.reach = use.limits.flexion = use.limits.shoulder_cone = true;
    swivel::ParentFrame<Counted> parent{vector(1, 2, 3), rotor(0.3, 0.1, 0.2, 0.9), Counted(1.1)};
    const Rotor<Counted> shoulder = rotor(0.3, 0.2, 0.1, 0.9), elbow = rotor(-0.4, 0, 0, 0.9),
                         hand = rotor(0.1, 0.3, 0.4, 0.8);
    swivel::LimbGoal<Counted> goal;
    goal.weights = {Counted(0.9), Counted(0.8), Counted(0.7)};
    goal.reach = {Counted(0.1), Counted(0.1), Counted(1.1), Counted(0.2)};
    goal.limits.flexion = {Counted(0.99), Counted(0.2)};
    goal.limits.shoulder_cone = {vector(0, 0.6, 0.8), Counted(-0.99)};
    tally = {};
    parent.rotation = parent.rotation * rotor(0.1, 0.2, 0.3, 0.9);
    const swivel::SeenGoal<Counted> seen = seen_by(parent, vector(1.3, 2.1, 3.4), vector(1.2, 1, 3.1), Counted(1.0));
    const Counted shrink = Counted(1.0) / seen.size;
    goal.arm = {shrink * seen.wrist, shrink * seen.pole, Counted(0.3), Counted(0.26)};
    goal.hand = ~parent.rotation * hand * rotor(0.2, 0.1, 0.3, 0.9);
    goal.incoming = {swivel::scaled(between(shoulder)), swivel::scaled(between(elbow)), swivel::scaled(between(hand))};
    const swivel::SolvedLimb<Counted> solved = swivel::solve_limb<false>(use, goal, Counted(0.0) <= Counted(0.0));
    store(between(solved.arm.shoulder), shoulder);
    store(between(swivel::elbow_rotor(solved.arm)), elbow);
    store(between(solved.wrist), hand);
    if (solved.arm.flags.value != SWIVEL_REACHED)
        throw std::logic_error("the production limb that is counted is not an ordinary one");
    return tally;
}

}  // namespace bench

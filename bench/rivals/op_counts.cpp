// SPDX-License-Identifier: MIT
//
// The only file beside counted.h that looks inside the library: it runs the formula itself, on numbers that count.
#include "bench/rivals/op_counts.h"

#include "bench/rivals/counted.h"
#include "core/limb.h"
#include "core/solve_arm.h"
#include "core/space.h"

namespace bench {

namespace {

Counted number(double x) { return Counted(x); }
swivel::Vector<Counted> vector(double x, double y, double z) { return swivel::vector(number(x), number(y), number(z)); }
swivel::Rotor<Counted> rotor(double x, double y, double z, double w)
{
    return swivel::rotor(number(x), number(y), number(z), number(w));
}
// With one of a binding's rotations on either side.
swivel::Rotor<Counted> between(const swivel::Rotor<Counted>& q)
{
    return rotor(0.1, 0.2, 0.3, 0.9) * q * rotor(0.2, 0.3, 0.1, 0.9);
}

}  // namespace

OpCounts count_ops()
{
    const swivel::ArmGoal<Counted> goal{vector(0.3, 0.1, 0.4), vector(0.2, -1, 0.1), number(0.3), number(0.26)};
    tally = {};
    const swivel::Rotor<Counted> shoulder = swivel::solve_plain(goal).pose.shoulder;
    swivel::with_sign_of(shoulder.at<swivel::kScalar>(), shoulder);
    return tally;
}

OpCounts count_production_ops()
{
    swivel::LimbUse use;
    use.hand = use.incoming = use.weights = use.reach = use.limits.flexion = use.limits.shoulder_cone = true;
    const swivel::ParentFrame<Counted> parent{vector(1, 2, 3), rotor(0.3, 0.1, 0.2, 0.9), number(1.1)};
    const swivel::Rotor<Counted> shoulder = rotor(0.3, 0.2, 0.1, 0.9), elbow = rotor(-0.4, 0, 0, 0.9),
                                 hand = rotor(0.1, 0.3, 0.4, 0.8);
    swivel::LimbGoal<Counted> goal;
    goal.weights = {number(0.9), number(0.8), number(0.7)};
    goal.reach = {number(0.1), number(0.1), number(1.1), number(0.2)};
    goal.limits.flexion = {number(0.99), number(0.2)};
    goal.limits.shoulder_cone = {vector(0.1, 0.1, 0.99), number(0.5)};
    tally = {};
    const swivel::SeenGoal<Counted> seen = seen_by(parent, vector(1.3, 2.1, 3.4), vector(1.2, 1, 3.1), number(1));
    const Counted shrink = Counted(1.0) / seen.size;
    goal.arm = {shrink * seen.wrist, shrink * seen.pole, number(0.3), number(0.26)};
    goal.hand = ~parent.rotation * hand * rotor(0.2, 0.1, 0.3, 0.9);
    goal.incoming = {between(shoulder), between(elbow), between(hand)};
    const swivel::SolvedLimb<Counted> solved = swivel::solve_limb<false>(use, goal, Counted(0.0) <= Counted(0.0));
    for (const swivel::Rotor<Counted>& joint : {solved.arm.shoulder, solved.arm.shoulder, solved.wrist}) {
        const swivel::Rotor<Counted> local = between(joint);
        swivel::with_sign_of(local.at<swivel::kScalar>(), local);
    }
    return tally;
}

}  // namespace bench

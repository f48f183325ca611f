// SPDX-License-Identifier: MIT
//
// The only file beside counted.h that looks inside the library: it runs the formula itself, on numbers that count.
#include "bench/rivals/op_counts.h"

#include "bench/rivals/counted.h"
#include "core/solve_arm.h"

namespace bench {

OpCounts count_ops()
{
    const auto number = [](double x) { return Counted(x); };
    const swivel::ArmGoal<Counted> goal{swivel::vector(number(0.3), number(0.1), number(0.4)),
                                        swivel::vector(number(0.2), number(-1), number(0.1)), number(0.3),
                                        number(0.26)};
    tally = {};
    const swivel::Rotor<Counted> shoulder = swivel::solve_plain(goal).pose.shoulder;
    swivel::with_sign_of(shoulder.at<swivel::kScalar>(), shoulder);
    return tally;
}

}  // namespace bench

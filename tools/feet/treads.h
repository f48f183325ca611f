// SPDX-License-Identifier: MIT
//
// How hills lift the feet and the body of a clip of level ground. A foot rises and turns from where it leaves the
// ground to where it lands, over what lies between, and the body rises with the mean of its feet. So edges between jerk
// nothing.
#pragma once

#include "tools/feet/floor.h"

namespace swivel::tools {

// Of one leg, in each frame: where its toe is moved, and which way is across the ground that it stands on or goes to.
struct LegLift {
    std::vector<Eigen::Vector3d> move_w;  // up with the ground, and aside from edges
    std::vector<Eigen::Vector3d> normal_w;
};
struct Lift {
    std::vector<double> body;
    std::vector<LegLift> legs;
};

Lift lift_of(const LegMotion& motion, const Contacts& contacts, const Floor& floor);

// Where a toe is, or the nearest place around it where the whole sole has ground below that is not steeper than 45
// degrees. A toe that has none within a sole's length stays. Only the way over the ground counts.
Eigen::Vector3d tread_near(const LegMotion& motion, const LegPath& path, std::size_t frame,
                           const Eigen::Vector3d& toe_w, const Floor& floor);

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
//
// Lifts the feet and the body of a clip of level ground onto hills. A foot rises and turns evenly from where it leaves
// the ground to where it lands, over any edge between, and the body rises with the mean of its feet. So edges cause no
// jerks.
#pragma once

#include <optional>

#include "tools/feet/contacts.h"

namespace swivel::tools {

// A leg's toe in each frame: its move, and the normal of the ground that it stands on or goes to.
struct LegLift {
    std::vector<Eigen::Vector3d> move_w;  // up with the ground, and aside from edges
    std::vector<Eigen::Vector3d> normal_w;
};
struct Lift {
    std::vector<double> body;
    std::vector<LegLift> legs;
};

Lift lift_of(const LegMotion& motion, const Contacts& contacts, const Floor& floor);

// True if no ground below the sole is steeper than 45 degrees, with the toe at toe_w and the sole as in that frame of
// the clip. Heights are ignored.
bool can_stand(const LegMotion& motion, const LegPath& path, std::size_t frame, const Eigen::Vector3d& toe_w,
               const Floor& floor);

// The toe's position in that frame if the sole can stand there, else the nearest one within a sole's length where it
// can, else none.
std::optional<Eigen::Vector3d> tread_near(const LegMotion& motion, const LegPath& path, std::size_t frame,
                                          const Floor& floor);

}  // namespace swivel::tools

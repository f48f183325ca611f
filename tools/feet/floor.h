// SPDX-License-Identifier: MIT
//
// What feet of a clip stand on: its own level floor, and hills that it is put on. Knows a clip's axes.
#pragma once

#include "tools/crowd/ground.h"
#include "tools/feet/contacts.h"

namespace swivel::tools {

struct Floor {
    Eigen::Vector3d up_w = Eigen::Vector3d::UnitY();
    double level = 0;               // how high the toes stand over the world's origin, where no hill is
    const Ground* hills = nullptr;  // not owned

    // How high the hills are there; 0 without any.
    double hill(const Eigen::Vector3d& place_w) const;
    // Across the ground there, unit, and upwards.
    Eigen::Vector3d normal_w(const Eigen::Vector3d& place_w) const;
    // A toe's height over where it would stand.
    double over(const Eigen::Vector3d& toe_w) const { return toe_w.dot(up_w) - level - hill(toe_w); }
};

// The floor of a clip without hills: the height that half of the frames of contact are not above. Some foot must be in
// contact.
double floor_level(const LegMotion& motion, const Contacts& contacts);

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
//
// From a skeleton's limb at rest to its binding: bone lengths, bone axes, bend, and the constant rotors between arm
// frame and joints.
#pragma once

#include "batch/swivel.h"

namespace swivel {

// What swivel_bind() promises, arguments already checked for null.
swivel_status bind(const swivel_chain& chain, swivel_binding& binding);
// What swivel_arm_axis() promises, likewise.
swivel_status arm_axis(const swivel_binding& binding, const float (&parent_rotation)[4], const double (&direction)[3],
                       double (&axis)[3]);
// Whether its quaternions are of unit length.
bool is_binding(const swivel_binding& binding);

}  // namespace swivel

// SPDX-License-Identifier: MIT
//
// From a skeleton's limb at rest to its binding: bone lengths, bone axes, bend, and the constant rotors between arm
// frame and joints.
#pragma once

#include "batch/swivel.h"

namespace swivel {

// What swivel_bind() promises, arguments already checked for null.
swivel_status bind(const swivel_chain& chain, swivel_binding& binding);

}  // namespace swivel

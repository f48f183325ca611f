// SPDX-License-Identifier: MIT
//
// Checks a crowd's definition.
#pragma once

#include "include/swivel/swivel_bodies.h"

namespace swivel {

// A definition that a crowd can be made of, or a refusal.
swivel_status check_def(const swivel_crowd_def* def);
// All of its members, also where an older header's structure is shorter.
swivel_crowd_def full_def(const swivel_crowd_def* def);

}  // namespace swivel

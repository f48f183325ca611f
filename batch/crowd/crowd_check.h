// SPDX-License-Identifier: MIT
//
// Checks a crowd's definition.
#pragma once

#include "include/swivel/swivel_bodies.h"

namespace swivel {

// Refuses a definition that no crowd can be made of.
swivel_status check_def(const swivel_crowd_def* def);
// The definition with all members: those that an older, shorter structure lacks get defaults.
swivel_crowd_def full_def(const swivel_crowd_def* def);

}  // namespace swivel

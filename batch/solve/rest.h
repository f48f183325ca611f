// SPDX-License-Identifier: MIT
//
// The poses that limbs have before their first solve.
#pragma once

#include "batch/crowd/crowd.h"

namespace swivel {

// Puts all limbs of a new crowd, or of a new group of free limbs, into their rest pose, without flags.
void rest(const swivel_crowd& crowd);
void rest(Group& group);

}  // namespace swivel

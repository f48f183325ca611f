// SPDX-License-Identifier: MIT
//
// Records suspicious use of a crowd, which swivel_explain() warns of.
#pragma once

#include "batch/solve/work.h"

namespace swivel {

// Records in the crowd, before a solve of poses, whether each frame resets all bodies, whether the time step is odd,
// and what the pose has.
void note_doubts(const Work& work);

}  // namespace swivel

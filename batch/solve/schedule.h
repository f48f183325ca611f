// SPDX-License-Identifier: MIT
//
// Solves large jobs on several threads.
#pragma once

#include "batch/solve/work.h"

namespace swivel {

// Solves a job in the caller's oneTBB arena. Returns false, and has solved nothing, where the job is too small for
// several threads or the library is built without oneTBB.
bool solve_on_threads(const Work& work);

// A crowd remembers which thread solved which chunk, from its creation to its end.
void begin_schedule(swivel_crowd& crowd);
void end_schedule(swivel_crowd& crowd);

}  // namespace swivel

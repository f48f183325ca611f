// SPDX-License-Identifier: MIT
//
// A job of bodies goes in strips. A strip has as many blocks of bodies as a workspace.
#pragma once

#include "batch/solve/work.h"

namespace swivel {

std::uint32_t strip_count(const Work& work);
// Solves strips first ... end - 1 of a job on this thread.
void solve_strips(const Work& work, std::uint32_t first, std::uint32_t end);

}  // namespace swivel

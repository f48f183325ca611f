// SPDX-License-Identifier: MIT
//
// Everyone who solves problem P beside swivel, ready to run on the same arms.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/rivals/limbs.h"

namespace bench {

struct Contender {
    std::string name, level;  // "loop_trig", "x86-64-v3"
    std::function<void()> solve;
    std::function<Poses()> poses;  // what it solved last
};

// The rivals of one level: the loops, then one arm at a time. Each keeps its own copy of the arms.
std::vector<Contender> contenders(const Level& level, std::span<const Limb> limbs);

}  // namespace bench

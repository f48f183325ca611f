// SPDX-License-Identifier: MIT
//
// Arms that the plain formula does not hold for, made of ordinary ones.
#pragma once

#include <array>
#include <span>

#include "bench/rivals/limbs.h"

namespace bench {

enum class Hard {
    pole,    // on the target's line, or of no length: it does not say where the elbow goes
    size,    // bones and targets 1e-12 or 1e10 long, targets nearly on the shoulder, a pole at 1e12
    number,  // a NaN, an infinity, a length below zero, a target at 1e20: bad input
};
inline constexpr std::array kHardKinds{Hard::pole, Hard::size, Hard::number};

// n: a running number, for variety.
void make_hard(Limb& limb, Hard kind, std::size_t n);

// Were these limbs solved as their kinds ask for? kinds has one entry for each limb, null for ordinary ones.
bool solved_as_hard(const swivel::Crowd& crowd, std::span<const Hard* const> kinds);

}  // namespace bench

// SPDX-License-Identifier: MIT
//
// How many limbs of a crowd their limits hold back, and crowds with a wanted share of them.
#pragma once

#include <array>
#include <memory>

#include "bench/suite.h"

namespace bench {

enum class Held {
    free,        // the limits allow the swivel that is wished for
    limited,     // they forbid it and allow another one
    infeasible,  // they allow none
};
inline constexpr std::array<const char*, 3> kHeldNames{"free", "limited", "infeasible"};

// The shares of limbs that are limited and infeasible, by the flags of the last solve.
Notes shares_of(const swivel::Crowd& crowd);

// Solved limbs of every kind. The region must outlive it.
struct Pool {
    swivel_features features;
    const swivel_region* region;
    swivel::Crowd crowd;
    std::array<std::vector<std::uint32_t>, 3> limbs;  // by kind
};
Pool make_pool(swivel_features features, const std::string& isa, const swivel_region* region);

// Crowds of limbs from the pool: this share is of that kind, the others are free. They are in no order.
std::shared_ptr<swivel::Crowd> mixed_crowd(const Pool& pool, std::size_t arm_count, Held kind, double share);

}  // namespace bench

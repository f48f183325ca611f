// SPDX-License-Identifier: MIT
//
// Which input of a body's pose disagrees with where the caller has the limb, in words, for people.
#pragma once

#include <cstdint>
#include <span>

#include "batch/crowd/crowd.h"
#include "core/conformal.h"
#include "include/swivel/swivel_explain.h"

namespace swivel {

// In the world.
struct LimbPlaces {
    Vector<double> at[3];  // shoulder, elbow, wrist
};

// Compares as swivel_compare() promises, and says whether they agree. The pose must be right, and whole; the group has
// limbs. text: a byte at least.
bool compare(const swivel_crowd& crowd, std::uint32_t group, std::uint32_t body, const swivel_pose& pose,
             const LimbPlaces& places, std::span<char> text);

}  // namespace swivel

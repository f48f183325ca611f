// SPDX-License-Identifier: MIT
//
// Names the input of a body's pose that disagrees with the caller's places of a limb, for people.
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

// Compares as swivel_compare() promises. Returns whether pose and places agree. The pose must be valid and of full
// size, and the group must have limbs. text: a byte or more.
bool compare(const swivel_crowd& crowd, std::uint32_t group, std::uint32_t body, const swivel_pose& pose,
             const LimbPlaces& places, std::span<char> text);

}  // namespace swivel

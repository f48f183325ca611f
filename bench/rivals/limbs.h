// SPDX-License-Identifier: MIT
//
// The made-up arms that everyone solves, the same on every machine, and what is made of them for each solver: arrays,
// structures, swivel's crowds. Knows swivel's public interface.
#pragma once

#include <span>
#include <vector>

#include "bench/rivals/arms.h"
#include "bench/rivals/level.h"
#include "swivel/swivel.hpp"

namespace bench {

struct Limb {
    float target[3], pole[3], lengths[2];      // in the arm frame, which is the parent's
    float position[3], rotation[4], scale[1];  // the parent's frame in the world
    float hand[4];                             // wanted orientation
    bool ordinary;                             // well within reach, the pole well off the target's line
};

// Upper arms are 0.2 to 0.4 long, and forearms 0.7 to 1.4 times that. Targets are in any direction. Of ten arms, seven
// are ordinary, with targets in the inner 5 to 98 % of the shell that the wrist can reach. One is nearly straight, one
// nearly folded or too near, and one too far. Every pole is at least sin 0.1 off the target's line.
std::vector<Limb> random_limbs(std::size_t count);

// A vector of the parent's frame in the world.
void to_world(const Limb& limb, float (&v)[3]);

Arms arms_of(std::span<const Limb> limbs);
std::vector<SingleArm> single_arms_of(std::span<const Limb> limbs);

// Resident: world targets, poles, lengths and parent frames in rows, the skeleton's local rotations in rows.
inline constexpr swivel_features kResident = SWIVEL_WORLD | SWIVEL_JOINTS;

// Parent frame, hand, cone and flexion limits, and a blend with an incoming pose.
inline constexpr swivel_features kFullArm = SWIVEL_WORLD | SWIVEL_WITH_HAND | SWIVEL_WITH_INCOMING |
                                            SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_FLEXION_LIMIT | SWIVEL_WITH_SHOULDER_CONE;
// Incoming poses, weights, reach and limits of the first limbs of a crowd, where it has them.
void write_limb_inputs(swivel::Crowd& crowd, std::uint32_t count);

// An arm whose bones are so long and run along +x, or along -x where they are negative, as in many rigs. It bends
// towards +z.
swivel_binding arm_along_x(float upper, float fore);

// A crowd of one group with all inputs written; limbs repeat where the crowd is larger than they are.
// region: for SWIVEL_WITH_REGION.
swivel::Crowd make_crowd(swivel_features features, std::size_t arm_count, std::span<const Limb> limbs,
                         const swivel_region* region = nullptr);
// Arms whose rows, in and out, are at home in a level of memory, one of kMemoryLevels; whole blocks.
std::size_t arms_within(std::size_t memory_level, swivel_features features);
// Results of a crowd without features.
Poses poses_of(const swivel::Crowd& crowd);

// Every block, on this thread, by that instruction set.
void solve_all(swivel::Crowd& crowd, const std::string& isa);
// The instruction sets that are built in and run here, best first.
std::vector<std::string> runnable_isas();

}  // namespace bench

// SPDX-License-Identifier: MIT
//
// The crowd that the promise of equal bits is checked on: for every set of features, ordinary limbs of all reaches,
// hard poses and bad input, in groups that end inside a block. Knows the public interface and nothing else.
#pragma once

#include <cstdint>

#include "swivel/swivel.hpp"

namespace swivel::tools {

// Sets of features a crowd can have: 0 ... kFeatureSets - 1, of which the invalid ones are skipped by is_feature_set().
inline constexpr std::uint32_t kFeatureSets = 16;
bool is_feature_set(std::uint32_t features);

// Sets of features of whole limbs: all that go together in the world and in the arm frame, each kind of swivel wish,
// each kind of limit, both boxes, aims, clavicles.
inline constexpr std::uint32_t kLimbSets[] = {
    SWIVEL_WITH_INCOMING,
    SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_POLE_NORMAL | SWIVEL_WITH_ANGLE | SWIVEL_WITH_STEP,
    SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_WITH_INCOMING | SWIVEL_POLE_INCOMING | SWIVEL_LIMIT_FLEXION |
        SWIVEL_WITH_REACH,
    SWIVEL_LIMIT_SHOULDER_CONE,
    SWIVEL_LIMIT_SHOULDER_BOX,
    SWIVEL_WITH_HAND | SWIVEL_LIMIT_WRIST_BOX | SWIVEL_LIMIT_SHOULDER_BOX,
    SWIVEL_WORLD | SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR | SWIVEL_LIMIT_HAND_CONE | SWIVEL_LIMIT_FOREARM_TWIST |
        SWIVEL_LIMIT_HAND_TWIST | SWIVEL_LIMIT_HUMERAL_TWIST,
    SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_POLE_DIRECTION | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_ANGLE |
        SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_REACH | SWIVEL_WITH_STEP | SWIVEL_LIMIT_FLEXION |
        SWIVEL_LIMIT_SHOULDER_CONE | SWIVEL_LIMIT_HUMERAL_TWIST | SWIVEL_LIMIT_SHOULDER_BOX | SWIVEL_LIMIT_HAND_CONE |
        SWIVEL_LIMIT_FOREARM_TWIST | SWIVEL_LIMIT_HAND_TWIST | SWIVEL_LIMIT_WRIST_BOX,
    SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_AIM | SWIVEL_WITH_STEP |
        SWIVEL_LIMIT_SHOULDER_CONE,
    SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_WITH_CLAVICLE | SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS,
};

// A crowd of three groups, limb_count limbs in the first and fewer in the others, all inputs written. The same numbers
// on every machine.
Crowd golden_crowd(std::uint32_t features, std::uint32_t limb_count);
// Other targets and poles for the same crowd.
void write_golden_targets(Crowd& crowd, std::uint64_t seed);

// FNV-1a (64 bits) over the results of all limbs, field by field; the padding is left out.
std::uint64_t digest(const Crowd& crowd, std::uint64_t hash);
inline constexpr std::uint64_t kDigestStart = 0xcbf29ce484222325u;

// The digest over every set of features, each crowd solved by solve(crowd).
template <class Solve>
std::uint64_t golden_digest(std::uint32_t limb_count, Solve solve)
{
    std::uint64_t hash = kDigestStart;
    for (std::uint32_t features = 0; features < kFeatureSets; ++features) {
        if (!is_feature_set(features)) continue;
        Crowd crowd = golden_crowd(features, limb_count);
        solve(crowd);
        hash = digest(crowd, hash);
    }
    return hash;
}

// The same over every set of whole limbs. Each crowd is solved three times, so that what it carries on counts.
template <class Solve>
std::uint64_t limb_digest(std::uint32_t limb_count, Solve solve)
{
    std::uint64_t hash = kDigestStart;
    for (const std::uint32_t features : kLimbSets) {
        Crowd crowd = golden_crowd(features, limb_count);
        for (int frame = 0; frame < 3; ++frame) {
            solve(crowd);
            hash = digest(crowd, hash);
            if (frame < 2) write_golden_targets(crowd, static_cast<std::uint64_t>(frame));
        }
    }
    return hash;
}

}  // namespace swivel::tools

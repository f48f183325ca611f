// SPDX-License-Identifier: MIT
//
// The ways in which the same limbs may be solved: in other orders, memory, jobs and spaces. Knows how to solve any
// crowd in any of them, and how to read every bit that a solve left. The promise of equal bits is that all are the
// same.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "swivel/swivel.hpp"

namespace swivel::test {

struct Way {
    // All in one job; or some limbs after the others, in jobs that choose them; or at once, by threads of the caller's.
    // Every limb is solved once.
    enum class Jobs { one, blocks, masks, threads };
    // joints: of a pose, all bodies' last ones, then all those before; gaps elsewhere. pages: of each limb or body,
    // which are locked away while others are solved.
    enum class Memory { packed, gaps, joints, pages };

    const char* name;
    Jobs jobs = Jobs::one;
    Memory memory = Memory::packed;
    bool is_shuffled = false;  // limbs are in any order, in crowds of 1, 5, 25... of them
    bool has_frames = false;   // inputs come in frames, and the crowd's rows have none of them
    bool is_apart = false;     // a pose's results go elsewhere
    bool is_far = false;       // positions are doubles, far from the origin; then inputs come in frames, too
    bool is_in_other_environment = false;
};

// What all crowds of a scene have in common.
struct Scene {
    using LimbCounts = std::vector<std::uint32_t>;  // of each group

    std::string name;
    std::uint32_t joint_count;  // of bodies; 0: limbs are free
    std::function<Crowd(const LimbCounts&)> make_crowd;
    std::map<LimbCounts, Crowd> crowds = {};  // in which ways are gone

    Crowd& crowd_of(const LimbCounts& counts)
    {
        const auto found = crowds.find(counts);
        return found != crowds.end() ? found->second : crowds.emplace(counts, make_crowd(counts)).first->second;
    }
};

// The bits that a solve left: of each group's limbs, and then of each body's pose. Results that say where something is
// may be left out: far from the origin they are from the root.
using Bits = std::vector<std::vector<std::vector<std::uint32_t>>>;
Bits bits_after(const Scene& scene, const Crowd& crowd, const Job& job, bool has_places = true);

// What a job would leave of a crowd if it were solved in another way. Neither is changed: all that a solve depends on
// is copied to other crowds and poses, and so is all that is carried, as it is saved and loaded. Memory that a solve
// must not write is checked.
Bits bits_of_way(Scene& scene, const Crowd& crowd, const Job& job, const Way& way);

// Rounds a scene's positions to so few digits that doubles far from the origin hold them, and takes none that is out of
// all bounds. Keeps bodies from being shifted: a shifted root is rounded where it is.
void shorten_positions(Crowd& crowd, const Job& job);

}  // namespace swivel::test

// SPDX-License-Identifier: MIT
//
// A whole frame without solving: a bare loop that reads and writes the same fields of the same pose buffers, as its
// user would write it. What it takes is the time of memory and of moving values. Compiled once for each level.
#include <cstring>

#include "bench/rivals/level.h"

namespace bench::SWIVEL_LEVEL {

namespace {

typedef float Four __attribute__((vector_size(16)));

inline Four load(const float (&from)[4])
{
    Four v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
inline void store(Four v, float (&to)[4]) { std::memcpy(to, &v, sizeof v); }

}  // namespace

void touch_frame(const FrameView& frame)
{
    for (std::size_t n = 0; n < frame.character_count; ++n) {
        const CharacterPose& world = frame.world[n];
        CharacterPose& local = frame.local[n];
        const Four chest = load(world.chest.rotation);
        const float scale = world.chest.scale[0];
        for (std::size_t side = 0; side < kArms; ++side) {
            const auto& goal = frame.goals[n].arm[side];
            const Four shoulder = load(world.arm[side].shoulder.position);
            store(chest + scale * (load(goal.wrist) - shoulder), local.arm[side].shoulder.rotation);
            store(chest + scale * (load(goal.pole) - shoulder), local.arm[side].elbow.rotation);
        }
    }
}

}  // namespace bench::SWIVEL_LEVEL

// SPDX-License-Identifier: MIT
//
// A crowd of bodies through the public interface, with goals, and poses in a buffer that it reads and writes.
#pragma once

#include "tests/pose_buffer.h"

namespace swivel::test {

inline Crowd body_crowd(const BodySkeleton& skeleton, swivel_features features, std::uint32_t body_count)
{
    std::vector<swivel_limb_joints> joints;
    for (std::size_t n = 0; n < skeleton.limbs.size(); ++n) joints.push_back(skeleton.joints(n));
    std::vector<swivel_group_def> groups;
    for (const swivel_limb_joints& each : joints) groups.push_back(body_group(each, features));
    return Crowd(skeleton.view(), body_count, groups);
}

// Where a limb goes.
struct BodyGoal {
    Float3 target, pole;
    Float4 hand;
};
using BodyGoals = std::vector<std::vector<BodyGoal>>;  // of each group's limbs

// The limb's own wrist.
BodyGoal own_goal(const BodySkeleton& skeleton, const Body& body, std::size_t limb);
// Any that the limb reaches.
BodyGoal random_goal(Random& random, const BodySkeleton& skeleton, const Body& body, std::size_t limb);

inline void write_goals(Crowd& crowd, const BodyGoals& goals)
{
    for (std::uint32_t g = 0; g < goals.size(); ++g) {
        const std::span<const BodyGoal> all = goals[g];
        const swivel_features features = swivel_group_features(crowd.get(), g);
        const auto write = [&](swivel_field field, const void* first) {
            check(swivel_write(crowd.get(), field, g, 0, static_cast<std::uint32_t>(all.size()),
                               {first, sizeof(BodyGoal)}));
        };
        write(SWIVEL_TARGET, &all[0].target);
        if (!(features & SWIVEL_POLE_INCOMING)) write(SWIVEL_POLE, &all[0].pole);
        if (features & SWIVEL_WITH_HAND) write(SWIVEL_HAND, &all[0].hand);
    }
}

inline void solve_poses(Crowd& crowd, const swivel_pose& pose) { crowd.solve({.pose = &pose}); }

}  // namespace swivel::test

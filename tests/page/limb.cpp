// SPDX-License-Identifier: MIT
//
// Solves one limb with the native library: reads as bytes its features, the rest places and rotations of its four
// joints, where its elbow bends, its goal_root and its goal_input. Prints the bits of its joints' rotations and of its
// elbow and wrist. The page's must be the same.
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <span>

#include "swivel/swivel.hpp"
#include "tools/crowd/goals.h"

namespace {

template <class Value>
void read(Value& value)
{
    if (std::fread(&value, sizeof value, 1, stdin) != 1) std::exit(2);
}

template <class Word, class Value, std::size_t count>
void print(const Value (&values)[count])
{
    for (const Value& value : values) {
        Word word;
        std::memcpy(&word, &value, sizeof word);
        std::printf("%0*" PRIx64 " ", static_cast<int>(2 * sizeof word), std::uint64_t{word});
    }
}

}  // namespace

int main()
{
    swivel_features features;
    float places[GOAL_JOINTS][3], rotations[GOAL_JOINTS][4];
    swivel_limb_joints joints = swivel_default_limb_joints(1, 2, 3);
    goal_root root;
    goal_input input;
    read(features), read(places), read(rotations), read(joints.bend), read(root), read(input);
    constexpr std::int32_t parents[GOAL_JOINTS] = {-1, 0, 1, 2};
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.joint_count = GOAL_JOINTS;
    skeleton.parents = {parents, sizeof parents[0]};
    skeleton.translations = {places, sizeof places[0]};
    skeleton.rotations = {rotations, sizeof rotations[0]};
    const swivel_group_def limb = swivel::body_group(joints, features);
    swivel::Crowd crowd(skeleton, 1, std::span(&limb, 1));
    float pose[4 * GOAL_JOINTS] = {};
    swivel_job job = swivel_default_job();
    const goal_character who{1, {}, 0, 0, 0, 1, 0, 0};
    swivel::check(swivel_goals_solve(crowd.get(), nullptr, nullptr, 0, &who, &root, &input, pose, &job));
    double elbow[3], wrist[3];
    swivel::check(swivel_forward(crowd.get(), 0, 0, 1, {elbow, sizeof elbow}, {wrist, sizeof wrist}, {nullptr, 0}));
    print<std::uint32_t>(pose);
    print<std::uint64_t>(elbow);
    print<std::uint64_t>(wrist);
}

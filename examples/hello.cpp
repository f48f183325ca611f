// SPDX-License-Identifier: MIT
// Bodies: a pose goes in, and a pose comes out. The README and docs/index.md show this program.
// [shown]
#include <array>
#include <cstdio>
#include <swivel/swivel_bodies.hpp>
#include <vector>

using Float3 = std::array<float, 3>;
using Float4 = std::array<float, 4>;  // a rotation: x, y, z, w

enum Joint { kHips, kThigh, kShin, kFoot, kChest, kUpperArm, kForearm, kHand, kJoints };

struct Character {
    Float3 place, hand_target, foot_target;    // of the root and of the targets, in the world
    std::array<Float4, kJoints> pose, solved;  // each joint's rotation relative to its parent
};

int main()
{
    // Your skeleton at rest: each joint's parent, and where it is in the parent's frame.
    const std::int32_t parents[] = {-1, kHips, kThigh, kShin, kHips, kChest, kUpperArm, kForearm};
    const float places[][3] = {{0, 0.9f, 0}, {-0.1f, 0, 0},    {0, -0.45f, 0}, {0, -0.43f, 0},
                               {0, 0.3f, 0}, {-0.2f, 0.2f, 0}, {-0.3f, 0, 0},  {-0.26f, 0, 0}};
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = swivel::stream(parents);
    skeleton.translations = swivel::stream(places);
    skeleton.joint_count = kJoints;
    swivel_limb_joints arm = swivel_default_limb_joints(kUpperArm, kForearm, kHand);
    swivel_limb_joints leg = swivel_default_limb_joints(kThigh, kShin, kFoot);
    arm.bend[2] = 1;   // flexion carries the forearm forwards, in the upper arm's frame,
    leg.bend[2] = -1;  // and the shin backwards

    // A thousand characters. Your animation system writes the poses in each frame; here they are at rest.
    Character one = {{0, 0, 0}, {-0.4f, 1.3f, 0.3f}, {-0.1f, 0.2f, 0.2f}, {}, {}};
    one.pose.fill({0, 0, 0, 1});
    std::vector<Character> characters(1000, one);
    swivel::Crowd crowd(skeleton, 1000,
                        {swivel::body_limb(arm, SWIVEL_POLE_INCOMING),    // elbows and knees stay
                         swivel::body_limb(leg, SWIVEL_POLE_INCOMING)});  // on their animated side

    // In each frame: one call reads all poses and targets, and writes the joints that it turns.
    for (Character& each : characters) each.solved = each.pose;
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {characters[0].pose.data(), sizeof(Character), sizeof(Float4), nullptr};
    pose.results = {characters[0].solved.data(), sizeof(Character), sizeof(Float4), nullptr};
    pose.root_position = swivel::stream(characters, &Character::place);
    swivel::Streams arms, legs;
    arms.in(SWIVEL_TARGET, swivel::stream(characters, &Character::hand_target));
    legs.in(SWIVEL_TARGET, swivel::stream(characters, &Character::foot_target));
    crowd.solve({.streams = {arms, legs}, .pose = &pose});

    std::vector<std::uint32_t> flags(1000);
    crowd.read(SWIVEL_FLAGS, 0, flags);
    int reached = 0;
    for (const std::uint32_t each : flags) reached += (each & SWIVEL_REACHED) != 0;
    std::printf("%d of 1000 hands are at their targets\n", reached);
}
// [end]

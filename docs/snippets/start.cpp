// SPDX-License-Identifier: MIT
// [shown]
#include <cstdio>
#include <swivel/swivel.hpp>
#include <vector>

// A joint of your skeleton at rest, as your engine keeps it.
struct Joint {
    std::int32_t parent;   // its number; -1 for a root
    float translation[3];  // in the parent's frame
    float rotation[4];     // relative to the parent: x, y, z, w
};

struct Character {  // your own, as well
    // Inputs, in the world. The wrist goes to the grip; the elbow leans to the hint.
    // The clavicle is the joint above the shoulder. Rotations are x, y, z, w.
    float grip[3], elbow_hint[3], shoulder_position[3], clavicle_rotation[4];
    // Results: local joint rotations.
    float upper_arm_rotation[4], forearm_rotation[4];
};

int main()
{
    // Bind: the skeleton at rest. A left arm's bones lie along +x of their joints,
    // which are not turned at rest. The character faces +z.
    const std::vector<Joint> joints = {
        {-1, {0, 1.4f, 0}, {0, 0, 0, 1}},  // 0: clavicle
        {0, {0.1f, 0, 0}, {0, 0, 0, 1}},   // 1: shoulder, where the upper arm begins
        {1, {0.30f, 0, 0}, {0, 0, 0, 1}},  // 2: elbow
        {2, {0.26f, 0, 0}, {0, 0, 0, 1}},  // 3: wrist
    };
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.joint_count = static_cast<std::uint32_t>(joints.size());
    skeleton.parents = swivel::stream(joints, &Joint::parent);
    skeleton.translations = swivel::stream(joints, &Joint::translation);
    skeleton.rotations = swivel::stream(joints, &Joint::rotation);
    swivel_limb_joints limb = swivel_default_limb_joints(1, 2, 3);
    limb.bend[2] = 1;  // forwards: where flexion carries the forearm
    const swivel_binding arm = swivel::bind(skeleton, limb);

    // A crowd: how many, what goes in and what comes out.
    const Character first{{0.4f, 1.2f, 0.3f},
                          {-0.1f, 0.9f, -0.3f},
                          {0.1f, 1.4f, 0},
                          {0, 0, 0, 1},
                          {},
                          {}};
    std::vector<Character> characters(1000, first);
    const auto count = static_cast<std::uint32_t>(characters.size());
    swivel_limb_def left_arms = swivel::limbs(count, SWIVEL_WORLD | SWIVEL_JOINTS);
    left_arms.binding = arm;
    swivel::Crowd crowd({left_arms});

    // Each frame: from your structures, to your structures.
    swivel::Streams arms;
    arms.in(SWIVEL_TARGET, swivel::stream(characters, &Character::grip));
    arms.in(SWIVEL_POLE, swivel::stream(characters, &Character::elbow_hint));
    arms.in(SWIVEL_SHOULDER_POSITION,
            swivel::stream(characters, &Character::shoulder_position));
    arms.in(SWIVEL_PARENT_ROTATION,
            swivel::stream(characters, &Character::clavicle_rotation));
    arms.out(SWIVEL_SHOULDER,
             swivel::stream(characters, &Character::upper_arm_rotation));
    arms.out(SWIVEL_ELBOW, swivel::stream(characters, &Character::forearm_rotation));
    crowd.solve({.streams = {arms}});

    std::vector<double> off(characters.size());  // from target to wrist, in arm lengths
    crowd.residuals(0, off);
    double worst = 0;
    for (const double each : off)
        if (!(each <= worst)) worst = each;  // NaN where input is bad
    std::printf("%zu arms, the worst wrist is off by %.7f\n", off.size(), worst);
}
// [end]

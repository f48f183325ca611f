// SPDX-License-Identifier: MIT
// [shown]
#include <algorithm>
#include <cstdio>
#include <swivel/swivel.hpp>

struct Character {                                  // your own, as your engine keeps it
    float grip[3], elbow_hint[3];                   // in the world: where the wrist goes, a point the elbow leans to
    float shoulder_position[3];                     // in the world: where the shoulder joint is
    float clavicle_rotation[4];                     // in the world, x, y, z, w: the shoulder's parent joint
    float upper_arm_rotation[4], fore_rotation[4];  // local joint rotations: what swivel writes
};

int main()
{
    // Bind: the skeleton's rest pose. These bones lie along +x of their joints and bend about +y.
    swivel_chain chain{};
    chain.shoulder_rotation[3] = chain.elbow_rotation[3] = chain.wrist_rotation[3] = 1;  // no turn at rest
    chain.elbow_offset[0] = 0.30f;                                                       // elbow in the shoulder joint
    chain.wrist_offset[0] = 0.26f;                                                       // wrist in the elbow joint
    chain.hinge[1] = -1;  // flexion turns the forearm about -hinge
    const swivel::BoundLimb arm = swivel::bind(chain);

    // A crowd: how many, what goes in and what comes out.
    std::vector<Character> characters(
        1000, {{0.4f, 1.2f, 0.3f}, {-0.1f, 0.9f, -0.3f}, {0.1f, 1.4f, 0}, {0, 0, 0, 1}, {}, {}});
    const swivel_group_def left_arms{static_cast<std::uint32_t>(characters.size()), arm.binding};
    swivel::Crowd crowd(SWIVEL_WORLD | SWIVEL_JOINTS, {&left_arms, 1});
    crowd.write_all(SWIVEL_LENGTHS, 0, arm.lengths);

    // Each frame: from your structures, to your structures.
    swivel_frame frame{};
    frame.target = {characters[0].grip, sizeof(Character)};
    frame.pole = {characters[0].elbow_hint, sizeof(Character)};
    frame.parent_position = {characters[0].shoulder_position, sizeof(Character)};
    frame.parent_rotation = {characters[0].clavicle_rotation, sizeof(Character)};
    frame.shoulder = {characters[0].upper_arm_rotation, sizeof(Character)};
    frame.elbow = {characters[0].fore_rotation, sizeof(Character)};
    crowd.solve_frame({&frame, 1});

    std::vector<double> off(characters.size());  // from target to wrist, in arm lengths
    crowd.residuals(0, off);
    std::printf("%zu arms, the worst wrist is off by %.7f\n", off.size(), *std::max_element(off.begin(), off.end()));
}
// [end]

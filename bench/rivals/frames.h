// SPDX-License-Identifier: MIT
//
// A frame as engines have it: pose buffers, an array of structures, and world targets. What solves one reads the world
// frames of shoulders and their parents and writes the local rotations of shoulders and elbows. Plain data, for rivals
// that are compiled for one level; knows no solver.
#pragma once

#include <cstddef>

namespace bench {

struct JointPose {
    float position[4], rotation[4], scale[4];  // x, y, z, unused; x, y, z, w; uniform: scale[0]
};

inline constexpr std::size_t kArms = 2;  // of a character: left, right

struct CharacterPose {
    JointPose chest;
    struct {
        JointPose shoulder, elbow, wrist;
    } arm[kArms];
};

struct CharacterGoal {
    struct {
        float wrist[4], pole[4];  // points in the world
    } arm[kArms];
};

// All characters share these for each arm: bone lengths in the rig's units, the place of the next joint at rest, and
// rotations of swivel_binding. The rotations map the arm frame to the joints.
struct Rig {
    float upper, fore;
    float elbow_offset[3], wrist_offset[3];
    float parent_from_arm[4], upper_from_arm[4], fore_from_arm[4];
};

struct FrameView {
    const CharacterPose* world;  // of the joints above the elbows
    const CharacterGoal* goals;
    CharacterPose* local;
    const Rig* rigs;  // kArms of them
    std::size_t character_count;
};

// What ozz-animation reads beside: the world matrices of the joints in the pose before, by columns, that pose's local
// rotations, and the hinge of each elbow, about which a positive turn opens it.
struct alignas(16) Matrix {
    float columns[4][4];
};
struct CharacterModel {
    struct {
        Matrix shoulder, elbow, wrist;
    } arm[kArms];
};
struct OzzView {
    const CharacterModel* models;
    const CharacterPose* before;
    float mid_axes[kArms][4];
};

}  // namespace bench

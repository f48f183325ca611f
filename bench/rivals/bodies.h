// SPDX-License-Identifier: MIT
//
// Character B: a humanoid of 20 joints as a game keeps it, whose hands and feet all have goals. Its skeleton, and many
// of them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace bench {

inline constexpr std::size_t kBodyJoints = 20, kBodyLimbs = 4;

// Each file has a copy, because files that are built for several CPUs share no symbol. The trunk has hips, two joints
// of the spine, chest, neck and head. Then come left and right arm, each with a clavicle, and left and right leg.
constexpr std::int32_t kBodyParents[kBodyJoints] = {-1, 0, 1, 2, 3, 4, 3, 6, 7, 8, 3, 10, 11, 12, 0, 14, 15, 0, 17, 18};
constexpr float kBodyOffsets[kBodyJoints][3] = {{0, 1, 0},      {0, 0.1f, 0},       {0, 0.15f, 0},      {0, 0.15f, 0},
                                                {0, 0.2f, 0},   {0, 0.1f, 0},       {0.05f, 0.15f, 0},  {0.12f, 0, 0},
                                                {0.3f, 0, 0},   {0.26f, 0, 0},      {-0.05f, 0.15f, 0}, {-0.12f, 0, 0},
                                                {-0.3f, 0, 0},  {-0.26f, 0, 0},     {0.1f, -0.05f, 0},  {0, -0.42f, 0},
                                                {0, -0.43f, 0}, {-0.1f, -0.05f, 0}, {0, -0.42f, 0},     {0, -0.43f, 0}};
struct BodyChain {
    std::uint32_t first, middle, last;
    float bend[3];  // where flexion carries the last bone, in the first joint's frame
};
constexpr BodyChain kBodyChains[kBodyLimbs] = {
    {7, 8, 9, {0, 0, 1}}, {11, 12, 13, {0, 0, 1}}, {14, 15, 16, {0, 0, -1}}, {17, 18, 19, {0, 0, -1}}};

struct BodyGoal {
    float target[3], hand[4];  // in the world; x, y, z, w
};
struct BodyCharacter {
    float rotations[kBodyJoints][4];  // local ones, x, y, z, w
    float root_place[3], root_rotation[4];
    float padding[5];
    BodyGoal goals[kBodyLimbs];
};

// Poses like those of a walking crowd, with goals that the limbs reach.
std::vector<BodyCharacter> random_bodies(std::size_t count);
// Where the joints of a body are in the world, in double.
using BodyVec = std::array<double, 3>;
using BodyQuat = std::array<double, 4>;  // x, y, z, w
BodyVec turned(const BodyQuat& q, const BodyVec& v);
struct BodyFrames {
    std::array<BodyVec, kBodyJoints> place;
    std::array<BodyQuat, kBodyJoints> turn;
};
BodyFrames frames_of(const BodyCharacter& body);
// How far the worst hand or foot is from its goal, in metres, by forward kinematics in double.
double worst_miss(const std::vector<BodyCharacter>& bodies);

}  // namespace bench

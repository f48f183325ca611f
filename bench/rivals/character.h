// SPDX-License-Identifier: MIT
//
// Character C: character B as a game has it in every frame. Feet stand on uneven ground, and the pelvis comes down for
// them. The right hand has a rifle, whose grip the left hand holds. Spine, neck and head look at a target.
#pragma once

#include "bench/rivals/bodies.h"

namespace bench {

inline constexpr std::size_t kLeftHand = 9, kRightHand = 13;
inline constexpr std::size_t kRightArm = 1, kLegs = 2;  // of the limbs; left leg, right leg

struct Character {
    BodyCharacter body;  // the goal of the right arm is the rifle's
    float weights[3];    // of the rifle's place, rotation and elbow
    float contact[2];    // of each foot: above 0.5 it stands
    float ground[2][3];  // a point of the ground below it
    float normal[2][3];
    float look[3];
};

// What all characters have.
constexpr float kToe[3] = {0, -0.05f, 0.1f}, kHeel[3] = {0, -0.05f, -0.05f};  // in a foot's frame
constexpr float kGrip[3] = {0.1f, 0.05f, 0.15f};                              // in the right hand's frame
constexpr float kEye[3] = {0, 0.08f, 0.1f};                                   // in the head's frame
constexpr std::uint32_t kLookChain[] = {2, 3, 4, 5};
constexpr float kLookShares[] = {1, 1, 2, 4}, kLookMax[] = {0.97f, 0.94f, 0.8f, 0.5f};  // cosines
constexpr float kMaxFlexion = 2.5f, kMinFlexion = 0.05f;
constexpr float kFrameTime = 1.0f / 60;
// Where the right upper arm may point: cones in order, in the frame of its shoulder at rest, from the bone along z.
struct CharacterCone {
    float axis[3], angle;
};
constexpr CharacterCone kArmCones[4] = {
    {{0, 0.2f, 1}, 1.1f}, {{0, 1, 0.3f}, 1.3f}, {{1, 0.3f, 0.2f}, 1.3f}, {{0.5f, -0.6f, 0.8f}, 0.9f}};

std::vector<Character> random_characters(std::size_t count);
// How far the worst left hand is from the grip that it reaches, in metres, by forward kinematics in double.
double worst_grip(const std::vector<Character>& characters);

// What a rival keeps of a character from frame to frame.
struct CharacterState {
    struct Foot {
        float anchor[3], offset[3], lift;
        bool is_locked, was_contact;
    } feet[2];
    float shift, shift_speed;
    float line[3];
    bool has_line;
};

}  // namespace bench

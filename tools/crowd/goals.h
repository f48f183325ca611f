// SPDX-License-Identifier: MIT
//
// The goals of a crowd that performs a clip: what each character's limb is asked for in a frame. One source for the
// command and the page: only + - * and plain structures, so both get the same bits. No Eigen, whose vector code adds in
// another order. The structures have one layout on all little-endian machines, so a page holds them as bytes.
#pragma once

#include <stdint.h>

#include "swivel/swivel.h"

extern "C" {

// One limb in one frame of the clip, as the solver sees it: two bones that at rest point where the limb's do. Places
// are relative to the limb's shoulder and rotations are in the world. For a mirrored limb all of them but `origin` are
// in the world's mirror image, x turned over. Words are an arm's. Quaternions are x, y, z, w.
typedef struct goal_source {
    double elbow[3], wrist[3];
    double hand[4];
    double lengths[2];                                  // upper arm, forearm
    double origin[3];                                   // the shoulder in the world
    float parent[4];                                    // of the joint above
    float shoulder[4], elbow_local[4], wrist_local[4];  // the clip's own pose between the two bones
} goal_source;

// A character of the crowd; the first is the clip's own. What is at x in the clip is at place + size * x.
typedef struct goal_character {
    double size;
    double place[3];
    uint32_t start;  // frame of the clip that it starts at
    uint32_t reserved;
} goal_character;

// What a goal's pole is.
enum goal_pole { GOAL_POLE_POINT = 0, GOAL_POLE_DIRECTION = 1, GOAL_POLE_NORMAL = 2 };  // of the swivel plane

// What a limb is asked for beside the clip's motion. Vectors are as solved: mirrored for a mirrored limb.
typedef struct goal_plan {
    double target_point[3], target_offset[3];
    double effector[3];  // in the end joint's frame, of a character of size 1
    double pole_fixed[3];
    uint32_t has_target_point, has_pole_fixed;  // 0 or 1
    uint32_t pole;                              // a goal_pole
    uint32_t hand_is_local;  // 1: the hand goal is the wrist's own local rotation, for SWIVEL_WITH_AIM
    uint32_t is_mirrored;
    uint32_t reserved;
} goal_plan;

// What a limb is asked for; hand is as the plan says.
typedef struct goal {
    double target[3], pole[3], hand[4];
} goal;

// What the solver takes of a limb, as float fields of these names have it.
typedef struct goal_input {
    float target[3], pole[3], lengths[2], position[3], rotation[4], hand[4];
    float shoulder[4], elbow[4], wrist[4];  // the incoming pose
} goal_input;

static_assert(sizeof(goal_source) == 184 && sizeof(goal_character) == 40 && sizeof(goal_plan) == 120 &&
              sizeof(goal_input) == 124);

// The goal of a character of that size. Any thread; no allocation.
goal swivel_goal(const goal_plan* plan, const goal_source* source, double size);

// Fills the inputs of one limb for count characters. sources: one for each frame of the clip. Character c shows frame
// (frame + start) % frame_count. Any thread; no allocation.
void swivel_goals(const goal_plan* plan, const goal_source* sources, uint32_t frame_count, uint32_t frame,
                  const goal_character* characters, uint32_t count, goal_input* inputs);

// Writes inputs to the crowd's fields, as far as it has them; count: all limbs of the group.
swivel_status swivel_goals_write(swivel_crowd* crowd, uint32_t group, uint32_t count, const goal_input* inputs);

}  // extern "C"

// SPDX-License-Identifier: MIT
//
// The goals of a crowd that performs a clip: each character's pose and its limbs' goals in a frame. One source for the
// command and the page: only + - * /, floor, sqrt and plain structures, so both get the same bits. No Eigen, whose
// vector code adds in another order. The structures have one layout on all little-endian machines, so a page holds them
// as bytes.
#pragma once

#include <stdint.h>

#include "swivel/swivel_bodies.h"

extern "C" {

// The way of a foot from one stand to the next, in frames of the sources.
typedef struct goal_stride {
    uint32_t stand;   // middle frame of the stand that the foot is in or comes from
    uint32_t leaves;  // frame after that stand; 0: the limb never stands
    uint32_t lands;   // first frame of the next stand
    uint32_t next;    // middle frame of the next stand
} goal_stride;

// One limb in one frame of the clip: two bones that at rest point where the limb's do. All is in the world's axes, but
// the clip's own pose; elbow and wrist are counted from the shoulder. Words are an arm's. Quaternions are x, y, z, w.
// A look is one more limb, of up to three joints: neck and head stand for shoulder, elbow and wrist.
// A cache has an array for each member of this, and of goal_character, with the words beside it.
typedef struct goal_source {
    double elbow[3];       // elbow from the shoulder, world axes, the clip's unit
    double wrist[3];       // wrist from the shoulder, world axes, the clip's unit
    double hand[4];        // world rotation of the hand, x y z w
    double lengths[2];     // upper arm and forearm, the clip's unit
    double origin[3];      // the shoulder in the world, the clip's unit
    double root[3];        // where the pose hangs, in the world, the clip's unit; the same of all limbs
    double carried[3];     // from the shoulder, the wrist of who carries a box
    float parent[4];       // world rotation of the shoulder's parent joint, x y z w
    float shoulder[4];     // the clip's own local rotation, x y z w
    float elbow_local[4];  // the clip's own local rotation, x y z w
    float wrist_local[4];  // the clip's own local rotation, x y z w
    float contact;         // of a leg that stands: 1 while the clip has its foot on the ground, else 0
    uint32_t carries;      // 1: the arm of who carries a box follows carried
    goal_stride stride;    // of a leg that stands; else zeros
} goal_source;

// A character of the crowd. What is at x in the clip is at place + size * x, where x is turned about y by the heading.
typedef struct goal_character {
    double size;       // factor of all lengths, also of the way it goes; one that a float holds
    double place[3];   // in the world, of the clip's origin; the clip's unit
    uint32_t start;    // frame of its clip that it starts at
    float wish;        // the shift where no leg asks for another; below 0 is lower
    uint32_t first;    // first frame of its clip, among the sources
    uint32_t count;    // frames of its clip, which it plays round and round; 1 or more
    uint32_t carries;  // 1: it carries a box in both hands
    float heading;     // tangent of a quarter of its turn about y, from z to x; 0: as the clip
} goal_character;

// The kind of a goal's pole.
enum goal_pole { GOAL_POLE_POINT = 0, GOAL_POLE_DIRECTION = 1, GOAL_POLE_NORMAL = 2 };  // of the swivel plane

// A limb's goals besides the clip's motion.
typedef struct goal_plan {
    double target_point[3], target_offset[3];
    double effector[3];        // in the end joint's frame, of a character of size 1
    double pole_fixed[3];      // points from the shoulder
    double shoulder_place[3];  // in the frame of the joint above, where that turns, too; else zeros
    double bones[2][3];        // where upper arm and forearm point at rest, in the frames of shoulder and elbow; unit
    float weights[3];          // of target, hand, and a pole that is given
    uint32_t has_target_point, has_pole_fixed;  // 0 or 1
    uint32_t pole;                              // a goal_pole
    uint32_t holds_pole;                        // 1: the clip's own pole counts, too; 0: the elbow goes as in the clip
    uint32_t hand_is_local;  // 1: the hand goal is the wrist's own local rotation, for SWIVEL_WITH_AIM
    uint32_t goes_along;  // 1: on ground its target and hand do not count, so it moves with its body; unless it carries
    uint32_t is_look;     // 1: no limb, but neck and head; target_offset is what they look at, in the world
    uint32_t holds;       // SWIVEL_WITH_LINK: 1 more than the number of the limb whose hand this one holds; else 0
    float clearance;      // of a leg that stands: swivel_ground's toe_clearance
} goal_plan;

// A limb's goal, in the world. Pole and hand are of the plan's kinds.
typedef struct goal {
    double target[3], pole[3], hand[4];
} goal;

// A given goal for a limb, which replaces the formula's in a frame of the page.
typedef struct goal_given {
    uint32_t frame, character, limb;
    float pole_weight;
    double target[3], pole[3];
    float hand[4];
} goal_given;

// Ground as it lies: a grid of heights, whose middle is at a place in the world. Columns go along x, rows along z.
// Beyond its edges the ground goes on level, as high as there.
typedef struct goal_ground {
    double size[3];          // along x; of a height of 1; along z; above 0
    double place[3];         // of the middle, where the height is 0
    uint32_t columns, rows;  // 2 or more; 0: all is level, as high as the place
} goal_ground;

// The root of a character's pose, the origin of all places in the solver's rows.
typedef struct goal_root {
    double place[3];  // in the world, as the clip and the ground have it
    float size;
    float shift;  // by the last solve: the body hangs so much higher
} goal_root;

// The solver's inputs of a limb: fields of these names, and the incoming pose of its joints in the order of
// GOAL_JOINTS. Places are in the parent's frame, of a character of size 1.
typedef struct goal_input {
    double target[3], pole[3];  // in the world
    float hand[4], weights[3];
    float places[4][3];
    float rotations[5][4];  // the last one, no turn, is each twist bone's: the clip has none of these
    float contact;          // as the source's
    float grip[7];  // as SWIVEL_GRIP, of size 1: where the clip has it on the wrist that it holds; zeros: it holds none
    float room;     // of a leg that stands: how far its toe is above its clearance over the clip's floor; at least 0
    double plane[3];  // then: a point of the plane of its ground, in the world
    float slopes[2];  // of that plane, along x and z
} goal_input;

// Joints of a limb in a crowd's skeleton: shoulder's parent, shoulder, elbow and wrist. Its twist bones come after
// them.
enum { GOAL_JOINTS = 4 };
enum { GOAL_MAX_LIMBS = 8 };  // of a character, with its look

// swivel_plant's anchor_lead and swivel_ground's half_life of groups that stand on ground, which differ from their
// defaults: planes already rise and turn smoothly with strides, and nothing is eased twice.
static const float GOAL_ANCHOR_LEAD = 1, GOAL_GROUND_HALF_LIFE = 0;

// The frame of the sources that a character shows in a frame of the crowd. Any thread; no allocation.
inline uint32_t swivel_goal_frame(const goal_character* character, uint32_t frame)
{
    return character->first + (uint32_t)((frame + (uint64_t)character->start) % character->count);
}

// Whether a limb of a character holds its box. Any thread; no allocation.
inline bool swivel_goal_carries(const goal_source* source, const goal_character* character)
{
    return source->carries != 0 && character->carries != 0;
}

// The goal of a limb of a character. Any thread; no allocation.
goal swivel_goal(const goal_plan* plan, const goal_source* source, const goal_character* character);

// Fills the inputs of `count` characters.
// plans: of each limb, at most GOAL_MAX_LIMBS. sources: of each limb, one for each frame of all clips.
// ground, heights: null, or feet that stand do so on it, and each character is raised to its lower foot's ground.
// roots: count of them. inputs: [character][limb].
// Any thread; no allocation.
void swivel_goals(const goal_plan* plans, const goal_source* const* sources, uint32_t limb_count, uint32_t frame,
                  const goal_ground* ground, const float* heights, const goal_character* characters, uint32_t count,
                  goal_root* roots, goal_input* inputs);

// The ground's height in the world. Any thread; no allocation.
double swivel_ground_height(const goal_ground* ground, const float* heights, double x, double z);

// Solves a crowd of bodies that has a group for each limb and the look, and joints as GOAL_JOINTS says. After them it
// may have a group of shifts.
// characters, roots, inputs: of all bodies. Roots get the shifts, if the crowd has some.
// ground, heights: what legs stand on; null without.
// seconds: since the last solve.
// poses: become the local rotations as solved, swivel_goal_pose_size() floats for each body. A limb has x, y, z, w of
// each of its joints. Joints that are not solved stay as they are, so start with zeros.
// job: which bodies, and on which threads. Its frames, pose and sampling are overwritten.
// It fails as swivel_solve() does. It also fails for more than GOAL_MAX_LIMBS limbs, and for other groups.
swivel_status swivel_goals_solve(swivel_crowd* crowd, const goal_ground* ground, const float* heights, float seconds,
                                 const goal_character* characters, goal_root* roots, const goal_input* inputs,
                                 float* poses, swivel_job* job);
uint32_t swivel_goal_pose_size(const swivel_crowd* crowd);

// The pose that swivel_goals_solve() solves, without its time. swivel_draw() takes it after a solve.
// Parameters: as those of swivel_goals_solve(). The pose points to their arrays.
// offsets: swivel_goal_pose_size() / 2 numbers, which this fills; they must live as long as the pose.
// Any thread; no allocation.
void swivel_goals_pose(const swivel_crowd* crowd, const goal_character* characters, const goal_root* roots,
                       const goal_input* inputs, float* poses, size_t* offsets, swivel_pose* pose);

// The digest of all results: swivel_digest(), continued with the poses of all bodies.
uint64_t swivel_goals_digest(const swivel_crowd* crowd, const float* poses);

}  // extern "C"

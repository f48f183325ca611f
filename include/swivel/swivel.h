// SPDX-License-Identifier: MIT
//
// swivel: inverse kinematics of crowds. For each limb, a wrist target and an elbow pole go in, and joint rotations come
// out. A solve uses only correctly rounded operations and no trigonometry, so every CPU gives the same bits. This
// header is the whole binary interface, and swivel.hpp wraps it for C++. docs/ explains every field with pictures.
//
// A whole program, for two arms in their own frames:
//     float targets[2][3] = {{0.3f, 0.1f, 0.3f}, {0.0f, 0.2f, 9.0f}};  // for the wrists; the second is out of reach
//     float pole[3] = {0, -1, 0}, lengths[2] = {0.30f, 0.26f};         // upper arm, forearm
//     float shoulder[2][4];                                            // x, y, z, w
//     swivel_group_def arms = swivel_default_group_def(2);             // group 0
//     swivel_crowd_def def = swivel_default_crowd_def();
//     swivel_crowd* crowd;
//     def.groups = &arms, def.group_count = 1;
//     if (swivel_crowd_create(&def, &crowd) != SWIVEL_OK) return puts(swivel_last_error());
//     swivel_write(crowd, SWIVEL_TARGET, 0, 0, 2, (swivel_in){targets, sizeof targets[0]});
//     swivel_write(crowd, SWIVEL_POLE, 0, 0, 2, (swivel_in){pole, 0});  // stride 0: one value for all
//     swivel_write(crowd, SWIVEL_LENGTHS, 0, 0, 2, (swivel_in){lengths, 0});
//     swivel_solve(crowd, NULL);
//     swivel_read(crowd, SWIVEL_SHOULDER, 0, 0, 2, (swivel_out){shoulder, sizeof shoulder[0]});
//     swivel_crowd_destroy(crowd);
//
// Conventions: right-handed axes; quaternions are Hamilton's, x, y, z, w, and a*b applies b first; lengths are in the
// caller's unit. In the arm frame the shoulder is at the origin, a straight limb at rest lies along +z, and flexion
// turns the forearm about -x, so the elbow moves towards -y. "Arm lengths" are the length of both bones together.
//
// Errors: a call that fails returns a status, leaves one line in swivel_last_error(), and changes nothing else.
//
// Threads: different threads may use different crowds at once. One crowd belongs to one thread at a time, with two
// exceptions: calls that take it const may run together while nothing changes it, and so may jobs on_this_thread on
// blocks that do not overlap, each in a workspace of its own. "Any thread" marks calls that need no such care.
//
// Every call computes with default rounding and denormals, whatever the caller has, and restores the caller's
// floating-point environment with its sticky flags; callbacks run in the caller's. Every call needs at most 32 KiB of
// stack; callbacks, and what oneTBB takes on its own threads, come on top.
//
// Structures that may grow begin with their size: start each from its swivel_default_ function. The library accepts the
// shorter structures of older headers. In an array, all elements have the size of the first.
//
// Debug builds, and builds with SWIVEL_CHECK_USE, also refuse destroyed crowds, crowds that two threads use at once,
// and results that overlap the inputs of other limbs.
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#if defined(SWIVEL_SHARED) && defined(_WIN32)  // SWIVEL_SHARED: the shared library itself is being compiled
#define SWIVEL_API __declspec(dllexport)
#elif defined(SWIVEL_SHARED)
#define SWIVEL_API __attribute__((visibility("default")))
#else
#define SWIVEL_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define SWIVEL_VERSION_MAJOR 0
#define SWIVEL_VERSION_MINOR 3
#define SWIVEL_VERSION_PATCH 0
#define SWIVEL_VERSION (SWIVEL_VERSION_MAJOR * 10000 + SWIVEL_VERSION_MINOR * 100 + SWIVEL_VERSION_PATCH)

enum { SWIVEL_LANES = 16 };  // limbs in a block of rows: see swivel_rows

typedef enum swivel_status {
    SWIVEL_OK = 0,
    SWIVEL_INVALID_ARGUMENT = 1,  // an argument breaks its contract
    SWIVEL_OUT_OF_MEMORY = 2,     // the allocator returned null, or the caller's memory is too small
    SWIVEL_UNKNOWN_ISA = 3,       // no instruction set of that name was built in
    SWIVEL_ISA_UNAVAILABLE = 4,   // it was built in, but this CPU or operating system cannot run it
} swivel_status;

// The flag word of a limb. A hard pose is a result with flags, not an error. Bits that are not listed are 0.
typedef enum swivel_flag {
    SWIVEL_REACHED = 1u << 0,       // the wrist, effector, prop or line of sight is where its goal wants it
    SWIVEL_SOFTENED = 1u << 1,      // in a soft zone of the reach, so the wrist is not quite at the target
    SWIVEL_STRETCHED = 1u << 2,     // SWIVEL_STRETCH is above 1
    SWIVEL_CLAMPED_FAR = 1u << 3,   // the target is too far: the wrist is at the nearest point within reach
    SWIVEL_CLAMPED_NEAR = 1u << 4,  // the target is too near: likewise
    // Pole, hand or target do not say where the elbow goes, so the last solve's normal does, or the incoming pose. If
    // neither does, the normal is the arm frame's x axis, or else its y axis.
    SWIVEL_SWIVEL_UNDEFINED = 1u << 5,
    SWIVEL_LIMITED_FLEXION = 1u << 6,  // the flexion limit keeps the wrist from the target
    // The named limit forbids the swivel that was wished for.
    SWIVEL_LIMITED_SHOULDER_CONE = 1u << 7,
    SWIVEL_LIMITED_HUMERAL_TWIST = 1u << 8,
    SWIVEL_LIMITED_SHOULDER_BOX = 1u << 9,
    SWIVEL_LIMITED_HAND_CONE = 1u << 10,
    SWIVEL_LIMITED_FOREARM_TWIST = 1u << 11,
    SWIVEL_LIMITED_HAND_TWIST = 1u << 12,
    SWIVEL_LIMITED_WRIST_BOX = 1u << 13,
    SWIVEL_LIMITED_STEP = 1u << 14,  // the wish is further than SWIVEL_MAX_SWIVEL from the last solve's swivel
    // No swivel keeps all limits. This one violates them least, or with STEP_WINS it is on its way there.
    SWIVEL_INFEASIBLE = 1u << 15,
    SWIVEL_JUMPED = 1u << 16,          // joint limits turned the swivel further than SWIVEL_MAX_SWIVEL
    SWIVEL_PLANTED = 1u << 17,         // the point is locked to its support
    SWIVEL_RELEASED = 1u << 18,        // this solve released it
    SWIVEL_BROKE_AWAY = 1u << 19,      // released by distance: the animated point is too far, though in contact
    SWIVEL_CUT = 1u << 20,             // a speed too high to be eased was cut at a lock or release: the point jumps
    SWIVEL_LIMITED_REGION = 1u << 21,  // the upper arm's region forbids the swivel that was wished for
    SWIVEL_LIMITED_LOOK = 1u << 22,    // a cone holds a joint of a look; later joints may make up for that
    SWIVEL_FADED = 1u << 23,           // a look's target is behind or too near, so the look counts less or not at all
    SWIVEL_BAD_INPUT = 1u << 30,       // an input is not valid or was never given: see swivel_on_bad_input
} swivel_flag;

// The features of a group: a combination of these bits, fixed at creation. A feature that is off costs neither memory
// nor time. SWIVEL_WITH_F adds the field F. swivel_describe_feature() lists what each feature needs and excludes, and
// creating a crowd checks that. Groups that are FIT, PROP or LOOK are no limbs and have no other feature.
typedef uint64_t swivel_features;
#define SWIVEL_WORLD (UINT64_C(1) << 0)           // targets, poles and hands are in the world; limbs have parents
#define SWIVEL_JOINTS (UINT64_C(1) << 1)          // results are local rotations of the skeleton's joints
#define SWIVEL_WITH_HAND (UINT64_C(1) << 2)       // a wanted hand rotation goes in, a wrist rotation comes out
#define SWIVEL_POLE_DIRECTION (UINT64_C(1) << 3)  // poles are directions, not points
#define SWIVEL_WITH_EFFECTOR (UINT64_C(1) << 5)   // the target is for a point of the hand
#define SWIVEL_WITH_ANGLE (UINT64_C(1) << 6)      // turns the elbow on from the pole's side
#define SWIVEL_POLE_NORMAL (UINT64_C(1) << 7)     // poles are normals of the swivel plane
#define SWIVEL_WITH_INCOMING (UINT64_C(1) << 8)   // the pose so far goes in: three fields
#define SWIVEL_POLE_INCOMING (UINT64_C(1) << 9)   // no poles: the incoming pose says where elbows go
#define SWIVEL_WITH_WEIGHTS (UINT64_C(1) << 10)
#define SWIVEL_WITH_REACH (UINT64_C(1) << 11)
#define SWIVEL_WITH_MAX_SWIVEL (UINT64_C(1) << 12)
#define SWIVEL_WITH_FLEXION_LIMIT (UINT64_C(1) << 13)
#define SWIVEL_WITH_SHOULDER_CONE (UINT64_C(1) << 14)
#define SWIVEL_WITH_HUMERAL_TWIST (UINT64_C(1) << 15)
#define SWIVEL_WITH_SHOULDER_BOX (UINT64_C(1) << 16)
#define SWIVEL_WITH_HAND_CONE (UINT64_C(1) << 17)
#define SWIVEL_WITH_FOREARM_TWIST (UINT64_C(1) << 18)
#define SWIVEL_WITH_HAND_TWIST (UINT64_C(1) << 19)
#define SWIVEL_WITH_WRIST_BOX (UINT64_C(1) << 20)
#define SWIVEL_WITH_AIM (UINT64_C(1) << 21)       // the flexion is given, and the hand points at the target
#define SWIVEL_WITH_CLAVICLE (UINT64_C(1) << 22)  // the shoulder's parent joint shares the reach
#define SWIVEL_BODY (UINT64_C(1) << 23)           // limb i is body i's; a crowd with a skeleton adds it and its needs
#define SWIVEL_WITH_RECORD (UINT64_C(1) << 24)    // bodies: keeps what the pose gave, which explain and others need
#define SWIVEL_WITH_PLANT (UINT64_C(1) << 25)     // a point of the hand or foot stands where it touches: swivel_plant
#define SWIVEL_WITH_PLANT_ROTATION (UINT64_C(1) << 26)  // the planted hand or foot keeps its rotation, too
#define SWIVEL_PLANT_BY_MOTION (UINT64_C(1) << 27)      // no labels: the point's speed and height show its contact
#define SWIVEL_WITH_CAP (UINT64_C(1) << 28)
#define SWIVEL_WITH_PELVIS_FIT (UINT64_C(1) << 29)   // a FIT group shifts the body so that this limb reaches
#define SWIVEL_WITH_NEXT_TARGET (UINT64_C(1) << 30)  // the shift also prepares for where the limb goes next
#define SWIVEL_FIT (UINT64_C(1) << 31)               // the group is each body's shift: swivel_fit
// Where the wrist misses its place, the hand turns about it, no further than it must, to bring the effector nearest to
// its target: a heel lifts where the leg is too short for the toe.
#define SWIVEL_HAND_YIELDS (UINT64_C(1) << 32)
// Where the hand or foot is after a solve. A group that others are linked to gets it by itself.
#define SWIVEL_WITH_HAND_TRANSFORM (UINT64_C(1) << 33)
#define SWIVEL_WITH_LINK (UINT64_C(1) << 34)    // the goal is a grip on another limb's hand, or on a PROP: link
#define SWIVEL_PROP (UINT64_C(1) << 35)         // the group is a thing that hands hold: swivel_prop
#define SWIVEL_WITH_GROUND (UINT64_C(1) << 36)  // the planted foot stands on uneven ground: swivel_ground
#define SWIVEL_SENT (UINT64_C(1) << 37)         // the library makes its goal: WITH_PLANT and WITH_LINK add it
#define SWIVEL_LOOK (UINT64_C(1) << 38)         // the group is joints that turn to a target: swivel_look
#define SWIVEL_WITH_REGION (UINT64_C(1) << 39)  // the upper arm stays in a region: swivel_region
#define SWIVEL_STEP_WINS (UINT64_C(1) << 43)    // SWIVEL_MAX_SWIVEL takes precedence over limits, so no elbow pops
// No poles: the elbow lies where it would if the wanted hand were not bent. Where the hand hardly says that, within 20
// degrees of the line from shoulder to wrist, the incoming pose fades in.
#define SWIVEL_POLE_HAND (UINT64_C(1) << 44)
#define SWIVEL_NO_LIMB (SWIVEL_FIT | SWIVEL_PROP | SWIVEL_LOOK)  // a group that is no limb has one of these
#define SWIVEL_WITH_TWIST_BONES (UINT64_C(1) << 40)              // times the number of twist bones, 1 to 7

// The inputs and results of a limb. Each comment starts with the number of floats, and the feature if one is needed. A
// "wish" is the swivel that pole, hand, angle and incoming pose ask for; a "share" is 0..1.
//
// - Valid input: positions and poles up to 1e15; quaternions of length 1e-9..1e9, which need not be normalised; axes
//   and pairs of cosine and sine whose squared length is 1 within 1e-6; shares. A limb with any other value gets
//   SWIVEL_BAD_INPUT, and no other limb changes by a bit.
// - Positions are in the target's space where no other frame is named: the arm frame, or with WORLD the world. In rows
//   they are from the root where a pose's root is in doubles.
// - A range of angles is four numbers: cosine and sine of its middle, then of its half-width. swivel_range() makes it.
// - Limits are measured from the rest pose with the elbow straight; their axes are in the arm frame. The solver takes
//   the allowed swivel that is nearest to the wish. The wrist comes before limits. Limits come before
//   SWIVEL_MAX_SWIVEL, but with STEP_WINS after it.
// - Results: quaternions of unit length within 1.1e-6 and with w >= 0; at w = 0 the first of x, y, z that is not 0 is
//   positive. WITH_INCOMING they have the sign nearer to the incoming one. Equal inputs give equal bits on every CPU
//   and instruction set, with any number of threads and any choice of blocks.
typedef enum swivel_field {
    SWIVEL_TARGET = 0,  // 3: where the wrist goes, in the arm frame, or with WORLD in the world
    // 3: a point that the elbow leans towards, in the target's space; with POLE_DIRECTION a direction, with POLE_NORMAL
    // the plane's normal: cross(line from shoulder to wrist, direction to the elbow's side).
    SWIVEL_POLE,
    SWIVEL_LENGTHS,            // 2: upper arm and forearm, before the parent's scale; each is 0 or 1e-15..1e15
    SWIVEL_SHOULDER_POSITION,  // 3, WORLD: the shoulder in the world
    SWIVEL_PARENT_ROTATION,    // 4, WORLD: world rotation of the shoulder's parent joint
    SWIVEL_PARENT_SCALE,       // 1, WORLD: the parent's uniform scale, 1e-15..1e15
    // 4, WITH_HAND: the wanted rotation of the hand, or with JOINTS of the wrist joint, in the target's space
    SWIVEL_HAND,
    // 3, WITH_EFFECTOR: a point in the hand's frame, which has the arm frame's axes at rest, or with JOINTS in the
    // wrist joint's own; in the bones' unit, before the parent's scale
    SWIVEL_EFFECTOR,
    // 2, WITH_ANGLE: cosine and sine of an angle by which the elbow turns on from the pole's side, by the right hand
    // about the line from shoulder to wrist. The pair's length is 1e-9..1e9.
    SWIVEL_ANGLE,
    // 4 each, WITH_INCOMING: the pose so far. With JOINTS local rotations; otherwise the shoulder in the arm frame, the
    // forearm relative to the upper arm, the hand relative to the forearm. The wrist's needs WITH_HAND.
    SWIVEL_INCOMING_SHOULDER,
    SWIVEL_INCOMING_ELBOW,
    SWIVEL_INCOMING_WRIST,
    SWIVEL_WEIGHTS,  // 3, WITH_WEIGHTS: shares of position, hand and pole: 0 keeps the incoming pose, 1 takes the goal
    // 4, WITH_REACH: far soft zone, near soft zone, max stretch 1..1000, min distance. Zones and distance are shares of
    // both bones' length. In a zone the wrist eases into the end of the reach; then the bones stretch to close the gap.
    SWIVEL_REACH,
    // 2, WITH_MAX_SWIVEL: cosine and sine of the largest turn of the swivel in one solve, 0..pi; where a pose has a
    // time, in a 60th of a second.
    SWIVEL_MAX_SWIVEL,
    SWIVEL_FLEXION_LIMIT,  // 2, WITH_FLEXION_LIMIT: cosines of half the min and half the max flexion; narrows the reach
    SWIVEL_SHOULDER_CONE,  // 4, WITH_SHOULDER_CONE: unit axis; cosine of the upper arm's max angle to it
    SWIVEL_HUMERAL_TWIST,  // 4, WITH_HUMERAL_TWIST: range of the upper arm's twist about itself
    // 12, WITH_SHOULDER_BOX: ranges of the shoulder's Euler angles, in the group's shoulder_order
    SWIVEL_SHOULDER_BOX,
    SWIVEL_HAND_CONE,      // 4, WITH_HAND_CONE: unit axis of the hand; cosine of its max angle to the forearm
    SWIVEL_FOREARM_TWIST,  // 4, WITH_FOREARM_TWIST: range of the hand's twist about the forearm
    SWIVEL_HAND_TWIST,     // 7, WITH_HAND_TWIST: unit axis of the hand; range of its twist about it
    SWIVEL_WRIST_BOX,      // 12, WITH_WRIST_BOX: ranges of the wrist's Euler angles, in the group's wrist_order
    // 5, WITH_AIM: unit axis in the effector's frame; cosine and sine of half the flexion, which the elbow keeps. The
    // shoulder turns until a ray from the effector along the axis meets the target. SWIVEL_HAND is then relative to the
    // forearm, or with JOINTS the wrist's local rotation.
    SWIVEL_AIM,
    // 4, WITH_CLAVICLE: the shoulder in its parent joint's frame, in the bones' unit; a share. The parent turns towards
    // the target by about that share of the angle. Bodies give 1 number, the share alone.
    SWIVEL_CLAVICLE,
    // 1, WITH_PLANT without PLANT_BY_MOTION: the label of contact, a share; above 0.5 the point touches
    SWIVEL_CONTACT,
    // 3, WITH_CAP: margin, least, zone, as shares of both bones' length. The limb reaches as far as the incoming pose,
    // or `least` if that is more, and `margin` beyond; an eased zone lies before that end. 0.01, 0.9, 0 at the start.
    SWIVEL_CAP,
    // 1, WITH_PELVIS_FIT: how much the limb's goal counts for the shift, a share; 1 at the start
    SWIVEL_PELVIS_FIT_WEIGHT,
    SWIVEL_NEXT_TARGET,  // 3, WITH_NEXT_TARGET: where the wrist or effector goes next, such as the next step
    // 1, WITH_NEXT_TARGET: seconds until then, 0 or more. 1e15, as at the start: nothing comes next
    SWIVEL_NEXT_TIME,
    // 1, FIT: the shift that is wished for, in the world's unit, -1e15..1e15; 0 at the start
    SWIVEL_SHIFT_WISH,
    SWIVEL_GROUND,  // 3, WITH_GROUND: a point of the ground, sampled at SWIVEL_PROBE. NaN, as at the start: none
    // 3, WITH_GROUND: its normal, of length 1e-9..1e9. Steeper than 87 degrees counts as no ground
    SWIVEL_GROUND_NORMAL,
    SWIVEL_GROUND_WEIGHT,  // 1, WITH_GROUND: how far the foot turns with the ground, a share; 1 at the start
    // 7, WITH_LINK: position, 3, and rotation, 4, of this limb's wrist or effector on what it is linked to: in the
    // frame of that limb's wrist joint, in the bones' unit; or in the PROP's frame, in the world's unit.
    SWIVEL_GRIP,
    // 3, PROP: in the target's space, or with a joint in its frame. NaN, as at the start: see swivel_prop
    SWIVEL_PROP_POSITION,
    SWIVEL_PROP_ROTATION,  // 4, PROP: likewise
    // 1, PROP: which hand says where it is, a share: 0, as at the start, the first; 1 the second; in between both
    SWIVEL_HAND_BLEND,
    // 1, PROP: how much given position, rotation and joint count against the hands, a share; 1 at the start
    SWIVEL_PROP_WEIGHT,
    SWIVEL_LOOK_TARGET,  // 3, LOOK: what to look at. NaN, as at the start: nothing, so the incoming pose comes back
    SWIVEL_LOOK_WEIGHT,  // 1, LOOK: how much of the turn is taken, a share; 1 at the start
    SWIVEL_INPUT_END,    // one past the last input of this release

    SWIVEL_SHOULDER = 256,  // 4: the shoulder's rotation in the arm frame, or with JOINTS the joint's local one
    // 2: cosine and sine of half the flexion, of the quaternion (-sin, 0, 0, cos). With JOINTS 4: the local rotation.
    SWIVEL_ELBOW,
    SWIVEL_WRIST,    // 4, WITH_HAND: the hand relative to the forearm, or with JOINTS the wrist joint's local rotation
    SWIVEL_FLAGS,    // 1: bits of swivel_flag, as uint32_t
    SWIVEL_STRETCH,  // 1, WITH_REACH: the factor for both bone lengths, 1 or more
    // 3, WITH_MAX_SWIVEL: unit normal of the swivel plane in the arm frame, from which the next solve steps
    SWIVEL_NORMAL,
    // 4 n, WITH_TWIST_BONES * n: rotations of n bones that share the hand's twist; bone i of 1..n turns by i / (n + 1).
    // Local rotations with JOINTS and a binding of these bones. Bodies: what each turns by from its incoming rotation.
    SWIVEL_TWIST_BONES,
    SWIVEL_CLAVICLE_ROTATION,  // 4, WITH_CLAVICLE: the parent joint's turn; its rotation becomes the old one times this
    // 22, WITH_RECORD: how the pose gave a body's limb. Shoulder position, 3; the arm frame's world rotation, 4; the
    // parent's scale; both lengths; the incoming upper arm, forearm and hand, 4 each.
    SWIVEL_RECORD,
    // 11, WITH_PLANT, in the support's frame: the anchor, or the last animated position, 3; the offset that fades, 3,
    // its velocity, 3; the seconds until it is gone; 0 before the first solve, else 8, plus 1 if locked, 2 if the next
    // label locks it, 4 if it was just released.
    SWIVEL_PLANT,
    // 10, WITH_PLANT_ROTATION: the same of the rotation: 4; offset, 3, and velocity, 3, of axis times tan(angle / 2)
    SWIVEL_PLANT_ROTATION,
    SWIVEL_CONTACT_STATE,  // 4, PLANT_BY_MOTION: the last animated position in the support's frame; 1 if in contact
    SWIVEL_SOLVED_GOAL,    // 7, SENT and WITH_RECORD: where the wrist or effector was sent, 3; the hand's rotation, 4
    SWIVEL_SHIFT,  // 3, FIT: the body's shift along `up`, in the world's unit; its rate a second; 1 once it has begun
    SWIVEL_PROBE,  // 3, WITH_GROUND: sample the ground above or below this point
    // 9, WITH_GROUND: the ground's lift along `up`, its rate, 1 once it has begun; the foot's normal, its rate
    SWIVEL_LIFT,
    // 7, WITH_HAND_TRANSFORM: the wrist joint after the solve: position, 3, and world rotation, 4
    SWIVEL_HAND_TRANSFORM,
    SWIVEL_PROP_TRANSFORM,  // 7, PROP: position, 3, and world rotation, 4
    // 6, LOOK: the line of sight after the solve: its start, 3; its unit direction in the world, 3
    SWIVEL_SIGHT,
    // 25, LOOK: 1 once solved; then 3 a joint: the axis of its turn times the tangent of a quarter of the angle, in the
    // last joint's incoming frame; 0 without a rate
    SWIVEL_LOOK_TURNS,
    SWIVEL_RESULT_END  // one past the last result of this release
} swivel_field;

enum { SWIVEL_MAX_TWIST_BONES = 7 };  // of one limb

typedef enum swivel_field_kind {
    SWIVEL_FIELD_INPUT,    // the caller writes it
    SWIVEL_FIELD_RESULT,   // a solve writes it
    SWIVEL_FIELD_CARRIED,  // a result that the limb's next solve starts from; swivel_reset() clears it
} swivel_field_kind;

// A feature and a field as the library has them in its table.
typedef struct swivel_feature_info {
    swivel_features feature;   // SWIVEL_WITH_TWIST_BONES stands for any number of them
    const char* name;          // such as "WITH_HAND"; a constant
    swivel_features needs;     // a group with the feature must have all of these
    swivel_features excludes;  // and none of these
} swivel_feature_info;
typedef struct swivel_field_info {
    swivel_field field;
    swivel_field_kind kind;
    const char* name;          // such as "shoulder_position"; a constant, as is the next
    const char* range;         // what a value of an input must be, in words; empty for results
    swivel_features needs;     // a group has the field if it has all of these, and any number of twist bones for theirs
    swivel_features excludes;  // and none of these
    uint32_t is_position;      // 1: it may be given in double, from an origin
    uint32_t max_components;   // the most numbers that a value has in any group; see swivel_field_row_count()
} swivel_field_info;

// Describes feature or field number `index`, from 0. Returns 1; or 0, changing nothing, if there is none. Any thread.
SWIVEL_API int swivel_describe_feature(uint32_t index, swivel_feature_info* info);
SWIVEL_API int swivel_describe_field(uint32_t index, swivel_field_info* info);
// The name of the lowest bit of a flag word, such as "REACHED"; null for an unknown bit. Any thread.
SWIVEL_API const char* swivel_flag_name(uint32_t flags);

typedef struct swivel_in {
    const void* data;  // null only for zero limbs
    size_t stride;     // bytes from one limb's value to the next; 0: one value for all limbs. Any alignment.
} swivel_in;

typedef struct swivel_out {
    void* data;     // null only for zero limbs
    size_t stride;  // bytes; at least the value's size. Any alignment.
} swivel_out;

// Maps the arm frame to a skeleton's joints, as unit quaternions (x, y, z, w). swivel_bind_joints() makes it.
typedef struct swivel_binding {
    size_t size;                     // sizeof(swivel_binding), set by swivel_default_binding()
    float parent_from_arm[4];        // arm frame to the shoulder's parent joint
    float upper_from_arm[4];         // arm frame, bones and hinge at rest, to the shoulder joint's own frame
    float elbow_parent_from_arm[4];  // the same, to the elbow's parent: upper_from_arm where that is the shoulder joint
    float fore_from_arm[4];          // the same, to the elbow joint's own frame
    float wrist_parent_from_arm[4];  // the same, to the wrist's parent: fore_from_arm where that is the elbow joint
    float shoulder_rest[4], elbow_rest[4], wrist_rest[4];  // local rotations a limb with bad input gets by default
    float lengths[2];                                      // upper arm, forearm; NaN where they are not known
    uint32_t twist_bone_count;  // 0: none is bound, and SWIVEL_TWIST_BONES is relative to their rest
    // The same, to each twist bone's parent and to its own frame. Unused entries hold fore_from_arm.
    float twist_parent_from_arm[SWIVEL_MAX_TWIST_BONES][4], twist_from_arm[SWIVEL_MAX_TWIST_BONES][4];
} swivel_binding;

// Not bound yet.
static inline swivel_binding swivel_default_binding(void)
{
    swivel_binding binding;
    memset(&binding, 0, sizeof binding);
    binding.size = sizeof binding;
    return binding;
}

// A skeleton at rest. Joints are named by index, in any order; every stride is at least a value's size.
typedef struct swivel_skeleton {
    size_t size;             // sizeof(swivel_skeleton), set by swivel_default_skeleton()
    swivel_in parents;       // an int32_t for each joint: its parent, or -1 for a root
    swivel_in rotations;     // x, y, z, w relative to the parent; null data: no joint is turned at rest
    swivel_in translations;  // 3 floats: the joint in its parent's frame. Scales must already be applied
    uint32_t joint_count;
    uint32_t reserved;  // 0
} swivel_skeleton;

static inline swivel_skeleton swivel_default_skeleton(void)
{
    swivel_skeleton skeleton;
    memset(&skeleton, 0, sizeof skeleton);
    skeleton.size = sizeof skeleton;
    return skeleton;
}

// Which joints of a skeleton are a limb: the elbow below the shoulder, the wrist below the elbow. Joints in between
// keep their rest rotations, as parts of the bone.
typedef struct swivel_limb_joints {
    size_t size;  // sizeof(swivel_limb_joints), set by swivel_default_limb_joints()
    uint32_t shoulder, elbow, wrist;
    // Joints that share the hand's twist, from elbow to wrist, up to SWIVEL_MAX_TWIST_BONES. Each is below the elbow
    // and not below the wrist. None is above the wrist or above another of them.
    uint32_t twist_bone_count;
    const uint32_t* twist_bones;
    // Where flexion carries the forearm, in the shoulder joint's frame: mostly forwards for an arm, backwards for a
    // leg. For a direction f in the world and the joint's world rotation q at rest, it is conjugate(q) * f * q, of any
    // length up to 1e15. Zero: the rest pose says where the limb bends, if it is bent by more than 10 degrees.
    float bend[3];
    float reserved;  // 0
} swivel_limb_joints;

static inline swivel_limb_joints swivel_default_limb_joints(uint32_t shoulder, uint32_t elbow, uint32_t wrist)
{
    swivel_limb_joints joints;
    memset(&joints, 0, sizeof joints);
    joints.size = sizeof joints;
    joints.shoulder = shoulder;
    joints.elbow = elbow;
    joints.wrist = wrist;
    return joints;
}

// Intrinsic Euler angles: SWIVEL_XYZ means R = Rx Ry Rz.
typedef enum swivel_euler_order {
    SWIVEL_XYZ,
    SWIVEL_XZY,
    SWIVEL_YZX,
    SWIVEL_YXZ,
    SWIVEL_ZXY,
    SWIVEL_ZYX,
} swivel_euler_order;

// A limb with bad input gets this, besides SWIVEL_BAD_INPUT.
typedef enum swivel_on_bad_input {
    SWIVEL_REST_POSE,  // its rest pose; its carried values are cleared
    SWIVEL_KEEP_POSE,  // the results and carried values that it had; in streams only its flags are written
} swivel_on_bad_input;

// How limbs WITH_PLANT stand. While its point, the effector or else the wrist, is in contact, it is locked to the
// support and keeps its bits there. Without contact, or further than unlock_radius from the animation, it is released
// and goes back. Position and speed stay continuous. The incoming pose says where the point is animated, unless targets
// and hands are written. Lengths are in limb lengths: both bones at rest times the root's scale. Times are in seconds.
// docs/howto/feet.md has pictures. Source: our own, after D. Holden, Inverse Kinematics and Foot Locking (2026).
typedef struct swivel_plant {
    float lock_radius;    // it locks only within this of the animated point
    float unlock_radius;  // it is released further than this from the animated point; no less than lock_radius
    float stop_time;      // a point that locks is at rest after this
    float release_time;   // a released point is with the animation again after this
    float relock_speed;   // limb lengths a second: after a release by distance a slower point locks again; 0: none does
    float anchor_lead;    // 0: the anchor is where the point locks. 1: where it would come to rest. 0.5 slides least
    float reset_time;     // a body that was not solved for longer than this starts anew; 0: none does
    // PLANT_BY_MOTION: a contact begins below speed[0] and height[0], and goes on below speed[1] and height[1]. Speeds
    // are in limb lengths a second, heights over the root along `up`.
    float speed[2], height[2];
} swivel_plant;

static inline swivel_plant swivel_default_plant(void)
{
    const swivel_plant plant = {0.12f, 0.24f, 0.1f, 0.2f, 0.06f, 0.5f, 0, {0.6f, 0.8f}, {0.08f, 0.1f}};
    return plant;
}

// How a FIT group shifts a body along the crowd's `up`, such as its pelvis, so that its limbs WITH_PELVIS_FIT reach.
// Among the shifts from which all reach it takes the nearest to the wish; if there is none, the middle between those
// that conflict. A critically damped spring eases it. Add SWIVEL_SHIFT to the position of root or pelvis along `up`.
// Solve the group in one job with all limbs of its bodies. Flags: REACHED, or CLAMPED_FAR where no shift within drop
// and rise lets all limbs reach.
typedef struct swivel_fit {
    float drop, rise;  // the most down and up, in limb lengths of the first group WITH_PELVIS_FIT
    float half_life;   // s: in which about half of a distance is made up
    float lookahead;   // s: from when on SWIVEL_NEXT_TARGET counts. At 0 s it counts whole, before by a parabola
} swivel_fit;

static inline swivel_fit swivel_default_fit(void)
{
    const swivel_fit fit = {0.1f, 0.05f, 0.1f, 0.3f};
    return fit;
}

// How feet WITH_GROUND stand on ground that is not flat. The effector is the toe or the ball of the foot. The caller
// samples a plane for each foot at SWIVEL_PROBE. The animated foot rises and falls with the ground's distance from the
// root's level, turns with the ground's normal by SWIVEL_GROUND_WEIGHT, and keeps toe and heel over the plane. Springs
// ease that. docs/howto/hills.md has pictures. Source: our own.
typedef struct swivel_ground {
    float heel[3];  // a point of the sole in the wrist joint's frame, in the bones' unit; 0: the wrist itself
    float toe_clearance, heel_clearance;  // heights over the plane where they stand, in the bones' unit
    float cos_max;                        // cosine of the angle that the foot turns at most, 0..1
    float half_life;                      // s: in which about half of a lift or a slope is made up
} swivel_ground;

static inline swivel_ground swivel_default_ground(void)
{
    const swivel_ground ground = {{0, 0, 0}, 0, 0, 0.8f, 0.05f};
    return ground;
}

// How a PROP lies, which one hand or two hold: limbs WITH_LINK. Its position, and apart from that its rotation, is as
// SWIVEL_PROP_POSITION or SWIVEL_PROP_ROTATION says; or else its joint's, as posed and shifted with the body; or else
// as the hands have it in the incoming pose, by SWIVEL_HAND_BLEND. Then it moves, no further than it must and max_move
// allows, so that all hands reach their grips. Flags: REACHED; CLAMPED_FAR where a hand cannot reach; CLAMPED_NEAR
// where a grip is too near to a shoulder. Source: our own.
typedef struct swivel_prop {
    int32_t joint;   // of the skeleton, which no limb may turn; -1: none
    float max_move;  // in limb lengths of the first limb that is linked to it; 0: it stays, as a ladder does
} swivel_prop;

static inline swivel_prop swivel_default_prop(void)
{
    const swivel_prop prop = {-1, 1};
    return prop;
}

enum { SWIVEL_MAX_LOOK_JOINTS = 8 };  // of a look

// How a LOOK turns a chain of joints, such as spine, neck and head, so that a line of sight in the last one meets
// SWIVEL_LOOK_TARGET. From the first to the last, each joint turns by its share of what is left, within its cone about
// its incoming rotation. The turn fades out as the target goes behind or comes too near, and changes by at most `rate`.
// Each joint lies below the one before. Looks come after a body's shift and before its props and limbs, in the order of
// their groups; what hangs below a look belongs in the same job. Flags: REACHED within 1e-4 rad, LIMITED_LOOK,
// LIMITED_STEP and FADED. docs/howto/look.md has pictures. Source: our own.
typedef struct swivel_look {
    uint32_t joint_count;                     // 1 to 8
    uint32_t joints[SWIVEL_MAX_LOOK_JOINTS];  // of the skeleton, from the first to the last
    float share[SWIVEL_MAX_LOOK_JOINTS];      // of the turn, of any sum: 0 or more, the last one's more than 0
    float cos_max[SWIVEL_MAX_LOOK_JOINTS];    // cosine of the angle that each joint turns at most, -1..1
    float eye[3];                             // where the line of sight starts, in the last joint's frame, in its unit
    float axis[3];                            // where it points, in the last joint's frame, of any length but 0
    // The turn fades between these cosines of the target's angle to the incoming line of sight: cos_full > cos_none.
    float cos_full, cos_none;
    float fade_distance;  // it also fades nearer than this, in the last joint's unit, 0 to 1e15
    float rate;           // radians a second; 0: turns are not eased
} swivel_look;

// No joints yet: shares of 1, cones of 46 degrees, a line along the last joint's z axis. It fades from 96 to 154
// degrees and nearer than 0.05, and turns by 6 radians a second.
static inline swivel_look swivel_default_look(void)
{
    swivel_look look;
    int n;
    memset(&look, 0, sizeof look);
    for (n = 0; n < SWIVEL_MAX_LOOK_JOINTS; ++n) look.share[n] = 1, look.cos_max[n] = 0.7f;
    look.axis[2] = 1;
    look.cos_full = -0.1f, look.cos_none = -0.9f;
    look.fade_distance = 0.05f;
    look.rate = 6;
    return look;
}

// REACH REGIONS: where the upper arm may point. A region is a union of parts, each an intersection of half-spaces;
// forbidden cones are cut out of all parts. Directions are in the arm frame at rest: see swivel_arm_axis(). An empty
// region allows nothing; add to it and forbid in any order. A call that fails leaves the region as it was. Any thread.
enum { SWIVEL_MAX_HALF_SPACES = 64, SWIVEL_MAX_REGION_PARTS = 24 };

// The directions whose scalar product with the axis is at least the cosine.
typedef struct swivel_half_space {
    float axis[3];     // unit
    float cosine;      // -1..1
    uint32_t is_edge;  // 0: its boundary lies within the region or outside, so it bounds nothing; else 1
} swivel_half_space;

typedef struct swivel_region {
    size_t size;                                  // sizeof(swivel_region), set by swivel_default_region()
    uint32_t cut_count;                           // the first half-spaces, which hold for all parts
    uint32_t part_count;                          // part n is half_space[first[n]] to half_space[first[n + 1] - 1]
    uint32_t first[SWIVEL_MAX_REGION_PARTS + 1];  // first[0] is cut_count
    swivel_half_space half_space[SWIVEL_MAX_HALF_SPACES];
} swivel_region;

static inline swivel_region swivel_default_region(void)
{
    swivel_region region;
    memset(&region, 0, sizeof region);
    region.size = sizeof region;
    return region;
}

// Limbs that share features and a binding, such as the left arms of one skeleton.
typedef struct swivel_group_def {
    size_t size;               // sizeof(swivel_group_def), set by swivel_default_group_def()
    swivel_features features;  // 0: all is in the arm frame
    uint32_t limb_count;       // 1 or more; in a crowd of bodies 0 or its body_count
    swivel_on_bad_input on_bad_input;
    swivel_euler_order shoulder_order, wrist_order;  // of SWIVEL_SHOULDER_BOX and SWIVEL_WRIST_BOX
    swivel_binding binding;                          // JOINTS: every limb uses it, and starts with its lengths
    const swivel_limb_joints* joints;  // bodies: which joints the limb has; null in crowds of free limbs; copied
    swivel_plant plant;                // WITH_PLANT
    swivel_fit fit;                    // FIT
    swivel_ground ground;              // WITH_GROUND
    swivel_prop prop;                  // PROP
    // WITH_LINK: the group that this one holds at SWIVEL_GRIP, instead of a target and hand of its own. It is a PROP,
    // or an earlier group, whose hand or foot is then where the same solve puts it. Solve both in one job.
    uint32_t link;                // UINT32_MAX: none
    swivel_look look;             // LOOK
    const swivel_region* region;  // WITH_REGION: where the upper arm may point, not nothing; copied. Null without it
} swivel_group_def;

// Plain limbs in the arm frame.
static inline swivel_group_def swivel_default_group_def(uint32_t limb_count)
{
    swivel_group_def group;
    memset(&group, 0, sizeof group);
    group.size = sizeof group;
    group.limb_count = limb_count;
    group.binding = swivel_default_binding();
    group.plant = swivel_default_plant();
    group.fit = swivel_default_fit();
    group.ground = swivel_default_ground();
    group.prop = swivel_default_prop();
    group.link = UINT32_MAX;
    group.look = swivel_default_look();
    return group;
}

// The limb of each body that has these joints, which must live until the crowd is made. With bad input it keeps its
// incoming pose.
static inline swivel_group_def swivel_default_body_group_def(const swivel_limb_joints* joints)
{
    swivel_group_def group = swivel_default_group_def(0);
    group.joints = joints;
    group.on_bad_input = SWIVEL_KEEP_POSE;
    return group;
}

// The shift of each body, which its limbs WITH_PELVIS_FIT ask for.
static inline swivel_group_def swivel_default_fit_group_def(void)
{
    swivel_group_def group = swivel_default_body_group_def(NULL);
    group.features = SWIVEL_FIT;
    return group;
}

// A thing that hands of each body hold.
static inline swivel_group_def swivel_default_prop_group_def(void)
{
    swivel_group_def group = swivel_default_body_group_def(NULL);
    group.features = SWIVEL_PROP;
    return group;
}

// A chain of joints of each body that looks. Name its joints in `look`.
static inline swivel_group_def swivel_default_look_group_def(void)
{
    swivel_group_def group = swivel_default_body_group_def(NULL);
    group.features = SWIVEL_LOOK;
    return group;
}

typedef struct swivel_crowd_def {
    size_t size;                     // sizeof(swivel_crowd_def), set by swivel_default_crowd_def()
    uint32_t group_count;            // 1 or more
    uint32_t workspace_count;        // how many workspaces it has, 0 to 64: see swivel_workspace_bytes()
    const swivel_group_def* groups;  // group_count of them, as far apart as the first one's size; copied
    // Memory comes from the first of these that is set: `memory`, the caller's own, aligned to 64 bytes and
    // swivel_crowd_bytes() long, which outlives the crowd; `allocate`, which aligns to 64 bytes; or the C library.
    void* memory;
    size_t memory_bytes;
    void* (*allocate)(size_t bytes, size_t alignment, void* user);
    void (*release)(void* memory, size_t bytes, void* user);
    void* user;
    const swivel_skeleton* skeleton;  // of all bodies; copied. Null: the crowd is of free limbs
    uint32_t body_count;              // with a skeleton 1 or more, else 0
    float up[3];                      // bodies: the axis of heights and shifts in the root's frame, of any length but 0
} swivel_crowd_def;

typedef struct swivel_crowd swivel_crowd;

// A group's memory. A block is 16 limbs; a row is one number of each of them: 16 floats, 64 bytes, aligned to 64. Row r
// of limb i is base[((i / 16) * row_count + r) * 16 + i % 16], on every CPU. Rows lie in the order of swivel_field, and
// lanes past the group's end are padding.
typedef struct swivel_rows {
    float* base;           // borrowed from the crowd, valid until it is destroyed
    uint32_t block_count;  // of the group
    uint32_t row_count;
} swivel_rows;

// The version the library was built as: compare with SWIVEL_VERSION. Any thread.
SWIVEL_API uint32_t swivel_version(void);
// Says what a status means, in a few words. Any thread.
SWIVEL_API const char* swivel_status_text(swivel_status status);
// One line on the calling thread's last failed call: what, where, what to do. Empty before any failure.
SWIVEL_API const char* swivel_last_error(void);

// One group must still be given; one workspace; the C library's memory.
static inline swivel_crowd_def swivel_default_crowd_def(void)
{
    const swivel_crowd_def def = {sizeof(swivel_crowd_def), 0, 1, NULL, NULL, 0, NULL, NULL, NULL, NULL, 0, {0, 1, 0}};
    return def;
}
// Bytes of memory a crowd of this def takes, in one piece; 0 if the def is invalid.
SWIVEL_API size_t swivel_crowd_bytes(const swivel_crowd_def* def);
// Makes a crowd; *crowd is null on failure. It allocates once, and later calls allocate nothing, but oneTBB may.
// Targets, shoulder positions, bodies' poles and unbound bone lengths start as NaN: a limb that never gets them is
// SWIVEL_BAD_INPUT. Other poles start as (0, -1, 0). All else starts neutral: no turn, weights 1, limits wide open.
// Results start as the rest pose, without flags.
SWIVEL_API swivel_status swivel_crowd_create(const swivel_crowd_def* def, swivel_crowd** crowd);
// Frees what create allocated. Null is allowed.
SWIVEL_API void swivel_crowd_destroy(swivel_crowd* crowd);

// Binds a limb: the alignments from its rest pose, and its two bone lengths. A skeleton of its three joints alone will
// do. Fails for joints that do not exist or are no limb, parents in a circle, bad quaternions, bones of no length, a
// bend along the upper arm or one that turns the forearm about itself, no bend for a rest pose bent by 10 degrees or
// less, and twist bones that are not in order. Any thread.
SWIVEL_API swivel_status swivel_bind_joints(const swivel_skeleton* skeleton, const swivel_limb_joints* joints,
                                            swivel_binding* binding);

// The crowd's shape. Masks count limbs through the whole crowd, padding lanes included: limb n of a group has the
// number swivel_group_first_limb() + n, and each group starts a block. In a crowd of bodies they count bodies: limb i
// of every group is body i's. For null crowds and groups that do not exist all are 0. Any thread.
SWIVEL_API uint32_t swivel_group_count(const swivel_crowd* crowd);
SWIVEL_API uint32_t swivel_block_count(const swivel_crowd* crowd);
SWIVEL_API uint32_t swivel_group_first_limb(const swivel_crowd* crowd, uint32_t group);
SWIVEL_API uint32_t swivel_group_limb_count(const swivel_crowd* crowd, uint32_t group);
SWIVEL_API swivel_features swivel_group_features(const swivel_crowd* crowd, uint32_t group);
// The first row of a field within each block of a group, and its number of rows, one for each number of a value. Both
// are 0 if the group lacks the field.
SWIVEL_API uint32_t swivel_field_first_row(const swivel_crowd* crowd, uint32_t group, swivel_field field);
SWIVEL_API uint32_t swivel_field_row_count(const swivel_crowd* crowd, uint32_t group, swivel_field field);

// Direct access to a group's rows: the fast way in and out. Padding lanes of inputs may hold anything; those of results
// mean nothing.
SWIVEL_API swivel_rows swivel_input_rows(swivel_crowd* crowd, uint32_t group);
SWIVEL_API swivel_rows swivel_result_rows(swivel_crowd* crowd, uint32_t group);

// Copies a field of limb_count limbs of a group from, or to, the caller's strided data: consecutive floats for each
// limb, a uint32_t for SWIVEL_FLAGS. `first` counts within the group. swivel_write() takes inputs and carried fields;
// swivel_read() takes any. The data may not overlap the crowd's own memory.
SWIVEL_API swivel_status swivel_write(swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                                      uint32_t limb_count, swivel_in values);
SWIVEL_API swivel_status swivel_read(const swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                                     uint32_t limb_count, swivel_out values);

// swivel_write() of positions far from the origin: 3 doubles for each limb, from which an origin, 3 doubles, is
// subtracted before they are rounded to floats. Give all positions of a limb from one origin near it, such as the
// character's position. origins: stride 0 is one for all; null data subtracts nothing; null for directions.
SWIVEL_API swivel_status swivel_write_doubles(swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                                              uint32_t limb_count, swivel_in values, swivel_in origins);

// One field in the caller's own array: the first limb's value is at `data`, each next one `stride` bytes further.
typedef struct swivel_stream {
    swivel_field field;
    void* data;     // inputs are only read; null: as if the field were not listed
    size_t stride;  // bytes; for an input 0 is one value for the group, otherwise at least the value's size
} swivel_stream;

// The kind of a caller's numbers.
typedef enum swivel_numbers {
    SWIVEL_NUMBERS_UNSPECIFIED,  // nothing is checked
    SWIVEL_FLOATS,
    SWIVEL_DOUBLES
} swivel_numbers;

// One group's values as engines keep them. An input that is not listed keeps its rows; a result that is not listed is
// not written. A field may be listed once.
typedef struct swivel_streams {
    size_t size;  // sizeof(swivel_streams), set by swivel_default_streams()
    const swivel_stream* fields;
    uint32_t field_count;
    uint32_t positions;  // a swivel_numbers: a solve fails where the listed positions would be read as the other kind
    // Null data: positions are floats. With data, all positions listed are 3 doubles, and this origin is subtracted as
    // by swivel_write_doubles(). Poles that are directions or normals are 3 doubles, too, but nothing is subtracted.
    // Positions in rows that are not listed must be from the same origin. Stride 0: one origin for the whole group.
    swivel_in origin;
} swivel_streams;

// Nothing in and nothing out.
static inline swivel_streams swivel_default_streams(void)
{
    swivel_streams streams;
    memset(&streams, 0, sizeof streams);
    streams.size = sizeof streams;
    return streams;
}

// The form of a pose's rotations.
typedef enum swivel_pose_form {
    SWIVEL_ROTATIONS,        // x, y, z, w; translations and scales lie apart
    SWIVEL_MATRIX_ROWS,      // 3 x 4 or 4 x 4 floats, row after row; a fourth row is not touched
    SWIVEL_MATRIX_COLUMNS,   // 4 x 4 floats, column after column; the last row is not touched
    SWIVEL_MATRIX_COLUMNS3,  // 3 x 4 floats, column after column
} swivel_pose_form;

// The space that the joints of a pose are in.
typedef enum swivel_pose_space {
    SWIVEL_LOCAL,    // each to its parent
    SWIVEL_IN_BODY,  // all to the root. Then all joints below a limb's move with it, and are read and written, too
} swivel_pose_space;

// Values of joints in the caller's own array. That of joint j of body i is at data + i * body_stride + o, where o is
// offsets[j], or j * joint_stride where offsets is null. Strides and offsets are in bytes; any alignment.
typedef struct swivel_joint_values {
    void* data;                        // null: none
    size_t body_stride, joint_stride;  // 0 of inputs: one value for all
    const size_t* offsets;             // one for each joint of the skeleton
} swivel_joint_values;

// The bodies' poses, as an engine keeps them. A job with a pose finds by forward kinematics where limbs are and how
// long their bones are, solves them, and writes the rotations that it changed: of shoulders, elbows, WITH_HAND of
// wrists, and of clavicles, twist bones and looks. Targets, poles and hands are in the world. docs/howto/bodies.md has
// more.
//
// - A joint turns by what carries the incoming bone to the solved one. So a goal at the incoming wrist with
//   POLE_INCOMING gives the incoming pose back; so do weights of 0, to the bit where the group has no limit, cap, soft
//   reach or step.
// - SHOULDER, ELBOW and WRIST in rows are the arm's, as without JOINTS; limits bound these, not the joints.
// - Rotations that are not finite, positions beyond 1e15, and scales or matrices that are mirrored, not uniform or
//   slanted by more than 1e-3 are bad input of all limbs at or below that joint.
// - A body's inputs are read before its results are written, so a pose may be solved in place. A body's results may not
//   overlap another body's inputs.
typedef struct swivel_pose {
    size_t size;  // sizeof(swivel_pose), set by swivel_default_pose()
    swivel_pose_form form;
    // Not 0: root positions are doubles, and so are the positions in the job's streams. The root is subtracted in
    // double, and positions in rows are relative to the root.
    uint32_t root_is_double;
    swivel_joint_values rotations;     // or matrices, as form says; must be given
    swivel_joint_values translations;  // 3 floats: in the parent's frame or in the body's space; none: as at rest
    swivel_joint_values scales;        // 3 floats, to the parent's or in the body's space; none: 1
    // where the joints that are written go, in the same form; none: back to rotations
    swivel_joint_values results;
    // The root of each body, which joints with parent -1 hang below. Null data: at the origin, not turned, scale 1.
    swivel_in root_position;  // 3 floats in the world, or doubles
    swivel_in root_rotation;  // x, y, z, w
    swivel_in root_scale;     // 1 float
    swivel_pose_space space;
    uint32_t reserved;  // 0
    // SWIVEL_IN_BODY with translations: where those of moved joints go; none: back to translations. Give it if results
    // are given.
    swivel_joint_values translation_results;
    // If given, where the joints that some group needs are after the solve, from the root: x, y, z, w, and 3 floats.
    // Bad values of the pose are NaN.
    swivel_joint_values joint_rotations, joint_positions;
    // Seconds since each body's last solve, 1 float, 0..1e15. Groups WITH_PLANT, FIT, or LOOK with a rate need it, and
    // WITH_MAX_SWIVEL goes by it where it is given.
    swivel_in time;
    // Planted points stand on this: a platform, or the ground near the body. Null: the world's origin, not turned. To
    // change it without a jump: swivel_change_support().
    swivel_in support_position;  // 3 floats in the world, or doubles as the root's
    swivel_in support_rotation;  // x, y, z, w
    // How much of all that turns a body's joints counts, 1 float, a share; null: 1. At 0 joints keep their incoming
    // bits while what is carried goes on, so a body comes and goes without a jump. Rows of limbs, props and shifts are
    // those of a weight of 1; a look's SWIVEL_SIGHT and REACHED are of this weight.
    swivel_in weight;
} swivel_pose;

// Rotations must still be given.
static inline swivel_pose swivel_default_pose(void)
{
    swivel_pose pose;
    memset(&pose, 0, sizeof pose);
    pose.size = sizeof pose;
    return pose;
}

// Some of a crowd's blocks.
typedef struct swivel_blocks {
    uint32_t first, count;
} swivel_blocks;

// Feet of one group that want to know the ground. Arrays have `count` entries, one for each foot. Positions are in the
// space of the rows: in the world, or from the root where that is in doubles.
typedef struct swivel_probes {
    uint32_t group, count;
    const uint32_t* bodies;
    const float (*places)[3];  // where to sample, as SWIVEL_PROBE; of bad input the last one that was good
    float (*grounds)[3];       // to store: SWIVEL_GROUND; it holds the present value. NaN: there is none
    float (*normals)[3];       // to store: SWIVEL_GROUND_NORMAL; it holds the present value
} swivel_probes;
typedef void swivel_sample(const swivel_probes* probes, void* user);

// One call of swivel_solve(). A null choice means all limbs, a null output is not written. A job of null pointers
// solves every limb.
typedef struct swivel_job {
    size_t size;  // sizeof(swivel_job), set by swivel_default_job()

    const swivel_blocks* blocks;  // which blocks. Others, and streams of groups outside, are neither read nor written
    // Which groups, by bits: group g is bit g % 32 of groups[g / 32]. group_word_count is (group count + 31) / 32.
    const uint32_t* groups;
    uint32_t group_word_count;

    // Which limbs, by bits: limb number i is bit i % 32 of mask[i / 32]; see swivel_group_first_limb(). Bits of padding
    // lanes are ignored. mask_word_count is (swivel_block_count() + 1) / 2. Chosen limbs get the same results as in a
    // solve of all; others keep theirs. swivel_choose() makes a mask of the most urgent blocks.
    const uint32_t* mask;
    uint32_t mask_word_count;

    // The caller's own arrays: swivel_streams of each group that is named, in the crowd's order, as far apart as the
    // first one's size. Null: values are in the crowd's rows.
    const swivel_streams* streams;

    // Not 0: solves on the calling thread, never allocates and never uses oneTBB; several threads may do so at once, on
    // blocks that do not overlap. 0: on the calling thread's oneTBB arena, if there is enough to do.
    int on_this_thread;

    uint32_t* solved_count;  // unless null, becomes how many limbs, or bodies, were solved

    // swivel_workspace_bytes() of memory for this call alone, aligned to 64. Null: one of the crowd's workspaces. Two
    // calls that share one spoil each other's results, which no build can see.
    void* workspace;

    const swivel_pose* pose;  // where the bodies' poses are; null in crowds of free limbs

    // Groups WITH_GROUND. Unless null, it is called on the solving threads, by several at a time, with up to 128 feet
    // of one group. It stores their ground. It may not throw, call this crowd, or wait for oneTBB's tasks unless it
    // isolates them. Null: the ground is as written, such as that below the last solve's SWIVEL_PROBE.
    swivel_sample* sample;
    void* sample_user;
} swivel_job;

// Every limb, from and to rows.
static inline swivel_job swivel_default_job(void)
{
    swivel_job job;
    memset(&job, 0, sizeof job);
    job.size = sizeof job;
    return job;
}

// Bytes of a workspace, the memory beside its rows that a solve works in: up to 64 KiB; of bodies up to 192 KiB, or 1.4
// KiB for each joint that is needed if that is more. A multiple of 64, the same for every instruction set; 0 if the
// crowd needs none. Each call of swivel_solve() that runs at the same time needs one: job.workspace, or a free one of
// the crowd's. Any thread.
SWIVEL_API size_t swivel_workspace_bytes(const swivel_crowd* crowd);

// Solves limbs; job may be null, for every limb from and to rows. Fails if no workspace is free.
//
// With streams, one pass replaces swivel_write() of every input given, the solve, and swivel_read() of every result
// given, with the same bits. A limb's inputs are read before its results are written, so its results may overlap its
// own inputs; they may not overlap another limb's inputs, other results or the crowd's memory. For arms of characters
// kept as structures, with SWIVEL_JOINTS, in a crowd of one group:
//     const size_t stride = sizeof characters[0];
//     const swivel_stream fields[] = {
//         {SWIVEL_TARGET, &characters[0].grip, stride},
//         {SWIVEL_POLE, &characters[0].elbow_hint, stride},
//         {SWIVEL_SHOULDER, &characters[0].joints[UPPER_ARM].rotation, stride},
//         {SWIVEL_ELBOW, &characters[0].joints[FOREARM].rotation, stride},
//     };
//     swivel_streams arms = swivel_default_streams();
//     arms.fields = fields, arms.field_count = 4;
//     swivel_job job = swivel_default_job();
//     job.streams = &arms;
//     status = swivel_solve(crowd, &job);
//
// A block of which some limbs are chosen takes about its usual time, and others take none: keep limbs that are solved
// together side by side.
SWIVEL_API swivel_status swivel_solve(swivel_crowd* crowd, const swivel_job* job);

// Chooses whole blocks by urgency, at most max_blocks of them, because one limb costs about as much as its block. Each
// call adds the largest priority among a block's limbs to the block's urgency, picks the most urgent blocks, of equals
// the lower index, and sets their urgency to 0. So a block is picked about as often as its priority says. A block whose
// priorities are all 0 is not picked.
//
// priorities: one entry for each group, in the crowd's order, or one alone for bodies; one float for each limb, in any
//   unit. Stride 0: one priority for the whole group. Values count as 0..1e15, NaN as 0.
// urgency: a float for each block, the caller's, 0 at first, kept from call to call. Null: priorities alone decide.
// mask: gets the bits of the picked blocks' limbs, and 0 elsewhere, for a job. mask_word_count is
//   (swivel_block_count() + 1) / 2.
// chosen_count: unless null, becomes how many limbs these are.
SWIVEL_API swivel_status swivel_choose(swivel_crowd* crowd, const swivel_in* priorities, float* urgency,
                                       uint32_t max_blocks, uint32_t* mask, uint32_t mask_word_count,
                                       uint32_t* chosen_count);

// Clears the carried fields of these limbs, so that they start anew: call it after a teleport, and where a body's place
// in the crowd is used anew.
SWIVEL_API swivel_status swivel_reset(swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count);

enum { SWIVEL_EXPLANATION_BYTES = 8192 };  // as many hold every text of swivel_explain() and swivel_compare()
#define SWIVEL_EVERY_GROUP UINT32_MAX      // for swivel_explain(): all groups of a body

// Explains a limb's state in a sentence or two, from its present inputs: the input that is bad, how far out of reach
// the target is, the limit that turned the elbow, why a point stands or slides. It warns of another unit, another
// origin, a time in milliseconds or a pose that is solved twice. With SWIVEL_EVERY_GROUP it explains all groups of body
// `limb`, each in a line that begins "group 0: ". Body groups that are limbs need WITH_RECORD. text gets at most size
// bytes, its 0 among them; a text that was cut ends in three dots. The words may change, and the last digits differ
// between C libraries. limb counts within the group. Takes up to a millisecond for a limb.
SWIVEL_API swivel_status swivel_explain(const swivel_crowd* crowd, uint32_t group, uint32_t limb, char* text,
                                        size_t size);

// Compares a pose, as a job has it, with where your engine has a limb of one body, and says which input disagrees: the
// order of quaternions, the form or the space, another joint, a unit, an axis, the root. Call it for each limb when you
// bind a skeleton. shoulder, elbow, wrist: positions in the world, 3 doubles each, of the pose as it goes in. agrees:
// unless null, becomes 1 where all are within 1e-3 of the limb's length, and time, bend and the skeleton's unit look
// right; else 0. text: as swivel_explain()'s. Takes up to a tenth of a millisecond.
SWIVEL_API swivel_status swivel_compare(const swivel_crowd* crowd, uint32_t group, uint32_t body,
                                        const swivel_pose* pose, const double shoulder[3], const double elbow[3],
                                        const double wrist[3], char* text, size_t size, int* agrees);

// An arc of swivels: cosine and sine of its ends, counter-clockwise about the line from shoulder to wrist. Angle 0 is
// the wish, as far as SWIVEL_MAX_SWIVEL allows it. The whole circle is one arc with equal ends.
typedef struct swivel_arc {
    float from[2], to[2];
} swivel_arc;

// The swivels that a limb's limits allow for its present inputs, in their order around the circle. At most capacity of
// them are stored; *arc_count says how many there are, 0 for bad input. Body groups need WITH_RECORD.
SWIVEL_API swivel_status swivel_allowed_arcs(const swivel_crowd* crowd, uint32_t group, uint32_t limb, swivel_arc* arcs,
                                             uint32_t capacity, uint32_t* arc_count);

// The joint angles of the results, for people and files: 7 doubles a limb, in radians about the rest pose and the arm
// frame's axes. Three of the shoulder in its order, the flexion, three of the wrist, which are 0 without WITH_HAND.
// Family 0 has middle angles within -pi/2..pi/2, family 1 is the other triple. In gimbal lock the last angle is 0.
SWIVEL_API swivel_status swivel_joint_angles(const swivel_crowd* crowd, uint32_t group, uint32_t first,
                                             uint32_t limb_count, swivel_euler_order shoulder_order,
                                             swivel_euler_order wrist_order, int family, swivel_out angles);

// Values of fields from angles in radians. Any thread. All but swivel_cos_sin() fail for values that are not finite or
// out of range, and then leave their outputs as they were.
//
// The range from min to max, no wider than 2 pi: a twist's, or one of the three of a box.
SWIVEL_API swivel_status swivel_range(double min, double max, float range[4]);
// An axis of any length but zero, and the largest angle to it, 0 to pi.
SWIVEL_API swivel_status swivel_cone(const double axis[3], double max, float cone[4]);
// A direction of the character in the arm frame, where the axes of limits are. parent_rotation: of the shoulder's
// parent joint in the world of the rest pose, x, y, z, w. direction: in that world, 1e-15..1e15 long. axis: becomes
// unit; may be direction itself. A cone of 80 degrees about forwards and down, for a character that faces +z with +y
// up:
//     const double down_ahead[3] = {0, -1, 1};
//     double axis[3];
//     float cone[4];
//     if (swivel_arm_axis(&binding, parent_rotation, down_ahead, axis) == SWIVEL_OK)
//         swivel_cone(axis, 80 * 3.14159265358979 / 180, cone);
SWIVEL_API swivel_status swivel_arm_axis(const swivel_binding* binding, const float parent_rotation[4],
                                         const double direction[3], double axis[3]);
// The elbow's min and max flexion, 0 <= min <= max <= pi.
SWIVEL_API swivel_status swivel_flexion(double min, double max, float flexion[2]);
// For SWIVEL_AIM: an axis of the hand, of any length but zero, and the elbow's flexion, 0 to pi.
SWIVEL_API swivel_status swivel_aim(const double axis[3], double flexion, float aim[5]);
// Cosine and sine of an angle, for SWIVEL_ANGLE and SWIVEL_MAX_SWIVEL.
SWIVEL_API void swivel_cos_sin(double angle, float pair[2]);
// The value of SWIVEL_ANGLE or of a limit for the same limb on the body's other side, for a skeleton mirrored in x:
// offsets and bends (-x, y, z), rotations (x, -y, -z, w). order: of boxes, else ignored. from and to may be the same.
// Other input fields are copied. Fails for results. Any thread.
SWIVEL_API swivel_status swivel_mirror(swivel_field field, swivel_euler_order order, const float* from, float* to);

// Reach regions: see swivel_region.
typedef struct swivel_region_cone {
    float axis[3];  // of any length but zero
    float angle;    // to the axis, at most: 0.01 to pi - 0.01
} swivel_region_cone;

// Adds cones in order, with a bridge between neighbours: what lies between both cones and outside of the two circles of
// radius (pi - both angles) / 2 that touch both. closed: not 0 to bridge the last cone and the first, too. Neighbours
// may not be opposite. A cone takes one half-space, a bridge four or eight.
SWIVEL_API swivel_status swivel_region_add_cones(swivel_region* region, const swivel_region_cone* cones, uint32_t count,
                                                 uint32_t closed);
// Adds a convex polygon of 3 corners or more, counter-clockwise as seen from outside; its sides are arcs of great
// circles. corners: x, y, z of each, of any length but zero.
SWIVEL_API swivel_status swivel_region_add_polygon(swivel_region* region, const float* corners, uint32_t count);
// Adds 1 to max_cones cones that hold all these directions, each with `margin` radians around it: what a clip does, and
// a little more. directions: x, y, z of each, of any length but zero, at least 1. margin: 0.01 to 1. max_cones: 1 to 6.
// Takes about 0.05 ms a direction.
SWIVEL_API swivel_status swivel_region_add_directions(swivel_region* region, const float* directions, uint32_t count,
                                                      float margin, uint32_t max_cones);
// Cuts a cone out of all that is there and will be added.
SWIVEL_API swivel_status swivel_region_forbid(swivel_region* region, const swivel_region_cone* cone);
// The region of the same limb on the body's other side, as swivel_mirror() has it. from and to may be the same.
SWIVEL_API swivel_status swivel_region_mirror(const swivel_region* from, swivel_region* to);
// How much room a direction of any length but zero has, as a difference of cosines: 0 or more where it is allowed.
SWIVEL_API swivel_status swivel_region_room(const swivel_region* region, const float direction[3], float* room);

// Forward kinematics of the results, in double, in the targets' space: 3 doubles for elbow and wrist, 4 for the hand's
// rotation, WITH_HAND. Outputs whose data is null are left out. Body groups need WITH_RECORD.
SWIVEL_API swivel_status swivel_forward(const swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count,
                                        swivel_out elbow, swivel_out wrist, swivel_out hand);
// How far each limb's wrist or effector is from its target, or WITH_AIM the target from the hand's ray: one double, in
// arm lengths as scaled and stretched; NaN for bad input. Body groups need WITH_RECORD.
SWIVEL_API swivel_status swivel_residuals(const swivel_crowd* crowd, uint32_t group, uint32_t first,
                                          uint32_t limb_count, swivel_out distance);

// Results in 16-bit words, about half of the rows' bytes, the same words on every CPU. blocks are counted within the
// group. Word r of lane l of the nth block becomes words[(n * rows + r) * SWIVEL_LANES + l], where rows is
// swivel_packed_row() of SWIVEL_RESULT_END; words has room for blocks.count * rows * SWIVEL_LANES.
// - A rotation takes 3 words. The largest component, the first of equals, is left out; its index is
//   word0 >> 15 | (word1 >> 15) << 1, its sign positive. The others follow in the order x, y, z, w, each
//   ((word & 32767) - 16384) / (16383 sqrt 2). Within 1.54e-4 rad.
// - ELBOW without JOINTS takes 2 words and STRETCH 1: half floats. FLAGS takes 2, the low half first. NORMAL takes
// none. docs/howto/results.md says how far wrists are off. Any thread, while nothing solves these blocks.
SWIVEL_API swivel_status swivel_pack(const swivel_crowd* crowd, uint32_t group, swivel_blocks blocks, uint16_t* words);
// The first row of words of a field of a group; if the group lacks it, the row after those before it. 0 for null crowds
// and groups that do not exist. Any thread.
SWIVEL_API uint32_t swivel_packed_row(const swivel_crowd* crowd, uint32_t group, swivel_field field);
// The rotation of three words that lie word_stride words apart, SWIVEL_LANES in rows. Any thread.
SWIVEL_API void swivel_unpack_rotation(const uint16_t* words, size_t word_stride, float xyzw[4]);
// The value of any half float, exactly. Any thread.
SWIVEL_API float swivel_unpack_half(uint16_t word);

// Changes what planted points of some bodies stand on without a jump: SWIVEL_PLANT and SWIVEL_PLANT_ROTATION move from
// one support's frame to another's. Call it between two solves, with both supports as they are now, and give the next
// pose the new support. Positions are 3 doubles, rotations x, y, z, w as floats; null: the origin, not turned.
typedef struct swivel_supports {
    swivel_in position, rotation;
} swivel_supports;
SWIVEL_API swivel_status swivel_change_support(swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count,
                                               swivel_supports from, swivel_supports to);

// A digest of all results, to compare machines by: crowds of the same groups with equal results have equal digests,
// others almost surely not. Each lane has a 64-bit hash, 0 at first, of its bits in the order of groups, blocks and
// rows, without padding: h becomes (h ^ bits) * 0x9e3779b97f4a7c15, then h ^ (h >> 32). A last hash takes those of the
// lanes, lane 0 first. 0 for a null crowd.
SWIVEL_API uint64_t swivel_digest(const swivel_crowd* crowd);

// The instruction set in use, chosen at first use: SWIVEL_FORCE_ISA of the environment, else the best that this CPU
// runs. Null, with swivel_last_error() set, if SWIVEL_FORCE_ISA names one that cannot be used. Any thread.
SWIVEL_API const char* swivel_isa_name(void);
// Selects the instruction set for the whole process, from the next solve on. Any thread.
SWIVEL_API swivel_status swivel_use_isa(const char* name);
// The built-in instruction sets, best first; null past the last.
SWIVEL_API const char* swivel_isa_at(uint32_t index);
// 1 if this CPU and operating system run it, else 0 (also for unknown names).
SWIVEL_API int swivel_isa_runs(const char* name);

#ifdef __cplusplus
}
#endif

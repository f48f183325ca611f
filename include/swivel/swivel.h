// SPDX-License-Identifier: MIT
//
// swivel: inverse kinematics of crowds. For each limb, a wrist target and an elbow pole go in, and joint rotations come
// out, the same bits on every CPU. This header has limbs, groups, streams and jobs; swivel_bodies.h has whole poses,
// feet, props and looks; swivel_regions.h where an upper arm may point; swivel_explain.h answers in words.
// examples/arms.c is a whole program, and docs/ explains every field with pictures.
//
// Conventions: right-handed axes; quaternions are Hamilton's, x, y, z, w, and a*b applies b first; lengths are in the
// caller's unit. In the arm frame the shoulder is at the origin, a straight limb at rest lies along +z, and flexion
// turns the forearm about -x, so the elbow moves towards -y. "Arm lengths" are the length of both bones together.
//
// Errors: a call that fails returns a status, leaves one line in swivel_last_error(), and changes nothing else.
//
// Threads: one crowd belongs to one thread at a time; but calls that take it const may run together, and so may jobs
// on_this_thread whose blocks do not overlap. Calls that take no crowd, or only ask for its shape, need no care. Every
// call needs at most 32 KiB of stack and leaves the caller's floating-point environment as it was.
//
// Structures that may grow begin with their size: start each from its swivel_default_ function. The library accepts the
// shorter structures of older headers.
//
// Debug builds, and builds with SWIVEL_CHECK_USE, also refuse crowds that are destroyed or used by two threads at once,
// and results that overlap each other or inputs that are not their own, if one stride is a multiple of the other.
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

typedef enum swivel_status {
    SWIVEL_OK = 0,
    SWIVEL_INVALID_ARGUMENT = 1,  // an argument breaks its contract
    SWIVEL_OUT_OF_MEMORY = 2,     // the allocator returned null, or the caller's memory is too small
    SWIVEL_UNKNOWN_ISA = 3,       // no instruction set of that name was built in
    SWIVEL_ISA_UNAVAILABLE = 4,   // it was built in, but this CPU or operating system cannot run it
} swivel_status;

// The version the library was built as: SWIVEL_VERSION.
SWIVEL_API uint32_t swivel_version(void);
// A status in a few words.
SWIVEL_API const char* swivel_status_text(swivel_status status);
// One line on the calling thread's last failed call: what, where, what to do. Later calls that succeed keep it. Empty
// before any failure.
SWIVEL_API const char* swivel_last_error(void);

// The flag word of a limb. A hard pose is a result with flags, not an error.
typedef enum swivel_flag {
    SWIVEL_REACHED = 1u << 0,                // the wrist, effector, prop or line of sight is at its goal
    SWIVEL_SOFTENED = 1u << 1,               // in a soft zone of the reach, so the wrist is not quite at the target
    SWIVEL_STRETCHED = 1u << 2,              // SWIVEL_STRETCH is above 1
    SWIVEL_CLAMPED_FAR = 1u << 3,            // the target is too far
    SWIVEL_CLAMPED_NEAR = 1u << 4,           // the target is too near
    SWIVEL_SWIVEL_UNDEFINED = 1u << 5,       // the pole is undefined, so the previous, incoming or rest swivel serves
    SWIVEL_LIMITED_FLEXION = 1u << 6,        // the flexion limit keeps the wrist from the target
    SWIVEL_LIMITED_SHOULDER_CONE = 1u << 7,  // this limit forbids the swivel that was wished for; so do those below
    SWIVEL_LIMITED_HUMERAL_TWIST = 1u << 8,
    SWIVEL_LIMITED_SHOULDER_BOX = 1u << 9,
    SWIVEL_LIMITED_HAND_CONE = 1u << 10,
    SWIVEL_LIMITED_FOREARM_TWIST = 1u << 11,
    SWIVEL_LIMITED_HAND_TWIST = 1u << 12,
    SWIVEL_LIMITED_WRIST_BOX = 1u << 13,
    SWIVEL_LIMITED_STEP = 1u << 14,    // SWIVEL_MAX_SWIVEL forbids the swivel that was wished for
    SWIVEL_INFEASIBLE = 1u << 15,      // no swivel keeps all limits; this one violates them least
    SWIVEL_JUMPED = 1u << 16,          // joint limits turned the swivel further than SWIVEL_MAX_SWIVEL
    SWIVEL_PLANTED = 1u << 17,         // the point is locked, though stop_time may still run
    SWIVEL_RELEASED = 1u << 18,        // this solve released it
    SWIVEL_BROKE_AWAY = 1u << 19,      // released by distance
    SWIVEL_CUT = 1u << 20,             // too fast to be eased, so the point jumps
    SWIVEL_LIMITED_REGION = 1u << 21,  // the upper arm's region forbids the swivel that was wished for
    SWIVEL_LIMITED_LOOK = 1u << 22,    // a cone holds a joint of a look
    SWIVEL_FADED = 1u << 23,           // a look's target is behind or too near
    SWIVEL_BAD_INPUT = 1u << 30,       // an input is not valid or was never given
} swivel_flag;

// In a crowd of bodies, limb i of each group belongs to body i.
typedef enum swivel_kind {
    SWIVEL_KIND_LIMB,  // free limbs: swivel_limb_def. Definitions of the others are in swivel_bodies.h
    SWIVEL_KIND_BODY_LIMB,
    SWIVEL_KIND_LOOK,
    SWIVEL_KIND_PROP,
    SWIVEL_KIND_SHIFT,
} swivel_kind;

// The features of a group of limbs, fixed at creation. A feature that is off costs neither memory nor time.
// SWIVEL_WITH_F mostly adds the field F. swivel_describe_feature() lists what each needs and excludes. A body's limb is
// in the world and has an incoming pose without asking.
typedef uint64_t swivel_features;
#define SWIVEL_WORLD (UINT64_C(1) << 0)          // targets, poles and hands are in the world; limbs have parents
#define SWIVEL_JOINTS (UINT64_C(1) << 1)         // results are local rotations of the skeleton's joints
#define SWIVEL_WITH_HAND (UINT64_C(1) << 2)      // a wanted hand rotation goes in, a wrist rotation comes out
#define SWIVEL_WITH_EFFECTOR (UINT64_C(1) << 3)  // the target is for a point of the hand
#define SWIVEL_WITH_AIM (UINT64_C(1) << 4)       // the flexion is given, and the hand points at the target
#define SWIVEL_WITH_INCOMING (UINT64_C(1) << 5)  // the pose so far goes in: three fields
#define SWIVEL_WITH_WEIGHTS (UINT64_C(1) << 6)
#define SWIVEL_POLE_DIRECTION (UINT64_C(1) << 7)  // poles are directions, not points
#define SWIVEL_POLE_NORMAL (UINT64_C(1) << 8)     // poles are normals of the swivel plane
#define SWIVEL_POLE_INCOMING (UINT64_C(1) << 9)   // no poles: the incoming pose says where elbows go
#define SWIVEL_POLE_HAND (UINT64_C(1) << 10)      // no poles: elbows lie as if the wanted hands were not bent
#define SWIVEL_WITH_ANGLE (UINT64_C(1) << 11)     // adds an angle to the pole's swivel
#define SWIVEL_WITH_REACH (UINT64_C(1) << 12)
#define SWIVEL_WITH_CAP (UINT64_C(1) << 13)
#define SWIVEL_WITH_CLAVICLE (UINT64_C(1) << 14)  // the shoulder's parent joint shares the reach
#define SWIVEL_HAND_YIELDS (UINT64_C(1) << 15)    // the hand turns where the wrist misses: a heel lifts for the toe
#define SWIVEL_WITH_MAX_SWIVEL (UINT64_C(1) << 16)
#define SWIVEL_STEP_WINS (UINT64_C(1) << 17)  // SWIVEL_MAX_SWIVEL comes before limits, so no elbow pops
#define SWIVEL_WITH_FLEXION_LIMIT (UINT64_C(1) << 18)
#define SWIVEL_WITH_SHOULDER_CONE (UINT64_C(1) << 19)
#define SWIVEL_WITH_HUMERAL_TWIST (UINT64_C(1) << 20)
#define SWIVEL_WITH_SHOULDER_BOX (UINT64_C(1) << 21)
#define SWIVEL_WITH_HAND_CONE (UINT64_C(1) << 22)
#define SWIVEL_WITH_FOREARM_TWIST (UINT64_C(1) << 23)
#define SWIVEL_WITH_HAND_TWIST (UINT64_C(1) << 24)
#define SWIVEL_WITH_WRIST_BOX (UINT64_C(1) << 25)
#define SWIVEL_WITH_REGION (UINT64_C(1) << 26)          // the upper arm stays in a region: swivel_regions.h
#define SWIVEL_WITH_PLANT (UINT64_C(1) << 27)           // a point of the hand or foot stands where it touches
#define SWIVEL_WITH_PLANT_ROTATION (UINT64_C(1) << 28)  // the planted hand or foot keeps its rotation, too
#define SWIVEL_PLANT_BY_MOTION (UINT64_C(1) << 29)      // no labels: the point's speed and height show its contact
#define SWIVEL_WITH_GROUND (UINT64_C(1) << 30)          // the planted foot stands on uneven ground
#define SWIVEL_WITH_PELVIS_FIT (UINT64_C(1) << 31)      // the body shifts so that this limb reaches
#define SWIVEL_WITH_NEXT_TARGET (UINT64_C(1) << 32)     // the shift also prepares for where the limb goes next
#define SWIVEL_WITH_LINK (UINT64_C(1) << 33)            // the goal is a grip on another limb's hand, or on a prop
#define SWIVEL_WITH_HAND_TRANSFORM (UINT64_C(1) << 34)  // where the hand or foot is after a solve
#define SWIVEL_WITH_RECORD (UINT64_C(1) << 35)          // keeps what the pose gave, for explanations
#define SWIVEL_POLE_HALF_LINE (UINT64_C(1) << 36)       // no poles: elbows follow wrists, but for a jump at pole_behind

// The inputs and results of a limb: how many floats, and what they are. docs/fields.md has ranges and formulas. A share
// is 0..1; a range is four numbers, which swivel_range() makes.
//
// - A limb with a value that is not valid gets SWIVEL_BAD_INPUT, and no other limb changes by a bit.
// - Positions and hands are in the arm frame, or with WORLD in the world.
// - Limits are measured from the rest pose with the elbow straight; their axes are in the arm frame. The wrist comes
//   before limits, limits before SWIVEL_MAX_SWIVEL.
// - Results: unit quaternions with w >= 0, or WITH_INCOMING with the incoming one's sign. Equal inputs give equal bits
//   on every CPU, with any number of threads and any choice of blocks.
typedef enum swivel_field {
    SWIVEL_TARGET = 0,         // 3: where the wrist goes
    SWIVEL_POLE,               // 3: where the elbow points, as a point, direction or normal
    SWIVEL_LENGTHS,            // 2: upper arm and forearm, before the parent's scale
    SWIVEL_SHOULDER_POSITION,  // 3, WORLD
    SWIVEL_PARENT_ROTATION,    // 4, WORLD: the shoulder's parent joint's
    SWIVEL_PARENT_SCALE,       // 1, WORLD
    SWIVEL_HAND,               // 4: the hand's rotation; JOINTS: the wrist joint's. Bodies without AIM: NaN is incoming
    SWIVEL_EFFECTOR,           // 3: a point in the frame of that, in the bones' unit
    SWIVEL_ANGLE,              // 2: cosine and sine of a turn about the line from shoulder to wrist
    SWIVEL_INCOMING_SHOULDER,  // 4, WITH_INCOMING: the pose so far, as the results are; so the next two
    SWIVEL_INCOMING_ELBOW,
    SWIVEL_INCOMING_WRIST,
    SWIVEL_WEIGHTS,            // 3: shares of position, hand and pole; 0 keeps the incoming pose
    SWIVEL_REACH,              // 4: far and near soft zone, max stretch, min distance; in arm lengths
    SWIVEL_MAX_SWIVEL,         // 2: cosine and sine of the max turn of the swivel in a solve
    SWIVEL_FLEXION_LIMIT,      // 2: cosines of half the min and half the max flexion
    SWIVEL_SHOULDER_CONE,      // 4: unit axis; cosine of the upper arm's max angle to it
    SWIVEL_HUMERAL_TWIST,      // 4: range of the upper arm's twist about itself
    SWIVEL_SHOULDER_BOX,       // 12: ranges of the shoulder's Euler angles
    SWIVEL_HAND_CONE,          // 4: unit axis of the hand; cosine of its max angle to the forearm
    SWIVEL_FOREARM_TWIST,      // 4: range of the hand's twist about the forearm
    SWIVEL_HAND_TWIST,         // 7: unit axis of the hand; range of its twist about it
    SWIVEL_WRIST_BOX,          // 12: ranges of the wrist's Euler angles
    SWIVEL_AIM,                // 5: unit axis in the effector's frame; cosine and sine of half the flexion
    SWIVEL_CLAVICLE,           // 4: the shoulder in its parent's frame; a share. Bodies: 1, the share
    SWIVEL_CONTACT,            // 1, WITH_PLANT: a share; above 0.5 the point touches
    SWIVEL_CAP,                // 3, in arm lengths: reach beyond the animation's, reach always allowed, soft zone
    SWIVEL_PELVIS_FIT_WEIGHT,  // 1, WITH_PELVIS_FIT: how much the limb counts, a share
    SWIVEL_NEXT_TARGET,        // 3: where the wrist or effector goes next
    SWIVEL_NEXT_TIME,          // 1, WITH_NEXT_TARGET: seconds until then; 1e15 at the start
    SWIVEL_SHIFT_WISH,         // 1, a shift: the wished shift, in the world's unit
    SWIVEL_GROUND,             // 3: a point of the ground at SWIVEL_PROBE; NaN: none
    SWIVEL_GROUND_NORMAL,      // 3, WITH_GROUND
    SWIVEL_GROUND_WEIGHT,      // 1, WITH_GROUND: how far the foot turns with the ground, a share
    SWIVEL_GRIP,           // 7, WITH_LINK: position and rotation of wrist or effector, in the frame of what it holds
    SWIVEL_PROP_POSITION,  // 3, a prop: NaN at the start: see swivel_prop_def
    SWIVEL_PROP_ROTATION,  // 4, a prop: likewise
    SWIVEL_HAND_BLEND,     // 1, a prop: which hand says where it is, a share: 0 the first, 1 the second
    SWIVEL_PROP_WEIGHT,    // 1, a prop: how much that counts against the hands, a share
    SWIVEL_LOOK_TARGET,    // 3, a look: NaN, the default, is no target
    SWIVEL_LOOK_WEIGHT,    // 1, a look: how much of the turn is taken, a share
    SWIVEL_INPUT_END,      // one past the last input

    SWIVEL_SHOULDER = 256,     // 4: in the arm frame, or with JOINTS the local rotation
    SWIVEL_ELBOW,              // 2: cosine and sine of half the flexion, or likewise 4
    SWIVEL_WRIST,              // 4, WITH_HAND: relative to the forearm, or likewise
    SWIVEL_FLAGS,              // 1: bits of swivel_flag, as uint32_t
    SWIVEL_STRETCH,            // 1, WITH_REACH: the factor for both bone lengths
    SWIVEL_NORMAL,             // 3, WITH_MAX_SWIVEL: of the swivel plane, from which the next solve steps
    SWIVEL_TWIST_BONES,        // 4 a bone: bone i of n takes i / (n + 1) of the hand's twist, +-180 degrees
    SWIVEL_CLAVICLE_ROTATION,  // 4, WITH_CLAVICLE: new rotation = old * this
    SWIVEL_RECORD,             // 22: shoulder, arm frame, scale, lengths and incoming rotations
    SWIVEL_PLANT,              // 11: the anchor, the offset that fades, its state
    SWIVEL_PLANT_ROTATION,     // 10: the same for the rotation
    SWIVEL_CONTACT_STATE,      // 4, PLANT_BY_MOTION: the last animated position; 1 if in contact
    SWIVEL_SOLVED_GOAL,        // 7, WITH_RECORD and WITH_PLANT or WITH_LINK
    SWIVEL_SHIFT,              // 3, a shift: along `up`, in the world's unit; its rate a second; 1 once begun
    SWIVEL_PROBE,              // 3, WITH_GROUND: sample the ground above or below this point
    SWIVEL_LIFT,               // 9, WITH_GROUND: lift along `up`, rate, 1 once begun; normal, rate
    SWIVEL_HAND_TRANSFORM,     // 7: the wrist joint's position and world rotation
    SWIVEL_PROP_TRANSFORM,     // 7, a prop: position and world rotation
    SWIVEL_SIGHT,              // 6, a look: start and unit direction
    SWIVEL_LOOK_TURNS,         // 25, a look: 1 once solved; the turn of each joint
    SWIVEL_RESULT_END          // one past the last result
} swivel_field;

typedef enum swivel_field_kind {
    SWIVEL_FIELD_INPUT,    // the caller writes it
    SWIVEL_FIELD_RESULT,   // a solve writes it
    SWIVEL_FIELD_CARRIED,  // a result that the limb's next solve starts from; swivel_reset() clears it
} swivel_field_kind;

// A feature and a field of the library's table. swivel_field_row_count() tells whether a group has a field.
typedef struct swivel_feature_info {
    swivel_features feature;
    const char* name;          // such as "WITH_HAND"; a constant
    swivel_features needs;     // a limb with it must have all of these; a body's has WORLD and WITH_INCOMING
    swivel_features excludes;  // and none of these
    uint32_t kinds;            // of groups that may have it: bit k is swivel_kind k
    uint32_t reserved;         // 0
} swivel_feature_info;
typedef struct swivel_field_info {
    swivel_field field;
    swivel_field_kind kind;
    const char* name;          // such as "shoulder_position"; a constant
    const char* range;         // what an input must be, in words; empty for results; a constant
    swivel_features needs;     // a group of these kinds has the field with all of these
    swivel_features excludes;  // and none of these
    uint32_t kinds;            // bit k is swivel_kind k
    uint32_t max_components;   // the most numbers of a value in any group
    uint32_t is_position;      // 1: it may be given in double, from an origin
    uint32_t reserved;         // 0
} swivel_field_info;

// Describes feature or field number `index`, from 0; returns 0 if there is none.
SWIVEL_API int swivel_describe_feature(uint32_t index, swivel_feature_info* info);
SWIVEL_API int swivel_describe_field(uint32_t index, swivel_field_info* info);
// The name of the lowest bit of a flag word, such as "REACHED"; null for an unknown bit.
SWIVEL_API const char* swivel_flag_name(uint32_t flags);

typedef struct swivel_in {
    const void* data;  // null only for zero limbs
    size_t stride;     // bytes from one limb's value to the next; 0: one value for all limbs
} swivel_in;

typedef struct swivel_out {
    void* data;     // null only for zero limbs
    size_t stride;  // bytes; at least the value's size
} swivel_out;

enum { SWIVEL_MAX_TWIST_BONES = 7 };  // of one limb

// Maps the arm frame to a skeleton's joints, as unit quaternions. swivel_bind_joints() makes it.
typedef struct swivel_binding {
    size_t size;
    float parent_from_arm[4];        // arm frame to the shoulder's parent joint
    float upper_from_arm[4];         // arm frame, bones and hinge at rest, to the shoulder joint's own frame
    float elbow_parent_from_arm[4];  // the same, to the elbow's parent
    float fore_from_arm[4];          // the same, to the elbow joint's own frame
    float wrist_parent_from_arm[4];  // the same, to the wrist's parent
    float shoulder_rest[4], elbow_rest[4], wrist_rest[4];  // local rotations
    float lengths[2];                                      // upper arm, forearm; NaN: not known
    uint32_t twist_bone_count;                             // 0: SWIVEL_TWIST_BONES is relative to their rest
    // The same, to each twist bone's parent and to its own frame.
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

// A skeleton at rest. Joints are named by index, in any order.
typedef struct swivel_skeleton {
    size_t size;
    swivel_in parents;       // an int32_t for each joint: its parent, or -1 for a root
    swivel_in rotations;     // relative to the parent; null data: no joint is turned at rest
    swivel_in translations;  // 3 floats: the joint in its parent's frame, with scales applied
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
    size_t size;
    uint32_t shoulder, elbow, wrist;
    // Joints that share the hand's twist, from elbow to wrist: each below the elbow, none above or below another.
    uint32_t twist_bone_count;  // 0 to 7
    const uint32_t* twist_bones;
    // Where flexion carries the forearm or shin, away from the pole, in the shoulder joint's frame: for a direction f
    // in the world, forwards for an arm and backwards for a leg, conjugate(q) * f * q. Zero: the rest pose says it, if
    // bent by more than 10 degrees.
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

// Binds a limb: the alignments from its rest pose, and its two bone lengths.
SWIVEL_API swivel_status swivel_bind_joints(const swivel_skeleton* skeleton, const swivel_limb_joints* joints,
                                            swivel_binding* binding);

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
    SWIVEL_KEEP_POSE,  // the results and carried values that it had
} swivel_on_bad_input;

// Free limbs that share features and a binding, such as the left arms of one skeleton.
typedef struct swivel_limb_def {
    size_t size;
    swivel_features features;  // 0: all is in the arm frame
    uint32_t limb_count;       // 1 or more
    swivel_on_bad_input on_bad_input;
    swivel_euler_order shoulder_order, wrist_order;  // of SWIVEL_SHOULDER_BOX and SWIVEL_WRIST_BOX
    uint32_t twist_bone_count;                       // 0 to 7; more than 0 needs WITH_HAND
    swivel_binding binding;                          // JOINTS: every limb uses it, and starts with its lengths
    const struct swivel_region* region;              // WITH_REGION; copied. Null without the feature
    // POLE_HALF_LINE: where no wrist goes, in the frame of the shoulder's parent, else in the arm frame; of any length.
    // Zeros: where the elbow points at rest. Better: above and behind for arms, behind for legs.
    float pole_behind[3];
} swivel_limb_def;

// Plain limbs in the arm frame.
static inline swivel_limb_def swivel_default_limb_def(uint32_t limb_count)
{
    swivel_limb_def limb;
    memset(&limb, 0, sizeof limb);
    limb.size = sizeof limb;
    limb.limb_count = limb_count;
    limb.binding = swivel_default_binding();
    return limb;
}

// A group of a crowd: one of these definitions, copied. Its number is its place in the crowd's array.
typedef struct swivel_group_def {
    size_t size;
    const swivel_limb_def* limb;
    const struct swivel_body_limb_def* body_limb;
    const struct swivel_look_def* look;
    const struct swivel_prop_def* prop;
    const struct swivel_shift_def* shift;  // of at most one group
} swivel_group_def;

// One definition must still be given.
static inline swivel_group_def swivel_default_group_def(void)
{
    const swivel_group_def group = {sizeof(swivel_group_def), NULL, NULL, NULL, NULL, NULL};
    return group;
}

typedef struct swivel_crowd_def {
    size_t size;
    uint32_t group_count;            // 1 or more
    uint32_t workspace_count;        // how many workspaces it has, 0 to 64: see swivel_workspace_bytes()
    const swivel_group_def* groups;  // group_count of them
    // Memory comes from the first of these that is set: `memory`, swivel_crowd_bytes() long and aligned to 64, which
    // outlives the crowd; `allocate`; or the C library.
    void* memory;
    size_t memory_bytes;
    void* (*allocate)(size_t bytes, size_t alignment, void* user);
    void (*release)(void* memory, size_t bytes, void* user);
    void* user;
    const swivel_skeleton* skeleton;  // of all bodies; copied. Null: the crowd is of free limbs
    uint32_t body_count;              // with a skeleton 1 or more, else 0
    float up[3];                      // bodies: the axis of heights and shifts in the root's frame, of any length but 0
} swivel_crowd_def;

// One group must still be given; one workspace; the C library's memory.
static inline swivel_crowd_def swivel_default_crowd_def(void)
{
    const swivel_crowd_def def = {sizeof(swivel_crowd_def), 0, 1, NULL, NULL, 0, NULL, NULL, NULL, NULL, 0, {0, 1, 0}};
    return def;
}

typedef struct swivel_crowd swivel_crowd;

// Bytes of memory a crowd of this def takes, in one piece; 0 if the def is invalid.
SWIVEL_API size_t swivel_crowd_bytes(const swivel_crowd_def* def);
// Makes a crowd; *crowd is null on failure. It allocates once; later calls allocate nothing, but oneTBB may. Inputs
// start neutral, or as NaN: not given, which is bad input where nothing else gives them. docs/fields.md has a table.
// Results start as the rest pose, without flags.
SWIVEL_API swivel_status swivel_crowd_create(const swivel_crowd_def* def, swivel_crowd** crowd);
// Frees what create allocated. Null is allowed.
SWIVEL_API void swivel_crowd_destroy(swivel_crowd* crowd);

enum { SWIVEL_LANES = 16 };  // limbs in a block

// The crowd's shape. Masks count limbs through the whole crowd, padding lanes included: limb n of a group has the
// number swivel_group_first_limb() + n. In a crowd of bodies they count bodies. 0 where there is none.
SWIVEL_API uint32_t swivel_group_count(const swivel_crowd* crowd);
SWIVEL_API uint32_t swivel_block_count(const swivel_crowd* crowd);
SWIVEL_API uint32_t swivel_group_first_limb(const swivel_crowd* crowd, uint32_t group);
SWIVEL_API uint32_t swivel_group_limb_count(const swivel_crowd* crowd, uint32_t group);
SWIVEL_API swivel_kind swivel_group_kind(const swivel_crowd* crowd, uint32_t group);
SWIVEL_API swivel_features swivel_group_features(const swivel_crowd* crowd, uint32_t group);
// The first row of a field within each block of a group, and its number of rows.
SWIVEL_API uint32_t swivel_field_first_row(const swivel_crowd* crowd, uint32_t group, swivel_field field);
SWIVEL_API uint32_t swivel_field_row_count(const swivel_crowd* crowd, uint32_t group, swivel_field field);

// A group's memory, in the order of swivel_field: row r of limb i is base[((i / 16) * row_count + r) * 16 + i % 16], on
// every CPU. Rows are aligned to 64 bytes.
typedef struct swivel_rows {
    float* base;           // borrowed from the crowd, valid until it is destroyed
    uint32_t block_count;  // of the group
    uint32_t row_count;
} swivel_rows;

// Direct access to a group's rows: the fast way in and out. Padding lanes may hold anything.
SWIVEL_API swivel_rows swivel_input_rows(swivel_crowd* crowd, uint32_t group);
SWIVEL_API swivel_rows swivel_result_rows(swivel_crowd* crowd, uint32_t group);

// Copies a field of limbs of a group from, or to, the caller's strided data: consecutive floats for each limb, a
// uint32_t for SWIVEL_FLAGS. `first` counts within the group. swivel_write() takes inputs and carried fields.
SWIVEL_API swivel_status swivel_write(swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                                      uint32_t limb_count, swivel_in values);
SWIVEL_API swivel_status swivel_read(const swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                                     uint32_t limb_count, swivel_out values);

// swivel_write() of positions far from the origin: 3 doubles for each limb, from which an origin near it is subtracted
// before they are rounded to floats.
SWIVEL_API swivel_status swivel_write_doubles(swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                                              uint32_t limb_count, swivel_in values, swivel_in origins);

// One field in the caller's own array.
typedef struct swivel_stream {
    swivel_field field;
    void* data;     // null: as if the field were not listed
    size_t stride;  // bytes; for an input 0 is one value for the group
} swivel_stream;

// The kind of a caller's numbers.
typedef enum swivel_numbers {
    SWIVEL_NUMBERS_UNSPECIFIED,  // nothing is checked
    SWIVEL_FLOATS,
    SWIVEL_DOUBLES
} swivel_numbers;

// One group's values as engines keep them. Other fields stay in the rows. A field may be listed once.
typedef struct swivel_streams {
    size_t size;
    const swivel_stream* fields;
    uint32_t field_count;
    uint32_t positions;  // a swivel_numbers: what the caller takes positions for, so that a mistake fails
    // Unless null, positions are 3 doubles, and this is subtracted as by swivel_write_doubles().
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

// Some of a crowd's blocks.
typedef struct swivel_blocks {
    uint32_t first, count;
} swivel_blocks;

// Stores the ground below some feet: swivel_bodies.h.
struct swivel_probes;
typedef void swivel_sample(const struct swivel_probes* probes, void* user);

// One call of swivel_solve(). A job of null pointers solves every limb, from and to rows.
typedef struct swivel_job {
    size_t size;

    // Which blocks, groups and limbs; null: all. Others keep their results. Group g is bit g % 32 of groups[g / 32],
    // limb i is bit i % 32 of mask[i / 32].
    const swivel_blocks* blocks;
    const uint32_t* groups;
    uint32_t group_word_count;  // (swivel_group_count() + 31) / 32
    const uint32_t* mask;
    uint32_t mask_word_count;  // (swivel_block_count() + 1) / 2

    // The caller's own arrays, for each group named, in the crowd's order. Null: the crowd's rows.
    const swivel_streams* streams;

    // Not 0: solves on the calling thread, and never allocates; several threads may do so at once, on blocks that do
    // not overlap. 0: on the calling thread's oneTBB arena, if there is enough to do.
    int on_this_thread;

    uint32_t* solved_count;  // unless null, becomes how many limbs, or bodies, were solved

    // swivel_workspace_bytes() of memory for this call alone, aligned to 64. Null: one of the crowd's workspaces.
    void* workspace;

    const struct swivel_pose* pose;  // where the bodies' poses are; null in crowds of free limbs

    // Groups WITH_GROUND: unless null, it is called on the solving threads, by several at a time, with up to 128 feet
    // of one group, and stores their ground. It may not throw or call this crowd. Null: rows or streams have it.
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
// KiB for each needed joint. Each swivel_solve() that runs at the same time needs one.
SWIVEL_API size_t swivel_workspace_bytes(const swivel_crowd* crowd);

// Solves limbs; job may be null. Fails if no workspace is free.
//
// With streams, one pass replaces swivel_write() of every input given, the solve, and swivel_read() of every result
// given, with the same bits. A limb's results may overlap its own inputs, and nothing else.
//
// A solve costs by blocks: keep limbs that are solved together side by side.
SWIVEL_API swivel_status swivel_solve(swivel_crowd* crowd, const swivel_job* job);

// Chooses at most max_blocks whole blocks by urgency. Each call adds the largest priority among a block's
// limbs to the block's urgency, picks the most urgent, and sets their urgency to 0.
//
// priorities: one entry for each group, or one alone for bodies; one float for each limb, 0..1e15.
// urgency: a float for each block, 0 at first, kept from call to call. Null: priorities alone decide.
// mask: gets the bits of the picked blocks' limbs, and 0 elsewhere, for a job.
// chosen_count: unless null, how many limbs these are.
SWIVEL_API swivel_status swivel_choose(swivel_crowd* crowd, const swivel_in* priorities, float* urgency,
                                       uint32_t max_blocks, uint32_t* mask, uint32_t mask_word_count,
                                       uint32_t* chosen_count);

// Clears these limbs' carried fields, so that they start anew, as after a teleport.
SWIVEL_API swivel_status swivel_reset(swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count);

// A body's state is what its next solve starts from besides the caller's inputs: the carried fields of all groups, and
// the results of free limbs with SWIVEL_KEEP_POSE. Body n of free limbs is limb n of each group, so groups need equal
// limb counts. docs/howto/server.md explains rollback.
//
// Bytes of one body's state; 0 if limb counts differ.
SWIVEL_API size_t swivel_state_bytes(const swivel_crowd* crowd);
// Saves the states of bodies side by side, the same on every CPU, to bytes of any alignment. size:
// swivel_state_bytes() a body, or more.
SWIVEL_API swivel_status swivel_save(const swivel_crowd* crowd, uint32_t first_body, uint32_t body_count, void* bytes,
                                     size_t size);
// Loads what swivel_save() saved of any bodies, of this crowd or of one whose groups carry the same fields; nothing if
// any bytes are of another kind of crowd. Inputs and other results stay: those that a body keeps because of bad input
// are not the saved crowd's until its next good solve.
SWIVEL_API swivel_status swivel_load(swivel_crowd* crowd, uint32_t first_body, uint32_t body_count, const void* bytes,
                                     size_t size);
// swivel_reset() of all groups of these bodies. In their next solve feet land where animated, and looks and shifts are
// at their goals.
SWIVEL_API swivel_status swivel_reset_body(swivel_crowd* crowd, uint32_t first_body, uint32_t body_count);
// A digest of all bodies' state, or of free limbs in any groups. Unlike swivel_digest(), it is the saved crowd's once
// all bodies are loaded.
SWIVEL_API uint64_t swivel_state_digest(const swivel_crowd* crowd);

// Values of fields from angles in radians. For twists and boxes, the range from min to max, no wider than 2 pi.
SWIVEL_API swivel_status swivel_range(double min, double max, float range[4]);
// An axis of any length but zero, and the largest angle to it, 0 to pi.
SWIVEL_API swivel_status swivel_cone(const double axis[3], double max, float cone[4]);
// A direction of the character in the arm frame, where the axes of limits are. parent_rotation: of the shoulder's
// parent joint in the world of the rest pose.
SWIVEL_API swivel_status swivel_arm_axis(const swivel_binding* binding, const float parent_rotation[4],
                                         const double direction[3], double axis[3]);
// The elbow's min and max flexion, 0 <= min <= max <= pi.
SWIVEL_API swivel_status swivel_flexion(double min, double max, float flexion[2]);
// For SWIVEL_AIM: an axis of the hand, of any length but zero, and the elbow's flexion, 0 to pi.
SWIVEL_API swivel_status swivel_aim(const double axis[3], double flexion, float aim[5]);
// Cosine and sine of an angle, for SWIVEL_ANGLE and SWIVEL_MAX_SWIVEL.
SWIVEL_API void swivel_cos_sin(double angle, float pair[2]);
// The value of SWIVEL_ANGLE or of a limit for the same limb on the other side of a skeleton mirrored in x. order: of
// boxes. Other input fields are copied.
SWIVEL_API swivel_status swivel_mirror(swivel_field field, swivel_euler_order order, const float* from, float* to);

// Forward kinematics of the results, in the targets' space: 3 doubles for elbow and wrist, 4 for the hand's rotation.
// Null outputs are left out. Body groups need WITH_RECORD for it, residuals and arcs.
SWIVEL_API swivel_status swivel_forward(const swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count,
                                        swivel_out elbow, swivel_out wrist, swivel_out hand);
// How far each limb's wrist or effector is from its target, or WITH_AIM the target from the hand's ray: one double, in
// arm lengths as scaled and stretched; NaN for bad input.
SWIVEL_API swivel_status swivel_residuals(const swivel_crowd* crowd, uint32_t group, uint32_t first,
                                          uint32_t limb_count, swivel_out distance);
// An arc of swivels: cosine and sine of its ends, counter-clockwise about the line from shoulder to wrist, or WITH_AIM
// to the target, from the swivel wished for. The whole circle is one arc with equal ends.
typedef struct swivel_arc {
    float from[2], to[2];
} swivel_arc;

// The swivels that a limb's limits allow for its present inputs, in their order around the circle, at most capacity of
// them. *arc_count: how many there are, 0 for bad input.
SWIVEL_API swivel_status swivel_allowed_arcs(const swivel_crowd* crowd, uint32_t group, uint32_t limb, swivel_arc* arcs,
                                             uint32_t capacity, uint32_t* arc_count);
// The joint angles of the results: 7 doubles a limb, in radians about the rest pose and the arm frame's axes. Three of
// the shoulder in its order, the flexion, three of the wrist. Family 0 has middle angles within -pi/2..pi/2, family 1
// is the other triple.
SWIVEL_API swivel_status swivel_joint_angles(const swivel_crowd* crowd, uint32_t group, uint32_t first,
                                             uint32_t limb_count, swivel_euler_order shoulder_order,
                                             swivel_euler_order wrist_order, int family, swivel_out angles);

// Results in 16-bit words, about half of the rows' bytes, the same on every CPU. Word r of lane l of the nth block
// becomes words[(n * rows + r) * SWIVEL_LANES + l], where rows is swivel_packed_row() of SWIVEL_RESULT_END. A rotation
// takes 3 words, flags 2, other numbers a half float each; SWIVEL_NORMAL takes none. docs/howto/limbs.md has the
// formula.
SWIVEL_API swivel_status swivel_pack(const swivel_crowd* crowd, uint32_t group, swivel_blocks blocks, uint16_t* words);
// The first row of words of a field of a group; if it has none, the row after those before it.
SWIVEL_API uint32_t swivel_packed_row(const swivel_crowd* crowd, uint32_t group, swivel_field field);
// The rotation of three words, word_stride words apart, SWIVEL_LANES in rows.
SWIVEL_API void swivel_unpack_rotation(const uint16_t* words, size_t word_stride, float xyzw[4]);
// The value of any half float, exactly.
SWIVEL_API float swivel_unpack_half(uint16_t word);

// A digest of all results, to compare machines by: equal results have equal ones, others almost surely not.
SWIVEL_API uint64_t swivel_digest(const swivel_crowd* crowd);

// The instruction set in use: SWIVEL_FORCE_ISA of the environment, else the best that this CPU runs. Null if the former
// cannot be used.
SWIVEL_API const char* swivel_isa_name(void);
// Selects the instruction set for the whole process, from the next solve on.
SWIVEL_API swivel_status swivel_use_isa(const char* name);
// The built-in instruction sets, best first; null past the last.
SWIVEL_API const char* swivel_isa_at(uint32_t index);
// 1 if this CPU and operating system run it, else 0.
SWIVEL_API int swivel_isa_runs(const char* name);

#ifdef __cplusplus
}
#endif

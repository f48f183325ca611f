// SPDX-License-Identifier: MIT
//
// swivel: the arms of crowds. Wrist targets and elbow poles go in, joint rotations come out: batched, free of
// trigonometry, with the same bits on every CPU. This header is the whole binary interface; swivel.hpp wraps it for
// C++.
//
// Everything here is experimental until release 1.0 keeps it.
//
// CONVENTIONS. Lengths are in the caller's unit. Quaternions are Hamilton's, stored x, y, z, w; a*b applies b first.
// The arm frame has the shoulder at its origin; at rest both bones lie along +z (e3), the hinge is +x (e1), and flexion
// carries the forearm towards +y (e2). The elbow lies on the pole's side of the line from shoulder to wrist.
//
// LIFE. swivel_default_crowd_def() -> edit -> swivel_crowd_create() -> each frame: write inputs, swivel_solve(), read
// results, or swivel_solve() with frames for all three -> swivel_crowd_destroy(). After creation swivel allocates
// nothing; oneTBB, inside the solves that use it, may.
//
// LAYOUT. One lane is one limb. A block is 16 limbs, a row is one component of a block: 16 floats, 64 bytes, aligned
// to 64. Row r of limb i is base[((i / 16) * row_count + r) * 16 + i % 16], on every CPU. A crowd is made of groups:
// limbs that share one binding, such as the left arms of one skeleton. Each group starts a block; lanes past its end
// are padding.
//
// INPUT ROWS, in this order    rows  present with    meaning
//   SWIVEL_TARGET              3     always          wrist position: arm frame, or world with WORLD
//   SWIVEL_POLE                3     always          pole point, or a direction with POLE_DIRECTION
//   SWIVEL_LENGTHS             2     always          upper arm, forearm (before the parent's scale)
//   SWIVEL_SHOULDER_POSITION   3     WORLD           the shoulder's place in the world
//   SWIVEL_PARENT_ROTATION     4     WORLD           world rotation of the shoulder's parent joint
//   SWIVEL_PARENT_SCALE        1     WORLD           uniform scale of the parent, > 0
//   SWIVEL_HAND                4     WITH_HAND       wanted hand orientation: arm frame, or world with WORLD
//   and those of THE WHOLE LIMB below
// RESULT ROWS, in this order
//   SWIVEL_SHOULDER            4     always          rotation in the arm frame, or the joint's local one with JOINTS
//   SWIVEL_ELBOW               2     no JOINTS       cos and sin of half the flexion, both >= 0
//                              4     JOINTS          the joint's local rotation
//   SWIVEL_WRIST               4     WITH_HAND       hand relative to forearm, or local rotation with JOINTS
//   SWIVEL_FLAGS               1     always          SWIVEL_REACHED..., as uint32_t
//   and those of THE WHOLE LIMB
//
// THE WHOLE LIMB. What else may be asked of a limb, each part with a feature of its own: what is off costs nothing. All
// of it is lane by lane, so every limb may have its own. Angles go in as cosines and sines; swivel_range(),
// swivel_cone(), swivel_flexion() and swivel_turn() make them. FEATURE is SWIVEL_ and the feature's name.
//
//   more input rows            rows  FEATURE              meaning
//   SWIVEL_EFFECTOR            3     WITH_EFFECTOR        the target is for this point of the hand (its own frame)
//   SWIVEL_ANGLE               2     WITH_ANGLE           cos, sin: turns the elbow on from the pole's side
//   SWIVEL_INCOMING_SHOULDER   4     WITH_INCOMING        the pose so far: local rotations with JOINTS, else in the
//   SWIVEL_INCOMING_ELBOW      4     WITH_INCOMING        arm frame, forearm to upper arm, hand to forearm; always
//   SWIVEL_INCOMING_WRIST      4     and WITH_HAND        whole quaternions
//   SWIVEL_WEIGHTS             3     WITH_WEIGHTS         of position, hand, pole: 0 the incoming pose's, 1 the goal's
//   SWIVEL_REACH               4     WITH_REACH           soft zone far, soft zone near, most stretch, least distance
//   SWIVEL_MOST_SWIVEL         2     WITH_MOST_SWIVEL            cos, sin of how far the swivel may turn in one solve,
//   0..pi SWIVEL_FLEXION_LIMIT       2     WITH_FLEXION_LIMIT        cos of half the least flexion, cos of half the
//   largest SWIVEL_SHOULDER_CONE       4     WITH_SHOULDER_CONE  unit axis; cos of the upper arm's largest angle to it
//   SWIVEL_HUMERAL_TWIST       4     WITH_HUMERAL_TWIST  range of the upper arm's twist about itself
//   SWIVEL_SHOULDER_BOX        12    WITH_SHOULDER_BOX   ranges of its Euler angles, in the crowd's order of axes
//   SWIVEL_HAND_CONE           4     WITH_HAND_CONE      unit axis of the hand; cos of its largest angle to forearm
//   SWIVEL_FOREARM_TWIST       4     WITH_FOREARM_TWIST  range of the hand's twist about the forearm
//   SWIVEL_HAND_TWIST          7     WITH_HAND_TWIST     unit axis of the hand; range of its twist about it
//   SWIVEL_WRIST_BOX           12    WITH_WRIST_BOX      ranges of the wrist's Euler angles
//   SWIVEL_AIM                 5     WITH_AIM             unit axis of the hand to aim with; cos, sin of half flexion
//   SWIVEL_CLAVICLE            4     WITH_CLAVICLE        shoulder's place in its parent joint's frame; share 0..1
//   more result rows
//   SWIVEL_STRETCH             1     WITH_REACH           factor for both bone lengths, 1 or more
//   SWIVEL_NORMAL              3     WITH_MOST_SWIVEL            unit normal of the swivel plane, arm frame; kept for
//   the next SWIVEL_TWIST_BONES               4 n   WITH_TWIST_BONES * n      a quaternion for each of n twist bones,
//   see below SWIVEL_CLAVICLE_TURN       4     WITH_CLAVICLE        what the parent joint turns by: its local rotation
//   * this
//
// RANGES. A range is cos and sin of its middle, then cos and sin of half its width, which is 0..pi. Axes, cosines with
// their sines, and ranges are of unit length within 5e-4. Weights are 0..1. Anything else is bad input.
//
// EFFECTOR. The target is for this point of the hand instead of the wrist. With JOINTS it is in the wrist joint's own
// frame, else in the arm frame's axes as the hand carries them. It is in the unit of the bones, before the parent's
// scale, and no longer than 1e15.
//
// POLES. With POLE_NORMAL a pole is the normal of the swivel plane. With POLE_INCOMING there are no poles. The angle
// turns the elbow on from the pole's side, about the line from shoulder to wrist, by the right hand; its cosine and
// sine may be of any length in 1e-9..1e9. Where the pole says nothing, the angle is ignored.
//
// INCOMING POSE. It says where the elbow goes where the pole does not. Each result has the sign that is nearer to the
// incoming quaternion, instead of w >= 0; compact results keep w >= 0.
//
// REACH. Soft zones and least distance are shares 0..1 of both bones' length, the stretch is 1..1000. At a reach R with
// a soft zone s, a wanted distance d becomes d - (d - R + s)^2 / (4 s) between R - s and R + s, and R beyond; the near
// end is the mirror image. Stretch makes up for what is missing, up to the most.
//
// LIMITS. They are about the rest pose with the elbow straightened. Their axes, also those of the hand, are the arm
// frame's there, whatever axes a skeleton's joints have: bones along +z, hinge +x. swivel_arm_axis() turns directions
// of the character into them. A twist is that of swing and twist: 2 atan2(v . axis, w) of what the joint adds to rest,
// by the right hand. Its axis is +z, from shoulder to hand, or the one given; it is none of the Euler angles.
// - Where the wish breaks a limit, the nearest swivel that keeps all of them is taken. The cosine of a limited angle is
//   off by at most 1e-6.
// - THE WRIST COMES FIRST. Where no swivel keeps all limits, the one that violates them least is taken, and flagged
//   SWIVEL_INFEASIBLE. A twist's violation counts (1 + cos swing) / 2 times. To keep a limit even then, move the
//   target, weigh it down or let the clavicle help.
// - Joint limits win over MOST_SWIVEL, and that over the wish.
// - Flexion does not depend on the swivel. Its limit narrows the reach, and the wrist stops short.
//
// AIMING. The elbow keeps the flexion given. The wrist keeps the rotation in SWIVEL_HAND, which is relative to the
// forearm, or with JOINTS the joint's local one; without WITH_HAND the hand is at rest. The shoulder turns so that a
// ray goes through the target: from the effector, else the wrist, along the axis. The axis is in the frame that
// effectors are in; swivel_aim() makes the value. The elbow lies on the pole's side of the line from shoulder to
// target. A target too near for that flexion is SWIVEL_CLAMPED_NEAR: then the ray's nearest point to the shoulder is
// brought onto the line from shoulder to target. Weights, reach, flexion limits and limits of the hand are refused.
//
// CLAVICLE. The parent joint, given as it is without this, turns about its own origin, which is SHOULDER_POSITION less
// the clavicle: the first three numbers, in the parent joint's axes and the unit of the bones, no longer than 1e15. It
// turns towards the target by about the share of the angle between clavicle and target, times the weight of position.
// Limits, rotations and results of the arm are relative to the parent as turned. For shares below 1 the turn is smooth,
// and fades for targets on the body's other side.
//
// TWIST BONES. The hand's twist about the forearm is shared over n of them, children of the forearm. Bone i of 1..n
// turns by i / (n + 1) of it, within 0.12 degrees, about the forearm's axis, relative to rest. With JOINTS its local
// rotation is this quaternion times its rest rotation; without, it is this quaternion in the arm frame.
//
// STEPS. With WITH_MOST_SWIVEL the plane's normal is carried from solve to solve, in the arm frame. In each it is first
// made perpendicular to the new line from shoulder to wrist: the step is the turn from there. Bad input and
// swivel_reset() forget it; call that after a teleport. Without WITH_MOST_SWIVEL results depend on the frame's own
// inputs alone.
//
// CONTINUITY. The swivel is continuous, but for targets that pass through the shoulder, poles that pass through the
// line, and limits whose nearest swivel changes sides. With WITH_AIM an elbow that passes through the line rolls the
// arm over, whatever MOST_SWIVEL says, which bounds the plane's normal.
//
// COMPACT RESULTS. With SWIVEL_COMPACT a result row is 16 uint16_t, 32 bytes, word r of limb i at
// base[((i / 16) * row_count + r) * 16 + i % 16] of swivel_compact_rows(), the fields in the same order:
//   SWIVEL_SHOULDER, SWIVEL_WRIST, and SWIVEL_ELBOW with JOINTS: 3 words, the quaternion's smallest three components.
//       The component of largest size (the first of x, y, z, w if equal) is left out; its index 0..3 is
//       word0 >> 15 | (word1 >> 15) << 1. The other three, in the order x, y, z, w, are
//       ((word & 32767) - 16384) / (16383 * sqrt 2), of the one of q and -q whose component left out is positive: that
//       one is sqrt(1 - the sum of their squares). Bit 15 of word2 is 0. Three words of 0, which no solve writes, are
//       four zeros.
//   SWIVEL_ELBOW without JOINTS: 2 words, cos and sin as IEEE half floats, rounded to nearest.
//   SWIVEL_FLAGS: 2 words, the low and the high half of the uint32_t.
// A rotation is within 1.54e-4 rad of the one without SWIVEL_COMPACT. A wrist is within 1.13e-3 arm lengths of it, for
// any bones; with JOINTS within 3.1e-4. The words are the same on every CPU, too. Packing takes a core up to half as
// long as solving, so it pays where memory is short or its bandwidth shared, or where results are sent on.
//
// hand = parent * shoulder * elbow * wrist, with JOINTS (the wrist joint's own orientation) and without, where the
// elbow's quaternion is (-sin, 0, 0, cos). With WORLD and without JOINTS the arm frame is the parent's own; with JOINTS
// the binding says how it lies there.
//
// COST. Ordinary arms are solved fastest. As the parent sees them, their bones are 1e-9..3e7 long and of a ratio below
// 1e6, their wrists 3e-5..5e3 from the shoulder, and their poles no further than 3e7 and off the target's line. The
// parent's scale is within 1e-5..1e5, its quaternion's squared length within 0.5..2. Any other arm, one with bad input
// too, is solved as exactly; but the 4 to 32 limbs of its step take about four times as long.
// Beside a plain arm, one with any feature of THE WHOLE LIMB takes about three times as long. With cones and twists it
// takes seven times as long; with a hand, a blend and limits ten; with boxes that leave one limb in eight no swivel
// thirty.
//
// VALID INPUT. Every position and pole is no longer than 1e15, in the world as given and in the arm frame. A bone
// length is 0 or in 1e-15..1e15. A quaternion's length is in 1e-9..1e9; it need not be 1. A scale is in 1e-15..1e15. A
// limb with anything else gets its rest pose and SWIVEL_BAD_INPUT, and no other limb changes by a bit. So does a limb
// that was never given its target, with WORLD its shoulder's place, or, without JOINTS, its bone lengths.
//
// Lengths below 1e-15 are not resolved: a target that near to the shoulder counts as on it. No wrist comes nearer to
// the shoulder than 1e-9 arm lengths; it is reached all the same. A bone under 1e-7 of the other is taken as straight
// with it.
//
// RESULTS. Every quaternion is of unit length within 1e-6 and has w >= 0 (at w = 0 the first of x, y, z that is not
// zero is positive). Equal inputs give equal bits on every CPU, instruction set, thread count and block range.
//
// FAR FROM THE ORIGIN. Results depend on differences of positions only, but a float 1e7 units out is good to half a
// unit. So positions may be given as doubles, with an origin near the arm that is taken off in double before they are
// rounded: swivel_write_doubles(), or swivel_frame's origin. The three fields of a limb that are positions
// (SWIVEL_TARGET, SWIVEL_POLE unless a direction, SWIVEL_SHOULDER_POSITION) must be given from the same origin. Which
// one does not matter while it is some arm lengths away: a position is rounded to 6e-8 of its distance from its origin.
// The shoulder's place, or the character's, will do. Rotations need no origin; swivel_forward()'s positions are from
// it, too.
//
// ERRORS. A call that fails changes nothing, returns a status and leaves one line in swivel_last_error().
//
// SIZES. Structures that may grow in later releases start with their size, as the caller's header has it. Start from
// the function that gives the defaults. A library accepts those of its own header and of older ones, which are shorter.
// In arrays all elements have the size of the first.
//
// THREADS. Different crowds may be used by different threads at once. One crowd may not, with two exceptions: jobs with
// on_this_thread on blocks that do not overlap, and calls that take it const while nothing else runs on it.
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#if defined(SWIVEL_SHARED) && defined(__GNUC__)
#define SWIVEL_API __attribute__((visibility("default")))
#else
#define SWIVEL_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define SWIVEL_VERSION_MAJOR 0
#define SWIVEL_VERSION_MINOR 2
#define SWIVEL_VERSION_PATCH 0
#define SWIVEL_VERSION (SWIVEL_VERSION_MAJOR * 10000 + SWIVEL_VERSION_MINOR * 100 + SWIVEL_VERSION_PATCH)

enum { SWIVEL_LANES = 16 };  // limbs in a block

typedef enum swivel_status {
    SWIVEL_OK = 0,
    SWIVEL_INVALID_ARGUMENT = 1,  // an argument breaks its contract
    SWIVEL_OUT_OF_MEMORY = 2,     // the allocator returned null, or the caller's memory is too small
    SWIVEL_UNKNOWN_ISA = 3,       // no instruction set of that name was built in
    SWIVEL_ISA_UNAVAILABLE = 4,   // it was built in, but this CPU or operating system cannot run it
} swivel_status;

// What the flag word of a limb says. Hard poses are results, not errors.
typedef enum swivel_flag {
    SWIVEL_REACHED = 1u << 0,      // the wrist is at its target or blended target, or the hand aims at it
    SWIVEL_SOFTENED = 1u << 1,     // in a soft zone of reach, so the wrist is not quite at the target
    SWIVEL_STRETCHED = 1u << 2,    // SWIVEL_STRETCH is above 1
    SWIVEL_CLAMPED_FAR = 1u << 3,  // target out of reach: the wrist is at the nearest point that bones and limits allow
    SWIVEL_CLAMPED_NEAR = 1u << 4,  // target too near: the wrist is at the nearest point that bones and limits allow
    SWIVEL_SWIVEL_UNDEFINED =
        1u << 5,  // pole of no length or within sin 1e-3 of the target's line, or target on the shoulder
    SWIVEL_LIMITED_FLEXION = 1u << 6,        // the elbow's flexion limit keeps the wrist from the target
    SWIVEL_LIMITED_SHOULDER_CONE = 1u << 7,  // this and the next: the limit forbids the swivel wished for
    SWIVEL_LIMITED_HUMERAL_TWIST = 1u << 8,
    SWIVEL_LIMITED_SHOULDER_BOX = 1u << 9,
    SWIVEL_LIMITED_HAND_CONE = 1u << 10,
    SWIVEL_LIMITED_FOREARM_TWIST = 1u << 11,
    SWIVEL_LIMITED_HAND_TWIST = 1u << 12,
    SWIVEL_LIMITED_WRIST_BOX = 1u << 13,
    SWIVEL_LIMITED_STEP = 1u << 14,  // the swivel wished for is further than SWIVEL_MOST_SWIVEL from the last one
    SWIVEL_INFEASIBLE = 1u << 15,    // no swivel is within the limits: this one violates them least
    SWIVEL_JUMPED = 1u << 16,        // joint limits made the swivel turn further than SWIVEL_MOST_SWIVEL
    SWIVEL_BAD_INPUT = 1u << 30,     // see VALID INPUT, or an input was never given; the limb has its rest pose
    // bits 17 to 29 are kept for later releases and are 0
} swivel_flag;

// What a crowd takes and gives; fixed at creation. Whatever is off costs neither memory nor time.
typedef enum swivel_feature {
    SWIVEL_WORLD = 1u << 0,           // targets, poles and hands are in the world; each limb has a parent frame
    SWIVEL_JOINTS = 1u << 1,          // results are the skeleton's own local rotations, through the group's binding
    SWIVEL_WITH_HAND = 1u << 2,       // a wanted hand orientation goes in, a wrist rotation comes out
    SWIVEL_POLE_DIRECTION = 1u << 3,  // with WORLD: poles are directions, not points
    SWIVEL_COMPACT = 1u << 4,         // results in 16-bit words, half as large or less; not with
                                      // WITH_REACH, WITH_MOST_SWIVEL, WITH_TWIST_BONES, WITH_CLAVICLE
    // THE WHOLE LIMB
    SWIVEL_WITH_EFFECTOR = 1u << 5,
    SWIVEL_WITH_ANGLE = 1u << 6,
    SWIVEL_POLE_NORMAL = 1u << 7,  // poles are normals of the swivel plane: cross(line from shoulder to wrist, pole)
    SWIVEL_WITH_INCOMING = 1u << 8,
    SWIVEL_POLE_INCOMING = 1u << 9,  // no poles: the elbow goes as in the incoming pose. Needs WITH_INCOMING
    SWIVEL_WITH_WEIGHTS = 1u << 10,
    SWIVEL_WITH_REACH = 1u << 11,
    SWIVEL_WITH_MOST_SWIVEL = 1u << 12,
    SWIVEL_WITH_FLEXION_LIMIT = 1u << 13,
    SWIVEL_WITH_SHOULDER_CONE = 1u << 14,
    SWIVEL_WITH_HUMERAL_TWIST = 1u << 15,
    SWIVEL_WITH_SHOULDER_BOX = 1u << 16,
    SWIVEL_WITH_HAND_CONE = 1u << 17,
    SWIVEL_WITH_FOREARM_TWIST = 1u << 18,
    SWIVEL_WITH_HAND_TWIST = 1u << 19,
    SWIVEL_WITH_WRIST_BOX = 1u << 20,
    SWIVEL_WITH_TWIST_BONES = 1u << 21,  // times the number of twist bones, 1 to 7
    SWIVEL_WITH_AIM = 1u << 24,          // the flexion is given, and the hand points at the target
    SWIVEL_WITH_CLAVICLE = 1u << 25,     // the shoulder's parent joint takes a share of the reach. Needs WORLD
    SWIVEL_BUDGET = 1u << 29,            // how long blocks wait is remembered: swivel_choose(), jobs with priorities
} swivel_feature;

typedef enum swivel_field {
    SWIVEL_TARGET,
    SWIVEL_POLE,
    SWIVEL_LENGTHS,
    SWIVEL_SHOULDER_POSITION,
    SWIVEL_PARENT_ROTATION,
    SWIVEL_PARENT_SCALE,
    SWIVEL_HAND,
    SWIVEL_EFFECTOR,
    SWIVEL_ANGLE,
    SWIVEL_INCOMING_SHOULDER,
    SWIVEL_INCOMING_ELBOW,
    SWIVEL_INCOMING_WRIST,
    SWIVEL_WEIGHTS,
    SWIVEL_REACH,
    SWIVEL_MOST_SWIVEL,
    SWIVEL_FLEXION_LIMIT,
    SWIVEL_SHOULDER_CONE,
    SWIVEL_HUMERAL_TWIST,
    SWIVEL_SHOULDER_BOX,
    SWIVEL_HAND_CONE,
    SWIVEL_FOREARM_TWIST,
    SWIVEL_HAND_TWIST,
    SWIVEL_WRIST_BOX,
    SWIVEL_AIM,
    SWIVEL_CLAVICLE,
    SWIVEL_SHOULDER,
    SWIVEL_ELBOW,
    SWIVEL_WRIST,
    SWIVEL_FLAGS,
    SWIVEL_STRETCH,
    SWIVEL_NORMAL,
    SWIVEL_TWIST_BONES,
    SWIVEL_CLAVICLE_TURN,
    SWIVEL_FIELD_COUNT
} swivel_field;

// How the arm frame lies in a skeleton's joints, and their rest pose: unit quaternions, x, y, z, w; and how long the
// bones are. Made by swivel_bind().
typedef struct swivel_binding {
    float parent_from_arm[4];  // arm frame to the shoulder's parent joint
    float upper_from_arm[4];   // arm frame, bones and hinge at rest, to the shoulder joint's own frame
    float fore_from_arm[4];    // the same, to the elbow joint's own frame
    float shoulder_rest[4], elbow_rest[4], wrist_rest[4];  // local rotations a limb with bad input gets
    float lengths[2];                                      // upper arm, forearm; NaN where they are not known
} swivel_binding;

// A shoulder, elbow and wrist joint at rest, as a skeleton stores them.
typedef struct swivel_chain {
    size_t size;                 // sizeof(swivel_chain), set by swivel_default_chain()
    float shoulder_rotation[4];  // rest rotation of the shoulder joint relative to its parent joint
    float elbow_rotation[4];     // rest rotation of the elbow joint relative to the shoulder joint
    float wrist_rotation[4];     // rest rotation of the wrist joint relative to the elbow joint
    float elbow_offset[3];       // elbow's place in the shoulder joint's frame
    float wrist_offset[3];       // wrist's place in the elbow joint's frame
    // Where flexion carries the forearm, in the shoulder joint's frame: mostly forwards for an arm, backwards for a
    // leg. Of the joint's world rotation q at rest and forwards f it is ~q f q. It is 1e-15..1e15 long and need not be
    // across the bones. Shorter than that, such as zero: as the rest pose is bent, by more than 10 degrees.
    float bend[3];
    float reserved;  // 0
} swivel_chain;

// Joints that are not turned at rest; bones and bend are still to be given.
static inline swivel_chain swivel_default_chain(void)
{
    const swivel_chain chain = {sizeof(swivel_chain), {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0}, {0}, {0}, 0};
    return chain;
}

// The axes of three rotations that make one, each about the axis as the ones before have left it: R = Rx Ry Rz is XYZ.
typedef enum swivel_euler_order {
    SWIVEL_XYZ,
    SWIVEL_XZY,
    SWIVEL_YZX,
    SWIVEL_YXZ,
    SWIVEL_ZXY,
    SWIVEL_ZYX,
} swivel_euler_order;

// Limbs that share one binding, such as the left arms of one skeleton.
typedef struct swivel_group_def {
    size_t size;             // sizeof(swivel_group_def), set by swivel_default_group_def()
    uint32_t limb_count;     // 1 or more
    uint32_t reserved;       // 0
    swivel_binding binding;  // with SWIVEL_JOINTS every limb uses it, and starts with its lengths; ignored without
} swivel_group_def;

// Limbs without a binding: in the arm frame.
static inline swivel_group_def swivel_default_group_def(uint32_t limb_count)
{
    swivel_group_def group;
    memset(&group, 0, sizeof group);
    group.size = sizeof group;
    group.limb_count = limb_count;
    return group;
}

typedef struct swivel_crowd_def {
    size_t size;                     // sizeof(swivel_crowd_def), set by swivel_default_crowd_def()
    uint32_t features;               // swivel_feature bits
    uint32_t group_count;            // 1 or more
    const swivel_group_def* groups;  // group_count of them, as far apart as the first one's size; copied
    // Memory, first that is set: the caller's (64-byte aligned, swivel_crowd_bytes() long, the caller frees it after
    // destroy), the caller's callbacks (64-byte aligned results), the C library.
    void* memory;
    size_t memory_bytes;
    void* (*allocate)(size_t bytes, size_t alignment, void* user);
    void (*release)(void* memory, size_t bytes, void* user);
    void* user;
    swivel_euler_order shoulder_order, wrist_order;  // of SWIVEL_SHOULDER_BOX and SWIVEL_WRIST_BOX
} swivel_crowd_def;

typedef struct swivel_crowd swivel_crowd;

typedef struct swivel_in {
    const void* data;
    size_t stride;  // bytes from one limb's value to the next; 0: one value for all limbs. Any alignment.
} swivel_in;

typedef struct swivel_out {
    void* data;
    size_t stride;  // bytes; at least the value's size. Any alignment.
} swivel_out;

typedef struct swivel_rows {
    float* base;  // borrowed from the crowd, valid until it is destroyed
    uint32_t block_count;
    uint32_t row_count;
} swivel_rows;

typedef struct swivel_words {
    uint16_t* base;  // borrowed as well
    uint32_t block_count;
    uint32_t row_count;
} swivel_words;

// The version the library was built as: compare with SWIVEL_VERSION. Any thread.
SWIVEL_API uint32_t swivel_version(void);
// What a status means, in a few words. Any thread.
SWIVEL_API const char* swivel_status_text(swivel_status status);
// One line on the calling thread's last failed call: what, where, what to do. Empty before any failure.
SWIVEL_API const char* swivel_last_error(void);

// One group must still be given; no features; the C library's memory.
static inline swivel_crowd_def swivel_default_crowd_def(void)
{
    const swivel_crowd_def def = {
        sizeof(swivel_crowd_def), 0, 0, NULL, NULL, 0, NULL, NULL, NULL, SWIVEL_XYZ, SWIVEL_XYZ};
    return def;
}
// Bytes of memory a crowd of this def takes, in one piece; 0 if the def is invalid.
SWIVEL_API size_t swivel_crowd_bytes(const swivel_crowd_def* def);
// Makes a crowd. Allocates once. On failure *crowd is null.
// What has no sensible default starts as NaN, so that a limb which never gets it is SWIVEL_BAD_INPUT: targets, with
// WORLD the shoulders' places, and bone lengths without JOINTS, where no binding says them. Poles start below the arm
// frame's or the world's origin, parent and hand as the identity, THE WHOLE LIMB as what changes nothing: no turn,
// weights 1, every limit wide open. Results start as the rest pose, without flags.
SWIVEL_API swivel_status swivel_crowd_create(const swivel_crowd_def* def, swivel_crowd** crowd);
// Frees what create allocated. Null is allowed.
SWIVEL_API void swivel_crowd_destroy(swivel_crowd* crowd);

// The alignments of a limb from its rest pose, and its two bone lengths. Any thread; no allocation. It fails for a zero
// or non-finite quaternion and a bone of no length. It fails for a bend along the upper arm, or one that turns about
// the forearm, and for a rest pose bent by 10 degrees or less without a bend.
SWIVEL_API swivel_status swivel_bind(const swivel_chain* chain, swivel_binding* binding);

// The crowd's shape. A group's first limb is a multiple of SWIVEL_LANES; limb indices count padding lanes. A group that
// does not exist has 0 limbs. Of a null crowd everything is 0 here and in the next five calls. Any thread.
SWIVEL_API uint32_t swivel_block_count(const swivel_crowd* crowd);
SWIVEL_API uint32_t swivel_group_first_limb(const swivel_crowd* crowd, uint32_t group);
SWIVEL_API uint32_t swivel_group_limb_count(const swivel_crowd* crowd, uint32_t group);
// First row of a field in its blocks, and its number of rows: 0 if this crowd does not have the field. Rows of words,
// for results of a crowd with SWIVEL_COMPACT.
SWIVEL_API uint32_t swivel_field_first_row(const swivel_crowd* crowd, swivel_field field);
SWIVEL_API uint32_t swivel_field_row_count(const swivel_crowd* crowd, swivel_field field);

// Direct access to rows: the fast way in and out. Padding lanes of inputs may hold anything and are left alone; those
// of results are overwritten and mean nothing. With SWIVEL_COMPACT results are compact rows, otherwise result rows; the
// other has a null base and no rows.
SWIVEL_API swivel_rows swivel_input_rows(swivel_crowd* crowd);
SWIVEL_API swivel_rows swivel_result_rows(swivel_crowd* crowd);
SWIVEL_API swivel_words swivel_compact_rows(swivel_crowd* crowd);

// Words of COMPACT RESULTS as numbers, the same as swivel_read() gives. A rotation's three words lie word_stride words
// apart, SWIVEL_LANES in compact rows; xyzw is a unit quaternion with w >= 0 as under RESULTS, or four zeros. Words
// that no solve wrote may give a quaternion of another length. Any thread.
SWIVEL_API void swivel_unpack_rotation(const uint16_t* words, size_t word_stride, float xyzw[4]);
// The value of any half float, exactly. Any thread.
SWIVEL_API float swivel_unpack_half(uint16_t word);

// Copies a field of limb_count limbs of one group in from, or out to, the caller's strided data. Each limb has
// consecutive floats, a uint32_t for SWIVEL_FLAGS. first is counted within the group. write takes input fields, read
// takes any. Values must not overlap the crowd's own memory. All fields together cost up to about a solve, less while
// the values are in cache. Rows cost nothing, and a solve with frames does not fetch values twice. Results of a crowd
// with SWIVEL_COMPACT are unpacked to floats and the uint32_t, one limb after the other.
SWIVEL_API swivel_status swivel_write(swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                                      uint32_t limb_count, swivel_in values);
SWIVEL_API swivel_status swivel_read(const swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                                     uint32_t limb_count, swivel_out values);

// The same for positions in double: SWIVEL_TARGET, SWIVEL_POLE and SWIVEL_SHOULDER_POSITION, 3 consecutive doubles for
// each limb. The limb's origin, 3 doubles as well (stride 0: one for all), is subtracted in double and the difference
// rounded to the row's float, once, to nearest; see FAR FROM THE ORIGIN. Null data of origins: nothing is subtracted.
// Poles of a crowd with SWIVEL_POLE_DIRECTION have no origin and are refused with one. A difference no float holds
// becomes infinite, and the limb gets SWIVEL_BAD_INPUT. values and origins may overlap each other, but not the crowd's
// own memory. Fails like swivel_write(), and for fields that are no positions. One thread; no allocation; two to
// three times as long as swivel_write(). The floating-point environment is restored.
SWIVEL_API swivel_status swivel_write_doubles(swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                                              uint32_t limb_count, swivel_in values, swivel_in origins);

// One group's values in the caller's own arrays, as engines keep them. The group's first limb's value is at `data`,
// each next one `stride` bytes further. A value is consecutive floats, a uint32_t for flags, of any alignment. Units
// and meanings are the fields'. A stride beside null data is ignored.
typedef struct swivel_frame {
    size_t size;  // sizeof(swivel_frame), set by swivel_default_frame()
    // With data: target, pole and shoulder_position hold 3 doubles each and are taken from this origin, 3 doubles as
    // well, as by swivel_write_doubles(). A pole that is a direction is doubles, too, but has no origin. A position
    // left out keeps its rows, which must be from the same origin. It may be shoulder_position itself: then all is from
    // the shoulder. Null data: positions are floats. Stride 0: one origin for the whole group.
    swivel_in origin;
    // Inputs, in the order of the fields. Null data: the rows keep what they hold. Stride 0: one value for the group.
    swivel_in target, pole, lengths, shoulder_position, parent_rotation, parent_scale, hand;
    swivel_in effector, angle, incoming_shoulder, incoming_elbow, incoming_wrist, weights, reach, most_swivel;
    swivel_in flexion_limit, shoulder_cone, humeral_twist, shoulder_box;
    swivel_in hand_cone, forearm_twist, hand_twist, wrist_box, aim, clavicle;
    // Results, in the order of the fields. Null data: not written.
    swivel_out shoulder, elbow, wrist, flags, stretch, normal, twist, clavicle_turn;
} swivel_frame;

// Nothing in and nothing out.
static inline swivel_frame swivel_default_frame(void)
{
    swivel_frame frame;
    memset(&frame, 0, sizeof frame);
    frame.size = sizeof frame;
    return frame;
}

// Some of a crowd's blocks.
typedef struct swivel_blocks {
    uint32_t first, count;
} swivel_blocks;

// Some of a crowd's limbs. indices may be null if count is 0.
typedef struct swivel_limbs {
    const uint32_t* indices;
    uint32_t count;
} swivel_limbs;

// What a call of swivel_solve() does. Null means all, or nothing to do; a job of null pointers solves every limb.
typedef struct swivel_job {
    size_t size;  // sizeof(swivel_job), set by swivel_default_job()

    // Which blocks; null for all. Others are neither read nor written. Frames of groups without a block among them are
    // not looked at, but for the first one's size.
    const swivel_blocks* blocks;

    // Which limbs, by at most one of the three; by none, all of these blocks. They get the bits that they would get
    // with all others, which keep their results bit for bit; frames of limbs that are not chosen are neither read nor
    // written. Lists and budgets are for the whole crowd, so they exclude blocks and on_this_thread.
    //
    // By bits: limb i of LAYOUT is bit i % 32 of mask[i / 32]. mask_word_count must be (swivel_block_count() + 1) / 2.
    // Bits of padding lanes, and past the last block, are ignored.
    const uint32_t* mask;
    uint32_t mask_word_count;
    // By a list of limb indices as in LAYOUT: swivel_group_first_limb() + n. Any order; a limb named twice is solved
    // once; an empty list solves nothing. Fails for an index that is out of range or a padding lane, before anything is
    // solved. A list in no order costs some nanoseconds an entry more than bits.
    const swivel_limbs* limbs;
    // By urgency, as swivel_choose() has it: at most so many blocks.
    const swivel_in* priorities;
    uint32_t most_blocks;

    // The caller's own arrays: one frame for each group, in the crowd's order, as far apart as the first one's size.
    // Null: values are in the crowd's rows.
    const swivel_frame* frames;

    // Not 0: solves on the calling thread, never allocates and never uses oneTBB. Such calls may run on several threads
    // at once, for blocks that do not overlap, with the same mask and frames.
    // 0: on the calling thread's oneTBB arena, if built with it and there is enough to do. oneTBB may allocate.
    int on_this_thread;

    // Unless null, becomes how many limbs were solved.
    uint32_t* solved_count;
} swivel_job;

// Every limb, from and to rows.
static inline swivel_job swivel_default_job(void)
{
    swivel_job job;
    memset(&job, 0, sizeof job);
    job.size = sizeof job;
    return job;
}

// Solves limbs; job may be null, for every limb from and to rows. The caller's floating-point environment is restored.
//
// With frames it is a whole frame in one pass: swivel_write() of every input given, the solve, swivel_read() of every
// result given, with the same bits. It takes a few blocks at a time, so that their rows stay in the nearest cache from
// copy to copy. Rows hold inputs and results afterwards. No byte beside the values is read or written. Inputs may
// overlap each other. A limb's inputs are read before its results are written, so its results may overlap its own
// inputs: a pose may be read and written in place. Another limb's inputs may be read later, on any thread. So no limb's
// result may overlap another's input; an input of stride 0 is every limb's. Nor may a result overlap another result, or
// any value the crowd's own memory. It fails for a field that this crowd does not have and for a stride smaller than a
// value. It also fails for results of a crowd with SWIVEL_COMPACT: those are read with swivel_read() or where they lie.
// For arms of characters kept as structures, with SWIVEL_JOINTS, in a crowd of one group:
//     swivel_frame frame = swivel_default_frame();
//     frame.target = (swivel_in){&characters[0].grip, sizeof characters[0]};
//     frame.pole = (swivel_in){&characters[0].elbow_hint, sizeof characters[0]};
//     frame.shoulder = (swivel_out){&characters[0].joints[UPPER_ARM].rotation, sizeof characters[0]};
//     frame.elbow = (swivel_out){&characters[0].joints[FOREARM].rotation, sizeof characters[0]};
//     swivel_job job = swivel_default_job();
//     job.frames = &frame;
//     status = swivel_solve(crowd, &job);
//
// The cost of some limbs goes with their blocks. A block chosen whole takes as long as in a solve of all, one chosen in
// part 1.2 to 3 times as long, one or two limbs of it up to once. So neighbours take their share of the crowd, or
// little more. Picked one by one at random, half of a crowd costs more than all of it. One in ten costs 0.5 to 1 times
// as much as all, up to 2.5 times where few rows come from memory; one in a hundred 0.1 to 0.4 times.
SWIVEL_API swivel_status swivel_solve(swivel_crowd* crowd, const swivel_job* job);

// Chooses limbs by urgency, within a budget; for a crowd with SWIVEL_BUDGET. Blocks are picked, whole, since a limb
// costs about as much as its block: at most most_blocks of them, SWIVEL_LANES limbs each, fewer at a group's end. Each
// call adds the largest priority among a block's limbs to the block's urgency, 0 at creation, and picks the most urgent
// blocks, of equals the lower; the urgency of those picked is 0 again. So over time a block is picked about as often as
// its priority says, blocks of equal priority take turns, and none starves: urgency only grows until it is the largest.
// Limbs of characters that matter together belong side by side. A block whose limbs all have priority 0 is not picked
// in this call and keeps its urgency. Solves without priorities change no urgency.
//
// priorities has one entry for each group, in the crowd's order: one float for each limb, any alignment, stride 0 for
// one priority for the whole group. In any unit: only ratios matter. Above 1e15, and infinity, count as 1e15; below 0
// and NaN as 0. Not kept; must not overlap the crowd's own memory.
//
// Sets the bits of the picked blocks' limbs in mask, which is a job's, and clears all others: for the caller's own
// threads; a job with priorities chooses and solves in one. *chosen_count, unless null, becomes how many limbs these
// are. Who is picked depends on the priorities of this and earlier calls alone: on no CPU, thread or clock. On the
// calling thread, which takes 1 to 3 nanoseconds for each limb of the crowd, picked or not; allocates nothing. Fails
// without SWIVEL_BUDGET, for missing priorities and for a stride below 4 other than 0.
SWIVEL_API swivel_status swivel_choose(swivel_crowd* crowd, const swivel_in* priorities, uint32_t most_blocks,
                                       uint32_t* mask, uint32_t mask_word_count, uint32_t* chosen_count);

// Forgets the swivel carried from solve to solve, of limbs of a group: the next one is not limited by
// SWIVEL_MOST_SWIVEL. Nothing to do in crowds without SWIVEL_WITH_MOST_SWIVEL.
SWIVEL_API swivel_status swivel_reset(swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count);

// The first limb with any of these flags, looked for from limb *limb of group *group on, through all later groups.
// Returns 1 and stores its place; or returns 0 and changes nothing: there is none, or a pointer is null. Limbs that
// were never solved have no flags. To go on, add 1 to *limb. Reads the flags alone; no allocation.
//     for (uint32_t group = 0, limb = 0; swivel_find(crowd, SWIVEL_BAD_INPUT, &group, &limb); ++limb)
//         printf("limb %u of group %u has bad input\n", limb, group);
SWIVEL_API int swivel_find(const swivel_crowd* crowd, uint32_t flags, uint32_t* group, uint32_t* limb);

// Says in a sentence or two why a limb is as it is, of its inputs as they are now. It names the input that is bad, how
// far out of reach the target is, which limit turned the elbow from its wish and by how much, or why none is kept.
// Where the limb's results are not those of its inputs, it says so. It cannot know the step that a swivel carried was
// from. limb is counted within the group. text gets at most size bytes, the 0 at its end among them. For people and
// logs: the words may change, and the last digits differ between C libraries. Takes up to a millisecond; no allocation.
SWIVEL_API swivel_status swivel_explain(const swivel_crowd* crowd, uint32_t group, uint32_t limb, char* text,
                                        size_t size);

// An arc of swivels, as cos and sin of its ends. It turns from one to the other by the right hand about the line from
// shoulder to wrist. 0 is the swivel wished for, as far as SWIVEL_MOST_SWIVEL lets it. The whole circle is one arc with
// equal ends.
typedef struct swivel_arc {
    float from[2], to[2];
} swivel_arc;

// The swivels that a limb's limits allow for its inputs as they are now, which are the next solve's. They are in their
// order around the circle. At most capacity of them are stored, *arc_count says how many there are. None for bad input.
// limb is counted within the group. Takes some microseconds; no allocation.
SWIVEL_API swivel_status swivel_allowed_arcs(const swivel_crowd* crowd, uint32_t group, uint32_t limb, swivel_arc* arcs,
                                             uint32_t capacity, uint32_t* arc_count);

// The joint angles of the results in radians, about the rest pose and the arm frame's axes. Each limb has 7 doubles:
// three of the shoulder in its order, the flexion, three of the wrist, which are 0 without SWIVEL_WITH_HAND. Two
// triples give a rotation. Family 0 has the middle angle within -pi/2..pi/2, family 1 is the other; at its ends the
// last angle is 0. This is an output for people and files: no solve uses it, and its last digits may differ between C
// libraries.
SWIVEL_API swivel_status swivel_joint_angles(const swivel_crowd* crowd, uint32_t group, uint32_t first,
                                             uint32_t limb_count, swivel_euler_order shoulder_order,
                                             swivel_euler_order wrist_order, int family, swivel_out angles);

// Values of limit and step fields, from angles in radians. Any thread; no allocation. All but swivel_turn() fail with
// SWIVEL_INVALID_ARGUMENT, and leave the values alone, for what is not finite or not in the range given here.
// A range from least to most, least <= most, no wider than 2 pi: one of the three of a box, or a twist's.
SWIVEL_API swivel_status swivel_range(double least, double most, float range[4]);
// An axis of any length but zero and the largest angle to it, 0 to pi.
SWIVEL_API swivel_status swivel_cone(const double axis[3], double most, float cone[4]);
// A direction of the character as the axes of limits take it, which are the arm frame's: "forwards and down" becomes
// the axis of a cone. direction: in the world of the rest pose, 1e-15..1e15 long. parent_rotation: of the shoulder's
// parent joint in that world, x, y, z, w. axis becomes unit, and may be direction itself. Fails for a binding that is
// none. The limit then turns with the parent joint. To keep it fixed to the character, call this with the parent's
// rotation of each frame, in the character's axes. A cone within 80 degrees of forwards and down, for one that faces
// +z:
//     const double down_ahead[3] = {0, -1, 1};
//     double axis[3];
//     float cone[4];
//     if (swivel_arm_axis(&binding, parent_rotation, down_ahead, axis) == SWIVEL_OK)
//         swivel_cone(axis, 80 * 3.14159265358979 / 180, cone);
SWIVEL_API swivel_status swivel_arm_axis(const swivel_binding* binding, const float parent_rotation[4],
                                         const double direction[3], double axis[3]);
// The elbow's least and largest flexion, 0 <= least <= most <= pi.
SWIVEL_API swivel_status swivel_flexion(double least, double most, float flexion[2]);
// For SWIVEL_AIM: an axis of the hand, of any length but zero, and the elbow's flexion, 0 to pi.
SWIVEL_API swivel_status swivel_aim(const double axis[3], double flexion, float aim[5]);
// Cosine and sine of an angle, for SWIVEL_ANGLE and SWIVEL_MOST_SWIVEL.
SWIVEL_API void swivel_turn(double angle, float turn[2]);
// The value of SWIVEL_ANGLE or of a limit for the same limb on the body's other side. Mirrored in x, a skeleton's
// offsets and bends are (-x, y, z), its rotations (x, -y, -z, w). swivel_bind() makes an arm frame of it that is the
// mirror image with its x axis turned over. order: of boxes, else ignored. from and to have the field's components and
// may be the same. Values of other input fields are copied: places, hands, effectors, aims and poses are for the caller
// to mirror. Fails for results and for an order that does not exist. Any thread; no allocation.
SWIVEL_API swivel_status swivel_mirror(swivel_field field, swivel_euler_order order, const float* from, float* to);

// Forward kinematics of the results, in double, in the space of the targets, clavicles turned: for each limb 3 doubles
// (elbow, wrist) or 4 (hand rotation; with SWIVEL_WITH_HAND). Outputs whose data is null are left out.
SWIVEL_API swivel_status swivel_forward(const swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count,
                                        swivel_out elbow, swivel_out wrist, swivel_out hand);
// How far the wrist, or the effector, of each limb is from its target; with WITH_AIM, how far the target is from the
// hand's ray. One double each, in arm lengths: upper + fore, scaled. 0 for a limb of no length, NaN for one with bad
// input. Means nothing before the first solve.
SWIVEL_API swivel_status swivel_residuals(const swivel_crowd* crowd, uint32_t group, uint32_t first,
                                          uint32_t limb_count, swivel_out distance);

// The instruction set in use; chosen on first need: the environment's SWIVEL_FORCE_ISA, else the best this CPU runs.
// Null, with swivel_last_error() set, if SWIVEL_FORCE_ISA names one that cannot be used; solving then fails the same
// way. Any thread.
SWIVEL_API const char* swivel_isa_name(void);
// Changes it for the whole process, from the next solve on. Any thread.
SWIVEL_API swivel_status swivel_use_isa(const char* name);
// The built-in instruction sets, best first; null past the last.
SWIVEL_API const char* swivel_isa_at(uint32_t index);
// 1 if this CPU and operating system run it, else 0 (also for unknown names).
SWIVEL_API int swivel_isa_runs(const char* name);

// One line of a self-check: an error measured over many arms against its limit.
typedef struct swivel_check {
    const char* name;  // what is compared, e.g. "production<float>, wrist to target"
    const char* set;   // over which arms, e.g. "reach 5-98 %"
    uint64_t arm_count;
    double max, rms;              // in arm lengths, or as the name says
    double max_limit, rms_limit;  // an rms_limit of 0: not limited
} swivel_check;

// Checks the formulas against each other: the lecture's steps against the dense oracle, production in float against its
// target through forward kinematics, on arm_count random arms in each of five reach bands, ratios 1:1 to 1000:1. Calls
// report once for each check, and for hard poses. *passed becomes 1 if every limit was kept, else 0. Takes about
// a microsecond an arm on one thread; allocates nothing. The same seed gives the same arms everywhere.
SWIVEL_API swivel_status swivel_verify(uint64_t arm_count, uint64_t seed,
                                       void (*report)(const swivel_check* check, void* user), void* user, int* passed);

#ifdef __cplusplus
}
#endif

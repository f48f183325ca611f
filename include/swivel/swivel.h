// SPDX-License-Identifier: MIT
//
// swivel: the arms and legs of crowds. For each limb, a wrist target and an elbow pole go in, and joint rotations come
// out. A solve uses only correctly rounded operations and no trigonometry, so every CPU gives the same bits. This
// header is the whole binary interface. swivel.hpp wraps it for C++. Everything here is experimental until release 1.0.
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
// CONVENTIONS. Lengths are in the caller's unit. Axes are right-handed; docs/engines.md is for engines with others.
// Quaternions are Hamilton's, stored x, y, z, w; a*b applies b first. In the arm frame the shoulder is at the origin. A
// straight limb at rest lies along +z. Flexion turns the forearm towards +y, about -x, so the elbow moves towards -y.
// The elbow lies on the pole's side of the line from shoulder to wrist. swivel_chain's bend says where the forearm
// goes, a pole where the elbow goes, so the two point opposite ways. An arm length is both bones' length, scaled. In
// comments, WORLD means SWIVEL_WORLD, and so on.
//
// ERRORS. A call that fails returns a status and leaves one line in swivel_last_error(). It changes nothing else, but
// swivel_crowd_create() sets *crowd to null.
//
// BODIES. A crowd with a skeleton is one of bodies. A pose goes in, a pose comes out: see swivel_pose. Limb i of every
// group is body i's, so wherever these comments count limbs or blocks of the whole crowd, they count bodies there.
//
// THREADS. Different threads may use different crowds at once. Use one crowd on one thread at a time, with two
// exceptions. Calls that take it const may run together while nothing changes it. Jobs on_this_thread may run together
// on blocks that do not overlap, each in a workspace of its own (swivel_workspace_bytes()).
//
// FLOATING POINT. No call depends on the caller's rounding, flushing of denormals or traps. Each computes, judges and
// writes its line in the usual environment, and restores the caller's with its sticky flags. Callbacks run in the
// caller's. No exception of C++ leaves a call.
//
// STACK. Every call takes at most 32 KiB of stack, so a fibre or thread of 64 KiB is enough for any job. Calls of the
// caller's own functions come on top. So does what oneTBB takes on its own threads.
//
// SIZES. Structures that may grow start with their size. Start each from its swivel_default_ function. A library
// accepts structures of its own header and of older ones, which are shorter. In an array, all have the size of the
// first.
//
// CHECKED BUILDS. Debug builds, and those with SWIVEL_CHECK_USE, refuse more, as far as they can see it. They refuse a
// crowd that is destroyed, and one that two threads use against the rules. They refuse frames whose results overlap
// other limbs' inputs.
//
// Read next: swivel_field for every value's meaning, swivel_bind() for skeletons, and swivel_solve(). The folder docs/
// has guides with pictures; docs/speed.md says what characters and limbs cost.
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
#define SWIVEL_VERSION_MINOR 2
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

// What the flag word of a limb says. Hard poses are results, not errors.
typedef enum swivel_flag {
    // The wrist or effector is at its target or blended target. Without features it is within 1e-6 arm lengths, with
    // features within 3e-6, where effector and clavicle are no longer than half of the arm. With WITH_AIM, the hand's
    // ray goes through the target instead.
    SWIVEL_REACHED = 1u << 0,
    SWIVEL_SOFTENED = 1u << 1,   // in a soft zone of reach, so the wrist is not quite at the target
    SWIVEL_STRETCHED = 1u << 2,  // SWIVEL_STRETCH is above 1
    // The target is too far or too near. The wrist is at the nearest point that bones and limits allow.
    SWIVEL_CLAMPED_FAR = 1u << 3,
    SWIVEL_CLAMPED_NEAR = 1u << 4,
    // The pole, or with POLE_HAND the hand, does not say where the elbow goes. It has no length, or it is on the line
    // to
    // the target: the sine of the angle between them is below 1e-3. Or the target is on the shoulder. The last solve's
    // normal (WITH_MAX_SWIVEL)
    // then says it, or the incoming pose. If neither does, the arm frame's x axis is the normal, or else its y axis.
    SWIVEL_SWIVEL_UNDEFINED = 1u << 5,
    SWIVEL_LIMITED_FLEXION = 1u << 6,  // the elbow's flexion limit keeps the wrist from the target
    // This limit forbids the swivel that was wished for.
    SWIVEL_LIMITED_SHOULDER_CONE = 1u << 7,
    SWIVEL_LIMITED_HUMERAL_TWIST = 1u << 8,
    SWIVEL_LIMITED_SHOULDER_BOX = 1u << 9,
    SWIVEL_LIMITED_HAND_CONE = 1u << 10,
    SWIVEL_LIMITED_FOREARM_TWIST = 1u << 11,
    SWIVEL_LIMITED_HAND_TWIST = 1u << 12,
    SWIVEL_LIMITED_WRIST_BOX = 1u << 13,
    // The swivel wished for is further than SWIVEL_MAX_SWIVEL from the last solve's. With STEP_WINS it is the swivel
    // that limits leave, so the elbow may still be outside of them.
    SWIVEL_LIMITED_STEP = 1u << 14,
    // No swivel is within the limits. This one violates them least; with STEP_WINS it may be on its way there.
    SWIVEL_INFEASIBLE = 1u << 15,
    SWIVEL_JUMPED = 1u << 16,      // joint limits made the swivel turn further than SWIVEL_MAX_SWIVEL
    SWIVEL_PLANTED = 1u << 17,     // the point is locked to its support
    SWIVEL_RELEASED = 1u << 18,    // this solve released it
    SWIVEL_BROKE_AWAY = 1u << 19,  // by distance: the animated point is too far from it, though in contact
    SWIVEL_CUT = 1u << 20,         // a speed too high to be eased away was cut at a lock or release, so the point jumps
    SWIVEL_LIMITED_REGION = 1u << 21,  // the upper arm's region forbids the swivel that was wished for
    SWIVEL_LIMITED_LOOK = 1u << 22,    // a cone holds a joint of a look; those after it may make up for that
    SWIVEL_FADED = 1u << 23,      // the target of a look is behind or too near, so the look counts less or not at all
    SWIVEL_BAD_INPUT = 1u << 30,  // an input is not valid or was never given: see swivel_on_bad_input
    // other bits are kept for later releases and are 0
} swivel_flag;

// The features of a group: a combination of these bits, fixed at creation. Whatever is off costs neither memory nor
// time. SWIVEL_WITH_F adds the field F. SWIVEL_WITH_INCOMING adds the three fields of the incoming pose.
// - POLE_DIRECTION and WITH_CLAVICLE need WORLD. POLE_INCOMING and WITH_WEIGHTS need WITH_INCOMING. WITH_EFFECTOR,
//   WITH_TWIST_BONES, POLE_HAND and limits of the hand need WITH_HAND. At most one of the four POLE_ features is given.
// - WITH_AIM excludes POLE_HAND, WITH_WEIGHTS, WITH_REACH, WITH_FLEXION_LIMIT, limits of the hand, WITH_PLANT,
//   WITH_CAP and WITH_PELVIS_FIT. WITH_CAP excludes WITH_REACH.
// - WITH_CAP needs WITH_INCOMING. What is WITH_PLANT or WITH_PELVIS_FIT is of bodies. WITH_PLANT_ROTATION and
// PLANT_BY_MOTION
//   need WITH_PLANT. WITH_PLANT_ROTATION needs WITH_HAND, too. WITH_NEXT_TARGET needs WITH_PELVIS_FIT.
// - HAND_YIELDS needs WITH_EFFECTOR and excludes WITH_AIM. WITH_GROUND needs WITH_PLANT and WITH_EFFECTOR.
// - WITH_HAND_TRANSFORM and WITH_LINK are of bodies and need WITH_HAND. WITH_LINK excludes WITH_AIM, WITH_PLANT and
//   WITH_PELVIS_FIT.
// - A group that is FIT, PROP or LOOK is no limb: it has none of the other features, and its joints are null. Calls
//   that need a limb refuse it.
// Creating a crowd against these rules is SWIVEL_INVALID_ARGUMENT.
typedef uint64_t swivel_features;
#define SWIVEL_WORLD (UINT64_C(1) << 0)           // targets, poles and hands are in the world; limbs have parents
#define SWIVEL_JOINTS (UINT64_C(1) << 1)          // results are local rotations of the skeleton's joints
#define SWIVEL_WITH_HAND (UINT64_C(1) << 2)       // a wanted hand orientation goes in, a wrist rotation comes out
#define SWIVEL_POLE_DIRECTION (UINT64_C(1) << 3)  // poles are directions, not points
#define SWIVEL_WITH_EFFECTOR (UINT64_C(1) << 5)
#define SWIVEL_WITH_ANGLE (UINT64_C(1) << 6)
#define SWIVEL_POLE_NORMAL (UINT64_C(1) << 7)  // poles are normals of the swivel plane
#define SWIVEL_WITH_INCOMING (UINT64_C(1) << 8)
#define SWIVEL_POLE_INCOMING (UINT64_C(1) << 9)  // no poles: the incoming pose says where elbows go
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
#define SWIVEL_BODY (UINT64_C(1) << 23)  // limb i is body i's: groups of a crowd with a skeleton have it, and its needs
#define SWIVEL_WITH_RECORD (UINT64_C(1) << 24)  // of bodies: keeps what the pose gave, which explain and others need
#define SWIVEL_WITH_PLANT (UINT64_C(1) << 25)   // a point of the hand or foot stands where it touches: swivel_plant
#define SWIVEL_WITH_PLANT_ROTATION (UINT64_C(1) << 26)  // the hand or foot keeps its rotation, too
#define SWIVEL_PLANT_BY_MOTION (UINT64_C(1) << 27)      // no labels: the point's speed and height show its contact
#define SWIVEL_WITH_CAP (UINT64_C(1) << 28)
#define SWIVEL_WITH_PELVIS_FIT (UINT64_C(1) << 29)   // a FIT group shifts the body so that this limb reaches
#define SWIVEL_WITH_NEXT_TARGET (UINT64_C(1) << 30)  // it also prepares for where the limb goes next
#define SWIVEL_FIT (UINT64_C(1) << 31)               // the group is each body's shift, not its limb: swivel_fit
// Where the wrist misses its place, the hand turns about it, no further than it must, to bring the effector nearest to
// its target. So a heel lifts where the leg is too short for the toe.
#define SWIVEL_HAND_YIELDS (UINT64_C(1) << 32)
// Where the hand or foot is after a solve. A group that others are linked to has it by itself.
#define SWIVEL_WITH_HAND_TRANSFORM (UINT64_C(1) << 33)
#define SWIVEL_WITH_LINK (UINT64_C(1) << 34)    // the goal is a grip on another limb's hand, or on a PROP: link
#define SWIVEL_PROP (UINT64_C(1) << 35)         // the group is a thing that hands hold, not a limb: swivel_prop
#define SWIVEL_WITH_GROUND (UINT64_C(1) << 36)  // the foot that is planted stands on ground as it lies: swivel_ground
#define SWIVEL_SENT (UINT64_C(1) << 37)  // its goal is made by the library: WITH_PLANT and WITH_LINK have it themselves
#define SWIVEL_LOOK (UINT64_C(1) << 38)  // the group is joints that turn to a target, not a limb: swivel_look
#define SWIVEL_WITH_REGION (UINT64_C(1) << 39)  // the upper arm stays in a region: swivel_group_def's region
// SWIVEL_MAX_SWIVEL takes precedence over limits: the elbow goes to where they allow it as fast as that lets it.
#define SWIVEL_STEP_WINS (UINT64_C(1) << 43)
// No poles: the wished hand says where elbows go. The elbow lies where it would if the wrist were not bent. Within 20
// degrees of the line from shoulder to wrist a hand hardly says it. WITH_INCOMING, the incoming pose fades in there,
// and along the line it alone counts.
#define SWIVEL_POLE_HAND (UINT64_C(1) << 44)
#define SWIVEL_NO_LIMB (SWIVEL_FIT | SWIVEL_PROP | SWIVEL_LOOK)  // a group of bodies that is no limb has one of these
#define SWIVEL_WITH_TWIST_BONES (UINT64_C(1) << 40)              // times the number of twist bones, 1 to 7

// The inputs and results of a limb. Each comment starts with the number of floats and the feature required. Every limb
// has its own value of each field. A wish is the swivel that pole, hand, angle and incoming pose ask for.
//
// VALID INPUT. A limb with any value that is not valid gets SWIVEL_BAD_INPUT, and its rest pose or the pose it had: see
// swivel_on_bad_input. No other limb changes by a bit. The magnitude of positions and poles is at most 1e15, in the
// world as given and in the arm frame. The norm of a quaternion is 1e-9..1e9; it need not be normalised. The squared
// length of an axis, summed in floats, is 1 within 1e-6. The same holds for each pair of cosine and sine, except
// SWIVEL_ANGLE's. Limits and SWIVEL_MAX_SWIVEL use them as they are. Weights and shares are 0..1. Other bounds are
// given at their fields.
//
// RANGES. A range of angles is four numbers: cos and sin of its middle, cos and sin of its half-width. The half-width
// is 0..pi. swivel_range(), swivel_cone(), swivel_flexion(), swivel_aim() and swivel_cos_sin() make values from angles.
//
// LIMITS are measured from the rest pose with the elbow straightened. All their axes, the hand's too, are given in the
// arm frame; the axes of a skeleton's joints do not matter. swivel_arm_axis() converts a direction of the character. A
// twist is that of swing and twist. For a rotation from rest with vector v and scalar w it is 2 atan2(dot(v, axis), w),
// by the right hand. Its axis is +z, from shoulder to hand, or the one given. It equals none of the Euler angles.
// - If the wish breaks a limit, the solver takes the nearest swivel that keeps all limits. The cosine of a limited
//   angle is off by at most 3e-6, for a twist times (1 + cos swing) / 2. So a cone may be left by 0.14 degrees near 0
//   and 180 degrees. In a box, the sine of the middle angle is off by at most 4e-6. So is the sine of each other angle,
//   times the cosine of the middle one. So near a right angle the middle one may be off by 0.17 degrees, and the others
//   may be free. docs/howto/limits.md has the figures that a search for the worst found.
// - The wrist comes first. If no swivel keeps all limits, the solver takes the one that violates them least, and flags
//   SWIVEL_INFEASIBLE. The violation of a twist is multiplied by (1 + cos swing) / 2. To keep a limit even then, move
//   the target, lower its weight or use WITH_CLAVICLE.
// - A region (WITH_REGION) is one more limit of the upper arm, the same for all limbs of the group.
// - Limits take precedence over SWIVEL_MAX_SWIVEL, and that over the wish. With STEP_WINS the step comes first.
//
// RESULTS. Every quaternion is of unit length within 1.1e-6 and has w >= 0; with WITH_INCOMING it has the sign nearer
// to the incoming one. At w = 0 the first of x, y, z that is not zero is positive. Equal inputs give equal bits on
// every CPU, instruction set, thread count and block range.
//
// Inputs and results are numbered apart, so later releases add to the end of either.
typedef enum swivel_field {
    // 3: where the wrist goes. In the arm frame, or with WORLD in the world. The wrist stays at least 1e-9 arm lengths
    // from the shoulder. A nearer target still counts as reached; one within 1e-15 counts as on the shoulder.
    SWIVEL_TARGET = 0,
    // 3: a point that the elbow leans towards, in the space of the target. With POLE_DIRECTION it is a direction. With
    // POLE_NORMAL it is the normal of the swivel plane: cross(line from shoulder to wrist, direction to the elbow's
    // side). Not with POLE_INCOMING and POLE_HAND.
    SWIVEL_POLE,
    // 2: upper arm and forearm, before the parent's scale. Each is 0 or 1e-15..1e15. If one is shorter than 1e-7 of the
    // other, the elbow counts as straight.
    SWIVEL_LENGTHS,
    // 3, WORLD: where the shoulder itself is, in the world.
    SWIVEL_SHOULDER_POSITION,
    // 4, WORLD: the world rotation of the shoulder's parent joint.
    SWIVEL_PARENT_ROTATION,
    // 1, WORLD: the parent's uniform scale, 1e-15..1e15.
    SWIVEL_PARENT_SCALE,
    // 4, WITH_HAND: the wanted orientation of the hand, in the space of the target. With JOINTS that of the wrist
    // joint.
    SWIVEL_HAND,
    // 3, WITH_EFFECTOR: the target is for this point of the hand instead of the wrist. With JOINTS it is in the wrist
    // joint's own frame. Otherwise it is in the hand's frame, which has the arm frame's axes at rest. It is in the
    // bones' unit, before the parent's scale.
    SWIVEL_EFFECTOR,
    // 2, WITH_ANGLE: cos and sin of an angle by which the elbow is turned away from the pole's side. The turn is about
    // the line from shoulder to wrist, by the right hand. The pair's length is 1e-9..1e9. If the pole does not define
    // the swivel, the last normal or the incoming pose may stand in: the angle is then ignored.
    SWIVEL_ANGLE,
    // 4 each, WITH_INCOMING: the pose so far. The wrist's needs WITH_HAND, too. The elbow's is a whole quaternion, also
    // without JOINTS. With JOINTS they are local rotations. Otherwise the shoulder is in the arm frame, the forearm
    // relative to the upper arm, the hand relative to the forearm. If the pole does not define the swivel, this pose
    // may: see SWIVEL_SWIVEL_UNDEFINED. Each result has the sign nearer to its incoming rotation.
    SWIVEL_INCOMING_SHOULDER,
    SWIVEL_INCOMING_ELBOW,
    SWIVEL_INCOMING_WRIST,
    // 3, WITH_WEIGHTS: the weights of position, hand and pole. 0 keeps the incoming pose, 1 takes the goal. That of the
    // position blends places of the wrist: with an effector, at 0 and a hand weight of 1, the wrist stays and the
    // effector turns about it.
    SWIVEL_WEIGHTS,
    // 4, WITH_REACH: far soft zone, near soft zone, most stretch 1..1000, least distance. Zones and distance are shares
    // of both bones' length. Let R be the far end of the reach and s the far zone. A wanted distance d from R - s to R
    // + s becomes d - (d - R + s)^2 / (4 s). A larger distance becomes R. The near end mirrors this. A zone is at most
    // half of the range between the two ends. Stretch then lengthens the bones to close the gap, up to its most.
    SWIVEL_REACH,
    // 2, WITH_MAX_SWIVEL: cos and sin of how far the swivel may turn in one solve, 0..pi. See SWIVEL_NORMAL. Where a
    // pose has a time, that is in a 60th of a second: the tangent of half of the angle goes with time, and at 0 the
    // plane stays.
    SWIVEL_MAX_SWIVEL,
    // 2, WITH_FLEXION_LIMIT: cos of half the least flexion, cos of half the largest. Flexion does not depend on the
    // swivel. So this limit narrows the reach, and the wrist stops short.
    SWIVEL_FLEXION_LIMIT,
    // 4, WITH_SHOULDER_CONE: unit axis; cos of the upper arm's largest angle to it.
    SWIVEL_SHOULDER_CONE,
    // 4, WITH_HUMERAL_TWIST: range of the upper arm's twist about itself.
    SWIVEL_HUMERAL_TWIST,
    // 12, WITH_SHOULDER_BOX: ranges of the shoulder's three Euler angles, in the group's shoulder_order.
    SWIVEL_SHOULDER_BOX,
    // 4, WITH_HAND_CONE: unit axis of the hand; cos of its largest angle to the forearm.
    SWIVEL_HAND_CONE,
    // 4, WITH_FOREARM_TWIST: range of the hand's twist about the forearm.
    SWIVEL_FOREARM_TWIST,
    // 7, WITH_HAND_TWIST: unit axis of the hand; range of its twist about it.
    SWIVEL_HAND_TWIST,
    // 12, WITH_WRIST_BOX: ranges of the wrist's three Euler angles, in the group's wrist_order.
    SWIVEL_WRIST_BOX,
    // 5, WITH_AIM: unit axis of the hand, in the effector's frame; cos and sin of half the flexion.
    // - The elbow keeps that flexion. SWIVEL_HAND is then relative to the forearm, or with JOINTS the wrist's local
    //   rotation, and the wrist keeps it. Without WITH_HAND the hand is at rest.
    // - The shoulder turns until a ray goes through the target. The ray starts at the effector, or else at the wrist,
    //   and runs along the axis. The elbow lies on the pole's side of the line from shoulder to target.
    // - If the target is too near for the flexion, the limb gets SWIVEL_CLAMPED_NEAR. The ray's point nearest to the
    //   shoulder then lies on the line from shoulder to target.
    // - If the elbow crosses that line between solves, the arm rolls over, whatever SWIVEL_MAX_SWIVEL says.
    SWIVEL_AIM,
    // 4, WITH_CLAVICLE: the shoulder's place in its parent joint's frame, in the bones' unit; a share. Give the
    // parent's
    // rotation as without this feature. The parent turns about its own origin, from which the shoulder's place is
    // counted. It turns towards the target by about share * position weight * the angle between clavicle and target.
    // Limits, rotations and results of the arm are relative to the parent as turned. For shares below 1 the turn is
    // continuous; it fades for targets on the other side of the body. Of bodies 1, the share alone: see swivel_pose.
    SWIVEL_CLAVICLE,
    // 1, WITH_PLANT without PLANT_BY_MOTION: the label of contact. Above 0.5 the point is in contact. 0..1.
    SWIVEL_CONTACT,
    // 3, WITH_CAP: how far the limb may reach, in shares of both bones' length, each 0..1. It reaches as far as the
    // incoming pose has it, or least if that is more, and margin beyond. So no limb gets straighter than animated by
    // more than that. An eased zone as wide as the margin, or zone if that is more, lies before the
    // end. So a zone wider than the margin eases what the incoming pose reaches, too. In the order margin, least, zone.
    // They start as 0.01, 0.9, 0: legs that are animated bent may still stretch far enough to stand.
    SWIVEL_CAP,
    // 1, WITH_PELVIS_FIT: how much the limb's goal counts, 0..1. At 0 it does not. At 1, as at the start, it must
    // reach.
    SWIVEL_PELVIS_FIT_WEIGHT,
    // 3, WITH_NEXT_TARGET: where the wrist or effector goes next, such as a swinging foot's next step, in the space of
    // the
    // target.
    SWIVEL_NEXT_TARGET,
    // 1, WITH_NEXT_TARGET: the seconds until then, 0 or more. It counts the more the nearer it is, whatever the weight:
    // see
    // swivel_fit. At the start 1e15, so it does not. Write that for a foot that stands.
    SWIVEL_NEXT_TIME,
    // 1, FIT: the shift that is wished for, at most 1e15 either way; 0 at the start.
    SWIVEL_SHIFT_WISH,
    // 3, WITH_GROUND: a point of the ground below the foot, in the space of the target. Sample it at SWIVEL_PROBE. NaN,
    // as at the start: no ground is known there.
    SWIVEL_GROUND,
    // 3, WITH_GROUND: its normal there, of length 1e-9..1e9. Ground steeper than 87 degrees counts as none.
    SWIVEL_GROUND_NORMAL,
    // 1, WITH_GROUND: how far the foot turns with the ground, 0..1. 1 at the start.
    SWIVEL_GROUND_WEIGHT,
    // 7, WITH_LINK: the place of this limb's wrist or effector, 3, and its hand's rotation, 4. They are in the frame of
    // what it is linked to. Of a limb that is the wrist joint's, and places are in the bones' unit. Of a PROP they are
    // in the world's unit.
    SWIVEL_GRIP,
    // 3, PROP: where it is, in the space of the targets; with a joint, in that joint's frame, in the world's unit, and
    // in floats whatever the root is.
    // NaN, as at the start: as swivel_prop says.
    SWIVEL_PROP_POSITION,
    // 4, PROP: its rotation, in the world or the joint's frame. NaN, as at the start: as swivel_prop says.
    SWIVEL_PROP_ROTATION,
    // 1, PROP: which hand says where it is, 0..1. At 0, as at the start, the first that is linked to it, at 1 the
    // other; in between both.
    SWIVEL_HAND_BLEND,
    // 1, PROP: how much place and rotation count that are given or are the joint's, 0..1. 1 at the start. At 0 it is as
    // the hands have it, in between it lies between both.
    SWIVEL_PROP_WEIGHT,
    // 3, LOOK: what to look at, in the space of the targets. NaN, as at the start: nothing, so the chain goes back to
    // its incoming pose.
    SWIVEL_LOOK_TARGET,
    // 1, LOOK: how much of the turn to the target is taken, 0..1. 1 at the start.
    SWIVEL_LOOK_WEIGHT,
    SWIVEL_INPUT_END,  // one past the last input of this release

    // 4: the shoulder's rotation. In the arm frame, or with JOINTS the joint's local one.
    SWIVEL_SHOULDER = 256,
    // Without JOINTS 2: cos and sin of half the flexion, both >= 0, of the quaternion (-sin, 0, 0, cos). With JOINTS 4:
    // the elbow joint's local rotation.
    SWIVEL_ELBOW,
    // 4, WITH_HAND: the hand relative to the forearm, or with JOINTS the wrist joint's local rotation. The hand's
    // orientation is parent * shoulder * elbow * wrist, where no joints are in between.
    SWIVEL_WRIST,
    // 1: bits of swivel_flag, as uint32_t.
    SWIVEL_FLAGS,
    // 1, WITH_REACH: the factor for both bone lengths, 1 or more.
    SWIVEL_STRETCH,
    // 3, WITH_MAX_SWIVEL: unit normal of the swivel plane, in the arm frame. The next solve makes it perpendicular to
    // its own line from shoulder to wrist. SWIVEL_MAX_SWIVEL limits the turn from there. Bad input clears it, unless
    // the group keeps poses. swivel_reset() clears it, too: call it after a teleport. Without this feature, results
    // depend on the present inputs alone, but for poses that are kept. The swivel is still continuous, with three
    // exceptions. The target crosses the shoulder, the pole crosses the line from shoulder to wrist, or the nearest
    // allowed swivel changes sides.
    SWIVEL_NORMAL,
    // 4 n, WITH_TWIST_BONES * n: the rotations of n bones that share the hand's twist about the forearm. Bone i of 1..n
    // turns by i / (n + 1) of it, within 0.12 degrees. With JOINTS and a binding of these bones (swivel_bind_joints())
    // they are local rotations. With a chain's binding, a local rotation is this quaternion times the rest rotation.
    // Without JOINTS it is this quaternion in the arm frame. Of bodies it is what each turns by from its incoming
    // rotation, about the forearm.
    SWIVEL_TWIST_BONES,
    // 4, WITH_CLAVICLE: the turn of the parent joint. Its rotation, in the world or local, becomes the old one times
    // this.
    SWIVEL_CLAVICLE_ROTATION,
    // 22, WITH_RECORD: how a body's limb came, from its pose and after the clavicle's turn. The shoulder's place, 3, in
    // the space of the target; the arm frame's rotation in the world, 4; the parent's scale; both lengths, as they
    // counted. Then the incoming pose, 4 each: the upper arm in the arm frame, the forearm relative to it, the hand
    // relative to the forearm; WITH_AIM the hand that is aimed. It is written for bad input, too, also in groups that
    // keep poses: then the scale is NaN where the pose is bad. Frames that a limb keeps do not get it.
    SWIVEL_RECORD,
    // 11, WITH_PLANT: how the point stands, in the support's frame. Its anchor while it is locked, otherwise the last
    // animated place, 3. The offset that fades, 3, and its velocity, 3. The seconds until it is gone. Last a number: 0
    // before the first solve, else 8, plus 1 if locked, 2 if the next label locks it, 4 if it was just released.
    SWIVEL_PLANT,
    // 10, WITH_PLANT_ROTATION: the same of the rotation: a quaternion, 4, then offset, 3, and velocity, 3, of the axis
    // times the tangent of half the angle.
    SWIVEL_PLANT_ROTATION,
    // 4, PLANT_BY_MOTION: the point's last animated place in the support's frame, 3, and 1 if it was in contact.
    SWIVEL_CONTACT_STATE,
    // 7, SENT and WITH_RECORD: where the wrist or effector was sent, 3, in the space of the target, and the hand's
    // rotation in the world, 4.
    SWIVEL_SOLVED_GOAL,
    // 3, FIT: the shift of the body along the crowd's axis `up`, in the world's unit; its rate a second; and 1 once it
    // has begun.
    SWIVEL_SHIFT,
    // 3, WITH_GROUND: where to sample the ground for the foot, in the space of the target: above or below this point.
    SWIVEL_PROBE,
    // 9, WITH_GROUND: how far the ground lifts the animated foot along `up`, in the world's unit; its rate a second;
    // and 1 once it has begun. Then the normal that the foot turns with, in the world, of any length, 3; its rate, 3.
    SWIVEL_LIFT,
    // 7, WITH_HAND_TRANSFORM: where the wrist joint is after the solve, 3, in the space of the target, and its rotation
    // in
    // the world, 4. Bones are as long as SWIVEL_LENGTHS says, also where weights of 0 keep the pose, or stretched. It
    // is NaN beyond 1e15, and after bad input but for a good pose that stays.
    SWIVEL_HAND_TRANSFORM,
    // 7, PROP: where it is, 3, in the space of the targets, and its rotation in the world, 4.
    SWIVEL_PROP_TRANSFORM,
    // 6, LOOK: the line of sight after the solve: its start, 3, in the space of the targets, and its direction in the
    // world, 3, of unit length.
    SWIVEL_SIGHT,
    // 25, LOOK: how the look has turned its joints. 1 once it has been solved, else 0. Then 3 for each joint, 0 without
    // a rate: the axis of its turn times the tangent of a quarter of its angle, in the last joint's incoming frame.
    SWIVEL_LOOK_TURNS,
    SWIVEL_RESULT_END  // one past the last result of this release
} swivel_field;

enum { SWIVEL_MAX_TWIST_BONES = 7 };  // of one limb

// What becomes of a field.
typedef enum swivel_field_kind {
    SWIVEL_FIELD_INPUT,    // the caller writes it
    SWIVEL_FIELD_RESULT,   // a solve writes it
    SWIVEL_FIELD_CARRIED,  // a result that the next solve of the limb starts from; swivel_reset() clears it
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
    uint32_t reserved;         // 0
} swivel_field_info;

// Describes a feature or a field: number `index`, from 0, in the order of their numbers. Returns 1; or returns 0 and
// changes nothing: there is none, or info is null. For bindings and tools that know all of them. Any thread.
SWIVEL_API int swivel_describe_feature(uint32_t index, swivel_feature_info* info);
SWIVEL_API int swivel_describe_field(uint32_t index, swivel_field_info* info);
// The numbers in a value of a field, in groups with these features: floats, or the one uint32_t of SWIVEL_FLAGS. 0 if
// they do not have it, or there is no such field. Any thread.
SWIVEL_API uint32_t swivel_component_count(swivel_field field, swivel_features features);
// The name of the lowest bit of a flag word, such as "REACHED"; null for a bit that is none. Any thread.
SWIVEL_API const char* swivel_flag_name(uint32_t flags);

typedef struct swivel_in {
    const void* data;  // null only for zero limbs
    size_t stride;     // bytes from one limb's value to the next; 0: one value for all limbs. Any alignment.
} swivel_in;

typedef struct swivel_out {
    void* data;     // null only for zero limbs
    size_t stride;  // bytes; at least the value's size. Any alignment.
} swivel_out;

// Maps the arm frame to a skeleton's joints. It holds unit quaternions (x, y, z, w), the rest pose and the bone
// lengths. Made by swivel_bind() or swivel_bind_joints().
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

// A shoulder, elbow and wrist joint at rest, as a skeleton stores them.
typedef struct swivel_chain {
    size_t size;                 // sizeof(swivel_chain), set by swivel_default_chain()
    float shoulder_rotation[4];  // rest rotation of the shoulder joint relative to its parent joint
    float elbow_rotation[4];     // rest rotation of the elbow joint relative to the shoulder joint
    float wrist_rotation[4];     // rest rotation of the wrist joint relative to the elbow joint
    float elbow_offset[3];       // elbow's place in the shoulder joint's frame
    float wrist_offset[3];       // wrist's place in the elbow joint's frame
    // Where flexion carries the forearm, in the shoulder joint's frame: mostly forwards for an arm, backwards for a
    // leg. For a direction f in the world and the joint's world rotation q at rest, it is conjugate(q) * f * q. It need
    // not be perpendicular to the bones. Its length is at most 1e15. If it is shorter than 1e-15, such as zero, the
    // rest pose says where the limb bends. That pose must then be bent by more than 10 degrees.
    float bend[3];
    float reserved;  // 0
} swivel_chain;

// Joints that are not turned at rest; bones and bend are still to be given.
static inline swivel_chain swivel_default_chain(void)
{
    const swivel_chain chain = {sizeof(swivel_chain), {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0}, {0}, {0}, 0};
    return chain;
}

// A skeleton at rest. Joints are named by index, in any order; every stride is at least a value's size.
typedef struct swivel_skeleton {
    size_t size;             // sizeof(swivel_skeleton), set by swivel_default_skeleton()
    swivel_in parents;       // an int32_t for each joint: its parent, or -1 for a root
    swivel_in rotations;     // x, y, z, w relative to the parent; null data: no joint is turned at rest
    swivel_in translations;  // 3 floats: the joint's place in its parent's frame. Scales must already be applied
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

// Which joints of a skeleton are a limb. The elbow is below the shoulder, the wrist below the elbow. Joints in between
// keep their rest rotations: they are part of the bone.
typedef struct swivel_limb_joints {
    size_t size;  // sizeof(swivel_limb_joints), set by swivel_default_limb_joints()
    uint32_t shoulder, elbow, wrist;
    // Joints that share the hand's twist, listed from elbow to wrist, at most SWIVEL_MAX_TWIST_BONES. Each is below
    // the elbow and not below the wrist. None of them is above another or above the wrist, which would be turned along.
    uint32_t twist_bone_count;
    const uint32_t* twist_bones;
    float bend[3];   // as swivel_chain's: in the shoulder joint's frame
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

// What a limb with bad input gets, besides SWIVEL_BAD_INPUT.
typedef enum swivel_on_bad_input {
    SWIVEL_REST_POSE,  // its rest pose; what it carries from solve to solve is cleared
    // Its results stay as they are, and so do its values in frames: only its flags are written. What it carries stays.
    SWIVEL_KEEP_POSE,
} swivel_on_bad_input;

// How the limbs of a group with SWIVEL_WITH_PLANT stand. A point is planted: the effector, or without one the wrist.
// The incoming pose says where it is, so no target and no hand is given; one that is written counts instead of the
// pose's. While it is in contact, it is locked to its support, and moves by no bit in the support's frame. A label
// makes it lock where it is. It comes to rest within `stop_time`. Without contact, or once the animation has left it by
// more than `unlock_radius`, it is released, and goes back to the animation within `release_time`. Its way and its
// speed are continuous, also where one change interrupts another. Without WITH_PLANT_ROTATION the hand or foot keeps
// its incoming rotation in the world, with it that is planted, too.
//
// Lengths are in limb lengths: both bones of the skeleton at rest, times the root's scale. Times are in seconds.
// The page docs/howto/feet.md has pictures. The pose has the time and the support (swivel_pose). Source: our own, after
// D. Holden, Inverse Kinematics and Foot Locking (2026).
typedef struct swivel_plant {
    float lock_radius;    // it locks only within this of the animated point. A speed that is eased away adds at most as
                          // much
    float unlock_radius;  // it is released if the animated point is further than this from it; no less than lock_radius
    float stop_time;      // a point that locks is at rest after this time
    float release_time;   // a point that is released is with the animation again after this time
    float
        relock_speed;   // limb lengths a second: after a release by distance it locks anew if it is slower; 0: never so
    float anchor_lead;  // 0: the anchor is where the point locks. 1: where it would come to rest by itself. 0.5 slides
                        // least
    float reset_time;   // a body that was not solved for longer than this starts anew; 0: it never does
    // With PLANT_BY_MOTION: the speed, in limb lengths a second, and the height of the point over the root, along `up`,
    // that bound a contact. First to begin, then to go on. Below both it is in contact.
    float speed[2], height[2];
} swivel_plant;

static inline swivel_plant swivel_default_plant(void)
{
    const swivel_plant plant = {0.12f, 0.24f, 0.1f, 0.2f, 0.06f, 0.5f, 0, {0.6f, 0.8f}, {0.08f, 0.1f}};
    return plant;
}

// How a group with SWIVEL_FIT shifts a body along the crowd's axis `up`, such as the pelvis of a character, so that its
// limbs WITH_PELVIS_FIT reach. The shift is the nearest to the wish from which all do. Where there is none, it is the
// middle between those that conflict. It is eased by a critically damped spring. The group's flags are REACHED where
// some shift within drop and rise lets all limbs that count reach, and CLAMPED_FAR where none does. Limbs are solved
// for a root that is shifted. The result SWIVEL_SHIFT says by how much: add it to the root's place along `up`, or to
// that of the pelvis. Places of joints are from the shifted root. Solve the group together with all limbs of its
// bodies. A job without the group solves them for a root that is not shifted. A job without some limbs does not know
// what these ask for. What counts is the reach of bones and cap; a flexion limit narrower than that may still keep a
// limb short. Limbs are of two bones; legs of more are not fitted.
typedef struct swivel_fit {
    float drop, rise;  // the most down and up, in limb lengths of the first group WITH_PELVIS_FIT: see swivel_plant
    float half_life;   // s: the time in which about half of a distance is made up
    float lookahead;   // s: from when on a coming target counts. At 0 s it counts whole, before by a parabola
} swivel_fit;

static inline swivel_fit swivel_default_fit(void)
{
    const swivel_fit fit = {0.1f, 0.05f, 0.1f, 0.3f};
    return fit;
}

// How feet of a group with SWIVEL_WITH_GROUND stand on ground that is not flat. The effector is the toe, or the ball of
// the foot. The caller gives a plane for each foot: SWIVEL_GROUND and its normal, sampled at SWIVEL_PROBE. Where no
// ground is known, the foot goes as it is animated.
//
// - The animated foot is raised or lowered by how far the ground is from the root's level: from the plane through the
//   root's place, across `up`. A spring eases that.
// - A point that locks does so at toe_clearance over the plane, where it stays.
// - No toe is sent below toe_clearance over its plane, no heel of a planted foot below heel_clearance. In the air the
//   heel's plane has the eased normal. For its heel the foot turns about the toe. With SWIVEL_HAND_YIELDS the foot also
//   turns where the leg is too short, and its toe stays over the plane.
// - The foot turns by what carries `up` to the ground's normal, times SWIVEL_GROUND_WEIGHT, up to an angle. A spring
//   eases the normal while the foot is not planted.
//
// Clearances are heights over the plane, in the bones' unit. Source: our own.
typedef struct swivel_ground {
    float heel[3];  // a point of the sole, in the wrist joint's frame, in the bones' unit; at 0 it is the wrist itself
    float toe_clearance, heel_clearance;  // of effector and heel where they stand: 0 if both are on the sole
    float cos_max;                        // cosine of the angle that the foot turns at most, 0..1
    float half_life;                      // s: the time in which about half of a lift or a slope is made up
} swivel_ground;

static inline swivel_ground swivel_default_ground(void)
{
    const swivel_ground ground = {{0, 0, 0}, 0, 0, 0.8f, 0.05f};
    return ground;
}

// How a group with SWIVEL_PROP lies: a thing that one hand or two hold, such as a rifle, a steering wheel or a ladder.
// Limbs are linked to it, and their grips are on it. Its place, and apart from that its rotation, are
// - SWIVEL_PROP_POSITION and SWIVEL_PROP_ROTATION, where they are given;
// - or else the joint's, if there is one: as posed, and shifted with the body. No limb may turn it;
// - or else as the hands have it in the incoming pose, each by its grip: SWIVEL_HAND_BLEND says which hand. Targets and
//   hands that are written for these limbs count instead of the pose's. A hand that says alone where it is keeps its
//   goal to the bit.
// SWIVEL_PROP_WEIGHT is how much of the first two counts, against the third.
//
// Then it moves as little as it must so that all hands on it reach their grips, up to max_move. What counts is the
// reach of bones, flexion limit, cap and soft zone. A hand with a position weight of 0 asks for nothing. The flags are
// REACHED where all hands reach, and CLAMPED_FAR where not: then it is where the worse hand misses least, or max_move
// on its way there. Nothing moves for a grip that is nearer to the shoulder than bones, flexion limit and least
// distance let the arm get: the flag is then CLAMPED_NEAR. Bad input leaves SWIVEL_PROP_TRANSFORM as it was. Source:
// our own.
typedef struct swivel_prop {
    int32_t joint;   // of the skeleton; -1: none
    float max_move;  // in limb lengths of the first limb that is linked to it; 0: it stays, as a ladder does
} swivel_prop;

static inline swivel_prop swivel_default_prop(void)
{
    const swivel_prop prop = {-1, 1};
    return prop;
}

enum { SWIVEL_MAX_LOOK_JOINTS = 8 };  // of a look

// How a group with SWIVEL_LOOK looks: a chain of 1 to 8 joints, such as spine, neck and head, turns so that a line of
// sight in the last one meets SWIVEL_LOOK_TARGET. Each joint lies below the one before; joints in between turn along.
//
// - From the first to the last, each joint turns by its share of what is left of the turn, and by no more than its cone
//   allows from its incoming rotation. The last one takes the rest, so it meets the target exactly where its cone
//   allows. A target nearer to that joint than the line of sight passes cannot be met. SWIVEL_LOOK_WEIGHT scales the
//   turns.
// - The turn fades out as the target goes behind: from the angle of cos_full to that of cos_none, between the incoming
//   line of sight and the line to the target. It also fades as the target comes nearer to the eye than `fade_distance`.
//   So nothing flips, and straight behind the pose is the incoming one.
// - The turns are eased: the one by which the last joint differs from its incoming rotation changes by at most `rate`,
//   whatever SWIVEL_LOOK_TARGET, SWIVEL_LOOK_WEIGHT and fades do. So a new target takes time. The first solve begins at
//   the target. swivel_reset() lets it begin anew: call it after a teleport.
//
// A body's looks come after its shift and before its props and limbs, in the order of their groups. So a limb may hang
// below a look, as an arm does below the spine: it is solved from where the look has turned its shoulder, and its
// incoming pose turns along. So solve a look in one job with what hangs below it. What is planted or fits asks for its
// place before. A look may hang below an earlier look, as an eye does below the head: let the head aim the point
// between the eyes. No look hangs below a limb. One joint is the aim of a turret or a weapon.
//
// The flags are REACHED where the line meets the target within 1e-4 rad, LIMITED_LOOK, LIMITED_STEP where the rate
// holds the line back, and FADED. Bad input keeps the incoming pose and leaves SWIVEL_SIGHT as it was. Source: our own.
typedef struct swivel_look {
    uint32_t joint_count;                     // 1 to 8
    uint32_t joints[SWIVEL_MAX_LOOK_JOINTS];  // of the skeleton, from the first to the last
    float share[SWIVEL_MAX_LOOK_JOINTS];      // of the turn, of any sum: 0 or more, the last one's more than 0
    float cos_max[SWIVEL_MAX_LOOK_JOINTS];    // cosine of the angle that each joint turns at most, -1..1
    float eye[3];                             // where the line of sight starts, in the last joint's frame, in its unit
    float axis[3];                            // where it points, in the last joint's frame, of any length but 0
    float cos_full, cos_none;                 // cosines of angles: cos_full is more than cos_none
    float fade_distance;                      // in the last joint's unit, 0 to 1e15
    float rate;                               // radians a second; 0: turns are not eased
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

// REACH REGIONS: where the upper arm may point. A region is a union of parts, each an intersection of half-spaces.
// Forbidden cones are cut out of all parts. Directions are in the arm frame at rest, like SWIVEL_SHOULDER_CONE's axis;
// swivel_arm_axis() converts those of the character. Start with an empty region, which allows nothing, then add to it
// and forbid, in any order: swivel_region_add_cones() and the calls after it. A call that fails leaves the region as it
// was. Any thread; no allocation.
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
    swivel_binding binding;  // with SWIVEL_JOINTS every limb uses it, and starts with its lengths; ignored without
    const swivel_limb_joints* joints;  // of bodies: which joints the limb has. Null in crowds of free limbs; copied
    swivel_plant plant;                // WITH_PLANT
    swivel_fit fit;                    // FIT
    swivel_ground ground;              // WITH_GROUND
    swivel_prop prop;                  // PROP
    // WITH_LINK: the group that this one holds. Its wrist or effector goes to SWIVEL_GRIP on it. It is a PROP; or an
    // earlier group, which is another limb's hand or foot, as the same solve leaves it, after its clamps and limits.
    // Then this group's target and hand are not read. Solve both in one job.
    uint32_t link;     // UINT32_MAX: none
    swivel_look look;  // LOOK
    // WITH_REGION: where the upper arm may point, with the elbow straightened at rest. It allows something. Null
    // without the feature; copied.
    const swivel_region* region;
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
    // Memory comes from the first of these that is set. 1: memory, the caller's own, aligned to 64 bytes and
    // swivel_crowd_bytes() long, which the caller frees after destroy. 2: allocate, whose results are aligned to 64
    // bytes. 3: the C library.
    void* memory;
    size_t memory_bytes;
    void* (*allocate)(size_t bytes, size_t alignment, void* user);
    void (*release)(void* memory, size_t bytes, void* user);
    void* user;
    // Null: free limbs. Otherwise a crowd of bodies, which all have this skeleton; it is copied. Every group then names
    // joints and has a limb of each body: see swivel_pose.
    const swivel_skeleton* skeleton;
    uint32_t body_count;  // with a skeleton 1 or more, else 0
    float up[3];          // of bodies, in the root's frame, of any length but 0: the axis of heights and shifts
} swivel_crowd_def;

typedef struct swivel_crowd swivel_crowd;

// A group's memory. One lane is one limb. A block is 16 limbs, a row is one component of a block: 16 floats, 64 bytes,
// aligned to 64. Row r of limb i of the group is base[((i / 16) * row_count + r) * 16 + i % 16], on every CPU. Rows lie
// in the order of swivel_field. Fields that the group lacks have no rows. Lanes past the group's end are padding.
typedef struct swivel_rows {
    float* base;           // borrowed from the crowd, valid until it is destroyed
    uint32_t block_count;  // of the group
    uint32_t row_count;
} swivel_rows;

// The version the library was built as: compare with SWIVEL_VERSION. Any thread.
SWIVEL_API uint32_t swivel_version(void);
// What a status means, in a few words. Any thread.
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
// Makes a crowd. It allocates memory once. Later calls allocate nothing, but oneTBB may inside solves that use it. On
// failure *crowd is null. What has no sensible default starts as NaN: a limb that never gets it is SWIVEL_BAD_INPUT.
// These are targets, shoulder positions, poles of bodies, and bone lengths where no binding has them. Other poles start
// as (0, -1, 0), parent and hand as the identity. All else starts neutral: no turn, weights 1, every limit wide open.
// Results start as the rest pose, without flags.
SWIVEL_API swivel_status swivel_crowd_create(const swivel_crowd_def* def, swivel_crowd** crowd);
// Frees what create allocated. Null is allowed. A checked build leaves a crowd that another thread uses as it is, and
// swivel_last_error() says so.
SWIVEL_API void swivel_crowd_destroy(swivel_crowd* crowd);

// The alignments of a limb from its rest pose, and its two bone lengths. Start binding from swivel_default_binding():
// its size says how much is written. Any thread; no allocation. It fails for a zero or non-finite quaternion, a bone of
// no length, and a binding without its size. It fails for a bend parallel to the upper arm, and for one that turns the
// forearm about itself. Without a bend it fails for a rest pose bent by 10 degrees or less.
SWIVEL_API swivel_status swivel_bind(const swivel_chain* chain, swivel_binding* binding);

// swivel_bind() of a limb in a skeleton. Local rotations are relative to the joint's own parent, as the skeleton has
// them. It reads the joints from wrist and twist bones up to the shoulder, and parents up to the root. Other joints are
// ignored. Any thread; no allocation. It fails as swivel_bind() does. It also fails for joints that do not exist or are
// no limb. It fails for parents that do not exist or form a circle, and for twist bones that are not in order.
SWIVEL_API swivel_status swivel_bind_joints(const swivel_skeleton* skeleton, const swivel_limb_joints* joints,
                                            swivel_binding* binding);

// The crowd's shape. Each group starts a block. Masks and lists count limbs through the whole crowd, padding lanes
// included. Limb n of a group has the number swivel_group_first_limb() + n. A group's first number is a multiple of
// SWIVEL_LANES. A group that does not exist has 0 limbs and no features. For a null crowd these calls and the next four
// give 0 or null rows. Any thread.
SWIVEL_API uint32_t swivel_group_count(const swivel_crowd* crowd);
SWIVEL_API uint32_t swivel_block_count(const swivel_crowd* crowd);
SWIVEL_API uint32_t swivel_group_first_limb(const swivel_crowd* crowd, uint32_t group);
SWIVEL_API uint32_t swivel_group_limb_count(const swivel_crowd* crowd, uint32_t group);
SWIVEL_API swivel_features swivel_group_features(const swivel_crowd* crowd, uint32_t group);
// The first row of a field within each block of a group, and its number of rows. Both are 0 if the group does not have
// the field.
SWIVEL_API uint32_t swivel_field_first_row(const swivel_crowd* crowd, uint32_t group, swivel_field field);
SWIVEL_API uint32_t swivel_field_row_count(const swivel_crowd* crowd, uint32_t group, swivel_field field);

// Direct access to a group's rows: the fast way in and out. Padding lanes of inputs may hold anything and are left
// alone; those of results are overwritten and mean nothing.
SWIVEL_API swivel_rows swivel_input_rows(swivel_crowd* crowd, uint32_t group);
SWIVEL_API swivel_rows swivel_result_rows(swivel_crowd* crowd, uint32_t group);

// swivel_write() copies a field of limb_count limbs of one group from the caller's strided data; swivel_read() copies
// it back. Each limb has consecutive floats, a uint32_t for SWIVEL_FLAGS. first is counted within the group.
// swivel_write() takes inputs, and what is carried, so that a saved state can be set back. A NaN in what is carried
// stays until swivel_reset(). swivel_read() takes any field. Values must not overlap the crowd's own memory. Copying
// all fields takes up to about as long as a solve, less while the values are in cache. Writing to rows needs no copy,
// and a solve with frames fetches each value once.
SWIVEL_API swivel_status swivel_write(swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                                      uint32_t limb_count, swivel_in values);
SWIVEL_API swivel_status swivel_read(const swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                                     uint32_t limb_count, swivel_out values);

// Results depend on differences of positions only, but a float 1e7 units from the origin is good to half a unit. So
// positions far from the origin may be given as doubles. An origin near the limb is subtracted in double before they
// are rounded to floats. The positions of a limb (SWIVEL_TARGET, SWIVEL_POLE unless a direction,
// SWIVEL_SHOULDER_POSITION, SWIVEL_NEXT_TARGET, SWIVEL_GROUND, and SWIVEL_PROP_POSITION of a prop without a joint) must
// be given from the same origin. Any origin within some arm lengths of the limb will do, such as the character's place.
// A position is rounded to 6e-8 of its distance from its origin. Rotations need no origin; swivel_forward()'s positions
// are from it, too.
//
// field is one of these. Each limb has 3 consecutive doubles, and so has its origin; stride 0 means one origin
// for all. The call subtracts the origin in double, and rounds the difference once, to the nearest float. If the data
// of origins is null, it subtracts nothing. Poles that are directions or normals have no origin and are refused with
// one. A difference no float holds becomes infinite, and the limb gets SWIVEL_BAD_INPUT. values and origins may overlap
// each other, but not the crowd's own memory. Fails like swivel_write(), and for fields that are no positions. One
// thread; no allocation; two to three times as long as swivel_write().
SWIVEL_API swivel_status swivel_write_doubles(swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                                              uint32_t limb_count, swivel_in values, swivel_in origins);

// One field in the caller's own array: the group's first limb's value is at `data`, each next one `stride` bytes
// further. A value is consecutive floats, a uint32_t for flags, of any alignment. Units and meanings are the fields'.
typedef struct swivel_frame_field {
    swivel_field field;
    void* data;     // inputs are only read; null: as if the field were not listed
    size_t stride;  // bytes; for an input 0 is one value for the group, otherwise at least the value's size
} swivel_frame_field;

// The kind of a caller's numbers.
typedef enum swivel_numbers {
    SWIVEL_NUMBERS_UNSPECIFIED,  // the caller does not say, so nothing is checked
    SWIVEL_FLOATS,
    SWIVEL_DOUBLES
} swivel_numbers;

// One group's values as engines keep them: a frame of animation, not one of axes. An input that is not listed keeps its
// rows; a result that is not listed is not written. A field may be listed once.
typedef struct swivel_frame {
    size_t size;  // sizeof(swivel_frame), set by swivel_default_frame()
    const swivel_frame_field* fields;
    uint32_t field_count;
    // A swivel_numbers, 0 at the start: what the listed inputs that are positions are. A solve fails where origin, or a
    // pose's root_is_double, would have them read as the other kind.
    uint32_t positions;
    // Null data: positions are floats. With data, all positions are 3 doubles each, and this
    // origin, 3 doubles as well, is subtracted as by swivel_write_doubles(). A pole that is a direction is doubles,
    // too, but has no origin. A position that is not listed keeps its rows, which must be from the same origin. origin
    // may be the same array as the shoulder positions; all is then relative to the shoulder. Stride 0: one origin for
    // the whole group.
    swivel_in origin;
} swivel_frame;

// Nothing in and nothing out.
static inline swivel_frame swivel_default_frame(void)
{
    swivel_frame frame;
    memset(&frame, 0, sizeof frame);
    frame.size = sizeof frame;
    return frame;
}

// What a pose's rotations are.
typedef enum swivel_pose_form {
    SWIVEL_ROTATIONS,        // x, y, z, w; translations and scales lie apart
    SWIVEL_MATRIX_ROWS,      // 3 x 4 or 4 x 4 floats, row after row; a fourth row is not touched
    SWIVEL_MATRIX_COLUMNS,   // 4 x 4 floats, column after column; the last row is not touched
    SWIVEL_MATRIX_COLUMNS3,  // 3 x 4 floats, column after column
} swivel_pose_form;

// What the joints of a pose are relative to.
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

// The bodies' poses, as an engine keeps them. A job with a pose reads what it says of the joints that some group needs:
// limbs, joints in between, and all above. It finds by forward kinematics where the limbs are and how long their bones
// are. Then it solves them. It writes the rotations of shoulders and elbows, and WITH_HAND of wrists. WITH_CLAVICLE and
// WITH_TWIST_BONES it writes those joints, too. In SWIVEL_IN_BODY it writes all that moves. The rest is left alone.
//
// - Targets, poles and hands are in the world. Positions in rows are too, unless the root is in doubles.
// - A solve corrects the incoming pose: a joint turns by what carries the incoming bone to the solved one. So it keeps
//   what the limb's formulas do not know, such as a forearm's roll. A goal at the incoming wrist with POLE_INCOMING
//   gives the incoming pose back. A joint is then within 2e-6 + 4e-7 L^2 / (L1 L2 sin b) rad, if the target is as exact
//   as that: L1 and L2 are the bones, L their sum, b the bend. Where all weights are 0, and the group has no limit,
//   cap, soft reach or step, the incoming bits stay.
// - With POLE_INCOMING the swivel plane's normal stays the incoming one, made perpendicular to the new line from
//   shoulder to wrist. Without it and POLE_HAND poles must be written. Lengths that are written count instead of the
//   pose's. Joints in between stay as they are posed.
// - Results in rows are the arm's: SHOULDER, ELBOW and WRIST as without JOINTS. Limits bound these, not the joints.
// - Twist bones turn from their incoming rotations. Bone i of n turns by i / (n + 1) of how far the hand's twist
//   changes. A limb whose joints name twist bones gets the feature by itself.
// - WITH_CLAVICLE the shoulder's parent turns towards the target, by its share of the angle between the incoming end
//   point and the target. The end point is the wrist or the effector. WITH_AIM it is the point of the incoming ray that
//   is as far away as the target. So an untouched goal does not turn it.
// - A rotation of no length or not finite is bad input, and so is a place beyond 1e15. The same holds for a scale that
//   is not above 0 or not uniform within 1e-3, and for a matrix that is mirrored or slanted by more than 1e-3. Bad
//   input makes all limbs with or below that joint SWIVEL_BAD_INPUT; that of the root all of the body. A root's place
//   in doubles counts by the positions that it is subtracted from.
// - A limb that keeps its pose (swivel_default_body_group_def()) has the incoming bits after bad input, NaN too. With
//   SWIVEL_REST_POSE matrices get rotations of scale 1. In SWIVEL_IN_BODY every limb keeps it. Joints that only move
//   along, such as fingers, are not checked.
// - Inputs are read before results are written, body by body. Results of a body must not overlap another's inputs.
typedef struct swivel_pose {
    size_t size;  // sizeof(swivel_pose), set by swivel_default_pose()
    swivel_pose_form form;
    // Not 0: root positions are doubles, and so are the positions in the job's frames. The root is subtracted in
    // double. Positions in rows are then relative to the root.
    uint32_t root_is_double;
    swivel_joint_values rotations;     // or matrices, as form says; must be given
    swivel_joint_values translations;  // 3 floats: the joint's place in its parent's frame, or in the body's space;
                                       // none: as the skeleton rests
    swivel_joint_values scales;        // 3 floats, to the parent's or in the body's space; none: 1
    // Where the joints that are written go, in the same form; none: back to rotations. A matrix's last row is not
    // written.
    swivel_joint_values results;
    // Of each body, which the joints with parent -1 hang below. Null data: at the origin, not turned, scale 1.
    swivel_in root_position;  // 3 floats in the world, or doubles
    swivel_in root_rotation;  // x, y, z, w
    swivel_in root_scale;     // 1 float
    swivel_pose_space space;
    uint32_t reserved;  // 0
    // In SWIVEL_IN_BODY with translations: where those of moved joints go; none: back to translations. Give it if
    // results are given. Poses without translations have no places that could move.
    swivel_joint_values translation_results;
    // If given: where the joints are after the solve, relative to the root. Of those that some group needs: limbs,
    // joints in between, and all above. x, y, z, w with w >= 0, and 3 floats. A limb that keeps its pose has them as
    // they come; what is bad in the pose is NaN.
    swivel_joint_values joint_rotations, joint_positions;
    // Of each body, for groups WITH_PLANT, FIT or LOOK with a rate: the seconds since its last solve, 1 float. It must
    // be given where one of these is solved. Where it is given, WITH_MAX_SWIVEL goes by it, too. 0 changes nothing
    // that has begun to be carried. Less than 0, NaN and more than 1e15 are bad input.
    swivel_in time;
    // What planted points stand on: a platform, a ladder, or the ground. Null position: at the world's origin. Null
    // rotation: not turned. For the ground give a position near the body, such as the origin of its tile, and change it
    // seldom. What is planted moves along with a support. To change a support without a jump: swivel_change_support().
    swivel_in support_position;  // 3 floats in the world, or doubles as the root's
    swivel_in support_rotation;  // x, y, z, w
    // How much of all that turns a body's joints counts, 0..1, 1 float for each body. Null: 1. Another number makes all
    // of its groups bad input. At 0 the joints keep their incoming bits, while what is carried goes on. So a body comes
    // and goes without a jump, as fast as the caller lets its weight change. In between no hand is quite at its goal.
    // Looks take their part first: SWIVEL_SIGHT and REACHED are of that, and limbs below are solved from there. Rows of
    // limbs and props are those of a weight of 1, and so is SWIVEL_SHIFT: scale it where you draw it.
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

// Some of a crowd's limbs. indices may be null if count is 0.
typedef struct swivel_limbs {
    const uint32_t* indices;
    uint32_t count;
} swivel_limbs;

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

// What a call of swivel_solve() does. A null choice means all limbs, a null output is not written. A job of null
// pointers solves every limb.
typedef struct swivel_job {
    size_t size;  // sizeof(swivel_job), set by swivel_default_job()

    // Which blocks; null for all. Other blocks are neither read nor written. Frames of groups outside these blocks are
    // ignored; the first one's size still is the array's step.
    const swivel_blocks* blocks;
    // Which groups, by bits: group g is bit g % 32 of groups[g / 32]; null for all. group_word_count must be
    // (swivel_group_count() + 31) / 32, and bits past the last group are ignored. A limb is solved if its group is
    // named here, its block is in blocks, and it is chosen below.
    const uint32_t* groups;
    uint32_t group_word_count;

    // Which limbs: by at most one of mask, limbs and priorities; without any, all limbs of these blocks. Chosen limbs
    // get the same bits as in a solve of all. Other limbs keep their results, and their values in frames are neither
    // read nor written. limbs and priorities are for the whole crowd, so they exclude blocks and on_this_thread.
    // Priorities exclude groups, too: a group that is not wanted has priority 0.
    //
    // By bits: limb n of a group has the number i = swivel_group_first_limb() + n, which is bit i % 32 of mask[i / 32].
    // mask_word_count must be (swivel_block_count() + 1) / 2. Bits of padding lanes, and past the last block, are
    // ignored.
    const uint32_t* mask;
    uint32_t mask_word_count;
    // By a list of such numbers. Any order; a limb named twice is solved once; an empty list solves nothing. Fails for
    // an index that is out of range or a padding lane, before anything is solved. A list in no order costs some
    // nanoseconds an entry more than bits.
    const swivel_limbs* limbs;
    // The most urgent blocks, at most max_blocks of them, as swivel_choose() picks them; urgency is its, or null.
    const swivel_in* priorities;
    float* urgency;
    uint32_t max_blocks;

    // The caller's own arrays: one frame for each group that is named, in the crowd's order, as far apart as the first
    // one's size. Null: values are in the crowd's rows.
    const swivel_frame* frames;

    // Not 0: solves on the calling thread, never allocates and never uses oneTBB. Several threads may make such calls
    // at once, on blocks that do not overlap, each in a workspace of its own. They may share a mask and frames. 0: on
    // the calling thread's oneTBB arena, if built with it and there is enough to do. oneTBB may allocate. Where it
    // finds no memory or cannot start its threads, the calling thread solves what is left, with the same bits and
    // status. If oneTBB itself failed, this process does not use it again.
    int on_this_thread;

    // Unless null, becomes how many limbs were solved; of bodies how many bodies.
    uint32_t* solved_count;

    // swivel_workspace_bytes() of memory for this call alone, aligned to 64. Null: one of the crowd's workspaces. Two
    // calls that share one spoil each other's results, which no build can see.
    void* workspace;

    // Of bodies: where their poses are. Null in crowds of free limbs. oneTBB's threads then allocate workspaces.
    const swivel_pose* pose;

    // For groups WITH_GROUND there are three ways to sample the ground. Equal ground gives equal bits.
    // - One call: give the ground below the last solve's SWIVEL_PROBE.
    // - Two calls, without that frame of latency. Not 0: the job finds SWIVEL_PROBE for these bodies and changes no
    //   other result. Then sample, and solve as usual. It may be repeated, but not with priorities.
    int probes_only;
    // - One call that asks. Unless null, it is called on the threads that solve, by several at a time, with some feet
    //   of one group: up to 128. It runs in the floating-point environment of its thread. It must not throw, nor call
    //   this crowd, nor wait for oneTBB's tasks unless it isolates them. What it stores are inputs, in rows, too.
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

// Bytes of a workspace: the memory beside its rows that a solve of this crowd works in. It has up to 64 KiB; of bodies
// up to 192 KiB, or 1.4 KiB for each joint that is needed if that is more. They are a
// multiple of 64, and the same for every instruction set. 0 for a crowd whose groups have no features beyond WORLD,
// JOINTS, WITH_HAND and POLE_DIRECTION. Of other crowds every call of swivel_solve() works in one: job.workspace, or
// one of the crowd's that no other call is using. So the crowd needs as many as calls run on it together, or these jobs
// bring theirs. A call with oneTBB needs one, too; its threads beside the caller's have their own. What a workspace
// holds before and after a call means nothing. Any thread; 0 for a null crowd.
SWIVEL_API size_t swivel_workspace_bytes(const swivel_crowd* crowd);

// Solves limbs; job may be null, for every limb from and to rows. It fails with SWIVEL_INVALID_ARGUMENT for a workspace
// that is not aligned to 64, and if the crowd has none that is free: then more of them help, or a later call.
//
// With frames, one pass replaces swivel_write() of every input given, the solve, and swivel_read() of every result
// given. The bits are the same. It takes a run of blocks of each group in turn, so limbs of one character use shared
// cache lines together. Rows hold inputs and results afterwards. Only the bytes of the values are read or written.
// Inputs may overlap each other. A limb's inputs are read before its results are written. So its results may overlap
// its own inputs, and a pose may be read and written in place. Inputs of other limbs may be read later, by any thread.
// So a limb's result must not overlap another limb's input, nor an input of stride 0. Results must not overlap each
// other. No value may overlap the crowd's own memory. It fails for a field that the group does not have and for a
// stride smaller than a value. For arms of characters kept as structures, with SWIVEL_JOINTS, in a crowd of one group:
//     const size_t stride = sizeof characters[0];
//     const swivel_frame_field fields[] = {
//         {SWIVEL_TARGET, &characters[0].grip, stride},
//         {SWIVEL_POLE, &characters[0].elbow_hint, stride},
//         {SWIVEL_SHOULDER, &characters[0].joints[UPPER_ARM].rotation, stride},
//         {SWIVEL_ELBOW, &characters[0].joints[FOREARM].rotation, stride},
//     };
//     swivel_frame frame = swivel_default_frame();
//     frame.fields = fields, frame.field_count = 4;
//     swivel_job job = swivel_default_job();
//     job.frames = &frame;
//     status = swivel_solve(crowd, &job);
//
// The cost of some limbs goes with their blocks. A block of which some limbs are chosen takes about its usual time;
// others take none. So neighbours cost their share of a solve of all, or little more. Half of a crowd, picked at
// random, costs as much as all of it. A random tenth costs 0.5 to 1 times as much as all, a random hundredth 0.1 to 0.4
// times.
SWIVEL_API swivel_status swivel_solve(swivel_crowd* crowd, const swivel_job* job);

// Chooses limbs by urgency, within a budget. Whole blocks are picked, because one limb costs about as much as its
// block: at most max_blocks of them. Each call adds the largest priority among a block's limbs to the block's urgency.
// It picks the most urgent blocks, of equals the lower index. The urgency of a picked block returns to 0. So over time
// a block is picked about as often as its priority says, and blocks of equal priority take turns. None waits for ever,
// unless others have 1e7 times its priority: floats then stop its urgency. Place limbs of equal importance side by
// side. A block whose limbs all have priority 0 is not picked in this call and keeps its urgency.
//
// priorities has one entry for each group, in the crowd's order; of bodies one alone. An entry has one float for each
// limb, at any
// alignment. With stride 0, one priority is for the whole group. In any unit: only ratios matter. Above 1e15, and
// infinity, count as 1e15; below 0 and NaN as 0.
//
// urgency: a float for each block, the caller's, 0 at first, kept from call to call. Only its magnitude counts: the
// sign is the library's. One that is not finite counts as 0. Null: each call starts from 0, so priorities alone decide.
//
// It sets the bits of the picked blocks' limbs in mask and clears all others. Give that mask to jobs on your own
// threads. A job with priorities does both steps in one call. *chosen_count, unless null, becomes how many limbs these
// are. The choice depends on priorities and urgency alone, not on CPU, threads or time. On the calling thread, which
// takes 1 to 3 nanoseconds for each limb of the crowd, picked or not; allocates nothing. Arrays must not overlap each
// other or the crowd's own memory. mask_word_count is (swivel_block_count() + 1) / 2. Fails for another one, for a null
// mask, for missing priorities, and for a stride below 4 other than 0.
SWIVEL_API swivel_status swivel_choose(swivel_crowd* crowd, const swivel_in* priorities, float* urgency,
                                       uint32_t max_blocks, uint32_t* mask, uint32_t mask_word_count,
                                       uint32_t* chosen_count);

// Clears what these limbs carry from solve to solve. SWIVEL_MAX_SWIVEL then does not limit their next solve. Planted
// points and shifts start anew, as in the first solve. Call it after a teleport, and where a body's place is used anew.
// Nothing to do in groups without such fields.
SWIVEL_API swivel_status swivel_reset(swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count);

// The first limb with any of these flags, looked for from limb *limb of group *group on, through all later groups.
// Returns 1 and stores its place; or returns 0 and changes nothing: there is none, or a pointer is null. Limbs that
// were never solved have no flags. To go on, add 1 to *limb. Reads the flags alone; no allocation.
//     for (uint32_t group = 0, limb = 0; swivel_find(crowd, SWIVEL_BAD_INPUT, &group, &limb); ++limb)
//         printf("limb %u of group %u has bad input\n", limb, group);
SWIVEL_API int swivel_find(const swivel_crowd* crowd, uint32_t flags, uint32_t* group, uint32_t* limb);

enum { SWIVEL_EXPLANATION_BYTES = 8192 };  // as many hold every text of swivel_explain() and swivel_compare()
#define SWIVEL_EVERY_GROUP UINT32_MAX      // of swivel_explain(): all that a body has

// Explains a limb's state in a sentence or two, from its present inputs. It names the input that is bad, or how far out
// of reach the target is. It names the limit that turned the elbow from its wish, and by how much. Where no elbow keeps
// the limits, it says by how many degrees the pose violates each. It says so if the results do not match the present
// inputs. It cannot know the swivel from which the last step started, and takes the step of a 60th of a second.
// Distances are in the targets' unit, unless it says that they are of the limb's length. With WITH_WEIGHTS it says how
// far the limb is from the target itself, not from the blended one. limb is counted within the group. text gets at most
// size bytes, the 0 at its end among them. For people and logs: the words may change, and the last digits differ
// between C libraries. A text that was cut ends in three dots. Of bodies it needs WITH_RECORD. Then it also says why a
// planted point stands or slides, and what a hand holds. It says how the ground lifts and turns a foot, for a root that
// is upright. Of a group that is no limb it needs none, and says how the body is shifted, where the prop is and why, or
// by how much a line of sight misses. With the hands' records it says how far the prop moved, and how far each hand is
// from its grip. With SWIVEL_EVERY_GROUP it says so of all groups of body `limb`, with a line for each that begins
// "group 0: ". It warns of what no solve refuses and hardly anybody means: another unit, another
// origin, a time in milliseconds, a pose that is solved twice. A warning of the last solve is a line of its own there.
// Takes up to a millisecond for a limb; no allocation.
SWIVEL_API swivel_status swivel_explain(const swivel_crowd* crowd, uint32_t group, uint32_t limb, char* text,
                                        size_t size);

// Compares a pose with where your engine has a limb, and says in words which input disagrees. Call it once for each
// limb when you bind a skeleton, before the first solve.
// pose: as a job has it. Its results do not matter.
// shoulder, elbow, wrist: places of these joints of one body, 3 doubles each. They are in the world, also where the
// root is in doubles, and those of the pose as it goes in. body is counted within the group.
// agrees: unless null, becomes 1 or 0.
// text: gets at most size bytes, the 0 at its end among them. A text that was cut ends in three dots. The words may
// change.
//
// The three agree if each place is within 1e-3 of the limb's length of the pose's. If the root is not in doubles, 2e-7
// of the distance from the origin is added, for the rounding of floats. If they do not agree, the call tries the usual
// mistakes, one at a time:
// - quaternions stored as w, x, y, z, and conjugates; matrices of another form, and transposed; the other space;
// - the joints of another group's limb, such as left for right; joints too high or too low, such as a clavicle, also
//   all three of them;
// - other units; a root's place, rotation or scale that is missing, was not given, or counts twice; a root in floats
//   for doubles, or the other way round; scales or translations that do not count; left-handed axes, another axis up.
// The text names the mistake that explains the places, or each of several. If none does, it names the first joint that
// is off, and what to look at, or a quaternion whose length shows that strides are wrong.
//
// They do not agree, either, where no place shows what is wrong: bones of the skeleton that are nearly twice as long as
// the pose's or nearly half, a time above 1 second, or an elbow bent by 20 degrees and more to the other side than
// `bend` says.
//
// What no place depends on cannot be seen, such as the wrist's own rotation. In SWIVEL_IN_BODY with translations the
// call looks whether rotations lead along the bones, where these are as long as at rest. Matrices that lie 64 bytes
// apart or more and have no translations are read as 4 x 4 floats, whatever their form. Takes up to a tenth of a
// millisecond, longer where thousands of joints are needed; no allocation. Fails for free limbs, groups of no limbs,
// poses that a job would refuse, and places that are not finite or beyond 1e15.
SWIVEL_API swivel_status swivel_compare(const swivel_crowd* crowd, uint32_t group, uint32_t body,
                                        const swivel_pose* pose, const double shoulder[3], const double elbow[3],
                                        const double wrist[3], char* text, size_t size, int* agrees);

// An arc of swivels, as cos and sin of its ends. It turns from one to the other by the right hand about the line from
// shoulder to wrist. Angle 0 is the wish, as far as SWIVEL_MAX_SWIVEL allows it. The whole circle is one arc with
// equal ends.
typedef struct swivel_arc {
    float from[2], to[2];
} swivel_arc;

// The swivels that the limits of a limb allow for its present inputs, as the next solve will use them. They are in
// their order around the circle. At most capacity of them are stored, *arc_count says how many there are. None for bad
// input. limb is counted within the group. Of bodies it needs WITH_RECORD. Takes some microseconds; no allocation.
SWIVEL_API swivel_status swivel_allowed_arcs(const swivel_crowd* crowd, uint32_t group, uint32_t limb, swivel_arc* arcs,
                                             uint32_t capacity, uint32_t* arc_count);

// The joint angles of the results in radians, about the rest pose and the arm frame's axes. Each limb has 7 doubles:
// three of the shoulder in its order, the flexion, three of the wrist, which are 0 without SWIVEL_WITH_HAND. Each
// rotation has two sets of Euler angles. Family 0 has a middle angle within -pi/2..pi/2, family 1 is the other. In
// gimbal lock the last angle is 0. This is an output for people and files: no solve uses it, and its last digits may
// differ between C libraries.
SWIVEL_API swivel_status swivel_joint_angles(const swivel_crowd* crowd, uint32_t group, uint32_t first,
                                             uint32_t limb_count, swivel_euler_order shoulder_order,
                                             swivel_euler_order wrist_order, int family, swivel_out angles);

// Values of limit and step fields, from angles in radians. Any thread; no allocation. These functions, except
// swivel_cos_sin(), fail for values that are not finite or out of range; outputs then stay unchanged. A range from
// least to most, least <= most, no wider than 2 pi: one of the three of a box, or a twist's.
SWIVEL_API swivel_status swivel_range(double min, double max, float range[4]);
// An axis of any length but zero and the largest angle to it, 0 to pi.
SWIVEL_API swivel_status swivel_cone(const double axis[3], double max, float cone[4]);
// Converts a direction of the character into the arm frame, which the axes of limits are in.
// parent_rotation: of the shoulder's parent joint in the world of the rest pose, x, y, z, w.
// direction: in that world, 1e-15..1e15 long.
// axis: becomes unit; may be direction itself.
// Fails if the binding is not valid. The limit then turns with the parent joint. To fix the limit to the character
// instead, call this in every frame, with the parent's rotation relative to the character. A cone of 80 degrees about
// forwards and down, for a character that faces +z with +y up:
//     const double down_ahead[3] = {0, -1, 1};
//     double axis[3];
//     float cone[4];
//     if (swivel_arm_axis(&binding, parent_rotation, down_ahead, axis) == SWIVEL_OK)
//         swivel_cone(axis, 80 * 3.14159265358979 / 180, cone);
SWIVEL_API swivel_status swivel_arm_axis(const swivel_binding* binding, const float parent_rotation[4],
                                         const double direction[3], double axis[3]);
// The elbow's least and largest flexion, 0 <= least <= most <= pi.
SWIVEL_API swivel_status swivel_flexion(double min, double max, float flexion[2]);
// For SWIVEL_AIM: an axis of the hand, of any length but zero, and the elbow's flexion, 0 to pi.
SWIVEL_API swivel_status swivel_aim(const double axis[3], double flexion, float aim[5]);
// Cosine and sine of an angle, for SWIVEL_ANGLE and SWIVEL_MAX_SWIVEL.
SWIVEL_API void swivel_cos_sin(double angle, float turn[2]);
// The value of SWIVEL_ANGLE or of a limit for the same limb on the body's other side. A skeleton mirrored in x has
// offsets and bends (-x, y, z) and rotations (x, -y, -z, w). Its arm frame from swivel_bind() is the mirror image with
// the x axis negated. order: of boxes, else ignored. from and to have the field's components and may be the same.
// Values of other input fields are copied: places, hands, effectors, aims and poses are for the caller to mirror. Fails
// for results and for an order that does not exist. Any thread; no allocation.
SWIVEL_API swivel_status swivel_mirror(swivel_field field, swivel_euler_order order, const float* from, float* to);

// Reach regions: see swivel_region.
typedef struct swivel_region_cone {
    float axis[3];  // of any length but zero
    float angle;    // to the axis, at most: 0.01 to pi - 0.01
} swivel_region_cone;

// Adds cones in order, with a bridge between neighbours. A bridge is what lies between both cones and outside of the
// two circles of radius (pi - both angles) / 2 that touch both. No bridge is needed where one cone holds the other, or
// where both angles are half a turn together. closed: not 0 to bridge the last cone and the first, too. Neighbours may
// not be opposite. Cones that are no neighbours are not bridged. A cone takes one half-space; a bridge takes four, or
// eight if its circles do not meet on the arc between the axes.
SWIVEL_API swivel_status swivel_region_add_cones(swivel_region* region, const swivel_region_cone* cones, uint32_t count,
                                                 uint32_t closed);
// Adds a convex polygon of 3 corners or more, counter-clockwise as seen from outside. Its sides are arcs of great
// circles. corners: x, y, z of each, of any length but zero; no corner may be equal or opposite to the next.
SWIVEL_API swivel_status swivel_region_add_polygon(swivel_region* region, const float* corners, uint32_t count);
// Adds cones in order that hold all these directions, each with `margin` radians around it: what a clip does, and a
// little more. They are 1 to max_cones, as many as allow least. directions: x, y, z of each, of any length but zero,
// `count` of them, 1 or more. margin: 0.01 to 1. max_cones: 1 to 6. Directions for which it finds no such cones,
// as two that are opposite, are refused. Takes about 0.05 ms for each direction.
SWIVEL_API swivel_status swivel_region_add_directions(swivel_region* region, const float* directions, uint32_t count,
                                                      float margin, uint32_t max_cones);
// Cuts a cone out of all that is there and will be added.
SWIVEL_API swivel_status swivel_region_forbid(swivel_region* region, const swivel_region_cone* cone);
// The region of the same limb on the body's other side, as swivel_mirror() has it. from and to may be the same.
SWIVEL_API swivel_status swivel_region_mirror(const swivel_region* from, swivel_region* to);
// How much room a direction has, in units of a cosine: not negative where it is allowed. direction: of any length but
// zero.
SWIVEL_API swivel_status swivel_region_room(const swivel_region* region, const float direction[3], float* room);

// Forward kinematics of the results, in double. Positions are in the space of the targets, after the clavicle's turn.
// For each limb, elbow and wrist are 3 doubles, hand is a rotation of 4, with SWIVEL_WITH_HAND. Outputs whose data is
// null are left out. Of bodies it needs WITH_RECORD.
SWIVEL_API swivel_status swivel_forward(const swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count,
                                        swivel_out elbow, swivel_out wrist, swivel_out hand);
// How far the wrist, or the effector, of each limb is from its target; with WITH_AIM, how far the target is from the
// hand's ray. One double each, in arm lengths: upper + fore, scaled and stretched. 0 for a limb of no length, NaN for
// one with bad input. Means nothing before the first solve. Of bodies it needs WITH_RECORD.
SWIVEL_API swivel_status swivel_residuals(const swivel_crowd* crowd, uint32_t group, uint32_t first,
                                          uint32_t limb_count, swivel_out distance);

// Results in 16-bit words, for memory or for another machine: about half of the rows' bytes. swivel_pack() packs blocks
// of a group, counted within it. Word r of lane l of the nth block becomes words[(n * rows + r) * SWIVEL_LANES + l],
// where rows is swivel_packed_row() of SWIVEL_RESULT_END. Fields keep their order; swivel_packed_row() is the row in
// which one begins.
// - Rotations take 3 words: the quaternion's smallest three components. The component of largest size (the first of x,
//   y, z, w if equal) is left out; its index 0..3 is word0 >> 15 | (word1 >> 15) << 1. The other three follow in the
//   order x, y, z, w; each is ((word & 32767) - 16384) / (16383 * sqrt 2). The sign of the quaternion makes the
//   component left out positive: it is sqrt(1 - the sum of their squares). Bit 15 of word2 is 0.
// - SWIVEL_ELBOW without JOINTS takes 2 words and SWIVEL_STRETCH 1. They are IEEE half floats, rounded to nearest.
// - SWIVEL_FLAGS takes 2 words, the low and the high half of the uint32_t.
// - SWIVEL_NORMAL takes none: it is for the next solve alone.
// A rotation is within 1.54e-4 rad of the result. A wrist is within 1.13e-3 arm lengths of its place, for any bones;
// with JOINTS within 3.1e-4. A stretch is within a 2048th of itself, and so is a wrist's distance that it makes longer.
// A clavicle's turn adds 1.54e-4 times the distance from its parent joint. The words are the same on every CPU.
//
// words: room for blocks.count * rows * SWIVEL_LANES of them, not in the crowd's own memory; null only for no blocks.
// Words of padding lanes mean nothing. Any thread, while nothing solves these blocks; no allocation; up to half as long
// as a solve of plain arms. Fails for a group or blocks that do not exist.
SWIVEL_API swivel_status swivel_pack(const swivel_crowd* crowd, uint32_t group, swivel_blocks blocks, uint16_t* words);
// The first row of words that a field is packed into, in groups with these features. If they lack the field, it is the
// row after the fields before it. Any thread.
SWIVEL_API uint32_t swivel_packed_row(swivel_features features, swivel_field field);
// The rotation of three words that lie word_stride words apart, SWIVEL_LANES in rows: a unit quaternion with w >= 0.
// Other words may give one of another length. Any thread.
SWIVEL_API void swivel_unpack_rotation(const uint16_t* words, size_t word_stride, float xyzw[4]);
// The value of any half float, exactly. Any thread.
SWIVEL_API float swivel_unpack_half(uint16_t word);

// Changes what planted points of some bodies stand on, from one support to another, without a jump: SWIVEL_PLANT and
// SWIVEL_PLANT_ROTATION, which are in the support's frame, become those of the new one. Call it between two solves, and
// give the next pose the new support. Both supports as they are now; how they move against each other is not known
// here, so a point that fades does so in the new one. Best change it while a foot is in the air. first is the group's
// first limb, that is body. Positions are 3 doubles, also where the pose's are floats. Rotations are x, y, z, w as
// floats of any length. Null positions: the origin; null rotations: not turned. Fails for groups without WITH_PLANT. No
// allocation.
typedef struct swivel_supports {
    swivel_in position, rotation;
} swivel_supports;
SWIVEL_API swivel_status swivel_change_support(swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count,
                                               swivel_supports from, swivel_supports to);

// A digest of all results, to compare machines by. Crowds with the same groups and equal results have equal digests. If
// results differ, digests almost surely differ, also in their low 32 bits. Padding lanes do not count. Each of the
// SWIVEL_LANES lanes has a hash of 64 bits, which starts at 0. Group after group and block after block, a lane's hash
// takes the bits of that lane in every row, in the order of the group's rows. To take a number, h becomes (h ^ number)
// * 0x9e3779b97f4a7c15 modulo 2^64, then h ^ (h >> 32). One more hash takes those of the lanes, lane 0 first. 0 for a
// null crowd. It protects from accidents, not from forgers. On the calling thread; no allocation.
SWIVEL_API uint64_t swivel_digest(const swivel_crowd* crowd);

// The instruction set in use. It is chosen at first use: SWIVEL_FORCE_ISA of the environment, else the best that this
// CPU runs. Null, with swivel_last_error() set, if SWIVEL_FORCE_ISA names one that cannot be used; solving then fails
// the same way. Any thread.
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

// SPDX-License-Identifier: MIT
//
// Bodies: crowds whose limbs hang on poses of one skeleton. Feet stand, hands hold, heads look, pelvises shift.
// docs/howto/bodies.md explains them, with a whole program; pages beside it have pictures.
#pragma once

#include "swivel.h"

#ifdef __cplusplus
extern "C" {
#endif

// How limbs WITH_PLANT stand. While its point, the effector or else the wrist, is in contact, it is locked to the
// support. Without contact, or further than unlock_radius from the animation, it is released and goes back, without a
// jump. Lengths are in limb lengths: both bones at rest times the root's scale.
// Source: our own, after D. Holden, Inverse Kinematics and Foot Locking (2026).
typedef struct swivel_plant {
    float lock_radius;    // it locks only within this distance of the animation
    float unlock_radius;  // beyond this distance it is released; no less than lock_radius
    float stop_time;      // s: a point that locks is at rest after this
    float release_time;   // s: a released point is with the animation again after this
    float relock_speed;   // limb lengths a second: after a release by distance a slower point locks again
    float anchor_lead;    // 0: the anchor is where the point locks. 1: where it would come to rest
    float reset_time;     // s: a body not solved for longer than this starts anew; 0: none does
    // PLANT_BY_MOTION: speed and height over the root below which a contact begins, then goes on.
    float speed[2], height[2];
} swivel_plant;

static inline swivel_plant swivel_default_plant(void)
{
    const swivel_plant plant = {0.12f, 0.24f, 0.1f, 0.2f, 0.06f, 0.5f, 0, {0.6f, 0.8f}, {0.08f, 0.1f}};
    return plant;
}

// How feet WITH_GROUND stand on ground that is not flat. The effector is the toe or the ball of the foot, which rises,
// falls and turns with the ground, eased by springs.
typedef struct swivel_ground {
    float heel[3];  // a point of the sole in the wrist joint's frame, in the bones' unit; 0: the wrist itself
    float toe_clearance, heel_clearance;  // distances from the plane where they stand, in the bones' unit
    float cos_max;                        // cosine of the foot's max turn, 0..1; 0.8: 37 degrees
    float half_life;                      // s: the time for about half of a lift or slope
} swivel_ground;

static inline swivel_ground swivel_default_ground(void)
{
    const swivel_ground ground = {{0, 0, 0}, 0, 0, 0.8f, 0.05f};
    return ground;
}

// A limb of each body. Its joints name its twist bones.
typedef struct swivel_body_limb_def {
    size_t size;
    swivel_features features;
    const swivel_limb_joints* joints;  // copied
    swivel_on_bad_input on_bad_input;  // by default it keeps its incoming pose
    swivel_euler_order shoulder_order, wrist_order;
    // WITH_LINK: the group that it holds at SWIVEL_GRIP, instead of a target and hand of its own: a prop, or an earlier
    // limb, whose hand or foot this solve leaves there. Solve both in one job. UINT32_MAX: none.
    uint32_t link;
    const struct swivel_region* region;  // WITH_REGION; copied. Null without the feature
    swivel_plant plant;                  // WITH_PLANT
    swivel_ground ground;                // WITH_GROUND
    float pole_behind[3];                // POLE_HALF_LINE: as swivel_limb_def's
} swivel_body_limb_def;

static inline swivel_body_limb_def swivel_default_body_limb_def(const swivel_limb_joints* joints)
{
    swivel_body_limb_def limb;
    memset(&limb, 0, sizeof limb);
    limb.size = sizeof limb;
    limb.joints = joints;
    limb.on_bad_input = SWIVEL_KEEP_POSE;
    limb.link = UINT32_MAX;
    limb.plant = swivel_default_plant();
    limb.ground = swivel_default_ground();
    return limb;
}

// The shift of each body along the crowd's `up`, so that its limbs WITH_PELVIS_FIT reach: the shift nearest to
// SWIVEL_SHIFT_WISH from which all reach, else the middle of the conflict. A spring delays it: limbs at the edge of
// their reach miss for a while, and a wish below 0 gives them room. Draw the pose with SWIVEL_SHIFT added to the root's
// position; positions that a solve tells have it already. Flags: REACHED if some shift within drop and rise lets all
// limbs reach, else CLAMPED_FAR.
typedef struct swivel_shift_def {
    size_t size;
    float drop, rise;  // max shift down and up, in limb lengths of the first group WITH_PELVIS_FIT
    float half_life;   // s: the time for about half of a distance
    float lookahead;   // s: how early SWIVEL_NEXT_TARGET counts
} swivel_shift_def;

static inline swivel_shift_def swivel_default_shift_def(void)
{
    const swivel_shift_def shift = {sizeof(swivel_shift_def), 0.1f, 0.05f, 0.1f, 0.3f};
    return shift;
}

// A thing that one or two hands of each body hold: limbs WITH_LINK. Its place comes from SWIVEL_PROP_POSITION and
// SWIVEL_PROP_ROTATION, else from its joint, else from the hands in the incoming pose, by SWIVEL_HAND_BLEND. Then it
// makes the least move that lets all hands reach their grips. Flags: REACHED; CLAMPED_FAR or CLAMPED_NEAR where a hand
// cannot.
typedef struct swivel_prop_def {
    size_t size;
    int32_t joint;   // of the skeleton, which no limb may turn; -1: none
    float max_move;  // in limb lengths of the first limb linked to it
} swivel_prop_def;

static inline swivel_prop_def swivel_default_prop_def(void)
{
    const swivel_prop_def prop = {sizeof(swivel_prop_def), -1, 1};
    return prop;
}

enum { SWIVEL_MAX_LOOK_JOINTS = 8 };

// A chain of joints of each body, such as spine, neck and head, that turns so that a line of sight in the last one
// meets SWIVEL_LOOK_TARGET. Each joint takes its share of the turn left. The turn fades out as the target goes behind
// or comes too near. Looks come after a body's shift and before its props and limbs, in the order of their groups.
// Flags: REACHED, LIMITED_LOOK, LIMITED_STEP and FADED.
typedef struct swivel_look_def {
    size_t size;
    uint32_t joint_count;                     // 1 to 8
    uint32_t joints[SWIVEL_MAX_LOOK_JOINTS];  // of the skeleton, each below the one before
    float share[SWIVEL_MAX_LOOK_JOINTS];      // of the turn, of any sum: 0 or more, the last more than 0
    float cos_max[SWIVEL_MAX_LOOK_JOINTS];    // cosine of each joint's max turn; 0.7: 46 degrees
    float eye[3];                             // where the line of sight starts, in the last joint's frame
    float axis[3];                            // where it points, likewise, of any length but 0
    float cos_full, cos_none;                 // it fades between these cosines of the target's angle
    float fade_distance;                      // it also fades nearer than this
    float rate;                               // radians a second; 0: turns are not eased
    uint32_t reserved;                        // 0
} swivel_look_def;

// No joints yet; a line along the last joint's z axis.
static inline swivel_look_def swivel_default_look_def(void)
{
    swivel_look_def look;
    int n;
    memset(&look, 0, sizeof look);
    look.size = sizeof look;
    for (n = 0; n < SWIVEL_MAX_LOOK_JOINTS; ++n) look.share[n] = 1, look.cos_max[n] = 0.7f;
    look.axis[2] = 1;
    look.cos_full = -0.1f, look.cos_none = -0.9f;
    look.fade_distance = 0.05f;
    look.rate = 6;
    return look;
}

// A constant of swivel_plant, swivel_ground or a definition above: a float, or several.
typedef struct swivel_constant_info {
    const char* structure;  // "plant", "ground", "shift", "prop" or "look"
    const char* name;       // such as "lock_radius"
    const char* unit;       // such as "s"; empty: none
    const char* text;       // what it means
    uint32_t offset;        // bytes from the structure's start
    uint32_t count;         // of floats
    float defaults[SWIVEL_MAX_LOOK_JOINTS];
    float min, max;  // of each
} swivel_constant_info;

// Describes constant number `index`, from 0; returns 0 if there is none.
SWIVEL_API int swivel_describe_constant(uint32_t index, swivel_constant_info* info);

// The form of a pose's rotations.
typedef enum swivel_pose_form {
    SWIVEL_ROTATIONS,        // x, y, z, w; translations and scales lie apart
    SWIVEL_MATRIX_ROWS,      // 3 x 4 or 4 x 4 floats, row after row
    SWIVEL_MATRIX_COLUMNS,   // 4 x 4 floats, column after column
    SWIVEL_MATRIX_COLUMNS3,  // 3 x 4 floats, column after column
} swivel_pose_form;

// The space that the joints of a pose are in.
typedef enum swivel_pose_space {
    SWIVEL_LOCAL,    // each to its parent
    SWIVEL_IN_BODY,  // all to the root: joints below a limb's are read and written, too
} swivel_pose_space;

// Values of joints in the caller's own array, joint j of body i at data + i * body_stride + offsets[j], or j *
// joint_stride where offsets is null. Strides and offsets are in bytes. Without offsets a job is refused whose results
// of two bodies overlap; with offsets, only debug builds and builds with SWIVEL_CHECK_USE see that.
typedef struct swivel_joint_values {
    void* data;                        // null: none
    size_t body_stride, joint_stride;  // 0 of inputs: one value for all
    const size_t* offsets;             // one for each joint of the skeleton
} swivel_joint_values;

// The bodies' poses, as an engine keeps them. A job finds limbs by forward kinematics, solves them, and writes the
// rotations that it changed. Scales and matrices that are mirrored, not uniform or slanted by more than 1e-3 are bad
// input of all limbs at or below.
typedef struct swivel_pose {
    size_t size;
    swivel_pose_form form;
    // Not 0: root positions and those that streams give are doubles; those in rows and results are from the root.
    uint32_t root_is_double;
    swivel_joint_values rotations;     // or matrices, as form says; must be given
    swivel_joint_values translations;  // 3 floats; none: as at rest
    swivel_joint_values scales;        // 3 floats; none: 1
    swivel_joint_values results;       // where changed joints go, in the same form; none: back to rotations
    // The root of each body before its shift: all positions that a job takes or tells hold for it. Null data: at the
    // origin, not turned, scale 1.
    swivel_in root_position;  // 3 floats in the world, or doubles
    swivel_in root_rotation;  // x, y, z, w
    swivel_in root_scale;     // 1 float
    swivel_pose_space space;
    uint32_t reserved;  // 0
    // SWIVEL_IN_BODY with translations and results: where those of moved joints go; none: back to translations.
    swivel_joint_values translation_results;
    // Where joints that limbs and looks need are after the solve, in the root's frame; others are not written.
    swivel_joint_values joint_rotations, joint_positions;
    // Seconds since each body's last solve, 1 float. Groups WITH_PLANT, shifts, and looks with a rate need it.
    swivel_in time;
    // The support of planted points, such as a platform. Null: the world's origin, not turned.
    swivel_in support_position;  // 3 floats in the world, or doubles as the root's
    swivel_in support_rotation;  // x, y, z, w
    // How much the solve counts, 1 float, a share; null: 1.
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

// Feet of one group, for a job's sample function. Arrays have an entry for each foot.
typedef struct swivel_probes {
    uint32_t group, count;
    const uint32_t* bodies;
    const float (*places)[3];  // where to sample, as SWIVEL_PROBE
    float (*grounds)[3];       // in and out: SWIVEL_GROUND. NaN: none
    float (*normals)[3];       // in and out: SWIVEL_GROUND_NORMAL
} swivel_probes;

// Changes what planted points of some bodies stand on, without a jump. Call it between two solves, with both supports
// as they are now, and give the next pose the new one. Positions are 3 doubles, rotations floats; null: the origin, not
// turned.
typedef struct swivel_supports {
    swivel_in position, rotation;
} swivel_supports;
SWIVEL_API swivel_status swivel_change_support(swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count,
                                               swivel_supports from, swivel_supports to);

#ifdef __cplusplus
}
#endif

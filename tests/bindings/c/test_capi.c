/* SPDX-License-Identifier: MIT
 *
 * The promise: the public headers are C11, and a C program can make crowds of limbs and of bodies from the defaults,
 * and solve them. */
#include <math.h>
#include <stdio.h>

#include "swivel/lecture.h"
#include "swivel/swivel_bodies.h"
#include "swivel/swivel_explain.h"
#include "swivel/swivel_regions.h"

static int failures = 0;

static void check(int held, const char* what)
{
    if (held) return;
    fprintf(stderr, "failed: %s (last error: '%s')\n", what, swivel_last_error());
    ++failures;
}

static void count_line(const swivel_check* line, void* user)
{
    check(line->name != NULL && line->set != NULL && line->max <= line->max_limit, "a line of swivel_verify");
    ++*(int*)user;
}

/* A group of each kind that bodies have, from the defaults: an arm that holds a prop, a leg that stands, their shift,
 * and a head that looks. */
enum { ARM, LEG, SHIFT, THING, HEAD, GROUP_COUNT };
static void bodies(void)
{
    static const int32_t parents[] = {-1, 0, 1, 2, 0, 4, 5, 0};
    static const float places[][3] = {{0, 1, 0},    {0.2f, 0.5f, 0}, {0.3f, 0, 0},  {0.25f, 0, 0},
                                      {0.1f, 0, 0}, {0, -0.45f, 0},  {0, -0.4f, 0}, {0, 0.6f, 0}};
    static float rotations[3][8][4];
    const float grip[7] = {0, 0, 0.1f, 0, 0, 0, 1}, thing[3] = {0.3f, 1.4f, 0.3f}, ball[3] = {1, 1.5f, 2}, contact = 1,
                time = 0.02f;
    static const swivel_kind kinds[] = {SWIVEL_KIND_BODY_LIMB, SWIVEL_KIND_BODY_LIMB, SWIVEL_KIND_SHIFT,
                                        SWIVEL_KIND_PROP, SWIVEL_KIND_LOOK};
    swivel_limb_joints arm_joints = swivel_default_limb_joints(1, 2, 3),
                       leg_joints = swivel_default_limb_joints(4, 5, 6);
    swivel_body_limb_def arm = swivel_default_body_limb_def(&arm_joints),
                         leg = swivel_default_body_limb_def(&leg_joints);
    swivel_shift_def shift = swivel_default_shift_def();
    swivel_prop_def prop = swivel_default_prop_def();
    swivel_look_def look = swivel_default_look_def();
    swivel_group_def groups[GROUP_COUNT];
    swivel_skeleton skeleton = swivel_default_skeleton();
    swivel_crowd_def def = swivel_default_crowd_def();
    swivel_pose pose = swivel_default_pose();
    swivel_job job = swivel_default_job();
    swivel_crowd* crowd = NULL;
    unsigned char state[256];
    uint64_t digest;
    uint32_t flags[3], solved = 0, n, joint, group;

    arm_joints.bend[2] = 1, leg_joints.bend[2] = -1;
    arm.features = SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND | SWIVEL_WITH_LINK;
    arm.link = THING;
    leg.features = SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT | SWIVEL_WITH_PELVIS_FIT;
    look.joint_count = 1, look.joints[0] = 7;
    for (group = 0; group < GROUP_COUNT; ++group) groups[group] = swivel_default_group_def();
    groups[ARM].body_limb = &arm, groups[LEG].body_limb = &leg, groups[SHIFT].shift = &shift;
    groups[THING].prop = &prop, groups[HEAD].look = &look;
    skeleton.parents.data = parents, skeleton.parents.stride = sizeof parents[0];
    skeleton.translations.data = places, skeleton.translations.stride = sizeof places[0];
    skeleton.joint_count = 8;
    def.skeleton = &skeleton, def.body_count = 3, def.groups = groups, def.group_count = GROUP_COUNT;
    check(swivel_crowd_create(&def, &crowd) == SWIVEL_OK, "bodies");
    if (crowd == NULL) return;
    for (n = 0; n < 3; ++n)
        for (joint = 0; joint < 8; ++joint) rotations[n][joint][3] = 1;
    pose.rotations.data = rotations;
    pose.rotations.body_stride = sizeof rotations[0], pose.rotations.joint_stride = sizeof rotations[0][0];
    job.pose = &pose, job.solved_count = &solved;
    check(swivel_write(crowd, SWIVEL_GRIP, ARM, 0, 3, (swivel_in){grip, 0}) == SWIVEL_OK, "grips");
    check(swivel_write(crowd, SWIVEL_CONTACT, LEG, 0, 3, (swivel_in){&contact, 0}) == SWIVEL_OK, "contacts");
    check(swivel_write(crowd, SWIVEL_PROP_POSITION, THING, 0, 3, (swivel_in){thing, 0}) == SWIVEL_OK, "places");
    check(swivel_write(crowd, SWIVEL_LOOK_TARGET, HEAD, 0, 3, (swivel_in){ball, 0}) == SWIVEL_OK, "balls");
    check(swivel_solve(crowd, &job) == SWIVEL_INVALID_ARGUMENT, "a pose without time is refused");
    pose.time.data = &time;
    check(swivel_solve(crowd, &job) == SWIVEL_OK && solved == 3, "a frame of bodies");
    for (group = 0; group < GROUP_COUNT; ++group) {
        const swivel_out to = {flags, sizeof flags[0]};
        check(swivel_group_kind(crowd, group) == kinds[group], "kinds in the order of the definitions");
        check(swivel_read(crowd, SWIVEL_FLAGS, group, 0, 3, to) == SWIVEL_OK, "flags of bodies");
        for (n = 0; n < 3; ++n) check(!(flags[n] & SWIVEL_BAD_INPUT), "no bad input");
    }
    check(rotations[2][1][3] != 1 && rotations[2][7][3] != 1, "arm and head are turned");
    digest = swivel_state_digest(crowd);
    check(swivel_state_bytes(crowd) * 3 <= sizeof state, "bytes of a state");
    check(swivel_save(crowd, 0, 3, state, sizeof state) == SWIVEL_OK, "bodies are saved");
    check(swivel_reset_body(crowd, 0, 3) == SWIVEL_OK && swivel_state_digest(crowd) != digest, "bodies begin anew");
    check(swivel_load(crowd, 0, 3, state, sizeof state) == SWIVEL_OK, "bodies are loaded");
    check(swivel_state_digest(crowd) == digest, "they are as they were");
    swivel_crowd_destroy(crowd);
    arm.link = UINT32_MAX;
    check(swivel_crowd_create(&def, &crowd) == SWIVEL_INVALID_ARGUMENT, "a hand that holds nothing is refused");
}

int main(void)
{
    const float target[3] = {0.5f, -0.75f, 1.0f}, pole[3] = {0.0f, -1.0f, -1.0f}, lengths[2] = {0.75f, 1.0f};
    const swivel_in target_in = {target, 0}, pole_in = {pole, 0}, lengths_in = {lengths, 0};
    swivel_stream fields[2];
    swivel_streams frame = swivel_default_streams();
    swivel_job job = swivel_default_job();
    const swivel_blocks first_block = {0, 1};
    const swivel_limb_def limb = swivel_default_limb_def(1);
    swivel_group_def group = swivel_default_group_def();
    swivel_crowd_def def = swivel_default_crowd_def();
    swivel_crowd* crowd = NULL;
    double wrist[3] = {0, 0, 0}, distance = 1;
    const swivel_out none = {NULL, 0}, wrist_out = {wrist, sizeof wrist}, distance_out = {&distance, sizeof distance};
    uint32_t flags = 0;
    const swivel_out flags_out = {&flags, sizeof flags};
    int lines = 0, c;

    bodies();

    group.limb = &limb;
    def.group_count = 1;
    def.groups = &group;
    check(def.size == sizeof def, "the default def knows its size");
    check(swivel_version() == SWIVEL_VERSION, "library and header are of one version");
    check(swivel_crowd_create(&def, &crowd) == SWIVEL_OK, "create");
    if (crowd == NULL) return 1;
    check(swivel_write(crowd, SWIVEL_TARGET, 0, 0, 1, target_in) == SWIVEL_OK, "write targets");
    check(swivel_write(crowd, SWIVEL_POLE, 0, 0, 1, pole_in) == SWIVEL_OK, "write poles");
    check(swivel_write(crowd, SWIVEL_LENGTHS, 0, 0, 1, lengths_in) == SWIVEL_OK, "write lengths");
    check(swivel_solve(crowd, NULL) == SWIVEL_OK, "solve");
    check(swivel_forward(crowd, 0, 0, 1, none, wrist_out, none) == SWIVEL_OK, "forward kinematics");
    for (c = 0; c < 3; ++c) check(fabs(wrist[c] - (double)target[c]) < 1e-6, "the wrist is on its target");
    check(swivel_residuals(crowd, 0, 0, 1, distance_out) == SWIVEL_OK && distance < 1e-6, "residual");
    check(swivel_read(crowd, SWIVEL_FLAGS, 0, 0, 1, flags_out) == SWIVEL_OK && flags == SWIVEL_REACHED, "flags");
    fields[0].field = SWIVEL_TARGET, fields[0].data = (void*)target, fields[0].stride = 0;
    fields[1].field = SWIVEL_FLAGS, fields[1].data = &flags, fields[1].stride = sizeof flags;
    frame.fields = fields, frame.field_count = 2;
    flags = 0;
    job.streams = &frame;
    check(swivel_solve(crowd, &job) == SWIVEL_OK && flags == SWIVEL_REACHED, "a whole frame");
    job.blocks = &first_block;
    job.on_this_thread = 1;
    check(swivel_solve(crowd, &job) == SWIVEL_OK, "a block of it");
    swivel_crowd_destroy(crowd);

    check(swivel_verify(200, 1, count_line, &lines) && lines > 0, "verify");
    check(swivel_use_isa("no such thing") == SWIVEL_UNKNOWN_ISA, "unknown instruction set");
    return failures != 0;
}

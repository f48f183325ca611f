/* SPDX-License-Identifier: MIT
 *
 * In C: bodies whose spine, neck and head look at a ball, and whose eyes do, above an arm. It prints a digest that the
 * other languages' tests of the same bodies must have. All inputs are floats without rounding. */
#include <stdio.h>
#include <string.h>
#include <swivel/swivel.h>

enum { BODY_COUNT = 20, FRAME_COUNT = 16, JOINT_COUNT = 9 };
enum { HIPS, SPINE, NECK, HEAD, LEFT_EYE, RIGHT_EYE, UPPER_ARM, FOREARM, HAND };
enum { ARM, BODY, LEFT, RIGHT };

static const int32_t parents[JOINT_COUNT] = {-1, HIPS, SPINE, NECK, HEAD, HEAD, SPINE, UPPER_ARM, FOREARM};
static const float places[JOINT_COUNT][3] = {{0, 0.875f, 0},
                                             {0, 0.25f, 0},
                                             {0, 0.375f, 0},
                                             {0, 0.125f, 0.0625f},
                                             {0.03125f, 0.125f, 0.125f},
                                             {-0.03125f, 0.125f, 0.125f},
                                             {0.1875f, 0.25f, 0},
                                             {0.3125f, 0, 0},
                                             {0.25f, 0, 0}};
static const float rest[JOINT_COUNT][4] = {{0, 0, 0, 1},           {0, 0.125f, 0, 1}, {0, 0, 0, 1},
                                           {0, 0, 0, 1},           {0, 0, 0, 1},      {0, 0, 0, 1},
                                           {0, -0.25f, -0.25f, 1}, {0, -0.5f, 0, 1},  {0, 0, 0, 1}};

static float rotations[BODY_COUNT][JOINT_COUNT][4], roots[BODY_COUNT][3], balls[BODY_COUNT][3];

/* Joints as a frame of the animation has them, and the balls that fly past. */
static void animate(int frame)
{
    int n;
    for (n = 0; n < BODY_COUNT; ++n) {
        memcpy(rotations[n], rest, sizeof rest);
        roots[n][0] = 0.25f * (float)n, roots[n][1] = 0, roots[n][2] = 0.0078125f * (float)frame;
        balls[n][0] = roots[n][0] + 0.25f * (float)(frame - 8), balls[n][1] = 1.5f,
        balls[n][2] = 0.125f * (float)(n - 4);
    }
}

static int failed(const char* what)
{
    fprintf(stderr, "%s: %s\n", what, swivel_last_error());
    return 1;
}

static swivel_group_def eye(uint32_t joint)
{
    swivel_group_def def = swivel_default_look_group_def();
    def.look.joint_count = 1, def.look.joints[0] = joint;
    def.look.cos_most[0] = 0.75f, def.look.cos_full = 0.25f, def.look.cos_none = -0.25f;
    def.look.fade_distance = 0.125f, def.look.rate = 0;
    return def;
}

int main(void)
{
    static const uint32_t chain[] = {SPINE, NECK, HEAD};
    static const float shares[] = {1, 1, 2}, most[] = {0.96875f, 0.875f, 0.625f};
    swivel_limb_joints arm = swivel_default_limb_joints(UPPER_ARM, FOREARM, HAND);
    swivel_group_def groups[4];
    swivel_skeleton skeleton = swivel_default_skeleton();
    swivel_crowd_def def = swivel_default_crowd_def();
    swivel_crowd* crowd;
    swivel_pose pose = swivel_default_pose();
    swivel_job job = swivel_default_job();
    const float time = 0.015625f;
    uint32_t group, frame;

    arm.bend[2] = 1;
    groups[ARM] = swivel_default_body_group_def(&arm);
    groups[ARM].features = SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND;
    groups[BODY] = swivel_default_look_group_def();
    groups[BODY].look.joint_count = 3;
    memcpy(groups[BODY].look.joints, chain, sizeof chain);
    memcpy(groups[BODY].look.share, shares, sizeof shares);
    memcpy(groups[BODY].look.cos_most, most, sizeof most);
    groups[BODY].look.eye[1] = groups[BODY].look.eye[2] = 0.125f;
    groups[BODY].look.axis[1] = -0.125f;
    groups[BODY].look.rate = 4;
    groups[LEFT] = eye(LEFT_EYE), groups[RIGHT] = eye(RIGHT_EYE);

    skeleton.parents.data = parents, skeleton.parents.stride = sizeof *parents;
    skeleton.translations.data = places, skeleton.translations.stride = sizeof *places;
    skeleton.joint_count = JOINT_COUNT;
    def.skeleton = &skeleton, def.body_count = BODY_COUNT, def.groups = groups, def.group_count = 4;
    if (swivel_crowd_create(&def, &crowd) != SWIVEL_OK) return failed("swivel_crowd_create");

    pose.rotations.data = rotations, pose.rotations.body_stride = sizeof *rotations;
    pose.rotations.joint_stride = sizeof **rotations;
    pose.root_position.data = roots, pose.root_position.stride = sizeof *roots;
    pose.time.data = &time;
    job.pose = &pose;
    for (frame = 0; frame < FRAME_COUNT; ++frame) {
        const swivel_in at = {balls, sizeof *balls};
        animate((int)frame);
        for (group = ARM; group <= RIGHT; ++group) {
            const swivel_field field = group == ARM ? SWIVEL_TARGET : SWIVEL_LOOK_TARGET;
            if (swivel_write(crowd, field, group, 0, BODY_COUNT, at) != SWIVEL_OK) return failed("swivel_write");
        }
        if (swivel_solve(crowd, &job) != SWIVEL_OK) return failed("swivel_solve");
    }
    printf("%016llx\n", (unsigned long long)swivel_digest(crowd));
    swivel_crowd_destroy(crowd);
    return 0;
}

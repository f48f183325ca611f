/* SPDX-License-Identifier: MIT
 *
 * In C: bodies whose two hands hold a rifle, or each other, and whose feet stand on slopes. It prints digests that the
 * other languages' tests of the same bodies must have. All inputs are floats without rounding. */
#include <stdio.h>
#include <swivel/swivel.h>

enum { BODY_COUNT = 20, FRAME_COUNT = 16, JOINT_COUNT = 11 };
enum { HIPS, CHEST, LEFT_ARM, LEFT_FOREARM, LEFT_HAND, RIGHT_ARM, RIGHT_FOREARM, RIGHT_HAND, THIGH, SHIN, FOOT };
enum { LEG, LEFT, RIGHT, RIFLE };

static const int32_t parents[JOINT_COUNT] = {-1,        HIPS,          CHEST, LEFT_ARM, LEFT_FOREARM, CHEST,
                                             RIGHT_ARM, RIGHT_FOREARM, HIPS,  THIGH,    SHIN};
static const float places[JOINT_COUNT][3] = {{0, 0.921875f, 0}, {0, 0.5f, 0},     {0.1875f, 0, 0},  {0.3125f, 0, 0},
                                             {0.25f, 0, 0},     {-0.1875f, 0, 0}, {-0.3125f, 0, 0}, {-0.25f, 0, 0},
                                             {0.125f, 0, 0},    {0, -0.4375f, 0}, {0, -0.4375f, 0}};
static const float rest[JOINT_COUNT][4] = {
    {0, 0, 0, 1},    {0, 0, 0, 1}, {0, -0.25f, -0.25f, 1}, {0, -0.5f, 0, 1}, {0, 0, 0, 1},      {0, 0.25f, 0.25f, 1},
    {0, 0.5f, 0, 1}, {0, 0, 0, 1}, {-0.125f, 0, 0, 1},     {0.25f, 0, 0, 1}, {-0.125f, 0, 0, 1}};

static float rotations[BODY_COUNT][JOINT_COUNT][4], roots[BODY_COUNT][3];

/* Joints as a frame of the animation has them, at rest at first. */
static void animate(int frame)
{
    int n, j, c;
    for (n = 0; n < BODY_COUNT; ++n) {
        for (j = 0; j < JOINT_COUNT; ++j)
            for (c = 0; c < 4; ++c) rotations[n][j][c] = rest[j][c];
        rotations[n][CHEST][1] = 0.125f * (float)(n % 3);
        roots[n][0] = 0.25f * (float)n, roots[n][1] = 0, roots[n][2] = 0.0078125f * (float)frame;
    }
}

/* The ground below feet: a plane for each body, through the place from which its root starts. */
static void sample(const float (*probes)[3], float (*grounds)[3], float (*normals)[3])
{
    int n;
    for (n = 0; n < BODY_COUNT; ++n) {
        const double x = probes[n][0], z = probes[n][2], ahead = 0.25 * (n % 3 - 1);
        grounds[n][0] = probes[n][0];
        grounds[n][1] = (float)(ahead * z + 0.125 * (x - 0.25 * n));
        grounds[n][2] = probes[n][2];
        normals[n][0] = -0.125f, normals[n][1] = 1, normals[n][2] = (float)-ahead;
    }
}

static int failed(const char* what)
{
    fprintf(stderr, "%s: %s\n", what, swivel_last_error());
    return 1;
}
static swivel_limb_joints limb(uint32_t shoulder, float bend)
{
    swivel_limb_joints joints = swivel_default_limb_joints(shoulder, shoulder + 1, shoulder + 2);
    joints.bend[2] = bend;
    return joints;
}
static swivel_status write(swivel_crowd* crowd, swivel_field field, uint32_t group, const float* values, size_t stride)
{
    const swivel_in in = {values, stride};
    return swivel_write(crowd, field, group, 0, BODY_COUNT, in);
}

/* One frame, with the ground by two calls. */
static int step(swivel_crowd* crowd, int frame)
{
    static float probes[BODY_COUNT][3], grounds[BODY_COUNT][3], normals[BODY_COUNT][3];
    const swivel_out to = {probes, sizeof probes[0]};
    const float contact = frame >= 2, time = 0.015625f;
    swivel_pose pose = swivel_default_pose();
    swivel_job job = swivel_default_job();
    animate(frame);
    pose.rotations.data = rotations;
    pose.rotations.body_stride = sizeof rotations[0], pose.rotations.joint_stride = sizeof rotations[0][0];
    pose.root_position.data = roots, pose.root_position.stride = sizeof roots[0];
    pose.time.data = &time;
    job.pose = &pose;
    if (write(crowd, SWIVEL_CONTACT, LEG, &contact, 0)) return failed("contact");
    job.probes_only = 1;
    if (swivel_solve(crowd, &job)) return failed("probes");
    job.probes_only = 0;
    if (swivel_read(crowd, SWIVEL_PROBE, LEG, 0, BODY_COUNT, to)) return failed("read");
    sample(probes, grounds, normals);
    if (write(crowd, SWIVEL_GROUND, LEG, grounds[0], sizeof grounds[0])) return failed("ground");
    if (write(crowd, SWIVEL_GROUND_NORMAL, LEG, normals[0], sizeof normals[0])) return failed("normals");
    if (swivel_solve(crowd, &job)) return failed("solve");
    return 0;
}

/* holds: each other, not a rifle. */
static int hold(int holds)
{
    const float toe[3] = {0, -0.0625f, 0.125f}, left_grip[7] = {0.125f, 0, 0.0625f, 0, 0, 0.25f, 1},
                right_grip[7] = {-0.125f, 0, 0, 0.125f, 0, 0, 1}, clasp[7] = {0.03125f, -0.0625f, 0, 0, 0.5f, 0, 1};
    const swivel_limb_joints leg = limb(THIGH, -1), left = limb(LEFT_ARM, 1), right = limb(RIGHT_ARM, 1);
    swivel_group_def groups[4];
    swivel_skeleton skeleton = swivel_default_skeleton();
    swivel_crowd_def def = swivel_default_crowd_def();
    swivel_crowd* crowd;
    float goals[BODY_COUNT][3];
    int n, frame;

    skeleton.parents.data = parents, skeleton.parents.stride = sizeof parents[0];
    skeleton.translations.data = places, skeleton.translations.stride = sizeof places[0];
    skeleton.joint_count = JOINT_COUNT;
    groups[LEG] = swivel_default_body_group_def(&leg);
    groups[LEG].features =
        SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_PLANT | SWIVEL_WITH_GROUND;
    groups[LEG].ground.heel[1] = groups[LEG].ground.heel[2] = -0.0625f;
    groups[LEG].ground.toe_clearance = 0.015625f, groups[LEG].ground.heel_clearance = 0.03125f;
    groups[LEG].ground.cos_most = 0.96875f, groups[LEG].ground.half = 0.125f;
    groups[LEFT] = swivel_default_body_group_def(&left);
    groups[RIGHT] = swivel_default_body_group_def(&right);
    groups[LEFT].features = groups[RIGHT].features = SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND | SWIVEL_WITH_LINK;
    groups[LEFT].link = groups[RIGHT].link = RIFLE;
    groups[RIFLE] = swivel_default_prop_group_def();
    groups[RIFLE].prop.joint = CHEST, groups[RIFLE].prop.most_move = 0.03125f;
    if (holds) groups[LEFT].features ^= SWIVEL_WITH_LINK, groups[RIGHT].link = LEFT;
    def.skeleton = &skeleton, def.body_count = BODY_COUNT;
    def.groups = groups, def.group_count = holds ? RIFLE : RIFLE + 1;

    if (swivel_crowd_create(&def, &crowd)) return failed("create");
    if (write(crowd, SWIVEL_EFFECTOR, LEG, toe, 0)) return failed("toe");
    if (write(crowd, SWIVEL_GRIP, RIGHT, holds ? clasp : right_grip, 0)) return failed("right grip");
    for (n = 0; n < BODY_COUNT; ++n) {
        goals[n][0] = holds ? 0.25f * (float)n : 0, goals[n][1] = holds ? 1.375f : -0.0625f;
        goals[n][2] = 0.3125f + 0.015625f * (float)n;
    }
    if (write(crowd, holds ? SWIVEL_TARGET : SWIVEL_PROP_PLACE, holds ? LEFT : RIFLE, goals[0], sizeof goals[0]))
        return failed("goals");
    if (!holds && write(crowd, SWIVEL_GRIP, LEFT, left_grip, 0)) return failed("left grip");
    for (frame = 0; frame < FRAME_COUNT; ++frame)
        if (step(crowd, frame)) return 1;
    printf("%016llx\n", (unsigned long long)swivel_digest(crowd));
    swivel_crowd_destroy(crowd);
    return 0;
}

int main(void) { return hold(0) || hold(1); }

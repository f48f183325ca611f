/* SPDX-License-Identifier: MIT
 * C11: the two arms of a skeleton. Its rest pose goes in once, then targets in the world; out come its own joints'
 * local rotations, ready to be stored. */
#include <stdio.h>
#include <swivel/swivel.h>

enum { LEFT, RIGHT, SIDE_COUNT };

static int failed(const char* what)
{
    fprintf(stderr, "%s failed: %s\n", what, swivel_last_error());
    return 1;
}

/* The skeleton at rest, in metres: a T-pose facing +z with y up, each joint in the frame of its parent. No joint is
 * turned at rest; else the skeleton would have rotations, too. */
enum { CHEST, LEFT_SHOULDER, LEFT_ELBOW, LEFT_WRIST, RIGHT_SHOULDER, RIGHT_ELBOW, RIGHT_WRIST, JOINT_COUNT };
static const int32_t parents[JOINT_COUNT] = {-1, CHEST, LEFT_SHOULDER, LEFT_ELBOW, CHEST, RIGHT_SHOULDER, RIGHT_ELBOW};
static const float translations[JOINT_COUNT][3] = {{0, 1.2f, 0},      {0.18f, 0.2f, 0}, {0.30f, 0, 0}, {0.26f, 0, 0},
                                                   {-0.18f, 0.2f, 0}, {-0.30f, 0, 0},   {-0.26f, 0, 0}};

static swivel_status bind_arm(int side, swivel_binding* binding)
{
    const uint32_t shoulder = side == LEFT ? LEFT_SHOULDER : RIGHT_SHOULDER;
    swivel_skeleton skeleton = swivel_default_skeleton();
    swivel_limb_joints joints = swivel_default_limb_joints(shoulder, shoulder + 1, shoulder + 2);
    skeleton.joint_count = JOINT_COUNT;
    skeleton.parents = (swivel_in){parents, sizeof parents[0]};
    skeleton.translations = (swivel_in){translations, sizeof translations[0]};
    joints.bend[2] = 1; /* both elbows bend forwards */
    return swivel_bind_joints(&skeleton, &joints, binding);
}

int main(void)
{
    /* What the game knows each frame, in the world. */
    const float grip[SIDE_COUNT][3] = {{0.15f, 1.10f, 0.40f}, {-0.25f, 1.55f, 0.35f}};
    const float elbow_hint[3] = {0, -10, 0}; /* elbows down */
    const float shoulder[SIDE_COUNT][3] = {{0.18f, 1.40f, 0}, {-0.18f, 1.40f, 0}};
    const char* const names[SIDE_COUNT] = {"left", "right"};

    swivel_limb_def arms[SIDE_COUNT]; /* limbs of one skeleton's one side: here a single one each */
    swivel_group_def groups[SIDE_COUNT];
    swivel_crowd_def def = swivel_default_crowd_def();
    swivel_crowd* crowd = NULL;
    int side;

    for (side = LEFT; side < SIDE_COUNT; ++side) {
        arms[side] = swivel_default_limb_def(1);
        arms[side].features = SWIVEL_WORLD | SWIVEL_JOINTS;
        if (bind_arm(side, &arms[side].binding) != SWIVEL_OK) return failed("swivel_bind_joints");
        groups[side] = swivel_default_group_def();
        groups[side].limb = &arms[side];
    }
    def.groups = groups;
    def.group_count = SIDE_COUNT;
    if (swivel_crowd_create(&def, &crowd) != SWIVEL_OK) return failed("swivel_crowd_create");

    for (side = LEFT; side < SIDE_COUNT; ++side) {
        const uint32_t group = (uint32_t)side;
        /* A stride of 0 is one value for all limbs of the group; there is one limb here. */
        const swivel_in target = {grip[side], 0}, pole = {elbow_hint, 0}, place = {shoulder[side], 0};
        if (swivel_write(crowd, SWIVEL_TARGET, group, 0, 1, target) != SWIVEL_OK ||
            swivel_write(crowd, SWIVEL_POLE, group, 0, 1, pole) != SWIVEL_OK ||
            swivel_write(crowd, SWIVEL_SHOULDER_POSITION, group, 0, 1, place) != SWIVEL_OK)
            return failed("swivel_write");
    }
    if (swivel_solve(crowd, NULL) != SWIVEL_OK) return failed("swivel_solve");

    for (side = LEFT; side < SIDE_COUNT; ++side) {
        const uint32_t group = (uint32_t)side;
        float local[4];  /* the shoulder joint's local rotation */
        double wrist[3]; /* where forward kinematics puts the wrist */
        double off = 0;  /* the largest of its three differences from the target */
        int c;
        const swivel_out local_out = {local, sizeof local}, wrist_out = {wrist, sizeof wrist}, none = {NULL, 0};
        if (swivel_read(crowd, SWIVEL_SHOULDER, group, 0, 1, local_out) != SWIVEL_OK) return failed("swivel_read");
        if (swivel_forward(crowd, group, 0, 1, none, wrist_out, none) != SWIVEL_OK) return failed("swivel_forward");
        for (c = 0; c < 3; ++c) {
            const double difference = wrist[c] - (double)grip[side][c];
            if (difference > off) off = difference;
            if (-difference > off) off = -difference;
        }
        printf("%s shoulder %+.3f %+.3f %+.3f %+.3f, wrist off by %.6f m\n", names[side], local[0], local[1], local[2],
               local[3], off);
    }
    swivel_crowd_destroy(crowd);
    return 0;
}

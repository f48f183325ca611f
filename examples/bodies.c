/* SPDX-License-Identifier: MIT
 * C11: a crowd of bodies. Their poses go in and come out. Feet that are down stand still, the pelvis goes down so that
 * legs reach, an arm takes hold of a thing, and the head looks at it. */
#include <math.h>
#include <stdio.h>
#include <string.h>
// [shown]
#include <swivel/swivel_bodies.h>

enum { BODY_COUNT = 20 };
enum { LEFT_LEG, RIGHT_LEG, ARM, LOOK, SHIFT, GROUP_COUNT };
enum { PELVIS, THIGH_L, SHIN_L, FOOT_L, THIGH_R, SHIN_R, FOOT_R, CHEST, HEAD, UPPER_ARM, FOREARM, HAND, JOINT_COUNT };
static const int32_t parents[JOINT_COUNT] = {-1,     PELVIS, THIGH_L, SHIN_L, PELVIS,    THIGH_R,
                                             SHIN_R, PELVIS, CHEST,   CHEST,  UPPER_ARM, FOREARM};
static const float offsets[JOINT_COUNT][3] = {{0, 0.9f, 0},  {0.1f, 0, 0},    {0, -0.45f, 0}, {0, -0.43f, 0},
                                              {-0.1f, 0, 0}, {0, -0.45f, 0},  {0, -0.43f, 0}, {0, 0.3f, 0},
                                              {0, 0.3f, 0},  {0.2f, 0.2f, 0}, {0.3f, 0, 0},   {0.26f, 0, 0}};

typedef struct body {
    float root[3];                /* in the world, as the target is; the roots here are not turned */
    float pose[JOINT_COUNT][4];   /* local rotations x, y, z, w, as the animation has them */
    float solved[JOINT_COUNT][4]; /* a copy of pose, solved: draw this one, with shift[0] added to the root's height */
    float joints[JOINT_COUNT][3]; /* where a solve has left them, from root and along its axes */
    float shift[3];
    float down[2];   /* 1 while the clip has the left or right foot down, else 0 */
    float target[3]; /* of the hand and of the eyes */
    float time;      /* seconds since this body's last solve */
} body;

static swivel_status make_crowd(swivel_crowd** crowd)
{
    swivel_limb_joints joints[] = {swivel_default_limb_joints(THIGH_L, SHIN_L, FOOT_L),
                                   swivel_default_limb_joints(THIGH_R, SHIN_R, FOOT_R),
                                   swivel_default_limb_joints(UPPER_ARM, FOREARM, HAND)};
    swivel_body_limb_def limbs[3];
    swivel_look_def look = swivel_default_look_def();
    swivel_shift_def shift = swivel_default_shift_def();
    swivel_group_def groups[GROUP_COUNT];
    swivel_skeleton skeleton = swivel_default_skeleton();
    swivel_crowd_def def = swivel_default_crowd_def();
    uint32_t g;

    for (g = 0; g < GROUP_COUNT; ++g) groups[g] = swivel_default_group_def();
    for (g = LEFT_LEG; g <= ARM; ++g) {
        joints[g].bend[2] = g == ARM ? 1 : -1; /* a forearm goes forwards, a shin backwards */
        limbs[g] = swivel_default_body_limb_def(&joints[g]);
        limbs[g].features = SWIVEL_POLE_INCOMING; /* knees and elbows stay in their plane */
        if (g != ARM) limbs[g].features |= SWIVEL_WITH_PLANT | SWIVEL_WITH_PELVIS_FIT;
        groups[g].body_limb = &limbs[g];
    }
    look.joint_count = 2;
    look.joints[0] = CHEST, look.joints[1] = HEAD; /* they see along the head's z axis */
    groups[LOOK].look = &look;
    groups[SHIFT].shift = &shift;

    skeleton.parents = (swivel_in){parents, sizeof parents[0]};
    skeleton.translations = (swivel_in){offsets, sizeof offsets[0]};
    skeleton.joint_count = JOINT_COUNT;
    def.skeleton = &skeleton;
    def.body_count = BODY_COUNT;
    def.groups = groups;
    def.group_count = GROUP_COUNT;
    return swivel_crowd_create(&def, crowd);
}

static swivel_status solve(swivel_crowd* crowd, body bodies[BODY_COUNT])
{
    const size_t step = sizeof bodies[0];
    const swivel_stream fields[GROUP_COUNT] = {[LEFT_LEG] = {SWIVEL_CONTACT, &bodies->down[0], step},
                                               [RIGHT_LEG] = {SWIVEL_CONTACT, &bodies->down[1], step},
                                               [ARM] = {SWIVEL_TARGET, bodies->target, step},
                                               [LOOK] = {SWIVEL_LOOK_TARGET, bodies->target, step},
                                               [SHIFT] = {SWIVEL_SHIFT, bodies->shift, step}};
    swivel_streams streams[GROUP_COUNT];
    swivel_pose pose = swivel_default_pose();
    swivel_job job = swivel_default_job();
    uint32_t n;

    for (n = 0; n < GROUP_COUNT; ++n) {
        streams[n] = swivel_default_streams();
        streams[n].fields = &fields[n], streams[n].field_count = 1;
    }
    for (n = 0; n < BODY_COUNT; ++n) memcpy(bodies[n].solved, bodies[n].pose, sizeof bodies[n].pose);
    pose.rotations = (swivel_joint_values){bodies->pose, step, sizeof bodies->pose[0], NULL};
    pose.results = (swivel_joint_values){bodies->solved, step, sizeof bodies->solved[0], NULL};
    pose.joint_positions = (swivel_joint_values){bodies->joints, step, sizeof bodies->joints[0], NULL};
    pose.root_position = (swivel_in){bodies->root, step};
    pose.time = (swivel_in){&bodies->time, step};
    job.streams = streams; /* one for each group */
    job.pose = &pose;
    return swivel_solve(crowd, &job);
}
// [end]

static int failed(const char* what)
{
    fprintf(stderr, "%s failed: %s\n", what, swivel_last_error());
    return 1;
}

/* How far a joint is from a place in the world. */
static double distance_of(const body* b, int joint, const float place[3])
{
    double squares = 0;
    int c;
    for (c = 0; c < 3; ++c) {
        const double off = (double)b->root[c] + (double)b->joints[joint][c] - (double)place[c];
        squares += off * off;
    }
    return sqrt(squares);
}

int main(void)
{
    static body bodies[BODY_COUNT];
    const float wish = -0.05f; /* in metres: it gives legs room while the shift's spring is on its way */
    swivel_crowd* crowd = NULL;
    double slid = 0, off = 0;
    int frame, n, joint;

    for (n = 0; n < BODY_COUNT; ++n) {
        const body stands = {.root = {2 * (float)n, 0, 0},
                             .down = {1, 1},
                             .target = {2 * (float)n + 0.4f, 1.3f, 0.4f},
                             .time = 1.0f / 60};
        bodies[n] = stands;
        for (joint = 0; joint < JOINT_COUNT; ++joint) bodies[n].pose[joint][3] = 1;
    }
    if (make_crowd(&crowd) != SWIVEL_OK) return failed("the crowd");
    if (swivel_write(crowd, SWIVEL_SHIFT_WISH, SHIFT, 0, BODY_COUNT, (swivel_in){&wish, 0}) != SWIVEL_OK)
        return failed("the wish");
    for (frame = 0; frame < 15; ++frame) { /* the animation stands while the root glides: feet would slide */
        if (solve(crowd, bodies) != SWIVEL_OK) return failed("the solve");
        for (n = 0; n < BODY_COUNT; ++n) {
            const float foot[3] = {2 * (float)n + 0.1f, 0.02f, 0};
            slid = fmax(slid, distance_of(&bodies[n], FOOT_L, foot));
            off = fmax(off, distance_of(&bodies[n], HAND, bodies[n].target));
            bodies[n].root[2] += 0.01f;
        }
    }
    printf("feet slid by %.6f m, hands are off by %.6f m; pelvises went down by %.3f m\n", slid, off,
           -(double)bodies[0].shift[0]);
    swivel_crowd_destroy(crowd);
    return 0;
}

/* SPDX-License-Identifier: MIT
 * C11: legs and arms of one skeleton in one crowd. Legs ask for little. Arms ask for a hand and a limit, and keep their
 * pose while a target is lost. One job solves both groups, from and to the program's own structures. */
#include <math.h>
#include <stdio.h>
#include <swivel/swivel.h>

enum { LEGS, ARMS, GROUP_COUNT, CHARACTER_COUNT = 20 };

typedef struct character { /* in the world; rotations are x, y, z, w */
    float hip[3], ankle[3], knee_hint[3];
    float thigh[4], shin[4]; /* local rotations of joints, as are the next three */
    float shoulder[3], grip[3], elbow_hint[3], palm[4];
    float upper_arm[4], forearm[4], hand[4];
    uint32_t arm_flags;
} character;

static character characters[CHARACTER_COUNT];

static int failed(const char* what)
{
    fprintf(stderr, "%s failed: %s\n", what, swivel_last_error());
    return 1;
}

static void place_characters(void)
{
    int n;
    for (n = 0; n < CHARACTER_COUNT; ++n) {
        const float x = 2 * (float)n;
        const character stands = {{x + 0.1f, 0.95f, 0},
                                  {x + 0.1f, 0.25f, 0.1f},
                                  {x + 0.1f, 0.5f, 2},
                                  {0},
                                  {0},
                                  {x + 0.2f, 1.4f, 0},
                                  {x + 0.4f, 1.2f, 0.3f},
                                  {x + 0.2f, 0.4f, -1},
                                  {0, 0, 0, 1},
                                  {0},
                                  {0},
                                  {0},
                                  0};
        characters[n] = stands;
    }
}

/* The skeleton at rest, each joint in the frame of its parent: a leg down -y and a left arm along +x. */
enum { PELVIS, HIP, KNEE, ANKLE, SHOULDER, ELBOW, WRIST, JOINT_COUNT };
static const int32_t parents[JOINT_COUNT] = {-1, PELVIS, HIP, KNEE, PELVIS, SHOULDER, ELBOW};
static const float translations[JOINT_COUNT][3] = {{0, 0.95f, 0},    {0.1f, 0, 0},  {0, -0.45f, 0}, {0, -0.42f, 0},
                                                   {0.2f, 0.45f, 0}, {0.30f, 0, 0}, {0.26f, 0, 0}};

/* forwards: towards +z, as an elbow bends; -1 is backwards, as a knee does. */
static swivel_status bind_limb(uint32_t first_joint, float forwards, swivel_binding* binding)
{
    swivel_skeleton skeleton = swivel_default_skeleton();
    swivel_limb_joints joints = swivel_default_limb_joints(first_joint, first_joint + 1, first_joint + 2);
    skeleton.joint_count = JOINT_COUNT;
    skeleton.parents = (swivel_in){parents, sizeof parents[0]};
    skeleton.translations = (swivel_in){translations, sizeof translations[0]};
    joints.bend[2] = forwards;
    return swivel_bind_joints(&skeleton, &joints, binding);
}

static swivel_status make_crowd(swivel_crowd** crowd)
{
    swivel_limb_def legs = swivel_default_limb_def(CHARACTER_COUNT);
    swivel_limb_def arms = swivel_default_limb_def(CHARACTER_COUNT);
    swivel_group_def groups[GROUP_COUNT];
    swivel_crowd_def def = swivel_default_crowd_def();
    legs.features = SWIVEL_WORLD | SWIVEL_JOINTS;
    arms.features = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_WITH_SHOULDER_CONE;
    arms.on_bad_input = SWIVEL_KEEP_POSE;
    groups[LEGS] = groups[ARMS] = swivel_default_group_def();
    groups[LEGS].limb = &legs;
    groups[ARMS].limb = &arms;
    def.groups = groups;
    def.group_count = GROUP_COUNT;
    if (bind_limb(HIP, -1, &legs.binding) != SWIVEL_OK) return SWIVEL_INVALID_ARGUMENT;
    if (bind_limb(SHOULDER, 1, &arms.binding) != SWIVEL_OK) return SWIVEL_INVALID_ARGUMENT;
    return swivel_crowd_create(&def, crowd);
}

/* Upper arms stay within 60 degrees of the arm at rest. */
static swivel_status limit_arms(swivel_crowd* crowd)
{
    const double along_arm[3] = {0, 0, 1};
    float cone[4];
    const swivel_in one_for_all = {cone, 0};
    if (swivel_cone(along_arm, 60 * 3.14159265358979 / 180, cone) != SWIVEL_OK) return SWIVEL_INVALID_ARGUMENT;
    return swivel_write(crowd, SWIVEL_SHOULDER_CONE, ARMS, 0, CHARACTER_COUNT, one_for_all);
}

static swivel_status solve(swivel_crowd* crowd)
{
    const size_t stride = sizeof characters[0];
    const swivel_stream leg[] = {
        {SWIVEL_SHOULDER_POSITION, characters[0].hip, stride},
        {SWIVEL_TARGET, characters[0].ankle, stride},
        {SWIVEL_POLE, characters[0].knee_hint, stride},
        {SWIVEL_SHOULDER, characters[0].thigh, stride},
        {SWIVEL_ELBOW, characters[0].shin, stride},
    };
    const swivel_stream arm[] = {
        {SWIVEL_SHOULDER_POSITION, characters[0].shoulder, stride},
        {SWIVEL_TARGET, characters[0].grip, stride},
        {SWIVEL_POLE, characters[0].elbow_hint, stride},
        {SWIVEL_HAND, characters[0].palm, stride},
        {SWIVEL_SHOULDER, characters[0].upper_arm, stride},
        {SWIVEL_ELBOW, characters[0].forearm, stride},
        {SWIVEL_WRIST, characters[0].hand, stride},
        {SWIVEL_FLAGS, &characters[0].arm_flags, stride},
    };
    swivel_streams streams[GROUP_COUNT];
    swivel_job job = swivel_default_job();
    streams[LEGS] = swivel_default_streams();
    streams[LEGS].fields = leg, streams[LEGS].field_count = sizeof leg / sizeof leg[0];
    streams[ARMS] = swivel_default_streams();
    streams[ARMS].fields = arm, streams[ARMS].field_count = sizeof arm / sizeof arm[0];
    job.streams = streams;  // one for each group
    return swivel_solve(crowd, &job);
}

/* The largest distance from a target to its ankle or wrist, in limb lengths. */
static double worst_of(const swivel_crowd* crowd, uint32_t group)
{
    double off[CHARACTER_COUNT], worst = 0;
    const swivel_out distance = {off, sizeof off[0]};
    int n;
    if (swivel_residuals(crowd, group, 0, CHARACTER_COUNT, distance) != SWIVEL_OK) return HUGE_VAL;
    for (n = 0; n < CHARACTER_COUNT; ++n)
        if (!(off[n] <= worst)) worst = off[n];
    return worst;
}

int main(void)
{
    swivel_crowd* crowd = NULL;
    character* const blind = &characters[7];
    float kept;
    int limited = 0, n;

    place_characters();
    if (make_crowd(&crowd) != SWIVEL_OK) return failed("the crowd");
    if (limit_arms(crowd) != SWIVEL_OK) return failed("the limit");
    if (solve(crowd) != SWIVEL_OK) return failed("the solve");
    for (n = 0; n < CHARACTER_COUNT; ++n) limited += (characters[n].arm_flags & SWIVEL_LIMITED_SHOULDER_CONE) != 0;
    printf("%d legs off by %.6f, %d arms by %.6f; the limit turned %d elbows\n", (int)CHARACTER_COUNT,
           worst_of(crowd, LEGS), (int)CHARACTER_COUNT, worst_of(crowd, ARMS), limited);

    kept = blind->upper_arm[0];
    blind->grip[0] = NAN; /* a tracker lost this hand */
    if (solve(crowd) != SWIVEL_OK) return failed("the second solve");
    printf("arm 7 has %s input and %s its pose\n", blind->arm_flags & SWIVEL_BAD_INPUT ? "bad" : "good",
           blind->upper_arm[0] == kept ? "keeps" : "LOST");
    swivel_crowd_destroy(crowd);
    return 0;
}

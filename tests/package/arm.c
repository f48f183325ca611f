/* SPDX-License-Identifier: MIT
 *
 * A host's C11 program: solves a thousand arms and prints one line with the digest of their results, the same as
 * arm.cpp prints. */
#include <stdio.h>
#include <swivel/swivel.h>

enum { ARM_COUNT = 1000 };

static float targets[ARM_COUNT][3];
static double distances[ARM_COUNT];

static int failed(const char* what)
{
    fprintf(stderr, "%s: %s\n", what, swivel_last_error());
    return 1;
}

int main(void)
{
    const float pole[3] = {0.25f, -1.0f, 0.125f}, lengths[2] = {0.30f, 0.26f};
    const swivel_in target_in = {targets, sizeof targets[0]}, pole_in = {pole, 0}, lengths_in = {lengths, 0};
    const swivel_out distance_out = {distances, sizeof distances[0]};
    const swivel_limb_def arms = swivel_default_limb_def(ARM_COUNT);
    swivel_group_def group = swivel_default_group_def();
    swivel_crowd_def def = swivel_default_crowd_def();
    swivel_crowd* crowd = NULL;
    uint32_t random = 1;
    uint64_t digest;
    double worst = 0;
    int n, c;

    if (swivel_version() != SWIVEL_VERSION) return fprintf(stderr, "header and library differ\n"), 1;
    group.limb = &arms;
    def.group_count = 1;
    def.groups = &group;
    for (n = 0; n < ARM_COUNT; ++n)
        for (c = 0; c < 3; ++c) { /* components from 0.04 to 0.30: all within reach */
            random = random * 1664525u + 1013904223u;
            targets[n][c] = 0.04f + (float)(random >> 8) * (0.26f / 16777216.0f);
        }

    if (swivel_crowd_create(&def, &crowd)) return failed("create");
    if (swivel_write(crowd, SWIVEL_TARGET, 0, 0, ARM_COUNT, target_in)) return failed("targets");
    if (swivel_write(crowd, SWIVEL_POLE, 0, 0, ARM_COUNT, pole_in)) return failed("poles");
    if (swivel_write(crowd, SWIVEL_LENGTHS, 0, 0, ARM_COUNT, lengths_in)) return failed("lengths");
    if (swivel_solve(crowd, NULL)) return failed("solve");
    if (swivel_residuals(crowd, 0, 0, ARM_COUNT, distance_out)) return failed("residuals");
    digest = swivel_digest(crowd);
    swivel_crowd_destroy(crowd);

    for (n = 0; n < ARM_COUNT; ++n)
        if (!(distances[n] <= worst)) worst = distances[n];
    printf("swivel %u, %d arms %s, digest %016llx\n", (unsigned)swivel_version(), (int)ARM_COUNT,
           worst < 1e-6 ? "on target" : "off target", (unsigned long long)digest);
    return !(worst < 1e-6);
}

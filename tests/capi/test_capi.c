/* SPDX-License-Identifier: MIT
 *
 * The promise: swivel.h is C11, and a C program can make a crowd, solve an arm and find its wrist on the target. */
#include <math.h>
#include <stdio.h>

#include "swivel/lecture.h"
#include "swivel/swivel.h"

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

/* As the head of swivel.h shows it; tests/test_docs.py compares them. Returns 0, or what puts() gives. */
static int head_of_header(void)
{
    float targets[2][3] = {{0.3f, 0.1f, 0.3f}, {0.0f, 0.2f, 9.0f}};  // for the wrists; the second is out of reach
    float pole[3] = {0, -1, 0}, lengths[2] = {0.30f, 0.26f};         // upper arm, forearm
    float shoulder[2][4];                                            // x, y, z, w
    swivel_group_def arms = swivel_default_group_def(2);             // group 0
    swivel_crowd_def def = swivel_default_crowd_def();
    swivel_crowd* crowd;
    def.groups = &arms, def.group_count = 1;
    if (swivel_crowd_create(&def, &crowd) != SWIVEL_OK) return puts(swivel_last_error());
    swivel_write(crowd, SWIVEL_TARGET, 0, 0, 2, (swivel_in){targets, sizeof targets[0]});
    swivel_write(crowd, SWIVEL_POLE, 0, 0, 2, (swivel_in){pole, 0});  // stride 0: one value for all
    swivel_write(crowd, SWIVEL_LENGTHS, 0, 0, 2, (swivel_in){lengths, 0});
    swivel_solve(crowd, NULL);
    swivel_read(crowd, SWIVEL_SHOULDER, 0, 0, 2, (swivel_out){shoulder, sizeof shoulder[0]});
    swivel_crowd_destroy(crowd);
    return !(shoulder[0][3] >= 0 && shoulder[1][0] < 0 && shoulder[0][0] != shoulder[1][0]);
}

int main(void)
{
    const float target[3] = {0.5f, -0.75f, 1.0f}, pole[3] = {0.0f, -1.0f, -1.0f}, lengths[2] = {0.75f, 1.0f};
    const swivel_in target_in = {target, 0}, pole_in = {pole, 0}, lengths_in = {lengths, 0};
    swivel_frame_field fields[2];
    swivel_frame frame = swivel_default_frame();
    swivel_job job = swivel_default_job();
    const swivel_blocks first_block = {0, 1};
    swivel_group_def group = swivel_default_group_def(1);
    swivel_crowd_def def = swivel_default_crowd_def();
    swivel_crowd* crowd = NULL;
    double wrist[3] = {0, 0, 0}, distance = 1;
    const swivel_out none = {NULL, 0}, wrist_out = {wrist, sizeof wrist}, distance_out = {&distance, sizeof distance};
    uint32_t flags = 0;
    const swivel_out flags_out = {&flags, sizeof flags};
    uint16_t words[7 * SWIVEL_LANES];
    float shoulder[4];
    int lines = 0, c;

    check(head_of_header() == 0, "the head of swivel.h is a program");

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
    job.frames = &frame;
    check(swivel_solve(crowd, &job) == SWIVEL_OK && flags == SWIVEL_REACHED, "a whole frame");
    job.blocks = &first_block;
    job.on_this_thread = 1;
    check(swivel_solve(crowd, &job) == SWIVEL_OK, "a block of it");
    swivel_crowd_destroy(crowd);

    group.features = 0;
    check(swivel_crowd_create(&def, &crowd) == SWIVEL_OK, "a crowd at rest");
    if (crowd == NULL) return 1;
    check(swivel_packed_row(0, SWIVEL_RESULT_END) == 7 && swivel_pack(crowd, 0, first_block, words) == SWIVEL_OK,
          "its words");
    swivel_unpack_rotation(words, SWIVEL_LANES, shoulder);
    check(shoulder[0] == 0 && shoulder[1] == 0 && shoulder[2] == 0 && shoulder[3] == 1, "its shoulder");
    check(swivel_unpack_half(words[3 * SWIVEL_LANES]) == 1, "its elbow");
    check(words[5 * SWIVEL_LANES] == 0 && words[6 * SWIVEL_LANES] == 0, "its flags, before any solve");
    check(swivel_solve(crowd, NULL) == SWIVEL_OK && swivel_pack(crowd, 0, first_block, words) == SWIVEL_OK &&
              words[6 * SWIVEL_LANES] == SWIVEL_BAD_INPUT >> 16,
          "its flags, solved without a target");
    swivel_crowd_destroy(crowd);

    check(swivel_verify(200, 1, count_line, &lines) && lines > 0, "verify");
    check(swivel_use_isa("no such thing") == SWIVEL_UNKNOWN_ISA, "unknown instruction set");
    return failures != 0;
}

/* SPDX-License-Identifier: MIT
 *
 * Prints src/layout.ts: the numbers of swivel.h's names, and where the members of its structures lie in WebAssembly's
 * memory. The compiler knows both, so no number is written twice. */
#include <inttypes.h>
#include <stdio.h>

#include "swivel/swivel.h"

#define FEATURE(NAME) printf("    %s: %" PRIu64 "n,\n", #NAME, (uint64_t)SWIVEL_##NAME)
#define NUMBER(NAME) printf("    %s: %u,\n", #NAME, (unsigned)SWIVEL_##NAME)
/* A field's number, and the name of its member in swivel_frame. */
#define FIELD(NAME, name) \
    NUMBER(NAME), members[field_count++] = (member) { #NAME, offsetof(swivel_frame, name) }
#define OFFSET(structure, name) printf(" %s: %zu,", #name, offsetof(structure, name))
#define BEGIN(structure) printf("    %s: { bytes: %zu,", #structure, sizeof(structure))
#define END() printf(" },\n")

typedef struct member {
    const char* name;
    size_t offset;
} member;
static member members[64];
static int field_count = 0;

static void print_names(void)
{
    printf("export const Feature = {\n");
    FEATURE(WORLD), FEATURE(JOINTS), FEATURE(WITH_HAND), FEATURE(POLE_DIRECTION), FEATURE(COMPACT);
    FEATURE(WITH_EFFECTOR), FEATURE(WITH_ANGLE), FEATURE(POLE_NORMAL), FEATURE(WITH_INCOMING), FEATURE(POLE_INCOMING);
    FEATURE(WITH_WEIGHTS), FEATURE(WITH_REACH), FEATURE(WITH_MOST_SWIVEL), FEATURE(WITH_FLEXION_LIMIT);
    FEATURE(WITH_SHOULDER_CONE), FEATURE(WITH_HUMERAL_TWIST), FEATURE(WITH_SHOULDER_BOX), FEATURE(WITH_HAND_CONE);
    FEATURE(WITH_FOREARM_TWIST), FEATURE(WITH_HAND_TWIST), FEATURE(WITH_WRIST_BOX), FEATURE(WITH_AIM);
    FEATURE(WITH_CLAVICLE), FEATURE(BUDGET), FEATURE(WITH_TWIST_BONES);
    printf("} as const;\n\nexport const Field = {\n");
    FIELD(TARGET, target), FIELD(POLE, pole), FIELD(LENGTHS, lengths), FIELD(SHOULDER_POSITION, shoulder_position);
    FIELD(PARENT_ROTATION, parent_rotation), FIELD(PARENT_SCALE, parent_scale), FIELD(HAND, hand);
    FIELD(EFFECTOR, effector), FIELD(ANGLE, angle), FIELD(INCOMING_SHOULDER, incoming_shoulder);
    FIELD(INCOMING_ELBOW, incoming_elbow), FIELD(INCOMING_WRIST, incoming_wrist), FIELD(WEIGHTS, weights);
    FIELD(REACH, reach), FIELD(MOST_SWIVEL, most_swivel), FIELD(FLEXION_LIMIT, flexion_limit);
    FIELD(SHOULDER_CONE, shoulder_cone), FIELD(HUMERAL_TWIST, humeral_twist), FIELD(SHOULDER_BOX, shoulder_box);
    FIELD(HAND_CONE, hand_cone), FIELD(FOREARM_TWIST, forearm_twist), FIELD(HAND_TWIST, hand_twist);
    FIELD(WRIST_BOX, wrist_box), FIELD(AIM, aim), FIELD(CLAVICLE, clavicle), FIELD(SHOULDER, shoulder);
    FIELD(ELBOW, elbow), FIELD(WRIST, wrist), FIELD(FLAGS, flags), FIELD(STRETCH, stretch), FIELD(NORMAL, normal);
    FIELD(TWIST_BONES, twist_bones), FIELD(CLAVICLE_TURN, clavicle_turn);
    printf("} as const;\n\nexport const Flag = {\n");
    NUMBER(REACHED), NUMBER(SOFTENED), NUMBER(STRETCHED), NUMBER(CLAMPED_FAR), NUMBER(CLAMPED_NEAR);
    NUMBER(SWIVEL_UNDEFINED), NUMBER(LIMITED_FLEXION), NUMBER(LIMITED_SHOULDER_CONE), NUMBER(LIMITED_HUMERAL_TWIST);
    NUMBER(LIMITED_SHOULDER_BOX), NUMBER(LIMITED_HAND_CONE), NUMBER(LIMITED_FOREARM_TWIST), NUMBER(LIMITED_HAND_TWIST);
    NUMBER(LIMITED_WRIST_BOX), NUMBER(LIMITED_STEP), NUMBER(INFEASIBLE), NUMBER(JUMPED), NUMBER(BAD_INPUT);
    printf("} as const;\n\nexport const Order = {\n");
    NUMBER(XYZ), NUMBER(XZY), NUMBER(YZX), NUMBER(YXZ), NUMBER(ZXY), NUMBER(ZYX);
    printf("} as const;\n\nexport const Status = {\n");
    NUMBER(OK), NUMBER(INVALID_ARGUMENT), NUMBER(OUT_OF_MEMORY), NUMBER(UNKNOWN_ISA), NUMBER(ISA_UNAVAILABLE);
    printf("} as const;\n");
}

static void print_structures(void)
{
    printf("\n// In bytes: the size of each structure, and where its members start.\nexport const layout = {\n");
    BEGIN(swivel_rows), OFFSET(swivel_rows, base), OFFSET(swivel_rows, block_count), OFFSET(swivel_rows, row_count);
    END();
    BEGIN(swivel_chain), OFFSET(swivel_chain, size), OFFSET(swivel_chain, shoulder_rotation);
    OFFSET(swivel_chain, elbow_rotation), OFFSET(swivel_chain, wrist_rotation), OFFSET(swivel_chain, elbow_offset);
    OFFSET(swivel_chain, wrist_offset), OFFSET(swivel_chain, bend), END();
    BEGIN(swivel_skeleton), OFFSET(swivel_skeleton, size), OFFSET(swivel_skeleton, parents);
    OFFSET(swivel_skeleton, rotations), OFFSET(swivel_skeleton, translations), OFFSET(swivel_skeleton, joint_count);
    END();
    BEGIN(swivel_limb_joints), OFFSET(swivel_limb_joints, size), OFFSET(swivel_limb_joints, shoulder);
    OFFSET(swivel_limb_joints, elbow), OFFSET(swivel_limb_joints, wrist), OFFSET(swivel_limb_joints, bend);
    OFFSET(swivel_limb_joints, twist_bone_count), OFFSET(swivel_limb_joints, twist_bones), END();
    BEGIN(swivel_binding), OFFSET(swivel_binding, parent_from_arm), OFFSET(swivel_binding, upper_from_arm);
    OFFSET(swivel_binding, elbow_parent_from_arm), OFFSET(swivel_binding, fore_from_arm);
    OFFSET(swivel_binding, wrist_parent_from_arm), OFFSET(swivel_binding, wrist_rest), OFFSET(swivel_binding, lengths);
    END();
    BEGIN(swivel_entity), OFFSET(swivel_entity, name), OFFSET(swivel_entity, meaning), OFFSET(swivel_entity, step);
    OFFSET(swivel_entity, coefficients), END();
    BEGIN(swivel_group_def), OFFSET(swivel_group_def, size), OFFSET(swivel_group_def, limb_count);
    OFFSET(swivel_group_def, binding), END();
    BEGIN(swivel_crowd_def), OFFSET(swivel_crowd_def, size), OFFSET(swivel_crowd_def, features);
    OFFSET(swivel_crowd_def, group_count), OFFSET(swivel_crowd_def, groups), OFFSET(swivel_crowd_def, shoulder_order);
    OFFSET(swivel_crowd_def, wrist_order), END();
    BEGIN(swivel_job), OFFSET(swivel_job, size), OFFSET(swivel_job, blocks), OFFSET(swivel_job, mask);
    OFFSET(swivel_job, mask_word_count), OFFSET(swivel_job, limbs), OFFSET(swivel_job, priorities);
    OFFSET(swivel_job, most_blocks), OFFSET(swivel_job, frames), OFFSET(swivel_job, solved_count), END();
    BEGIN(swivel_frame), OFFSET(swivel_frame, size), END();
    printf(
        "} as const;\n\n// Where a swivel_frame has each field.\nexport const frameMembers: Record<number, number> = "
        "{\n");
    for (int n = 0; n < field_count; ++n) printf("    [Field.%s]: %zu,\n", members[n].name, members[n].offset);
    printf("};\n\nexport const LANES = %d;\nexport const MOST_TWIST_BONES = %d;\n", SWIVEL_LANES,
           SWIVEL_MOST_TWIST_BONES);
    printf("export const EXPLANATION_BYTES = %d;\n", SWIVEL_EXPLANATION_BYTES);
    printf("export const VERSION = \"%d.%d.%d\";\n", SWIVEL_VERSION_MAJOR, SWIVEL_VERSION_MINOR, SWIVEL_VERSION_PATCH);
}

int main(void)
{
    printf("// SPDX-License-Identifier: MIT\n// Made by layout.c from swivel.h.\n\n");
    print_names();
    print_structures();
}

/* SPDX-License-Identifier: MIT
 *
 * Prints src/layout.ts: the numbers of swivel.h's names, and where the members of its structures lie in WebAssembly's
 * memory. The library describes features, fields and flags, the compiler knows the rest, so no number is written
 * twice. */
#include <ctype.h>
#include <inttypes.h>
#include <stdio.h>

#include "swivel/lecture.h"
#include "swivel/swivel.h"

#define NUMBER(NAME) printf("    %s: %u,\n", #NAME, (unsigned)SWIVEL_##NAME)
#define OFFSET(structure, name) printf(" %s: %zu,", #name, offsetof(structure, name))
#define BEGIN(structure) printf("    %s: { bytes: %zu,", #structure, sizeof(structure))
#define END() printf(" },\n")
#define CONSTANT(of, name) printf("    %s: %g,\n", #name, (double)of.name)
#define RENAMED(of, name, shown) printf("    %s: %g,\n", shown, (double)of.name)
#define PAIR(of, name) printf("    %s: [%g, %g],\n", #name, (double)of.name[0], (double)of.name[1])
#define TRIPLE(of, name) \
    printf("    %s: [%g, %g, %g],\n", #name, (double)of.name[0], (double)of.name[1], (double)of.name[2])

_Static_assert(sizeof(swivel_frame_field) == 12, "rows.ts writes it as three words");
_Static_assert(sizeof(swivel_joint_values) == 16, "bodies.ts writes it as four words");
_Static_assert(sizeof(swivel_supports) == 16, "bodies.ts writes it as four words");
_Static_assert(sizeof(swivel_plant) == 11 * sizeof(float), "groups.ts writes it as floats");
_Static_assert(sizeof(swivel_fit) == 4 * sizeof(float), "groups.ts writes it as floats");
_Static_assert(sizeof(swivel_ground) == 7 * sizeof(float), "groups.ts writes it as floats");
_Static_assert(sizeof(swivel_prop) == 8, "groups.ts writes it as a joint and a float");
_Static_assert(sizeof(swivel_region_cone) == 4 * sizeof(float), "region.ts writes it as floats");
_Static_assert(sizeof(swivel_look) == 35 * 4, "groups.ts writes it as a count, 8 joints and 26 floats");

static void print_features(void)
{
    swivel_feature_info info;
    printf("export const Feature = {\n");
    for (uint32_t n = 0; swivel_describe_feature(n, &info); ++n)
        printf("    %s: %" PRIu64 "n,\n", info.name, info.feature);
    printf("} as const;\n\n/** What a group with a feature must have, and what it must not have. */\n");
    printf("export const featureRules: Record<keyof typeof Feature, { needs: bigint; excludes: bigint }> = {\n");
    for (uint32_t n = 0; swivel_describe_feature(n, &info); ++n)
        printf("    %s: { needs: %" PRIu64 "n, excludes: %" PRIu64 "n },\n", info.name, info.needs, info.excludes);
    printf("};\n");
}

static void print_upper(const char* name)
{
    for (; *name; ++name) putchar(toupper((unsigned char)*name));
}

static void print_field(const swivel_field_info* info) { printf("    Field."), print_upper(info->name), printf(",\n"); }

static void print_fields(void)
{
    swivel_field_info info;
    printf("\nexport const Field = {\n");
    for (uint32_t n = 0; swivel_describe_field(n, &info); ++n)
        printf("    "), print_upper(info.name), printf(": %u,\n", (unsigned)info.field);
    printf("} as const;\n\n/** Results that the next solve starts from. */\nexport const carried = [\n");
    for (uint32_t n = 0; swivel_describe_field(n, &info); ++n)
        if (info.kind == SWIVEL_FIELD_CARRIED) print_field(&info);
    printf("] as const;\n\n/** Fields that may be given in doubles. */\nexport const positions = [\n");
    for (uint32_t n = 0; swivel_describe_field(n, &info); ++n)
        if (info.is_position) print_field(&info);
    printf("] as const;\n");
}

static void print_flags(void)
{
    printf("\nexport const Flag = {\n");
    for (uint32_t bit = 0; bit < 32; ++bit) {
        const char* const name = swivel_flag_name(UINT32_C(1) << bit);
        if (name) printf("    %s: %" PRIu32 ",\n", name, UINT32_C(1) << bit);
    }
    printf("} as const;\n");
}

static void print_enumerations(void)
{
    printf("\nexport const Order = {\n");
    NUMBER(XYZ), NUMBER(XZY), NUMBER(YZX), NUMBER(YXZ), NUMBER(ZXY), NUMBER(ZYX);
    printf("} as const;\n\nexport const OnBadInput = {\n");
    NUMBER(REST_POSE), NUMBER(KEEP_POSE);
    printf("} as const;\n\nexport const PoseForm = {\n");
    NUMBER(ROTATIONS), NUMBER(MATRIX_ROWS), NUMBER(MATRIX_COLUMNS), NUMBER(MATRIX_COLUMNS3);
    printf("} as const;\n\nexport const PoseSpace = {\n");
    NUMBER(LOCAL), NUMBER(IN_BODY);
    printf("} as const;\n\nexport const Status = {\n");
    NUMBER(OK), NUMBER(INVALID_ARGUMENT), NUMBER(OUT_OF_MEMORY), NUMBER(UNKNOWN_ISA), NUMBER(ISA_UNAVAILABLE);
    printf("} as const;\n");
}

/* As short as the header has them; they become floats again. */
static void print_constants(void)
{
    const swivel_plant plant = swivel_default_plant();
    const swivel_fit fit = swivel_default_fit();
    const swivel_ground ground = swivel_default_ground();
    const swivel_prop prop = swivel_default_prop();
    const swivel_look look = swivel_default_look();
    printf("\nexport const defaultPlant = {\n");
    CONSTANT(plant, lock), CONSTANT(plant, unlock), CONSTANT(plant, stop), CONSTANT(plant, blend);
    CONSTANT(plant, again), CONSTANT(plant, run), CONSTANT(plant, longest), PAIR(plant, speed), PAIR(plant, height);
    printf("} as const;\n\nexport const defaultFit = {\n");
    CONSTANT(fit, drop), CONSTANT(fit, rise), CONSTANT(fit, half), CONSTANT(fit, ahead);
    printf("} as const;\n\nexport const defaultGround = {\n");
    TRIPLE(ground, heel), RENAMED(ground, toe_clearance, "toeClearance");
    RENAMED(ground, heel_clearance, "heelClearance"), RENAMED(ground, cos_most, "cosMost"), CONSTANT(ground, half);
    printf("} as const;\n\nexport const defaultProp = {\n");
    CONSTANT(prop, joint), RENAMED(prop, most_move, "mostMove");
    printf("} as const;\n\nexport const defaultLook = {\n");
    RENAMED(look, share[0], "share"), RENAMED(look, cos_most[0], "cosMost"), TRIPLE(look, eye), TRIPLE(look, axis);
    RENAMED(look, cos_full, "cosFull"), RENAMED(look, cos_none, "cosNone"),
        RENAMED(look, fade_distance, "fadeDistance"), CONSTANT(look, rate);
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
    BEGIN(swivel_binding), OFFSET(swivel_binding, size), OFFSET(swivel_binding, parent_from_arm),
        OFFSET(swivel_binding, upper_from_arm);
    OFFSET(swivel_binding, elbow_parent_from_arm), OFFSET(swivel_binding, fore_from_arm);
    OFFSET(swivel_binding, wrist_parent_from_arm), OFFSET(swivel_binding, wrist_rest), OFFSET(swivel_binding, lengths);
    END();
    BEGIN(swivel_entity), OFFSET(swivel_entity, name), OFFSET(swivel_entity, meaning), OFFSET(swivel_entity, step);
    OFFSET(swivel_entity, coefficients), END();
    BEGIN(swivel_group_def), OFFSET(swivel_group_def, size), OFFSET(swivel_group_def, features);
    OFFSET(swivel_group_def, limb_count), OFFSET(swivel_group_def, on_bad_input);
    OFFSET(swivel_group_def, shoulder_order), OFFSET(swivel_group_def, wrist_order);
    OFFSET(swivel_group_def, binding), OFFSET(swivel_group_def, joints), OFFSET(swivel_group_def, plant);
    OFFSET(swivel_group_def, fit), OFFSET(swivel_group_def, ground), OFFSET(swivel_group_def, prop);
    OFFSET(swivel_group_def, link), OFFSET(swivel_group_def, look), OFFSET(swivel_group_def, region), END();
    BEGIN(swivel_region), END();
    BEGIN(swivel_look), OFFSET(swivel_look, joints), OFFSET(swivel_look, share), OFFSET(swivel_look, cos_most);
    OFFSET(swivel_look, eye), OFFSET(swivel_look, axis), OFFSET(swivel_look, cos_full), END();
    BEGIN(swivel_crowd_def), OFFSET(swivel_crowd_def, size), OFFSET(swivel_crowd_def, group_count);
    OFFSET(swivel_crowd_def, workspace_count), OFFSET(swivel_crowd_def, groups);
    OFFSET(swivel_crowd_def, skeleton), OFFSET(swivel_crowd_def, body_count), OFFSET(swivel_crowd_def, up), END();
    BEGIN(swivel_job), OFFSET(swivel_job, size), OFFSET(swivel_job, blocks), OFFSET(swivel_job, groups);
    OFFSET(swivel_job, group_word_count), OFFSET(swivel_job, mask), OFFSET(swivel_job, mask_word_count);
    OFFSET(swivel_job, limbs), OFFSET(swivel_job, priorities), OFFSET(swivel_job, urgency);
    OFFSET(swivel_job, most_blocks), OFFSET(swivel_job, frames), OFFSET(swivel_job, solved_count);
    OFFSET(swivel_job, pose), OFFSET(swivel_job, probes_only), END();
    BEGIN(swivel_frame), OFFSET(swivel_frame, size), OFFSET(swivel_frame, fields);
    OFFSET(swivel_frame, field_count), END();
    BEGIN(swivel_pose), OFFSET(swivel_pose, size), OFFSET(swivel_pose, form), OFFSET(swivel_pose, root_is_double);
    OFFSET(swivel_pose, rotations), OFFSET(swivel_pose, translations), OFFSET(swivel_pose, scales);
    OFFSET(swivel_pose, results), OFFSET(swivel_pose, root_position), OFFSET(swivel_pose, root_rotation);
    OFFSET(swivel_pose, root_scale), OFFSET(swivel_pose, space), OFFSET(swivel_pose, translation_results);
    OFFSET(swivel_pose, joint_rotations), OFFSET(swivel_pose, joint_places), OFFSET(swivel_pose, time);
    OFFSET(swivel_pose, support_position), OFFSET(swivel_pose, support_rotation), OFFSET(swivel_pose, weight), END();
    printf("} as const;\n\nexport const LANES = %d;\nexport const MOST_TWIST_BONES = %d;\n", SWIVEL_LANES,
           SWIVEL_MOST_TWIST_BONES);
    printf("export const MOST_LOOK_JOINTS = %d;\n", SWIVEL_MOST_LOOK_JOINTS);
    printf("export const ENTITY_COUNT = %d;\n", SWIVEL_ENTITY_COUNT);
    printf("export const RESULT_END = %d;\n", SWIVEL_RESULT_END);
    printf("export const EXPLANATION_BYTES = %d;\n", SWIVEL_EXPLANATION_BYTES);
    printf("export const VERSION = \"%d.%d.%d\";\n", SWIVEL_VERSION_MAJOR, SWIVEL_VERSION_MINOR, SWIVEL_VERSION_PATCH);
}

int main(void)
{
    printf("// SPDX-License-Identifier: MIT\n// Made by layout.c from swivel.h.\n\n");
    print_features();
    print_fields();
    print_flags();
    print_enumerations();
    print_constants();
    print_structures();
}

/* SPDX-License-Identifier: MIT
 *
 * Prints src/layout.ts: the numbers of the headers' names, and where the members of their structures lie in
 * WebAssembly's memory. The library describes features, fields and flags, the compiler knows the rest, so no number is
 * written twice. */
#include <ctype.h>
#include <inttypes.h>
#include <stdio.h>

#include "swivel/lecture.h"
#include "swivel/swivel_bodies.h"
#include "swivel/swivel_explain.h"
#include "swivel/swivel_regions.h"

#define NUMBER(NAME) printf("    %s: %u,\n", #NAME, (unsigned)SWIVEL_##NAME)
#define GROUP_KIND(NAME) printf("    %s: %u,\n", #NAME, (unsigned)SWIVEL_KIND_##NAME)
#define OFFSET(structure, name) printf(" %s: %zu,", #name, offsetof(structure, name))
#define BEGIN(structure) printf("    %s: { bytes: %zu,", #structure, sizeof(structure))
#define END() printf(" },\n")
#define BEGIN_DEFAULT(name, structure) \
    begin_default(#name);              \
    const swivel_##structure name = swivel_default_##structure()
#define END_DEFAULT() printf("} as const;\n")
#define VALUES(of, name) print_values(#name, KIND(of.name), &of.name, sizeof(of.name) / sizeof(float))
/* Sizes, counts and numbers of joints have no default. */
#define KIND(value) \
    _Generic(value,                      \
             size_t : NO_VALUE,          \
             uint32_t : NO_VALUE,        \
             const uint32_t* : NO_VALUE, \
             int32_t : WHOLE_NUMBER,     \
             default : FLOATS)
enum kind { NO_VALUE, WHOLE_NUMBER, FLOATS };

_Static_assert(sizeof(swivel_stream) == 12, "rows.ts writes it as three words");
_Static_assert(sizeof(swivel_joint_values) == 16, "bodies.ts writes it as four words");
_Static_assert(sizeof(swivel_supports) == 16, "bodies.ts writes it as four words");
_Static_assert(sizeof(swivel_plant) == 11 * sizeof(float), "groups.ts writes it as floats");
_Static_assert(sizeof(swivel_shift_def) == sizeof(size_t) + 4 * sizeof(float),
               "groups.ts writes floats after the size");
_Static_assert(sizeof(swivel_ground) == 7 * sizeof(float), "groups.ts writes it as floats");
_Static_assert(sizeof(swivel_region_cone) == 4 * sizeof(float), "region.ts writes it as floats");
_Static_assert(offsetof(swivel_look_def, rate) - offsetof(swivel_look_def, cos_full) == 3 * sizeof(float),
               "groups.ts writes four floats from there on");

static void print_features(void)
{
    swivel_feature_info info;
    printf("export const Feature = {\n");
    for (uint32_t n = 0; swivel_describe_feature(n, &info); ++n)
        printf("    %s: %" PRIu64 "n,\n", info.name, info.feature);
    printf("} as const;\n\n/** A free limb with a feature has all that this needs, and nothing that it excludes. Bit ");
    printf("k of kinds: groups of Kind k may have it. */\nexport const featureRules: ");
    printf("Record<keyof typeof Feature, { needs: bigint; excludes: bigint; kinds: number }> = {\n");
    for (uint32_t n = 0; swivel_describe_feature(n, &info); ++n)
        printf("    %s: { needs: %" PRIu64 "n, excludes: %" PRIu64 "n, kinds: %" PRIu32 " },\n", info.name, info.needs,
               info.excludes, info.kinds);
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
    printf("\nexport const Kind = {\n");
    GROUP_KIND(LIMB), GROUP_KIND(BODY_LIMB), GROUP_KIND(LOOK), GROUP_KIND(PROP), GROUP_KIND(SHIFT);
    printf("} as const;\n\nexport const Order = {\n");
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

/* The name as JavaScript writes it. */
static void print_camel(const char* name)
{
    for (; *name; ++name) putchar(*name == '_' ? toupper((unsigned char)*++name) : *name);
}

/* As short as the header has them; they become floats again. One value stands for those of all joints of a look. */
static void print_values(const char* name, enum kind kind, const void* values, size_t count)
{
    if (kind == NO_VALUE) return;
    if (count == SWIVEL_MAX_LOOK_JOINTS) count = 1;
    printf("    "), print_camel(name), printf(count > 1 ? ": [" : ": ");
    for (size_t n = 0; n < count; ++n) {
        if (n > 0) printf(", ");
        if (kind == FLOATS) printf("%g", (double)((const float*)values)[n]);
        if (kind == WHOLE_NUMBER) printf("%" PRId32, ((const int32_t*)values)[n]);
    }
    printf(count > 1 ? "],\n" : ",\n");
}

static void begin_default(const char* name)
{
    printf("\nexport const default%c%s = {\n", toupper((unsigned char)*name), name + 1);
}

static void print_constants(void)
{
#include "defaults.inc"
}

static void print_structures(void)
{
    printf("\n// In bytes: the size of each structure, and where its members start.\nexport const layout = {\n");
#include "structures.inc"
    printf("} as const;\n\nexport const LANES = %d;\nexport const MAX_TWIST_BONES = %d;\n", SWIVEL_LANES,
           SWIVEL_MAX_TWIST_BONES);
    printf("export const MAX_LOOK_JOINTS = %d;\n", SWIVEL_MAX_LOOK_JOINTS);
    printf("export const ENTITY_COUNT = %d;\n", SWIVEL_ENTITY_COUNT);
    printf("export const RESULT_END = %d;\n", SWIVEL_RESULT_END);
    printf("export const EXPLANATION_BYTES = %d;\n", SWIVEL_EXPLANATION_BYTES);
    printf("export const VERSION = \"%d.%d.%d\";\n", SWIVEL_VERSION_MAJOR, SWIVEL_VERSION_MINOR, SWIVEL_VERSION_PATCH);
}

int main(void)
{
    printf("// SPDX-License-Identifier: MIT\n// Made by layout.c from the C headers.\n\n");
    print_features();
    print_fields();
    print_flags();
    print_enumerations();
    print_constants();
    print_structures();
}

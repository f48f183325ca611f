// SPDX-License-Identifier: MIT
//
// The C entry points: check the arguments, call in, turn outcomes into statuses.
#include <cstdlib>

#include "batch/api/check.h"
#include "batch/api/use.h"
#include "batch/crowd/group_def.h"
#include "batch/crowd/rig.h"
#include "batch/crowd/streams.h"
#include "batch/refusal/sized.h"
#include "batch/refusal/status.h"
#include "batch/solve/rest.h"
#include "batch/solve/solve.h"
#include "simd/dispatch.h"
#include "simd/float_env.h"
#include "simd/rows.h"

using namespace swivel;

namespace {

// A crowd's group; null if there is none.
const Group* group_of(const swivel_crowd* crowd, std::uint32_t group)
{
    return crowd && group < crowd->group_count ? crowd->groups + group : nullptr;
}

}  // namespace

uint32_t swivel_version(void) { return SWIVEL_VERSION; }

const char* swivel_status_text(swivel_status status)
{
    switch (number_of(status)) {
        case SWIVEL_OK:
            return "done";
        case SWIVEL_INVALID_ARGUMENT:
            return "invalid argument";
        case SWIVEL_OUT_OF_MEMORY:
            return "out of memory";
        case SWIVEL_UNKNOWN_ISA:
            return "unknown instruction set";
        case SWIVEL_ISA_UNAVAILABLE:
            return "instruction set not available on this CPU";
    }
    return "unknown status";
}

const char* swivel_last_error(void) { return last_error(); }

size_t swivel_crowd_bytes(const swivel_crowd_def* def)
{
    return check_def(def) == SWIVEL_OK ? static_cast<size_t>(crowd_bytes(full_def(def))) : 0;
}

swivel_status swivel_crowd_create(const swivel_crowd_def* def, swivel_crowd** crowd)
{
    if (!crowd) return refuse("swivel_crowd_create: crowd is null");
    *crowd = nullptr;
    if (const swivel_status status = check_def(def); status != SWIVEL_OK) return status;
    const swivel_crowd_def full = full_def(def);
    const size_t bytes = static_cast<size_t>(crowd_bytes(full));
    void (*release)(void*, size_t, void*) = full.release;
    void* arena = nullptr;
    if (full.memory) {
        if (reinterpret_cast<std::uintptr_t>(full.memory) % kArenaAlignment != 0)
            return refuse("the caller's memory is not aligned to %zu bytes", kArenaAlignment);
        if (full.memory_bytes < bytes)
            return fail(SWIVEL_OUT_OF_MEMORY, "the caller's memory has %zu bytes, the crowd needs %zu",
                        full.memory_bytes, bytes);
        arena = full.memory;
        release = nullptr;
    } else if (full.allocate) {
        arena = full.allocate(bytes, kArenaAlignment, full.user);
    } else {
#ifdef _WIN32  // its C library has no aligned_alloc
        arena = _aligned_malloc(bytes, kArenaAlignment);
        release = [](void* memory, size_t, void*) { _aligned_free(memory); };
#else
        arena = std::aligned_alloc(kArenaAlignment, bytes);
        release = [](void* memory, size_t, void*) { std::free(memory); };
#endif
    }
    if (!arena) return fail(SWIVEL_OUT_OF_MEMORY, "no memory for a crowd of %zu bytes", bytes);
    *crowd = place_crowd(full, arena);
    rest(**crowd);
    (*crowd)->release = release;
    (*crowd)->user = full.user;
    begin_schedule(**crowd);
    return SWIVEL_OK;
}

void swivel_crowd_destroy(swivel_crowd* crowd)
{
    if (!crowd || Use(crowd, Sharing::alone).status != SWIVEL_OK) return;
    crowd->alive = 0;
    end_schedule(*crowd);
    if (crowd->release) crowd->release(crowd->arena, crowd->arena_bytes, crowd->user);
}

swivel_status swivel_bind_joints(const swivel_skeleton* skeleton, const swivel_limb_joints* joints,
                                 swivel_binding* binding)
{
    const FloatEnv env;
    if (!skeleton || !joints || !binding) return refuse("swivel_bind_joints: skeleton, joints or binding is null");
    swivel_status status = check_size<swivel_skeleton>("skeleton", size_of(skeleton));
    if (status == SWIVEL_OK) status = check_size<swivel_limb_joints>("limb joints", size_of(joints));
    if (status != SWIVEL_OK) return status;
    const swivel_skeleton whole = element(skeleton, 0, swivel_default_skeleton());
    const swivel_limb_joints given = element(joints, 0, swivel_default_limb_joints(0, 0, 0));
    RestLimb limb;
    status = check_reserved("skeleton", whole);
    if (status == SWIVEL_OK) status = check_reserved("limb joints", given);
    if (status == SWIVEL_OK) status = rest_limb(whole, given, limb);
    return status == SWIVEL_OK ? bind(limb, *binding) : status;
}

swivel_status swivel_arm_axis(const swivel_binding* binding, const float parent_rotation[4], const double direction[3],
                              double axis[3])
{
    const FloatEnv env;
    if (!binding || !parent_rotation || !direction || !axis)
        return refuse("swivel_arm_axis: %s is null", !binding           ? "binding"
                                                     : !parent_rotation ? "parent_rotation"
                                                     : !direction       ? "direction"
                                                                        : "axis");
    if (const swivel_status status = check_size<swivel_binding>("binding", size_of(binding)); status != SWIVEL_OK)
        return status;
    return arm_axis(element(binding, 0, swivel_default_binding()), parent_rotation, direction, axis);
}

uint32_t swivel_group_count(const swivel_crowd* crowd) { return crowd ? crowd->group_count : 0; }
uint32_t swivel_block_count(const swivel_crowd* crowd) { return crowd ? crowd->block_count : 0; }
uint32_t swivel_group_first_limb(const swivel_crowd* crowd, uint32_t group)
{
    const Group* const found = group_of(crowd, group);
    return found ? found->first_block * SWIVEL_LANES : 0;
}
uint32_t swivel_group_limb_count(const swivel_crowd* crowd, uint32_t group)
{
    const Group* const found = group_of(crowd, group);
    return found ? found->limb_count : 0;
}
swivel_kind swivel_group_kind(const swivel_crowd* crowd, uint32_t group)
{
    const Group* const found = group_of(crowd, group);
    return found ? kind_of(found->features) : SWIVEL_KIND_LIMB;
}
swivel_features swivel_group_features(const swivel_crowd* crowd, uint32_t group)
{
    const Group* const found = group_of(crowd, group);
    return found ? found->asked : 0;
}
uint32_t swivel_field_first_row(const swivel_crowd* crowd, uint32_t group, swivel_field field)
{
    const Group* const found = group_of(crowd, group);
    return found && is_field(field) && field_row_count(found->features, field) > 0
               ? field_first_row(found->features, field)
               : 0;
}
uint32_t swivel_field_row_count(const swivel_crowd* crowd, uint32_t group, swivel_field field)
{
    const Group* const found = group_of(crowd, group);
    return found && is_field(field) ? field_row_count(found->features, field) : 0;
}
swivel_rows swivel_input_rows(swivel_crowd* crowd, uint32_t group)
{
    const Group* const found = group_of(crowd, group);
    return found ? swivel_rows{found->input, found->block_count, found->input_row_count} : swivel_rows{};
}
swivel_rows swivel_result_rows(swivel_crowd* crowd, uint32_t group)
{
    const Group* const found = group_of(crowd, group);
    return found ? swivel_rows{found->results, found->block_count, found->result_row_count} : swivel_rows{};
}
swivel_status swivel_write(swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first, uint32_t limb_count,
                           swivel_in values)
{
    const Use use(crowd, Sharing::alone);
    swivel_status status = use.for_limbs(group, first, limb_count);
    if (status == SWIVEL_OK) status = check_values(*crowd, group, field, limb_count, values.data, values.stride, true);
    if (status != SWIVEL_OK) return status;
    copy_in(rows_of(crowd->groups[group], field), first, limb_count, values);
    return SWIVEL_OK;
}

swivel_status swivel_write_doubles(swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                                   uint32_t limb_count, swivel_in values, swivel_in origins)
{
    const FloatEnv env;
    const Use use(crowd, Sharing::alone);
    swivel_status status = use.for_limbs(group, first, limb_count);
    if (status == SWIVEL_OK) status = check_field(*crowd, group, field, true);
    if (status != SWIVEL_OK) return status;
    const Group& target_group = crowd->groups[group];
    if (!is_position(field))
        return refuse("group %u, %s: not a position; write it by swivel_write()", group, name_of(field));
    if (origins.data && !has_origin(target_group, field))
        return refuse("group %u, %s: it is %s here, which has no origin; give null", group, name_of(field),
                      field == SWIVEL_POLE ? "a direction" : "in a joint's frame");
    status = check_values(*crowd, group, field, limb_count, values.data, values.stride, true, sizeof(double));
    if (status == SWIVEL_OK && origins.data)
        status = check_stride(group, "origin", limb_count, origins.data, origins.stride, 3 * sizeof(double), true);
    if (status != SWIVEL_OK) return status;
    copy_doubles_in(rows_of(target_group, field), first, limb_count, values, origins);
    return SWIVEL_OK;
}

swivel_status swivel_read(const swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                          uint32_t limb_count, swivel_out values)
{
    const Use use(crowd, Sharing::shared);
    swivel_status status = use.for_limbs(group, first, limb_count);
    if (status == SWIVEL_OK) status = check_values(*crowd, group, field, limb_count, values.data, values.stride, false);
    if (status != SWIVEL_OK) return status;
    copy_out(rows_of(crowd->groups[group], field), first, limb_count, values);
    return SWIVEL_OK;
}

const char* swivel_isa_name(void)
{
    swivel_status status = SWIVEL_OK;
    const Isa* isa = usable_isa(status);
    return isa ? isa->name : nullptr;
}

swivel_status swivel_use_isa(const char* name)
{
    const Isa* isa = name ? find_isa(name) : nullptr;
    if (!isa)
        return fail(SWIVEL_UNKNOWN_ISA, "no instruction set '%s' in this build; swivel_isa_at() lists them",
                    name ? name : "");
    if (!isa->can_run()) return fail(SWIVEL_ISA_UNAVAILABLE, "this CPU or operating system does not run '%s'", name);
    use_isa(*isa);
    return SWIVEL_OK;
}

const char* swivel_isa_at(uint32_t index)
{
    const Isa* isa = isa_at(index);
    return isa ? isa->name : nullptr;
}

int swivel_isa_runs(const char* name)
{
    const Isa* isa = name ? find_isa(name) : nullptr;
    return isa && isa->can_run();
}

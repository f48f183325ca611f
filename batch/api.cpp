// SPDX-License-Identifier: MIT
//
// The C entry points: check the arguments, call in, turn outcomes into statuses.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <tuple>

#include "batch/check.h"
#include "batch/edge.h"
#include "batch/frame.h"
#include "batch/joint_angles.h"
#include "batch/rig.h"
#include "batch/solve.h"
#include "batch/status.h"
#include "batch/streams.h"
#include "batch/unpack.h"
#include "core/arm.h"
#include "simd/dispatch.h"
#include "simd/float_env.h"
#include "simd/rows.h"

using namespace swivel;

static_assert(flag::reached == SWIVEL_REACHED && flag::softened == SWIVEL_SOFTENED &&
              flag::stretched == SWIVEL_STRETCHED && flag::clamped_far == SWIVEL_CLAMPED_FAR &&
              flag::clamped_near == SWIVEL_CLAMPED_NEAR && flag::swivel_undefined == SWIVEL_SWIVEL_UNDEFINED &&
              flag::limited_flexion == SWIVEL_LIMITED_FLEXION &&
              flag::limited_shoulder_cone == SWIVEL_LIMITED_SHOULDER_CONE &&
              flag::limited_humeral_twist == SWIVEL_LIMITED_HUMERAL_TWIST &&
              flag::limited_shoulder_box == SWIVEL_LIMITED_SHOULDER_BOX &&
              flag::limited_hand_cone == SWIVEL_LIMITED_HAND_CONE &&
              flag::limited_forearm_twist == SWIVEL_LIMITED_FOREARM_TWIST &&
              flag::limited_hand_twist == SWIVEL_LIMITED_HAND_TWIST &&
              flag::limited_wrist_box == SWIVEL_LIMITED_WRIST_BOX && flag::limited_step == SWIVEL_LIMITED_STEP &&
              flag::infeasible == SWIVEL_INFEASIBLE && flag::jumped == SWIVEL_JUMPED &&
              flag::bad_input == SWIVEL_BAD_INPUT);

namespace {

constexpr std::uint32_t kAllFeatures = (8 * SWIVEL_TWIST_BONES - 1) | SWIVEL_BUDGET;

// Features that mean something only beside another, or not beside another.
struct FeatureRule {
    std::uint32_t feature, other;
    bool together;
    const char* text;
};
constexpr FeatureRule kFeatureRules[] = {
    {SWIVEL_POLE_DIRECTION, SWIVEL_WORLD, true,
     "SWIVEL_POLE_DIRECTION needs SWIVEL_WORLD; in the arm frame a pole is both"},
    {SWIVEL_POLE_NORMAL, SWIVEL_POLE_DIRECTION, false,
     "SWIVEL_POLE_NORMAL and SWIVEL_POLE_DIRECTION exclude each other; a pole is one of them"},
    {SWIVEL_POLE_INCOMING, SWIVEL_POLE_DIRECTION, false,
     "SWIVEL_POLE_INCOMING and SWIVEL_POLE_DIRECTION exclude each other; with the first there are no poles"},
    {SWIVEL_POLE_INCOMING, SWIVEL_POLE_NORMAL, false,
     "SWIVEL_POLE_INCOMING and SWIVEL_POLE_NORMAL exclude each other; with the first there are no poles"},
    {SWIVEL_POLE_INCOMING, SWIVEL_WITH_INCOMING, true, "SWIVEL_POLE_INCOMING needs SWIVEL_WITH_INCOMING"},
    {SWIVEL_WITH_WEIGHTS, SWIVEL_WITH_INCOMING, true,
     "SWIVEL_WITH_WEIGHTS needs SWIVEL_WITH_INCOMING, the pose to blend with"},
    {SWIVEL_WITH_EFFECTOR, SWIVEL_WITH_HAND, true, "SWIVEL_WITH_EFFECTOR needs SWIVEL_WITH_HAND, which carries it"},
    {SWIVEL_LIMIT_HAND_CONE, SWIVEL_WITH_HAND, true, "SWIVEL_LIMIT_HAND_CONE needs SWIVEL_WITH_HAND"},
    {SWIVEL_LIMIT_FOREARM_TWIST, SWIVEL_WITH_HAND, true, "SWIVEL_LIMIT_FOREARM_TWIST needs SWIVEL_WITH_HAND"},
    {SWIVEL_LIMIT_HAND_TWIST, SWIVEL_WITH_HAND, true, "SWIVEL_LIMIT_HAND_TWIST needs SWIVEL_WITH_HAND"},
    {SWIVEL_LIMIT_WRIST_BOX, SWIVEL_WITH_HAND, true, "SWIVEL_LIMIT_WRIST_BOX needs SWIVEL_WITH_HAND"},
    {7 * SWIVEL_TWIST_BONES, SWIVEL_WITH_HAND, true,
     "SWIVEL_TWIST_BONES needs SWIVEL_WITH_HAND, whose twist is shared"},
    {SWIVEL_COMPACT, 7 * SWIVEL_TWIST_BONES, false, "SWIVEL_COMPACT has no words for SWIVEL_TWIST_BONES"},
    {SWIVEL_COMPACT, SWIVEL_WITH_REACH, false, "SWIVEL_COMPACT has no word for SWIVEL_WITH_REACH's stretch"},
    {SWIVEL_COMPACT, SWIVEL_WITH_STEP, false, "SWIVEL_COMPACT does not keep SWIVEL_WITH_STEP's normal"},
};
constexpr std::uint64_t kMostLimbs = 1u << 31;
constexpr std::size_t kArenaAlignment = 64;

bool is_binding(const swivel_binding& b)
{
    for (const auto* q :
         {&b.parent_from_arm, &b.upper_from_arm, &b.fore_from_arm, &b.shoulder_rest, &b.elbow_rest, &b.wrist_rest}) {
        const Rotor<double> unit = rotor<double>((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
        if (!(std::fabs(len2(unit) - 1) <= 1e-5)) return false;  // ten times what rounding to floats leaves
    }
    return true;
}

swivel_status check(const swivel_crowd_def* def)
{
    if (!def) return fail(SWIVEL_INVALID_ARGUMENT, "crowd def is null; start from swivel_default_crowd_def()");
    if (def->size != sizeof(swivel_crowd_def))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "crowd def has size %zu, this library's has %zu; start from swivel_default_crowd_def()", def->size,
                    sizeof(swivel_crowd_def));
    if (def->features & ~kAllFeatures)
        return fail(SWIVEL_INVALID_ARGUMENT, "crowd def has unknown feature bits 0x%x", def->features & ~kAllFeatures);
    for (const FeatureRule& rule : kFeatureRules)
        if ((def->features & rule.feature) && !(def->features & rule.other) == rule.together)
            return fail(SWIVEL_INVALID_ARGUMENT, "%s", rule.text);
    if (def->group_count == 0 || !def->groups)
        return fail(SWIVEL_INVALID_ARGUMENT, "crowd def has no groups; give at least one");
    if (!def->allocate != !def->release)
        return fail(SWIVEL_INVALID_ARGUMENT, "crowd def has one of allocate and release; give both or none");
    for (const auto& [order, name] :
         {std::pair{def->shoulder_order, "shoulder_order"}, std::pair{def->wrist_order, "wrist_order"}})
        if (static_cast<unsigned>(order) > SWIVEL_ZYX)
            return fail(SWIVEL_INVALID_ARGUMENT, "crowd def's %s is %d; it is one of SWIVEL_XYZ to SWIVEL_ZYX", name,
                        static_cast<int>(order));
    std::uint64_t limb_count = 0;
    for (std::uint32_t g = 0; g < def->group_count; ++g) {
        if (def->groups[g].limb_count == 0)
            return fail(SWIVEL_INVALID_ARGUMENT, "group %u has no limbs; give at least one", g);
        if ((def->features & SWIVEL_JOINTS) && !is_binding(def->groups[g].binding))
            return fail(SWIVEL_INVALID_ARGUMENT,
                        "group %u's binding holds a quaternion not of unit length; make it with swivel_bind()", g);
        limb_count += std::uint64_t{def->groups[g].limb_count} + SWIVEL_LANES;
    }
    if (limb_count > kMostLimbs)
        return fail(SWIVEL_INVALID_ARGUMENT, "more than 2^31 limbs, padding included; use several crowds");
    return SWIVEL_OK;
}

}  // namespace

namespace swivel {

swivel_status check(const swivel_crowd* crowd, std::uint32_t group, std::uint32_t first, std::uint32_t limb_count)
{
    if (!crowd) return fail(SWIVEL_INVALID_ARGUMENT, "crowd is null");
    if (group >= crowd->group_count)
        return fail(SWIVEL_INVALID_ARGUMENT, "group %u does not exist; this crowd has %u", group, crowd->group_count);
    const std::uint32_t has = crowd->groups[group].limb_count;
    if (first > has || limb_count > has - first)
        return fail(SWIVEL_INVALID_ARGUMENT, "limbs %u to %llu are not all in group %u, which has %u", first,
                    static_cast<unsigned long long>(first) + limb_count, group, has);
    return SWIVEL_OK;
}

swivel_status check_stride(std::uint32_t group, const char* name, const void* data, std::size_t stride,
                           std::size_t value_bytes, bool may_repeat)
{
    if (!data) return fail(SWIVEL_INVALID_ARGUMENT, "group %u, %s: data is null", group, name);
    if (stride < value_bytes && !(may_repeat && stride == 0))
        return fail(SWIVEL_INVALID_ARGUMENT, "group %u, %s: stride %zu is smaller than a value, %zu bytes", group, name,
                    stride, value_bytes);
    return SWIVEL_OK;
}

swivel_status check_field(const swivel_crowd& crowd, std::uint32_t group, swivel_field field, bool input)
{
    const char* const name = field_name(field);
    if (!name) return fail(SWIVEL_INVALID_ARGUMENT, "there is no field %d", static_cast<int>(field));
    if (input && !is_input(field))
        return fail(SWIVEL_INVALID_ARGUMENT, "%s is a result; swivel_write takes input fields", name);
    if (field_component_count(crowd.features, field) == 0)
        return fail(SWIVEL_INVALID_ARGUMENT, "group %u, %s: not part of this crowd; create it with%s %s", group, name,
                    kFields[field].without ? "out" : "", needed_feature(crowd.features, field));
    return SWIVEL_OK;
}

swivel_status check_blocks(const swivel_crowd* crowd, std::uint32_t first_block, std::uint32_t block_count)
{
    if (!crowd) return fail(SWIVEL_INVALID_ARGUMENT, "crowd is null");
    if (first_block > crowd->block_count || block_count > crowd->block_count - first_block)
        return fail(SWIVEL_INVALID_ARGUMENT, "blocks %u to %llu do not all exist; this crowd has %u", first_block,
                    static_cast<unsigned long long>(first_block) + block_count, crowd->block_count);
    return SWIVEL_OK;
}

const Isa* usable_isa(swivel_status& status)
{
    const Isa* isa = current_isa();
    if (isa) return isa;
    const char* forced = std::getenv("SWIVEL_FORCE_ISA");
    const bool built = forced && find_isa(forced);
    status = fail(built ? SWIVEL_ISA_UNAVAILABLE : SWIVEL_UNKNOWN_ISA,
                  "SWIVEL_FORCE_ISA=%s names an instruction set that %s; unset it, or see swivel info",
                  forced ? forced : "", built ? "this CPU does not run" : "this build does not have");
    return nullptr;
}

}  // namespace swivel

namespace {

// The caller's values of a field, to be read if they are input: components of component_bytes each.
swivel_status check_values(const swivel_crowd& crowd, std::uint32_t group, swivel_field field, const void* data,
                           std::size_t stride, bool input, std::size_t component_bytes = sizeof(float))
{
    if (const swivel_status status = check_field(crowd, group, field, input); status != SWIVEL_OK) return status;
    return check_stride(group, field_name(field), data, stride,
                        field_component_count(crowd.features, field) * component_bytes, input);
}

// A range of blocks, and the frames of the groups it touches: those of other groups are not looked at.
swivel_status check_frames(const swivel_crowd& crowd, const swivel_frame* frames, std::uint32_t first_block,
                           std::uint32_t block_count)
{
    if (!frames)
        return fail(SWIVEL_INVALID_ARGUMENT, "frames are missing; give one for each of this crowd's %u groups",
                    crowd.group_count);
    swivel_status status = SWIVEL_OK;
    for_each_group(crowd, first_block, block_count, [&](std::uint32_t g, std::uint32_t, std::uint32_t) {
        const swivel_in& origin = frames[g].origin;
        const auto check_member = [&](swivel_field field, const auto& values) {
            if (!values.data || status != SWIVEL_OK) return;
            if (is_packed(crowd, field))
                status = fail(SWIVEL_INVALID_ARGUMENT,
                              "group %u, %s: a frame does not take results out of a crowd with SWIVEL_COMPACT; use "
                              "swivel_read() or swivel_compact_rows()",
                              g, field_name(field));
            else
                status = check_values(crowd, g, field, values.data, values.stride, is_input(field),
                                      origin.data && is_position(field) ? sizeof(double) : sizeof(float));
        };
        if (origin.data && status == SWIVEL_OK)
            status = check_stride(g, "origin", origin.data, origin.stride, 3 * sizeof(double), true);
        for (const FrameInput& input : kFrameInputs) check_member(input.field, frames[g].*input.member);
        for (const FrameOutput& output : kFrameOutputs) check_member(output.field, frames[g].*output.member);
    });
    return status;
}

void store(const swivel_out& out, std::size_t n, const Vector<double>& v)
{
    if (out.data) std::memcpy(static_cast<char*>(out.data) + n * out.stride, v.c, sizeof v.c);
}
void store(const swivel_out& out, std::size_t n, const Rotor<double>& q)
{
    const double xyzw[4] = {q.at<kI>(), q.at<kJ>(), q.at<kK>(), q.at<kScalar>()};
    if (out.data) std::memcpy(static_cast<char*>(out.data) + n * out.stride, xyzw, sizeof xyzw);
}

}  // namespace

uint32_t swivel_version(void) { return SWIVEL_VERSION; }

const char* swivel_status_text(swivel_status status)
{
    switch (status) {
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

swivel_crowd_def swivel_default_crowd_def(void)
{
    swivel_crowd_def def{};
    def.size = sizeof def;
    return def;
}

size_t swivel_crowd_bytes(const swivel_crowd_def* def) { return check(def) == SWIVEL_OK ? crowd_bytes(*def) : 0; }

swivel_status swivel_crowd_create(const swivel_crowd_def* def, swivel_crowd** crowd)
{
    if (!crowd) return fail(SWIVEL_INVALID_ARGUMENT, "swivel_crowd_create: crowd is null");
    *crowd = nullptr;
    if (const swivel_status status = check(def); status != SWIVEL_OK) return status;
    const size_t bytes = crowd_bytes(*def);
    void (*release)(void*, size_t, void*) = def->release;
    void* arena = nullptr;
    if (def->memory) {
        if (reinterpret_cast<std::uintptr_t>(def->memory) % kArenaAlignment != 0)
            return fail(SWIVEL_INVALID_ARGUMENT, "the caller's memory is not aligned to %zu bytes", kArenaAlignment);
        if (def->memory_bytes < bytes)
            return fail(SWIVEL_OUT_OF_MEMORY, "the caller's memory has %zu bytes, the crowd needs %zu",
                        def->memory_bytes, bytes);
        arena = def->memory;
        release = nullptr;
    } else if (def->allocate) {
        arena = def->allocate(bytes, kArenaAlignment, def->user);
    } else {
        arena = std::aligned_alloc(kArenaAlignment, bytes);
        release = [](void* memory, size_t, void*) { std::free(memory); };
    }
    if (!arena) return fail(SWIVEL_OUT_OF_MEMORY, "no memory for a crowd of %zu bytes", bytes);
    *crowd = place_crowd(*def, arena);
    (*crowd)->release = release;
    (*crowd)->user = def->user;
    begin_schedule(**crowd);
    return SWIVEL_OK;
}

void swivel_crowd_destroy(swivel_crowd* crowd)
{
    if (!crowd) return;
    end_schedule(*crowd);
    if (crowd->release) crowd->release(crowd->arena, crowd->arena_bytes, crowd->user);
}

swivel_status swivel_bind(const swivel_chain* chain, swivel_binding* binding, float lengths[2])
{
    if (!chain || !binding) return fail(SWIVEL_INVALID_ARGUMENT, "swivel_bind: chain or binding is null");
    return bind(*chain, *binding, lengths);
}

uint32_t swivel_block_count(const swivel_crowd* crowd) { return crowd->block_count; }
uint32_t swivel_group_first_limb(const swivel_crowd* crowd, uint32_t group)
{
    return group < crowd->group_count ? crowd->groups[group].first_block * SWIVEL_LANES : 0;
}
uint32_t swivel_group_limb_count(const swivel_crowd* crowd, uint32_t group)
{
    return group < crowd->group_count ? crowd->groups[group].limb_count : 0;
}
uint32_t swivel_field_first_row(const swivel_crowd* crowd, swivel_field field)
{
    return field_first_row(crowd->features, field);
}
uint32_t swivel_field_row_count(const swivel_crowd* crowd, swivel_field field)
{
    return field_row_count(crowd->features, field);
}
swivel_rows swivel_input_rows(swivel_crowd* crowd)
{
    return {crowd->input, crowd->block_count, crowd->input_row_count};
}
swivel_rows swivel_result_rows(swivel_crowd* crowd)
{
    return {crowd->results, crowd->block_count, crowd->results ? crowd->result_row_count : 0};
}
swivel_words swivel_compact_rows(swivel_crowd* crowd)
{
    return {crowd->words, crowd->block_count, crowd->words ? crowd->result_row_count : 0};
}

void swivel_unpack_rotation(const uint16_t* words, size_t word_stride, float xyzw[4])
{
    const FloatEnv env;
    const std::array<float, 4> q = unpack_rotation(words, word_stride);
    std::copy(q.begin(), q.end(), xyzw);
}
float swivel_unpack_half(uint16_t word) { return unpack_half(word); }

swivel_status swivel_write(swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first, uint32_t limb_count,
                           swivel_in values)
{
    if (const swivel_status status = check(crowd, group, first, limb_count); status != SWIVEL_OK) return status;
    if (const swivel_status status = check_values(*crowd, group, field, values.data, values.stride, true);
        status != SWIVEL_OK)
        return status;
    copy_in(rows_of(*crowd, crowd->groups[group], field), first, limb_count, values);
    return SWIVEL_OK;
}

swivel_status swivel_write_doubles(swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                                   uint32_t limb_count, swivel_in values, swivel_in origins)
{
    swivel_status status = check(crowd, group, first, limb_count);
    if (status == SWIVEL_OK) status = check_field(*crowd, group, field, true);
    if (status != SWIVEL_OK) return status;
    if (!is_position(field))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "group %u, %s: not a position; doubles are for target, pole and parent_position", group,
                    field_name(field));
    if (origins.data && !has_origin(crowd->features, field))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "group %u, %s: a direction has no origin, and SWIVEL_POLE_DIRECTION makes it one; give null", group,
                    field_name(field));
    status = check_values(*crowd, group, field, values.data, values.stride, true, sizeof(double));
    if (status == SWIVEL_OK && origins.data)
        status = check_stride(group, "origin", origins.data, origins.stride, 3 * sizeof(double), true);
    if (status != SWIVEL_OK) return status;
    const FloatEnv env;
    copy_doubles_in(rows_of(*crowd, crowd->groups[group], field), first, limb_count, values, origins);
    return SWIVEL_OK;
}

swivel_status swivel_read(const swivel_crowd* crowd, swivel_field field, uint32_t group, uint32_t first,
                          uint32_t limb_count, swivel_out values)
{
    if (const swivel_status status = check(crowd, group, first, limb_count); status != SWIVEL_OK) return status;
    if (const swivel_status status = check_values(*crowd, group, field, values.data, values.stride, false);
        status != SWIVEL_OK)
        return status;
    if (is_packed(*crowd, field))
        unpack_out(*crowd, crowd->groups[group], field, first, limb_count, values);
    else
        copy_out(rows_of(*crowd, crowd->groups[group], field), first, limb_count, values);
    return SWIVEL_OK;
}

swivel_status swivel_solve(swivel_crowd* crowd)
{
    if (!crowd) return fail(SWIVEL_INVALID_ARGUMENT, "swivel_solve: crowd is null");
    swivel_status status = SWIVEL_OK;
    const Isa* isa = usable_isa(status);
    if (!isa) return status;
    solve_all(*crowd, *isa->kernels);
    return SWIVEL_OK;
}

swivel_status swivel_solve_blocks(swivel_crowd* crowd, uint32_t first_block, uint32_t block_count)
{
    swivel_status status = check_blocks(crowd, first_block, block_count);
    if (status != SWIVEL_OK) return status;
    const Isa* isa = usable_isa(status);
    if (!isa) return status;
    solve_blocks(*crowd, *isa->kernels, first_block, block_count);
    return SWIVEL_OK;
}

swivel_status swivel_solve_frame(swivel_crowd* crowd, const swivel_frame* frames)
{
    if (!crowd) return fail(SWIVEL_INVALID_ARGUMENT, "swivel_solve_frame: crowd is null");
    swivel_status status = check_frames(*crowd, frames, 0, crowd->block_count);
    if (status != SWIVEL_OK) return status;
    const Isa* isa = usable_isa(status);
    if (!isa) return status;
    solve_frame_all(*crowd, *isa->kernels, frames);
    return SWIVEL_OK;
}

swivel_status swivel_solve_frame_blocks(swivel_crowd* crowd, const swivel_frame* frames, uint32_t first_block,
                                        uint32_t block_count)
{
    swivel_status status = check_blocks(crowd, first_block, block_count);
    if (status == SWIVEL_OK) status = check_frames(*crowd, frames, first_block, block_count);
    if (status != SWIVEL_OK) return status;
    const Isa* isa = usable_isa(status);
    if (!isa) return status;
    solve_frame_blocks(*crowd, *isa->kernels, frames, first_block, block_count);
    return SWIVEL_OK;
}

swivel_status swivel_reset(swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count)
{
    if (const swivel_status status = check(crowd, group, first, limb_count); status != SWIVEL_OK) return status;
    if (!(crowd->features & SWIVEL_WITH_STEP)) return SWIVEL_OK;
    const float zero[3] = {};
    copy_in(rows_of(*crowd, crowd->groups[group], SWIVEL_NORMAL), first, limb_count, {zero, 0});
    return SWIVEL_OK;
}

swivel_status swivel_allowed_arcs(const swivel_crowd* crowd, uint32_t group, uint32_t limb, swivel_arc* arcs,
                                  uint32_t capacity, uint32_t* arc_count)
{
    if (const swivel_status status = check(crowd, group, limb, 1); status != SWIVEL_OK) return status;
    if (!arc_count) return fail(SWIVEL_INVALID_ARGUMENT, "swivel_allowed_arcs: arc_count is null");
    if (!arcs && capacity > 0) return fail(SWIVEL_INVALID_ARGUMENT, "swivel_allowed_arcs: arcs is null");
    *arc_count = allowed_arcs(*crowd, *find_isa("scalar")->kernels, crowd->groups[group], limb, arcs, capacity);
    return SWIVEL_OK;
}

swivel_status swivel_joint_angles(const swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count,
                                  swivel_euler_order shoulder_order, swivel_euler_order wrist_order, int family,
                                  swivel_out angles)
{
    if (const swivel_status status = check(crowd, group, first, limb_count); status != SWIVEL_OK) return status;
    for (const auto& [order, name] :
         {std::pair{shoulder_order, "shoulder_order"}, std::pair{wrist_order, "wrist_order"}})
        if (static_cast<unsigned>(order) > SWIVEL_ZYX)
            return fail(SWIVEL_INVALID_ARGUMENT, "swivel_joint_angles: %s is %d; it is one of SWIVEL_XYZ to SWIVEL_ZYX",
                        name, static_cast<int>(order));
    if (family != 0 && family != 1)
        return fail(SWIVEL_INVALID_ARGUMENT, "swivel_joint_angles: family is %d; it is 0 or 1", family);
    if (const swivel_status status =
            check_stride(group, "angles", angles.data, angles.stride, 7 * sizeof(double), false);
        status != SWIVEL_OK)
        return status;
    const FloatEnv env;
    const Group& g = crowd->groups[group];
    for (std::uint32_t n = 0; n < limb_count; ++n) {
        const std::size_t limb = std::size_t{g.first_block} * SWIVEL_LANES + first + n;
        const JointAngles seven = joint_angles(arm_rotors(*crowd, g, limb), shoulder_order, wrist_order, family);
        std::memcpy(static_cast<char*>(angles.data) + n * angles.stride, &seven, sizeof seven);
    }
    return SWIVEL_OK;
}

swivel_status swivel_forward(const swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count,
                             swivel_out elbow, swivel_out wrist, swivel_out hand)
{
    if (const swivel_status status = check(crowd, group, first, limb_count); status != SWIVEL_OK) return status;
    if (hand.data && !(crowd->features & SWIVEL_WITH_HAND))
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "swivel_forward: this crowd has no hands; create it with SWIVEL_WITH_HAND");
    for (const auto& [name, out, component_count] :
         {std::tuple{"elbow", elbow, 3u}, {"wrist", wrist, 3u}, {"hand", hand, 4u}})
        if (out.data)
            if (const swivel_status status =
                    check_stride(group, name, out.data, out.stride, component_count * sizeof(double), false);
                status != SWIVEL_OK)
                return status;
    const Group& of = crowd->groups[group];
    for (uint32_t n = 0; n < limb_count; ++n) {
        const LimbPose pose = forward(*crowd, of, std::size_t{of.first_block} * SWIVEL_LANES + first + n);
        store(elbow, n, pose.elbow);
        store(wrist, n, pose.wrist);
        store(hand, n, pose.hand);
    }
    return SWIVEL_OK;
}

swivel_status swivel_residuals(const swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count,
                               swivel_out distance)
{
    if (const swivel_status status = check(crowd, group, first, limb_count); status != SWIVEL_OK) return status;
    if (const swivel_status status =
            check_stride(group, "distance", distance.data, distance.stride, sizeof(double), false);
        status != SWIVEL_OK)
        return status;
    const Group& of = crowd->groups[group];
    for (uint32_t n = 0; n < limb_count; ++n) {
        const double value = residual(*crowd, of, std::size_t{of.first_block} * SWIVEL_LANES + first + n);
        std::memcpy(static_cast<char*>(distance.data) + n * distance.stride, &value, sizeof value);
    }
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

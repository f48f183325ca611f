// SPDX-License-Identifier: MIT
#include <algorithm>

#include "batch/api/check.h"
#include "batch/api/pose_arrays.h"
#include "batch/refusal/sized.h"
#include "batch/refusal/status.h"
#include "batch/solve/work.h"

namespace swivel {

namespace {

swivel_status check_stride(const char* name, const char* what, std::size_t stride, std::size_t bytes, bool may_repeat)
{
    if (stride >= bytes || (may_repeat && stride == 0)) return SWIVEL_OK;
    return refuse("the pose's %s: %s %zu is smaller than a value, %zu bytes", name, what, stride, bytes);
}
// Bodies and joints must not share the value of a result.
swivel_status check_strides(const swivel_crowd& crowd, const PoseArray& array)
{
    const bool is_read = array.use == PoseUse::read, may_repeat = is_read || crowd.groups[0].limb_count == 1;
    const swivel_status status =
        check_stride(array.name, "body_stride", array.values.body_stride, array.bytes, may_repeat);
    if (status != SWIVEL_OK || array.values.offsets) return status;
    return check_stride(array.name, "joint_stride", array.values.joint_stride, array.bytes, is_read);
}

swivel_status check_space(const swivel_pose& pose)
{
    const std::uint32_t space = number_of(pose.space);
    if (space > SWIVEL_IN_BODY) return refuse("the pose's space is %u; it is SWIVEL_LOCAL or SWIVEL_IN_BODY", space);
    return check_reserved("pose", pose);
}
bool needs_time(const swivel_crowd& crowd, const std::uint32_t* groups)
{
    for (std::uint32_t g = 0; g < crowd.group_count; ++g)
        if (is_named(groups, g) &&
            (crowd.groups[g].features & (SWIVEL_WITH_PLANT | kShift) || crowd.groups[g].plan.look.rate > 0))
            return true;
    return false;
}
// Whether translations go where they must.
swivel_status check_translation_results(const swivel_pose& pose)
{
    const bool moves = pose.space == SWIVEL_IN_BODY && pose.translations.data;
    if (pose.translation_results.data && !moves)
        return refuse(
            "the pose has translation_results, but only translations in the body's space change; leave them out");
    if (moves && pose.results.data && !pose.translation_results.data)
        return refuse(
            "the pose has results, but no translation_results, and in the body's space translations change; give them");
    return SWIVEL_OK;
}

// Refuses an array without offsets in which results of two bodies overlap.
swivel_status check_bodies_apart(const swivel_crowd& crowd, const std::uint32_t* groups, const swivel_pose& pose,
                                 const PoseArray& array)
{
    const std::uint64_t body_count = crowd.groups[0].limb_count, body_step = array.values.body_stride,
                        joint_step = array.values.joint_stride, bytes = array.bytes;
    if (array.use == PoseUse::read || array.values.offsets || body_count == 1) return SWIVEL_OK;
    std::uint32_t first = UINT32_MAX, last = 0;
    for_each_joint(crowd, groups, pose, array.use, [&](std::uint32_t joint) {
        first = std::min(first, joint);
        last = std::max(last, joint);
    });
    if (first >= last) return SWIVEL_OK;
    const bool is_body_by_body = body_step >= (last - first) * joint_step + bytes,
               is_joint_by_joint = joint_step >= (body_count - 1) * body_step + bytes;
    if (is_body_by_body || is_joint_by_joint) return SWIVEL_OK;
    // The body whose lower joint overlaps body 0's higher one, `apart` joints on; 0: none. Only two bodies' lower
    // joints are next to the higher one.
    const auto body_on = [=](std::uint32_t apart) -> std::uint64_t {
        const std::uint64_t at = apart * joint_step, before = at / body_step, behind = before + 1;
        if (before > 0 && before < body_count && at - before * body_step < bytes) return before;
        return behind < body_count && behind * body_step - at < bytes ? behind : 0;
    };
    // Distances are few and pairs are many, so pairs are looked at only where some distance overlaps.
    std::uint32_t apart = 1;
    while (apart <= last - first && body_on(apart) == 0) ++apart;
    if (apart > last - first) return SWIVEL_OK;
    swivel_status status = SWIVEL_OK;
    for_each_joint(crowd, groups, pose, array.use, [&](std::uint32_t low) {
        if (status != SWIVEL_OK) return;
        for_each_joint(crowd, groups, pose, array.use, [&](std::uint32_t high) {
            const std::uint64_t body = high > low && status == SWIVEL_OK ? body_on(high - low) : 0;
            if (body == 0) return;
            status = refuse(
                "the pose's %s: by a body_stride of %zu and a joint_stride of %zu joint %u of body %llu overlaps joint "
                "%u of body 0; give the bytes from body to body, such as the size of your structure, and from joint to "
                "joint",
                array.name, array.values.body_stride, array.values.joint_stride, low,
                static_cast<unsigned long long>(body), high);
        });
    });
    return status;
}

}  // namespace

swivel_status check_pose(const swivel_crowd& crowd, const swivel_pose* given)
{
    if (crowd.joint_count == 0)
        return given ? refuse("this crowd has no bodies, so it takes no pose; create it with a skeleton") : SWIVEL_OK;
    if (!given) return refuse("this crowd is of bodies; give the job their pose");
    if (const swivel_status sized = check_size<swivel_pose>("pose", size_of(given)); sized != SWIVEL_OK) return sized;
    const swivel_pose pose = full_pose(given);
    const std::uint32_t form = number_of(pose.form);
    if (form > SWIVEL_MATRIX_COLUMNS3)
        return refuse("the pose's form is %u; it is one of SWIVEL_ROTATIONS to SWIVEL_MATRIX_COLUMNS3", form);
    if (const swivel_status status = check_space(pose); status != SWIVEL_OK) return status;
    if (!pose.rotations.data) return refuse("the pose has no rotations; give them");
    if (pose.form != SWIVEL_ROTATIONS && (pose.translations.data || pose.scales.data))
        return refuse("the pose has matrices and %s, which matrices hold; leave these out",
                      pose.translations.data ? "translations" : "scales");
    swivel_status status = check_translation_results(pose);
    for_each_array(pose, [&](const PoseArray& array) {
        if (status == SWIVEL_OK) status = check_strides(crowd, array);
    });
    for (const BodyValues& each : values_of_bodies(pose))
        if (status == SWIVEL_OK && each.values.data)
            status = check_stride(each.name, "stride", each.values.stride, each.bytes, true);
    if (status == SWIVEL_OK && pose.root_is_double && !pose.root_position.data)
        status = refuse("the pose's root is in doubles, but has no position; give it");
    return status;
}

swivel_status check_pose(const swivel_crowd& crowd, const std::uint32_t* groups, const swivel_pose* given)
{
    swivel_status status = check_pose(crowd, given);
    if (status != SWIVEL_OK || !given) return status;
    const swivel_pose pose = full_pose(given);
    for_each_array(pose, [&](const PoseArray& array) {
        if (status == SWIVEL_OK) status = check_bodies_apart(crowd, groups, pose, array);
    });
    if (status != SWIVEL_OK || pose.time.data || !needs_time(crowd, groups)) return status;
    return refuse(
        "the pose has no time, which plants, shifts and looks with a rate need; give the seconds since each body's "
        "last solve");
}

}  // namespace swivel

// SPDX-License-Identifier: MIT
#include "batch/pose.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "batch/sized.h"
#include "batch/status.h"
#include "simd/transpose.h"

namespace swivel {

namespace {

// Rows of C floats of some bodies of a block to their values. Whole blocks go four bodies at a time.
template <std::size_t C>
void from_rows(const float* rows, LaneMask lanes, char* values, std::size_t stride)
{
    if (lanes == kAllLanes)
        for (std::size_t n = 0; n < kLanes; n += 4) four_values_from_rows<C>(rows + n, values + n * stride, stride);
    else
        for (; lanes != 0; lanes &= lanes - 1) {
            const auto n = static_cast<std::size_t>(std::countr_zero(lanes));
            value_from_rows<C>(rows + n, values + n * stride);
        }
}

// The value of a joint of a block's first body.
char* value_of(const swivel_joint_values& values, std::uint32_t joint, std::uint32_t body)
{
    return static_cast<char*>(values.data) + std::size_t{body} * values.body_stride +
           (values.offsets ? values.offsets[joint] : joint * values.joint_stride);
}

// Bytes of a pose's rotation or matrix, as far as they are touched.
std::size_t rotation_bytes(swivel_pose_form form)
{
    if (form == SWIVEL_ROTATIONS) return 4 * sizeof(float);
    return (form == SWIVEL_MATRIX_COLUMNS ? 15 : 12) * sizeof(float);
}

swivel_status check_stride(const char* name, const char* what, std::size_t stride, std::size_t bytes, bool may_repeat)
{
    if (stride >= bytes || (may_repeat && stride == 0)) return SWIVEL_OK;
    return fail(SWIVEL_INVALID_ARGUMENT, "the pose's %s: %s %zu is smaller than a value, %zu bytes", name, what, stride,
                bytes);
}
// is_result: bodies must not share a value.
swivel_status check_values(const swivel_crowd& crowd, const char* name, const swivel_joint_values& values,
                           std::size_t bytes, bool is_result)
{
    if (!values.data) return SWIVEL_OK;
    const bool may_repeat = !is_result || crowd.groups[0].limb_count == 1;
    const swivel_status status = check_stride(name, "body_stride", values.body_stride, bytes, may_repeat);
    if (status != SWIVEL_OK || values.offsets) return status;
    return check_stride(name, "joint_stride", values.joint_stride, bytes, !is_result);
}
swivel_status check_root(const char* name, const swivel_in& values, std::size_t bytes)
{
    return values.data ? check_stride(name, "stride", values.stride, bytes, true) : SWIVEL_OK;
}

}  // namespace

swivel_pose full_pose(const swivel_pose* given) { return element(given, 0, swivel_default_pose()); }

swivel_status check_pose(const swivel_crowd& crowd, const swivel_pose* given)
{
    if (crowd.joint_count == 0)
        return given ? fail(SWIVEL_INVALID_ARGUMENT,
                            "this crowd has no bodies, so it takes no pose; create it with a skeleton")
                     : SWIVEL_OK;
    if (!given) return fail(SWIVEL_INVALID_ARGUMENT, "this crowd is of bodies; give the job their pose");
    if (const swivel_status sized = check_size<swivel_pose>("pose", size_of(given)); sized != SWIVEL_OK) return sized;
    const swivel_pose pose = full_pose(given);
    std::uint32_t form;  // C lets it be any number
    static_assert(sizeof form == sizeof pose.form);
    std::memcpy(&form, &pose.form, sizeof form);
    if (form > SWIVEL_MATRIX_COLUMNS3)
        return fail(SWIVEL_INVALID_ARGUMENT,
                    "the pose's form is %u; it is one of SWIVEL_ROTATIONS to SWIVEL_MATRIX_COLUMNS3", form);
    if (!pose.rotations.data) return fail(SWIVEL_INVALID_ARGUMENT, "the pose has no rotations; give them");
    if (pose.form != SWIVEL_ROTATIONS && (pose.translations.data || pose.scales.data))
        return fail(SWIVEL_INVALID_ARGUMENT, "the pose has matrices and %s, which matrices hold; leave these out",
                    pose.translations.data ? "translations" : "scales");
    const std::size_t bytes = rotation_bytes(pose.form), float3 = 3 * sizeof(float);
    swivel_status status = check_values(crowd, "rotations", pose.rotations, bytes, !pose.results.data);
    if (status == SWIVEL_OK) status = check_values(crowd, "translations", pose.translations, float3, false);
    if (status == SWIVEL_OK) status = check_values(crowd, "scales", pose.scales, float3, false);
    if (status == SWIVEL_OK) status = check_values(crowd, "results", pose.results, bytes, true);
    if (status == SWIVEL_OK)
        status = check_root("root_position", pose.root_position, pose.root_is_double ? 3 * sizeof(double) : float3);
    if (status == SWIVEL_OK) status = check_root("root_rotation", pose.root_rotation, 4 * sizeof(float));
    if (status == SWIVEL_OK) status = check_root("root_scale", pose.root_scale, sizeof(float));
    if (status == SWIVEL_OK && pose.root_is_double && !pose.root_position.data)
        status = fail(SWIVEL_INVALID_ARGUMENT, "the pose's root is in doubles, but has no position; give it");
    return status;
}

void pose_out(const swivel_pose& pose, const swivel_crowd& crowd, const Group& group, const BodyBlock& block)
{
    const swivel_joint_values& results = pose.results.data ? pose.results : pose.rotations;
    const auto out = [&](std::uint32_t n) {
        const float* const rows = block.rows + joint_row(n) * kLanes;
        char* const to = value_of(results, crowd.joints[n].skeleton_joint, block.first);
        if (pose.form == SWIVEL_ROTATIONS)
            return from_rows<4>(rows + kLocalRow * kLanes, block.lanes, to, results.body_stride);
        const std::size_t step = (pose.form == SWIVEL_MATRIX_COLUMNS3 ? 3 : 4) * sizeof(float);
        for (std::size_t part = 0; part < 3; ++part)
            from_rows<3>(rows + (kAxesRow + 3 * part) * kLanes, block.lanes, to + part * step, results.body_stride);
    };
    out(group.limb.shoulder);
    out(group.limb.elbow);
    if (group.features & SWIVEL_WITH_HAND) out(group.limb.wrist);
}

}  // namespace swivel

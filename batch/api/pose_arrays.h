// SPDX-License-Identifier: MIT
//
// The arrays of joints that a pose has: which of them a solve reads and writes, and of which joints. For the checks of
// a pose.
#pragma once

#include <cstddef>
#include <cstdint>

#include "batch/crowd/crowd.h"
#include "batch/solve/work.h"
#include "simd/body_rows.h"

namespace swivel {

// How a solve uses an array: it writes the joints that move, or writes all that some group needs, or may read a joint.
enum class PoseUse { moved, needed, read };
// What an array has of each joint. A pose and its results are of one kind.
enum class PoseKind : std::uint32_t { rotations, translations, scales, joint_rotations, joint_positions };
struct PoseArray {
    PoseKind kind;
    const char* name;
    swivel_joint_values values;
    std::size_t bytes;  // of a value, as far as it is touched
    PoseUse use;
};

// Bytes of a pose's rotation or matrix, as far as they are touched.
inline std::size_t rotation_bytes(swivel_pose_form form)
{
    return form == SWIVEL_ROTATIONS ? 4 * sizeof(float) : entry_offset(form, 2, 3) + sizeof(float);
}

// Calls take(array) for each array that the pose has. What is read and written in place is two arrays.
template <class Take>
void for_each_array(const swivel_pose& pose, const Take& take)
{
    const std::size_t bytes = rotation_bytes(pose.form);
    constexpr std::size_t float3 = 3 * sizeof(float), float4 = 4 * sizeof(float);
    const auto take_given = [&](PoseKind kind, const char* name, const swivel_joint_values& values, std::size_t size,
                                PoseUse use) {
        if (values.data) take(PoseArray{kind, name, values, size, use});
    };
    take_given(PoseKind::rotations, "rotations", pose.rotations, bytes, PoseUse::read);
    take_given(PoseKind::translations, "translations", pose.translations, float3, PoseUse::read);
    take_given(PoseKind::scales, "scales", pose.scales, float3, PoseUse::read);
    if (pose.results.data)
        take_given(PoseKind::rotations, "results", pose.results, bytes, PoseUse::moved);
    else
        take_given(PoseKind::rotations, "rotations", pose.rotations, bytes, PoseUse::moved);
    if (pose.translation_results.data)
        take_given(PoseKind::translations, "translation_results", pose.translation_results, float3, PoseUse::moved);
    else if (pose.space == SWIVEL_IN_BODY)
        take_given(PoseKind::translations, "translations", pose.translations, float3, PoseUse::moved);
    take_given(PoseKind::joint_rotations, "joint_rotations", pose.joint_rotations, float4, PoseUse::needed);
    take_given(PoseKind::joint_positions, "joint_positions", pose.joint_positions, float3, PoseUse::needed);
}

// Calls take(joint) for the joints of an array, as the skeleton numbers them, in any order. groups: those that a job
// names. A joint that is read may come twice.
template <class Take>
void for_each_joint(const swivel_crowd& crowd, const std::uint32_t* groups, const swivel_pose& pose, PoseUse use,
                    const Take& take)
{
    const bool in_body = pose.space == SWIVEL_IN_BODY;
    for (std::uint32_t n = 1; n < crowd.joint_count && use != PoseUse::moved; ++n) take(crowd.joints[n].skeleton_joint);
    for (std::uint32_t g = 0; g < crowd.group_count && use != PoseUse::needed; ++g) {
        const Group& group = crowd.groups[g];
        if (!is_named(groups, g) && !(in_body && hangs_on_solved(crowd, groups, group))) continue;
        const GroupJoints& joints = group.plan.joints;
        for (std::uint32_t n = 0; n < joints.turned_count && !in_body; ++n) take(joints.turned[n].skeleton_joint);
        for (std::uint32_t n = 0; n < joints.moved_count && in_body; ++n) take(joints.moved[n].skeleton_joint);
    }
}

}  // namespace swivel

// SPDX-License-Identifier: MIT
//
// The arrays that a pose has, of joints and of bodies: which of them a solve reads and writes, and of which joints. For
// the checks of a pose.
#pragma once

#include <array>
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

// Calls take(array) for each array that the pose has. What is read and written in place is two arrays.
template <class Take>
void for_each_array(const swivel_pose& pose, const Take& take)
{
    constexpr std::size_t float3 = 3 * sizeof(float), float4 = 4 * sizeof(float);
    const std::size_t bytes =
        pose.form == SWIVEL_ROTATIONS ? float4 : entry_offset(pose.form, 2, 3) + sizeof(float);  // of a matrix
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

// The values of bodies that a solve reads, as far as the pose has them.
struct BodyValues {
    const char* name;
    swivel_in values;
    std::size_t bytes;
};
inline std::array<BodyValues, 7> values_of_bodies(const swivel_pose& pose)
{
    const std::size_t place = 3 * (pose.root_is_double ? sizeof(double) : sizeof(float));
    return {{{"root_position", pose.root_position, place},
             {"root_rotation", pose.root_rotation, 4 * sizeof(float)},
             {"root_scale", pose.root_scale, sizeof(float)},
             {"time", pose.time, sizeof(float)},
             {"weight", pose.weight, sizeof(float)},
             {"support_position", pose.support_position, place},
             {"support_rotation", pose.support_rotation, 4 * sizeof(float)}}};
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

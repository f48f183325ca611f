// SPDX-License-Identifier: MIT
//
// The joints that the groups of a def turn and need, and their order in the skeleton. The sizes of the def's structures
// are already checked.
#pragma once

#include "batch/crowd/crowd.h"
#include "batch/crowd/group_def.h"
#include "batch/crowd/rig.h"
#include "batch/refusal/sized.h"
#include "simd/rows.h"

namespace swivel {

inline swivel_skeleton skeleton_of(const swivel_crowd_def& def)
{
    return element(def.skeleton, 0, swivel_default_skeleton());
}
inline swivel_limb_joints joints_of(const GroupDef& group)
{
    return element(group.joints, 0, swivel_default_limb_joints(0, 0, 0));
}

// Some joints of the skeleton.
struct JointList {
    std::uint32_t joint[kMaxTurned];
    std::uint32_t count = 0;

    const std::uint32_t* begin() const { return joint; }
    const std::uint32_t* end() const { return joint + count; }
};

// The joints that a group's limb or look turns, upper ones first.
struct TurnedJoints : JointList {
    TurnedJoints(const swivel_skeleton& skeleton, const GroupDef& group)
    {
        if (group.features & kLook)
            for (; count < group.look.joint_count; ++count) joint[count] = group.look.joints[count];
        if (!group.joints) return;  // no limb
        const swivel_limb_joints limb = joints_of(group);
        if (group.features & SWIVEL_WITH_CLAVICLE)
            joint[count++] = static_cast<std::uint32_t>(parent_of(skeleton, limb.shoulder));
        joint[count++] = limb.shoulder;
        joint[count++] = limb.elbow;
        if (group.features & SWIVEL_WITH_HAND) joint[count++] = limb.wrist;
        for (std::uint32_t n = 0; n < twist_bone_count(group.features); ++n) joint[count++] = limb.twist_bones[n];
    }
};

// Whether `joint` is `below` or above it. Both are in the skeleton, and parents lead to a root.
inline bool is_above(const swivel_skeleton& skeleton, std::uint32_t joint, std::uint32_t below)
{
    for (auto at = static_cast<std::int32_t>(below); at >= 0; at = parent_of(skeleton, static_cast<std::uint32_t>(at)))
        if (static_cast<std::uint32_t>(at) == joint) return true;
    return false;
}

// The lowest joints that a group needs; it also needs all joints above them.
struct NeededEnds : JointList {
    explicit NeededEnds(const GroupDef& group)
    {
        if (group.features & kLook) joint[count++] = group.look.joints[group.look.joint_count - 1];
        if (group.features & kProp && group.prop.joint >= 0)
            joint[count++] = static_cast<std::uint32_t>(group.prop.joint);
        if (!group.joints) return;  // no limb
        const swivel_limb_joints limb = joints_of(group);
        joint[count++] = limb.wrist;
        for (std::uint32_t n = 0; n < twist_bone_count(group.features); ++n) joint[count++] = limb.twist_bones[n];
    }
};

}  // namespace swivel

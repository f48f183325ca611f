// SPDX-License-Identifier: MIT
//
// The joints of a crowd of bodies, as a def names them: which of the skeleton a group's limb turns, and how they hang
// below each other. The def's structures have the sizes that they must have.
#pragma once

#include <algorithm>

#include "batch/crowd/crowd.h"
#include "batch/crowd/group_def.h"
#include "batch/crowd/skeleton.h"
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

// The joints that a group's limb or look turns, an upper one first.
struct TurnedJoints {
    std::uint32_t joint[kMaxTurned];
    std::uint32_t count = 0;

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
    const std::uint32_t* begin() const { return joint; }
    const std::uint32_t* end() const { return joint + count; }
    bool has(std::int32_t of) const { return of >= 0 && std::find(begin(), end(), std::uint32_t(of)) != end(); }
};

// Whether a joint is another or above it. Both are in the skeleton, and parents lead to a root.
inline bool is_above(const swivel_skeleton& skeleton, std::uint32_t joint, std::uint32_t below)
{
    for (auto at = static_cast<std::int32_t>(below); at >= 0; at = parent_of(skeleton, static_cast<std::uint32_t>(at)))
        if (static_cast<std::uint32_t>(at) == joint) return true;
    return false;
}

// Calls take(joint) for each joint that some group needs: those of all limbs, and what is above them.
template <class Take>
void for_each_needed(const swivel_crowd_def& def, const swivel_skeleton& skeleton, const Take& take)
{
    const auto is_needed = [&](std::uint32_t joint) {
        for (std::uint32_t g = 0; g < def.group_count; ++g) {
            const GroupDef group = unlinked_group(def, g);
            if (group.joints && is_above(skeleton, joint, joints_of(group).wrist)) return true;
            if (group.features & kProp && group.prop.joint >= 0 &&
                is_above(skeleton, joint, static_cast<std::uint32_t>(group.prop.joint)))
                return true;
            for (const std::uint32_t turned : TurnedJoints(skeleton, group))
                if (is_above(skeleton, joint, turned)) return true;
        }
        return false;
    };
    for (std::uint32_t joint = 0; joint < skeleton.joint_count; ++joint)
        if (is_needed(joint)) take(joint);
}

}  // namespace swivel

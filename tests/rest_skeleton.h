// SPDX-License-Identifier: MIT
//
// Random skeletons in which an arm is hidden, joints in any order, and where their joints are in the world: forward
// kinematics over all joints, by Eigen in double. Knows nothing of arm frames.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "tests/test_limb.h"

namespace swivel::test {

struct RestSkeleton {
    std::vector<std::int32_t> parents;
    std::vector<Float4> rotations;  // of any length
    std::vector<Float3> translations;
    std::uint32_t shoulder = 0, elbow = 0, wrist = 0;
    std::vector<std::uint32_t> twist_bones, between;
    Float3 bend{};

    std::uint32_t size() const { return static_cast<std::uint32_t>(parents.size()); }
    std::uint32_t add(std::uint32_t parent, const Float4& rotation, const Float3& translation)
    {
        parents.push_back(static_cast<std::int32_t>(parent));
        rotations.push_back(rotation);
        translations.push_back(translation);
        return size() - 1;
    }
    swivel_skeleton view() const { return view_of(*this); }
    swivel_limb_joints joints() const
    {
        swivel_limb_joints joints = swivel_default_limb_joints(shoulder, elbow, wrist);
        joints.twist_bones = twist_bones.data();
        joints.twist_bone_count = static_cast<std::uint32_t>(twist_bones.size());
        std::ranges::copy(bend, joints.bend);
        return joints;
    }
    swivel_binding bound() const { return bind(view(), joints()); }
};

// The local rotations of all joints.
using Locals = std::vector<Quaterniond>;
inline Locals rest_locals(const RestSkeleton& skeleton)
{
    Locals locals;
    for (const Float4& q : skeleton.rotations) locals.push_back(quat(q).normalized());
    return locals;
}

struct JointPlace {
    Quaterniond rotation;
    Vector3d position;
};
// From its root on, which stands in `world`.
inline JointPlace place_of(const RestSkeleton& skeleton, const Locals& locals, const Parent& world, std::uint32_t joint)
{
    const std::int32_t parent = skeleton.parents[joint];
    const JointPlace above = parent < 0 ? JointPlace{world.rotation, world.position}
                                        : place_of(skeleton, locals, world, static_cast<std::uint32_t>(parent));
    return {above.rotation * locals[joint],
            above.position + world.scale * (above.rotation * vec(skeleton.translations[joint]))};
}
inline JointPlace place_of_parent(const RestSkeleton& skeleton, const Locals& locals, const Parent& world,
                                  std::uint32_t joint)
{
    const std::int32_t parent = skeleton.parents[joint];
    return parent < 0 ? JointPlace{world.rotation, world.position}
                      : place_of(skeleton, locals, world, static_cast<std::uint32_t>(parent));
}

// How many joints lie above the shoulder, and between those of the limb.
struct Between {
    std::uint32_t above, upper, fore;
};
RestSkeleton random_skeleton(Random& random, const Between& between, std::uint32_t twist_bone_count);

}  // namespace swivel::test

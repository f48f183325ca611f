// SPDX-License-Identifier: MIT
//
// A crowd of bodies through the public interface, with goals, and poses in a buffer that it reads and writes. And how
// far floats may put a limb off.
#pragma once

#include "tests/pose_buffer.h"

namespace swivel::test {

// region: of all limbs, with SWIVEL_WITH_REGION.
inline Crowd body_crowd(const BodySkeleton& skeleton, swivel_features features, std::uint32_t body_count,
                        const swivel_region* region = nullptr)
{
    std::vector<swivel_limb_joints> joints;
    for (std::size_t n = 0; n < skeleton.limbs.size(); ++n) joints.push_back(skeleton.joints(n));
    std::vector<swivel_group_def> groups;
    for (const swivel_limb_joints& each : joints) groups.push_back(body_group(each, features));
    for (swivel_group_def& group : groups) group.region = features & SWIVEL_WITH_REGION ? region : nullptr;
    return Crowd(skeleton.view(), body_count, groups);
}

// Where a limb goes.
struct BodyGoal {
    Float3 target, pole;
    Float4 hand;
};
using BodyGoals = std::vector<std::vector<BodyGoal>>;  // of each group's limbs

// The limb's own wrist.
BodyGoal own_goal(const BodySkeleton& skeleton, const Body& body, std::size_t limb);
// Any that the limb reaches.
BodyGoal random_goal(Random& random, const BodySkeleton& skeleton, const Body& body, std::size_t limb);

inline void write_goals(Crowd& crowd, const BodyGoals& goals)
{
    for (std::uint32_t g = 0; g < goals.size(); ++g) {
        const std::span<const BodyGoal> all = goals[g];
        const swivel_features features = swivel_group_features(crowd.get(), g);
        const auto write = [&](swivel_field field, const void* first) {
            check(swivel_write(crowd.get(), field, g, 0, static_cast<std::uint32_t>(all.size()),
                               {first, sizeof(BodyGoal)}));
        };
        write(SWIVEL_TARGET, &all[0].target);
        if (swivel_field_row_count(crowd.get(), g, SWIVEL_POLE)) write(SWIVEL_POLE, &all[0].pole);
        if (features & SWIVEL_WITH_HAND) write(SWIVEL_HAND, &all[0].hand);
    }
}

// A limb as it comes.
struct LimbAt {
    double upper, fore, sine, way;  // way: of the joints from the root, and what a float target is off

    LimbAt(const BodySkeleton& skeleton, const Body& body, const std::vector<JointAt>& at, const BodyLimbJoints& limb)
    {
        const Vector3d first = at[limb.elbow].place - at[limb.shoulder].place,
                       second = at[limb.wrist].place - at[limb.elbow].place;
        upper = first.norm(), fore = second.norm();
        sine = first.cross(second).norm() / (upper * fore);
        way = way_to(skeleton, at, limb.wrist) + vec(body.root_position).norm() / 3;  // rounded to 1e-7 of it
    }
    double length() const { return upper + fore; }
    // How far a wrist may be off; and a joint, because floats know the distance to the wrist only so well.
    double wrist_bound() const { return 2e-6 * length() + 3e-7 * way; }
    double joint_bound() const { return 2e-6 + (4e-7 * length() + 3e-7 * way) * length() / (upper * fore * sine); }
};

// How far a limb with an untouched goal is from where it was: the worst share of what is allowed.
inline double strayed(const LimbAt& limb, const BodyLimbJoints& joints, const std::vector<JointAt>& was,
                      const std::vector<JointAt>& is)
{
    double worst = 0;
    const auto keep = [&](double share) { worst = share <= worst ? worst : share; };  // NaN stays
    const auto turned = [&](std::uint32_t joint) { return is[joint].rotation.angularDistance(was[joint].rotation); };
    keep((is[joints.wrist].place - was[joints.wrist].place).norm() / limb.wrist_bound());
    keep(turned(joints.shoulder) / limb.joint_bound());
    keep(turned(joints.elbow) / limb.joint_bound());
    keep(turned(joints.wrist) / 5e-6);
    return worst;
}

inline void solve_poses(Crowd& crowd, const swivel_pose& pose) { crowd.solve({.pose = &pose}); }

}  // namespace swivel::test

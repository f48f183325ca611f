// SPDX-License-Identifier: MIT
#include "tools/crowd/look_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;
using formats::JointPose;

constexpr std::size_t kMax = 3;  // joints; a goal_source has as many

// A pose of the looking joints. local: the joint above them comes first.
struct LookPose {
    Quaterniond local[1 + kMax];
    Vector3d bones[kMax - 1];  // from each joint to the next, in its own axes, of a figure of size 1
    Vector3d origin;
};
LookPose look_pose(const Clip& clip, std::span<const int> joints, std::span<const JointPose> pose_w)
{
    const auto at = [&](int joint) { return joint < 0 ? JointPose() : pose_w[static_cast<std::size_t>(joint)]; };
    LookPose pose;
    std::ranges::fill(pose.local, Quaterniond::Identity());
    std::ranges::fill(pose.bones, Vector3d::Zero());
    JointPose above = at(joint_at(clip, joints[0]).parent);
    pose.local[0] = above.rotation;
    pose.origin = at(joints[0]).position;
    for (std::size_t n = 0; n < joints.size(); ++n) {
        const JointPose joint = at(joints[n]);
        pose.local[n + 1] = above.rotation.conjugate() * joint.rotation;
        if (n > 0) pose.bones[n - 1] = above.rotation.conjugate() * Vector3d(joint.position - above.position);
        above = joint;
    }
    return pose;
}

}  // namespace

std::vector<int> look_joints(const Clip& clip, const std::vector<BodyPart>& body, std::span<const Limb> limbs)
{
    const std::vector<int> heads = joints_of(body, "head"), necks = joints_of(body, "neck");
    const auto carries_limb = [&](int joint) {
        return std::ranges::any_of(limbs, [&](const Limb& limb) { return is_above(clip, joint, limb.upper()); });
    };
    if (heads.empty()) return {};
    const std::vector<JointPose> at_rest = rest_pose(clip);
    const auto turns_freely = [&](int joint) {  // a mirror's half turn is no turn of the joint
        const formats::Joint& own = joint_at(clip, joint);
        return !at_rest[static_cast<std::size_t>(joint)].mirrored && own.rest_scale.minCoeff() > 0 &&
               own.scale_track < 0;
    };
    std::vector<int> joints;
    for (int joint = heads.back(); joint >= 0 && joints.size() < kMax; joint = joint_at(clip, joint).parent) {
        const bool is_one = joints.empty() || std::ranges::count(necks, joint) > 0;
        if (!is_one || carries_limb(joint) || !turns_freely(joint)) break;
        joints.insert(joints.begin(), joint);
    }
    return joints;
}

Vector3d face_of(const Clip& clip, int head, const Vector3d& faces_w)
{
    return rest_pose(clip)[static_cast<std::size_t>(head)].rotation.conjugate() * faces_w;
}

LookPlan plan_look(const Clip& clip, std::vector<int> joints, const Vector3d& faces_w, const Vector3d& target_w,
                   double max)
{
    const LookPose at_rest = look_pose(clip, joints, rest_pose(clip));
    LookPlan plan{std::move(joints), {}};
    LimbSetup& setup = plan.setup;
    setup.goals.is_look = 1;
    put(target_w, setup.goals.target_offset);
    for (std::size_t n = 0; n < kMax - 1; ++n)
        if (!at_rest.bones[n].isZero(0)) put(at_rest.bones[n].normalized(), setup.goals.bones[n]);
    put(at_rest.local[1].coeffs(), setup.rest.shoulder_rotation);
    put(at_rest.local[2].coeffs(), setup.rest.elbow_rotation);
    put(at_rest.local[3].coeffs(), setup.rest.wrist_rotation);
    put(at_rest.bones[0], setup.rest.elbow_offset);
    put(at_rest.bones[1], setup.rest.wrist_offset);
    swivel_look_def& look = setup.look.emplace(swivel_default_look_def());
    look.joint_count = static_cast<std::uint32_t>(plan.joints.size());
    for (std::uint32_t n = 0; n < look.joint_count; ++n) look.joints[n] = n;
    for (float& cosine : look.cos_max) cosine = static_cast<float>(std::cos(max));
    put(face_of(clip, plan.joints.back(), faces_w), look.axis);
    return plan;
}

goal_source look_source(const Clip& clip, std::span<const int> joints, std::span<const JointPose> pose_w,
                        const Vector3d& root)
{
    const LookPose pose = look_pose(clip, joints, pose_w);
    goal_source source{};
    put(Quaterniond::Identity().coeffs(), source.hand);
    put(Eigen::Vector2d(pose.bones[0].norm(), pose.bones[1].norm()), source.lengths);
    put(pose.origin, source.origin);
    put(root, source.root);
    put(pose.local[0].coeffs(), source.parent);
    put(pose.local[1].coeffs(), source.shoulder);
    put(pose.local[2].coeffs(), source.elbow_local);
    put(pose.local[3].coeffs(), source.wrist_local);
    return source;
}

}  // namespace swivel::tools

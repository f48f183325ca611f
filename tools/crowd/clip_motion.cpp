// SPDX-License-Identifier: MIT
#include "tools/crowd/clip_motion.h"

#include <algorithm>
#include <cmath>

#include "tools/crowd/stands.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::JointPose;

LimbInClip limb_in(const Limb& limb, const ChainPose& pose, const JointPose& parent_w)
{
    const Quaterniond& parent = parent_w.rotation;
    const auto from_shoulder = [&](std::size_t part) {
        return Vector3d(parent_w.scale * (parent * limb.as_solved(Vector3d(pose.position[part] - pose.position[0]))));
    };
    const auto aimed = [&](const Vector3d& at_rest, const Vector3d& bone) {
        return aim(limb.as_solved(at_rest), limb.as_solved(bone));
    };
    LimbInClip in;
    in.elbow = from_shoulder(1);
    in.wrist = from_shoulder(2);
    in.upper_aim = aimed(limb.upper_bone, pose.upper_bone());
    in.fore_aim = aimed(limb.lower_bone, pose.lower_bone());
    in.parent = parent;
    in.upper = parent * limb.as_solved(pose.turn[0]) * in.upper_aim;
    in.fore = parent * limb.as_solved(pose.turn[1]) * in.fore_aim;
    in.hand = parent * limb.as_solved(pose.turn[2]);
    return in;
}

// The middle of the arms' shoulders, or else of the legs' hips: floats are finest there. In the joints' order, so that
// that of the limbs does not matter.
Vector3d limbs_root(std::span<const Limb> limbs, std::span<const JointPose> pose_w)
{
    Vector3d sum = Vector3d::Zero();
    double count = 0;
    for (std::size_t joint = 0; joint < pose_w.size(); ++joint)
        for (const Limb& limb : limbs)
            if (limb.name.kind == limbs[0].name.kind && limb.upper() == static_cast<int>(joint))
                sum += pose_w[joint].position, ++count;
    return sum / count;
}

goal_source source_of(const LimbInClip& in, const Vector3d& origin, const Vector3d& root)
{
    goal_source source{};
    put(in.elbow, source.elbow);
    put(in.wrist, source.wrist);
    put(in.hand.coeffs(), source.hand);
    put(Eigen::Vector2d(in.upper_length(), in.fore_length()), source.lengths);
    put(origin, source.origin);
    put(root, source.root);
    put(in.parent.coeffs(), source.parent);
    put((in.parent.conjugate() * in.upper).coeffs(), source.shoulder);
    put((in.upper.conjugate() * in.fore).coeffs(), source.elbow_local);
    put(in.local_wrist().coeffs(), source.wrist_local);
    return source;
}

// The strides of a leg in a part of the clip.
void put_strides(const std::vector<bool>& contact, const ClipPart& part, double frame_time,
                 std::span<goal_source> sources)
{
    const auto first = contact.begin() + static_cast<std::ptrdiff_t>(part.first);
    const std::vector<Contact> stands = stands_of({first, first + static_cast<std::ptrdiff_t>(part.count)}, frame_time);
    const auto in_clip = [&](std::size_t frame) { return static_cast<std::uint32_t>(part.first + frame); };
    std::size_t frame = 0;
    for (std::size_t n = 0; n < stands.size(); ++n) {
        const bool is_last = n + 1 == stands.size();
        const Contact &from = stands[n], &next = is_last ? from : stands[n + 1];
        const goal_stride stride{in_clip(middle_of(from)), in_clip(is_last ? part.count : from.end),
                                 in_clip(next.first), in_clip(middle_of(next))};
        for (const std::size_t end = is_last ? part.count : next.first; frame < end; ++frame)
            sources[part.first + frame].stride = stride;
    }
}

// Without stretched bones, lengths differ from those at rest by rounding alone.
void settle_lengths(std::span<goal_source> sources, const float (&at_rest)[2])
{
    const auto differs = [&](const goal_source& source, int bone) {
        return std::abs(source.lengths[bone] - at_rest[bone]) > 1e-7 * source.lengths[bone];
    };
    if (std::ranges::any_of(sources,
                            [&](const goal_source& source) { return differs(source, 0) || differs(source, 1); }))
        return;
    for (goal_source& source : sources)
        for (int bone = 0; bone < 2; ++bone) source.lengths[bone] = at_rest[bone];
}

}  // namespace

ClipMotion::ClipMotion(const formats::Clip& clip, std::span<const Limb> limbs, const CrowdPlan& plan)
    : limb_count_(limbs.size()), sources_(limbs.size() + (plan.look ? 1 : 0)), frame_count_(clip.frame_count)
{
    std::vector<JointPose> pose_w(clip.joints.size());
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        formats::world_pose(clip, frame, pose_w);
        Vector3d root = limbs_root(limbs, pose_w);
        if (plan.ground) root.y() = plan.foot.y();  // lifts of feet are counted from it
        for (std::size_t n = 0; n < limbs.size(); ++n) {
            const Limb& limb = limbs[n];
            const int parent = joint_at(clip, limb.upper()).parent;
            const JointPose parent_w = parent < 0 ? JointPose() : pose_w[static_cast<std::size_t>(parent)];
            limbs_.push_back(limb_in(limb, chain_pose(clip, frame, limb.chain), parent_w));
            if (parent >= 0)
                limbs_.back().local_parent =
                    clip.rotation[frame * clip.joints.size() + static_cast<std::size_t>(parent)];
            sources_[n].push_back(
                source_of(limbs_.back(), pose_w[static_cast<std::size_t>(limb.upper())].position, root));
            goal_source& source = sources_[n].back();
            if (plan.limbs[n].has(SWIVEL_WITH_GROUND)) source.contact = plan.contacts[n][frame] ? 1.0f : 0.0f;
            if (plan.carry && limb.name.kind == formats::LimbKind::arm) {
                source.carries = 1;
                put(carrying_wrist(*plan.carry, limb.name, pose_w) - Vector3d(source.origin), source.carried);
            }
        }
        if (plan.look) sources_.back().push_back(look_source(clip, plan.look->joints, pose_w, root));
    }
    std::vector<ClipPart> parts = plan.clips;
    if (parts.empty()) parts = {{0, clip.frame_count}};
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        settle_lengths(sources_[n], limbs[n].bound.lengths);
        if (plan.limbs[n].has(SWIVEL_WITH_GROUND))
            for (const ClipPart& part : parts) put_strides(plan.contacts[n], part, clip.frame_time, sources_[n]);
    }
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
#include "tools/feet/turn_legs.h"

#include <fmt/format.h>

#include "swivel/swivel.hpp"
#include "tools/formats/error.h"
#include "tools/rig/limb_words.h"

namespace swivel::tools {

namespace {

using Eigen::Quaternionf;
using Eigen::Vector3d;
using Eigen::Vector3f;
using formats::Clip;
using formats::joint_at;

// x, y, z, w
std::array<float, 4> floats(const Eigen::Quaterniond& q)
{
    const Quaternionf single = q.cast<float>();
    return {single.x(), single.y(), single.z(), single.w()};
}
std::array<float, 3> floats(const Vector3d& v)
{
    const Vector3f single = v.cast<float>();
    return {single.x(), single.y(), single.z()};
}

// A clip's skeleton at rest, as the library takes it.
struct Skeleton {
    std::vector<std::int32_t> parents;
    std::vector<std::array<float, 4>> rotations;
    std::vector<std::array<float, 3>> translations;
    std::vector<swivel_limb_joints> limbs;

    Skeleton(const Clip& clip, std::span<const Limb> legs)
    {
        for (const formats::Joint& joint : clip.joints) {
            parents.push_back(joint.parent);
            rotations.push_back(floats(joint.rest_rotation));
            translations.push_back(floats(joint.offset));
        }
        for (const Limb& leg : legs) {
            const auto number = [&](std::size_t n) { return static_cast<std::uint32_t>(leg.joints[n]); };
            limbs.push_back(swivel_default_limb_joints(number(0), number(1), number(2)));
            std::ranges::copy(floats(leg.bend), limbs.back().bend);
        }
    }
    Crowd crowd(std::size_t body_count) const
    {
        swivel_skeleton skeleton = swivel_default_skeleton();
        skeleton.parents = stream(parents);
        skeleton.rotations = {rotations.data(), sizeof rotations[0]};
        skeleton.translations = {translations.data(), sizeof translations[0]};
        skeleton.joint_count = static_cast<std::uint32_t>(parents.size());
        std::vector<swivel_group_def> groups;
        for (const swivel_limb_joints& limb : limbs)
            groups.push_back(body_group(limb, SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND));
        return Crowd(skeleton, static_cast<std::uint32_t>(body_count), groups);
    }
};

// All frames of a clip, each a pose from its own origin: where this root is. So floats are fine wherever the clip goes.
struct Poses {
    std::size_t joint_count;
    std::vector<std::array<float, 4>> rotations;  // [frame * joints + joint]
    std::vector<std::array<float, 3>> translations, scales;
    std::vector<Vector3d> origins_w;

    Poses(const Clip& clip, int root) : joint_count(clip.joints.size())
    {
        const auto top = static_cast<std::size_t>(root);
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
            origins_w.push_back(formats::local_translation(clip, frame, top));
            for (std::size_t joint = 0; joint < joint_count; ++joint) {
                const formats::Joint& at = clip.joints[joint];
                const Vector3d place = formats::local_translation(clip, frame, joint);
                rotations.push_back(floats(clip.rotation[frame * joint_count + joint]));
                translations.push_back(floats(at.parent < 0 ? Vector3d(place - origins_w.back()) : place));
                scales.push_back(floats(
                    at.scale_track < 0
                        ? at.rest_scale
                        : clip.scale[frame * clip.scale_track_count + static_cast<std::size_t>(at.scale_track)]));
            }
        }
    }
    swivel_pose view()
    {
        swivel_pose pose = swivel_default_pose();
        pose.rotations = view(rotations);
        pose.translations = view(translations);
        pose.scales = view(scales);
        return pose;
    }

private:
    template <class Value>
    swivel_joint_values view(std::vector<Value>& values) const
    {
        return {values.data(), joint_count * sizeof(Value), sizeof(Value), nullptr};
    }
};

int root_of(const Clip& clip, int joint)
{
    while (joint_at(clip, joint).parent >= 0) joint = joint_at(clip, joint).parent;
    return joint;
}

// The carrier's place against its parent, moved by the body's shift.
TurnedJoint moved_carrier(const Clip& clip, int carrier, const PlacedFeet& placed)
{
    TurnedJoint moved{carrier, {}, {}};
    const int parent = joint_at(clip, carrier).parent;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        Vector3d place = formats::local_translation(clip, frame, static_cast<std::size_t>(carrier));
        if (parent < 0) {
            place += placed.shift_w[frame];
        } else {
            const formats::JointPose above = formats::world_pose(clip, frame)[static_cast<std::size_t>(parent)];
            place = to_inner(above, to_outer(above, place) + placed.shift_w[frame]);
        }
        moved.translation.push_back(place);
    }
    return moved;
}

}  // namespace

Clip with_joints(Clip clip, std::span<const TurnedJoint> joints)
{
    const std::size_t joint_count = clip.joints.size();
    for (const TurnedJoint& turned : joints) {
        formats::Joint& joint = clip.joints[static_cast<std::size_t>(turned.joint)];
        for (std::size_t frame = 0; frame < turned.rotation.size(); ++frame)
            clip.rotation[frame * joint_count + static_cast<std::size_t>(turned.joint)] = turned.rotation[frame];
        if (turned.translation.empty()) continue;
        if (joint.track < 0) {  // a column more
            std::vector<Vector3d> wider;
            for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
                const auto row = clip.translation.begin() + static_cast<std::ptrdiff_t>(frame * clip.track_count);
                wider.insert(wider.end(), row, row + static_cast<std::ptrdiff_t>(clip.track_count));
                wider.push_back(joint.offset);
            }
            clip.translation = std::move(wider);
            joint.track = static_cast<int>(clip.track_count++);
        }
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
            clip.translation[frame * clip.track_count + static_cast<std::size_t>(joint.track)] =
                turned.translation[frame];
    }
    return clip;
}

std::vector<TurnedJoint> turn_legs(const Clip& clip, std::span<const Limb> legs, const LegMotion& motion,
                                   const PlacedFeet& placed, const std::filesystem::path& file)
{
    std::vector<TurnedJoint> joints{moved_carrier(clip, motion.carrier, placed)};
    const Clip moved = with_joints(clip, joints);
    Poses poses(moved, root_of(clip, legs.front().upper()));
    Crowd crowd = Skeleton(clip, legs).crowd(clip.frame_count);
    std::vector<std::vector<std::array<float, 3>>> targets(legs.size());
    std::vector<std::vector<std::array<float, 4>>> feet(legs.size());
    std::vector<formats::JointPose> pose_w(clip.joints.size());
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        formats::world_pose(moved, frame, pose_w);
        for (std::size_t n = 0; n < legs.size(); ++n) {
            const PlacedLeg& leg = placed.legs[n];
            targets[n].push_back(floats(Vector3d(leg.ankle_w[frame] - poses.origins_w[frame])));
            feet[n].push_back(floats(leg.turn_w[frame] * pose_w[static_cast<std::size_t>(legs[n].end())].rotation));
        }
    }
    for (std::uint32_t n = 0; n < legs.size(); ++n) {
        crowd.write(SWIVEL_TARGET, n, targets[n]);
        crowd.write(SWIVEL_HAND, n, feet[n]);
    }
    const swivel_pose pose = poses.view();
    crowd.solve({.pose = &pose});
    if (const auto bad = crowd.find(SWIVEL_BAD_INPUT))
        throw formats::InputError(
            file, fmt::format("{}, frame {}: it lies below a mirror or a scale that is not uniform, or too far out; "
                              "apply scales where the rig was made",
                              plain_name(legs[bad->group].name), bad->limb));
    for (const Limb& leg : legs)
        for (const int joint : leg.joints) {
            TurnedJoint turned{joint, {}, {}};
            for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
                turned.rotation.push_back(
                    quaternion(poses.rotations[frame * poses.joint_count + static_cast<std::size_t>(joint)]));
            joints.push_back(std::move(turned));
        }
    return joints;
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
#include "tools/feet/turn_legs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "swivel/swivel_bodies.hpp"
#include "tools/formats/error.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;
using formats::joint_at;

// x, y, z, w
std::array<float, 4> floats(const Eigen::Quaterniond& q)
{
    std::array<float, 4> numbers;
    put(q.coeffs(), numbers);
    return numbers;
}
std::array<float, 3> floats(const Vector3d& v)
{
    std::array<float, 3> numbers;
    put(v, numbers);
    return numbers;
}

// A crowd of the clip's skeleton, with a body for each frame.
Crowd crowd_of(const Clip& clip, std::span<const Limb> legs)
{
    std::vector<std::int32_t> parents;
    std::vector<std::array<float, 4>> rotations;
    std::vector<std::array<float, 3>> translations;
    for (const formats::Joint& joint : clip.joints) {
        parents.push_back(joint.parent);
        rotations.push_back(floats(joint.rest_rotation));
        translations.push_back(floats(joint.offset));
    }
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = stream(parents);
    skeleton.rotations = {rotations.data(), sizeof rotations[0]};
    skeleton.translations = {translations.data(), sizeof translations[0]};
    skeleton.joint_count = static_cast<std::uint32_t>(parents.size());
    std::vector<swivel_limb_joints> joints(legs.size());
    std::vector<Definition> groups;
    for (std::size_t leg = 0; leg < legs.size(); ++leg) {
        const auto number = [&](std::size_t n) { return static_cast<std::uint32_t>(legs[leg].joints[n]); };
        joints[leg] = swivel_default_limb_joints(number(0), number(1), number(2));
        std::ranges::copy(floats(legs[leg].bend), joints[leg].bend);
        groups.emplace_back(body_limb(joints[leg], SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND));
    }
    return Crowd(skeleton, static_cast<std::uint32_t>(clip.frame_count), groups);
}

// All frames of a clip as poses, each relative to its own root's place, so that floats suffice wherever the clip goes.
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
                const Vector3d place = formats::local_translation(clip, frame, joint);
                rotations.push_back(floats(clip.rotation[frame * joint_count + joint]));
                translations.push_back(
                    floats(clip.joints[joint].parent < 0 ? Vector3d(place - origins_w.back()) : place));
                scales.push_back(floats(formats::local_scale(clip, frame, joint)));
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

constexpr double kBendSpeed = 2 * std::numbers::pi;  // radians a second

// How far toes bend up about their axis so that their tip is at least `rise` over the toe, radians. From toes that
// point ahead: 90 degrees at most, and less where they point back, which feet do that kneel or lie.
double bend_to(const Vector3d& way_w, const Vector3d& across_w, const Vector3d& up_w, double rise)
{
    // In the plane that the toes bend in.
    const Vector3d up = up_w - up_w.dot(across_w) * across_w, way = way_w - way_w.dot(across_w) * across_w;
    const double reach = up.norm() * way.norm();
    if (reach == 0 || across_w.isZero()) return 0;  // it lies on its side, or points straight down at rest
    const double angle = std::atan2(way.dot(up), way.dot(up.cross(across_w)));
    const double beside = way_w.dot(across_w) * up_w.dot(across_w);
    const double min_angle = std::asin(std::clamp((rise - beside) / reach, -1.0, 1.0));
    return std::max(0.0, std::min({min_angle - angle, std::numbers::pi / 2, angle + std::numbers::pi}));
}

// How far the toes of one leg bend up in each frame, radians.
std::vector<double> bends_of(const LegPath& leg, const std::vector<Quaterniond>& turn_w, const LegMotion& motion,
                             const Floor& floor)
{
    std::vector<double> bends;
    for (std::size_t frame = 0; frame < motion.frame_count(); ++frame)
        bends.push_back(bend_to(leg.tip_w[frame] - leg.toe_w[frame], leg.across_w[frame], turn_w[frame] * motion.up_w,
                                leg.tip_rise - std::max(floor.over(leg.toe_w[frame]), 0.0)));
    // Those that come and go in a frame begin earlier and end later.
    return course_above(std::move(bends), kBendSpeed * motion.frame_time);
}

// A joint's local rotation after a turn of the world.
Quaterniond turned(const Clip& clip, std::size_t frame, int joint, const Quaterniond& turn_w)
{
    const int parent = joint_at(clip, joint).parent;
    const formats::JointPose parent_w =
        parent < 0 ? formats::JointPose() : formats::world_pose(clip, frame)[static_cast<std::size_t>(parent)];
    const Quaterniond inner = parent_w.rotation.conjugate() * turn_w * parent_w.rotation;
    return (parent_w.mirrored ? formats::mirrored(inner) : inner) *
           clip.rotation[frame * clip.joints.size() + static_cast<std::size_t>(joint)];
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
    Crowd crowd = crowd_of(clip, legs);
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
    std::vector<std::uint32_t> flags(clip.frame_count);
    for (std::uint32_t n = 0; n < legs.size(); ++n) {
        crowd.read(SWIVEL_FLAGS, n, flags);
        const auto bad = std::ranges::find_if(flags, [](std::uint32_t each) { return each & SWIVEL_BAD_INPUT; });
        if (bad != flags.end())
            throw formats::InputError(
                file, fmt::format("{}, frame {}: it lies below a mirror or a scale that is not uniform, or too far "
                                  "out; apply scales where the rig was made",
                                  plain_name(legs[n].name), bad - flags.begin()));
    }
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

std::vector<TurnedJoint> bend_toes(const Clip& clip, const LegMotion& motion, const PlacedFeet& placed,
                                   const Floor& floor)
{
    std::vector<TurnedJoint> bent;
    for (std::size_t n = 0; n < motion.legs.size(); ++n) {
        const LegPath& leg = motion.legs[n];
        if (!leg.has_toe) continue;
        const std::vector<double> bends = bends_of(leg, placed.legs[n].turn_w, motion, floor);
        if (std::ranges::max(bends) == 0) continue;
        TurnedJoint toes{leg.toe, {}, {}};
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
            toes.rotation.push_back(
                turned(clip, frame, leg.toe, Quaterniond(Eigen::AngleAxisd(bends[frame], leg.across_w[frame]))));
        bent.push_back(std::move(toes));
    }
    return bent;
}

}  // namespace swivel::tools

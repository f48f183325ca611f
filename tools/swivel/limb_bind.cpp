// SPDX-License-Identifier: MIT
#include "tools/swivel/limb_bind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/formats/text.h"
#include "tools/swivel/limb_words.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;
using formats::Joint;
using formats::JointPose;

// What is wrong with a joint's scale, and what to do; empty if nothing is.
std::string scale_fault(const Joint& joint, const JointPose& pose, const std::string& when)
{
    const std::string name = printable_name(joint);
    const char* why = "so its bones change shape as they turn; apply the scale where the rig was made";
    if (joint.is_sheared) return fmt::format("the matrix of '{}' is sheared, {}", name, why);
    if (!pose.is_uniform) return fmt::format("'{}' is scaled unevenly{}, {}", name, when, why);
    if (!(pose.scale > 0))
        return fmt::format("'{}' is scaled to nothing{}; {}", name, when.empty() ? " at rest" : when,
                           when.empty() ? "give it a scale where the rig was made"
                                        : "choose an animation that does not hide the figure");
    return {};
}

// How a frame's mirror differs from the rest pose's; empty if it does not.
std::string mirror_fault(const Joint& joint, const JointPose& rest, const JointPose& pose, std::size_t frame)
{
    if (pose.mirrored == rest.mirrored) return {};
    return pose.mirrored ? fmt::format("'{}' is mirrored in frame {} and not at rest", printable_name(joint), frame)
                         : fmt::format("'{}' is mirrored at rest and not in frame {}", printable_name(joint), frame);
}

// Every joint that the limb's size hangs on: all above the end joint.
void check_scales(const Clip& clip, const LimbChain& chain)
{
    for (int joint = joint_at(clip, chain.end()).parent; joint >= 0; joint = joint_at(clip, joint).parent) {
        const Joint& at = joint_at(clip, joint);
        const JointPose rest = formats::local_rest_pose(at);
        std::string fault = scale_fault(at, rest, ""), turned_over;
        for (std::size_t frame = 0; frame < clip.frame_count && fault.empty() && at.scale_track >= 0; ++frame) {
            const JointPose pose = formats::local_pose(clip, frame, static_cast<std::size_t>(joint));
            fault = scale_fault(at, pose, fmt::format(" in frame {}", frame));
            if (turned_over.empty()) turned_over = mirror_fault(at, rest, pose, frame);
        }
        if (!fault.empty()) throw CannotBind(fault);
        if (!turned_over.empty())
            throw CannotBind(fmt::format(
                "{}, and a limb is solved on one side of a mirror; choose an animation that keeps the rest pose's",
                turned_over));
    }
}

void check_lengths(const Clip& clip, const LimbJoints& joints, const ChainPose& rest)
{
    const double upper = rest.upper_bone().norm(), lower = rest.lower_bone().norm();
    for (std::size_t n = 0; n < 2; ++n)
        if (!((n == 0 ? upper : lower) > 1e-6 * (upper + lower)))
            throw CannotBind(fmt::format("the bone from '{}' to '{}' has no length; name other joints",
                                         printable_name(joint_at(clip, joints[n])),
                                         printable_name(joint_at(clip, joints[n + 1]))));
}

template <int size>
void store(const Eigen::Matrix<double, size, 1>& v, float (&to)[size])
{
    for (int n = 0; n < size; ++n) to[n] = static_cast<float>(v[n]);
}

swivel_chain chain_at(const ChainPose& rest, const Vector3d& hinge)
{
    swivel_chain chain{};
    store<4>(rest.turn[0].coeffs(), chain.shoulder_rotation);
    store<4>((rest.turn[0].conjugate() * rest.turn[1]).coeffs(), chain.elbow_rotation);
    store<4>((rest.turn[1].conjugate() * rest.turn[2]).coeffs(), chain.wrist_rotation);
    store<3>(rest.upper_bone(), chain.elbow_offset);
    store<3>(rest.lower_bone(), chain.wrist_offset);
    store<3>(hinge, chain.hinge);
    return chain;
}

BoundLimb bind_rest(const ChainPose& rest, const Vector3d& hinge)
{
    try {
        return bind(chain_at(rest, hinge));
    } catch (const Error& error) {
        throw CannotBind(error.what());
    }
}

// The arm frame's axes in the world, by those of the upper joint's parent.
Eigen::Matrix3d axes_of(const swivel_binding& binding, const JointPose& parent_w)
{
    Eigen::Matrix3d axes_w = quaternion(binding.parent_from_arm).toRotationMatrix();
    for (int n = 0; n < 3; ++n) {
        const Vector3d axis = axes_w.col(n);
        axes_w.col(n) = parent_w.rotation * (parent_w.mirrored ? formats::mirrored(axis) : axis);
    }
    return axes_w;
}

void take_given_hinge(std::span<const GivenHinge> hinges, Limb& limb)
{
    for (const GivenHinge& given : hinges) {
        if (given.limb != limb.name) continue;
        const Vector3d& upper = limb.upper_bone;
        if (given.axis.cross(upper).norm() < 0.1)  // about 6 degrees: no one means that
            throw CannotBind(fmt::format(
                "its hinge, {}, is along its upper bone ({:.3f} {:.3f} {:.3f}), which does not bend that way",
                given.where, upper.x(), upper.y(), upper.z()));
        limb.hinge = given.axis;
        limb.hinge_source = given.where;
    }
}

std::vector<int> side_twists(const Clip& clip, const LimbChain& chain)
{
    std::vector<int> found;
    for (const int joint : chain.joints)
        for (const int child : formats::child_joints(clip, joint))
            if (joint != chain.end() && is_twist_name(joint_at(clip, child).name) &&
                std::find(chain.joints.begin(), chain.joints.end(), child) == chain.joints.end())
                found.push_back(child);
    return found;
}

// What require_twists_between() asks of one bone, from chain.joints[first] to chain.joints[last].
void require_twists_on(const Clip& clip, const LimbChain& chain, std::size_t first, std::size_t last,
                       Vector3d (ChainPose::*bone)() const)
{
    const std::vector<JointPose> rest_w = formats::rest_pose(clip);
    const auto place = [&](std::size_t n) { return rest_w[static_cast<std::size_t>(chain.joints[n])].position; };
    const auto name = [&](std::size_t n) { return printable_name(joint_at(clip, chain.joints[n])); };
    const Vector3d along = place(last) - place(first);
    std::size_t part = 0;  // the first joint that has to prove itself
    for (std::size_t n = last - 1; n > first; --n) {
        const Vector3d step = place(n) - place(first);
        const double near = 1e-3 * along.norm();  // a joint at an end's place turns as that end does
        if (is_twist_name(joint_at(clip, chain.joints[n]).name) || step.norm() < near || (along - step).norm() < near)
            continue;
        part = n;
        const double on_line = std::clamp(step.dot(along) / along.squaredNorm(), 0.0, 1.0);
        if (const double off = (step - on_line * along).norm() / along.norm(); off > 0.1)
            throw CannotBind(
                fmt::format("'{}' is off the line from '{}' to '{}' by {:.0f} % of its length, so is no part "
                            "of that bone; name the joints",
                            name(n), name(first), name(last), 100 * off));
    }
    if (part == 0) return;
    const Vector3d rest = (rest_pose(clip, chain).*bone)();
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const Vector3d now = (chain_pose(clip, frame, chain).*bone)();
        const double degrees = std::atan2(rest.cross(now).norm(), rest.dot(now)) * 180 / std::numbers::pi;
        if (degrees > 15)
            throw CannotBind(
                fmt::format("what lies between '{}' and '{}' ('{}') turns that bone by {:.0f} degrees in "
                            "frame {}, so is no part of it; name the joints",
                            name(first), name(last), name(part), degrees, frame));
    }
}

}  // namespace

swivel_chain rest_chain(const Clip& clip, const LimbChain& chain, const Vector3d& hinge)
{
    return chain_at(rest_pose(clip, chain), hinge);
}

Limb bind_limb(const Clip& clip, formats::LimbName name, const LimbJoints& joints, const Front& front,
               std::span<const GivenHinge> hinges)
{
    Limb limb;
    limb.name = name;
    limb.joints = joints;
    limb.chain = chain_of(clip, joints);
    check_scales(clip, limb.chain);
    const ChainPose rest = rest_pose(clip, limb.chain);
    check_lengths(clip, joints, rest);
    const int parent = joint_at(clip, limb.upper()).parent;
    const JointPose parent_w = parent < 0 ? JointPose() : formats::rest_pose(clip)[static_cast<std::size_t>(parent)];
    limb.scale = parent_w.scale;
    limb.mirrored = parent_w.mirrored;
    limb.upper_bone = rest.upper_bone().normalized();
    limb.lower_bone = rest.lower_bone().normalized();
    const Hinge hinge = choose_hinge(clip, name.kind, limb.chain, rest, parent_w, front);
    limb.hinge = hinge.axis;
    limb.hinge_source = hinge.source;
    take_given_hinge(hinges, limb);
    limb.bound = bind_rest(rest, limb.hinge);
    for (float& length : limb.bound.lengths) length = static_cast<float>(limb.scale * static_cast<double>(length));
    limb.axes_w = axes_of(limb.bound.binding, parent_w);
    limb.side_twists = side_twists(clip, limb.chain);
    return limb;
}

void require_twists_between(const Clip& clip, const Limb& limb)
{
    require_twists_on(clip, limb.chain, 0, limb.chain.lower, &ChainPose::upper_bone);
    require_twists_on(clip, limb.chain, limb.chain.lower, limb.chain.joints.size() - 1, &ChainPose::lower_bone);
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
#include "tools/rig/limb_bind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tools/rig/joint_names.h"
#include "tools/rig/limb_hinge.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;
using formats::Joint;
using formats::JointPose;

// What is wrong with a joint's scale.
std::optional<CannotBind> scale_fault(const Joint& joint, const JointPose& pose, const std::string& when)
{
    const std::string name = printable_name(joint);
    const auto changes_shape = [](const std::string& what) {
        return CannotBind(what + ", so its bones change shape as they turn", "apply the scale where the rig was made");
    };
    if (joint.is_sheared) return changes_shape(fmt::format("the matrix of '{}' is sheared", name));
    if (!pose.is_uniform) return changes_shape(fmt::format("'{}' is scaled unevenly{}", name, when));
    if (pose.scale > 0) return std::nullopt;
    if (when.empty())
        return CannotBind(fmt::format("'{}' is scaled to nothing at rest", name),
                          "give it a scale where the rig was made");
    return CannotBind(fmt::format("'{}' is scaled to nothing{}", name, when),
                      "use a clip that does not hide the figure");
}

// How a frame's mirror differs from the rest pose's.
std::optional<CannotBind> mirror_fault(const Joint& joint, const JointPose& rest, const JointPose& pose,
                                       std::size_t frame)
{
    if (pose.mirrored == rest.mirrored) return std::nullopt;
    const std::string name = printable_name(joint);
    return CannotBind((pose.mirrored ? fmt::format("'{}' is mirrored in frame {} and not at rest", name, frame)
                                     : fmt::format("'{}' is mirrored at rest and not in frame {}", name, frame)) +
                          ", and a limb is solved on one side of a mirror",
                      "use a clip that keeps the rest pose's");
}

// Every joint that the limb's size hangs on: all above the end joint.
void check_scales(const Clip& clip, const LimbChain& chain)
{
    for (int joint = joint_at(clip, chain.end()).parent; joint >= 0; joint = joint_at(clip, joint).parent) {
        const Joint& at = joint_at(clip, joint);
        const JointPose rest = formats::local_rest_pose(at);
        std::optional<CannotBind> fault = scale_fault(at, rest, ""), turned_over;
        for (std::size_t frame = 0; frame < clip.frame_count && !fault && at.scale_track >= 0; ++frame) {
            const JointPose pose = formats::local_pose(clip, frame, static_cast<std::size_t>(joint));
            fault = scale_fault(at, pose, fmt::format(" in frame {}", frame));
            if (!turned_over) turned_over = mirror_fault(at, rest, pose, frame);
        }
        if (fault) throw *fault;
        if (turned_over) throw *turned_over;
    }
}

void check_lengths(const Clip& clip, const LimbJoints& joints, const ChainPose& rest)
{
    const double upper = rest.upper_bone().norm(), lower = rest.lower_bone().norm();
    for (std::size_t n = 0; n < 2; ++n)
        if (!((n == 0 ? upper : lower) > 1e-6 * (upper + lower)))
            throw CannotBind(
                fmt::format("the bone from '{}' to '{}' has no length", printable_name(joint_at(clip, joints[n])),
                            printable_name(joint_at(clip, joints[n + 1]))),
                "name other joints");
}

template <int size>
void store(const Eigen::Matrix<double, size, 1>& v, float (&to)[size])
{
    for (int n = 0; n < size; ++n) to[n] = static_cast<float>(v[n]);
}

swivel_chain chain_at(const ChainPose& rest, const Vector3d& bend)
{
    swivel_chain chain = swivel_default_chain();
    store<4>(rest.turn[0].coeffs(), chain.shoulder_rotation);
    store<4>((rest.turn[0].conjugate() * rest.turn[1]).coeffs(), chain.elbow_rotation);
    store<4>((rest.turn[1].conjugate() * rest.turn[2]).coeffs(), chain.wrist_rotation);
    store<3>(rest.upper_bone(), chain.elbow_offset);
    store<3>(rest.lower_bone(), chain.wrist_offset);
    store<3>(bend, chain.bend);
    return chain;
}

swivel_binding bind_rest(const ChainPose& rest, const Vector3d& bend)
{
    try {
        return bind(chain_at(rest, bend));
    } catch (const Error& error) {
        throw CannotBind(error.what(), "");
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

// Where the user gave a bend, for people.
std::string place_of(const GivenBend& given) { return fmt::format("{} of {}", given.key, given.file); }

// The bend that the user gave the limb.
const GivenBend* given_bend(std::span<const GivenBend> bends, const Limb& limb)
{
    const auto is_its = [&](const GivenBend& each) { return each.limb == limb.name; };
    const auto given = std::find_if(bends.begin(), bends.end(), is_its);
    if (given == bends.end()) return nullptr;
    const Vector3d& upper = limb.upper_bone;
    if (given->direction.cross(upper).norm() < 0.1)  // about 6 degrees: no one means that
        throw CannotBind(
            fmt::format("its bend, {}, is along its upper bone ({:.3f} {:.3f} {:.3f}), which does not bend that way",
                        place_of(*given), upper.x(), upper.y(), upper.z()),
            "give a direction across it");
    if (given->key.ends_with(".hinge"))
        throw CannotBind(
            fmt::format("{} is an axis, and a crowd file now says where the limb bends to", place_of(*given)),
            fmt::format("write bend = {} instead", toml_row(bend_of_hinge(upper, given->direction))));
    return &*given;
}

std::vector<int> side_twists(const Clip& clip, const LimbChain& chain)
{
    std::vector<int> found;
    for (const int joint : chain.joints)
        for (const int child : formats::child_joints(clip, joint))
            if (joint != chain.end() &&
                (is_twist_name(joint_at(clip, child).name) || is_roll_name(joint_at(clip, child).name)) &&
                std::find(chain.joints.begin(), chain.joints.end(), child) == chain.joints.end())
                found.push_back(child);
    return found;
}

// The bone from chain.joints[first] to chain.joints[last], and what lies between, by places in the chain.
struct ChainBone {
    const Clip& clip;
    const LimbChain& chain;
    std::size_t first, last;

    const std::string& name(std::size_t n) const { return joint_at(clip, chain.joints[n]).name; }
    std::string shown(std::size_t n) const { return printable_name(joint_at(clip, chain.joints[n])); }
    Vector3d at_rest() const { return rest_bone(clip, chain, first, last); }

    // By how many degrees these joints' own motion turns the bone, in the frame where it turns it most.
    struct Swing {
        double degrees = 0;
        std::size_t frame = 0;
    };
    Swing swing_of(const std::vector<std::size_t>& moving) const
    {
        const Vector3d rest = at_rest();
        Swing most;
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
            const double degrees = degrees_between(rest, bone_moved_by(clip, frame, moving, chain, first, last));
            if (degrees > most.degrees) most = {degrees, frame};
        }
        return most;
    }
};

constexpr double kSwing = 15;  // degrees: what a joint that only twists its bone stays below, one that aims it exceeds

// A joint between two of a limb's, as to the bone between these, for a length of 1.
struct Part {
    std::size_t place;  // in the chain
    double at, off;     // where along the bone it is, and how far from it
};
std::vector<Part> parts_of(const ChainBone& bone)
{
    const Vector3d along = bone.at_rest();
    std::vector<Part> parts;
    for (std::size_t place = bone.first + 1; place < bone.last; ++place) {
        const Vector3d step = rest_bone(bone.clip, bone.chain, bone.first, place) / along.norm();
        const double near = 1e-3;  // a joint at an end's place turns as that end does
        if (step.norm() < near || (along.normalized() - step).norm() < near) continue;
        const double at = step.dot(along.normalized());
        parts.push_back({place, at, (step - std::clamp(at, 0.0, 1.0) * along.normalized()).norm()});
    }
    return parts;
}

[[noreturn]] void refuse(const ChainBone& bone, const std::vector<std::size_t>& blamed, const std::string& why,
                         const char* advice)
{
    std::vector<std::string> names;
    for (const std::size_t place : blamed) names.push_back(bone.shown(place));
    throw CannotBind(fmt::format("'{}' on the bone from '{}' to '{}' {}", fmt::join(names, "', '"),
                                 bone.shown(bone.first), bone.shown(bone.last), why),
                     advice);
}

void require_still(const ChainBone& bone, std::size_t place)
{
    const auto own = ChainBone{bone.clip, bone.chain, place, bone.last}.swing_of({place});
    if (own.degrees > kSwing)
        refuse(bone, {place},
               fmt::format("swings what hangs on it by {:.0f} degrees in frame {}", own.degrees, own.frame),
               "name the joints");
}

// What require_parts_between() asks of one bone.
void require_parts_on(const ChainBone& bone)
{
    std::vector<std::size_t> sharing;  // those that are no twist bones by name
    std::vector<Part> dividing;  // those that may be the joint which the bone turns in, unless they divide it evenly
    for (const Part& part : parts_of(bone)) {
        const std::string& name = bone.name(part.place);
        const bool is_twist = is_twist_name(name), is_roll = is_roll_name(name);
        if (!is_twist && part.off > 0.1)
            refuse(bone, {part.place}, fmt::format("is off its line by {:.0f} % of its length", 100 * part.off),
                   "name the joints");
        if (!is_twist) sharing.push_back(part.place);
        if (!is_twist && (is_roll || is_copy_name(name))) dividing.push_back(part);
        if (is_twist || is_roll) require_still(bone, part.place);
    }
    for (std::size_t n = 0; n < dividing.size(); ++n) {
        const double even = static_cast<double>(n + 1) / static_cast<double>(dividing.size() + 1);
        if (std::abs(dividing[n].at - even) < 0.05) continue;  // tools that split bones split them evenly
        const std::size_t place = dividing[n].place;
        require_still(bone, place);
        if (bone.clip.frame_count < 2 || bone.swing_of({bone.first}).degrees <= kSwing)  // one pose is no motion
            refuse(bone, {place}, "may be the joint that it turns in, and the clip does not show that it is none",
                   "use a clip that swings it, or name the joints");
    }
    if (sharing.empty()) return;
    if (const auto all = bone.swing_of(sharing); all.degrees > kSwing)
        refuse(bone, sharing,
               fmt::format("{} it by {:.0f} degrees in frame {}", sharing.size() > 1 ? "turn" : "turns", all.degrees,
                           all.frame),
               "name the joints");
}

}  // namespace

swivel_chain rest_chain(const Clip& clip, const LimbChain& chain, const Vector3d& bend)
{
    return chain_at(rest_pose(clip, chain), bend);
}

Limb bind_limb(const Clip& clip, formats::LimbName name, const LimbJoints& joints, const Front& front,
               std::span<const GivenBend> bends)
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
    if (const GivenBend* const given = given_bend(bends, limb)) {
        limb.bend = given->direction;
        limb.bend_source = place_of(*given);
    } else {
        const Hinge hinge = choose_hinge(clip, name, limb.chain, rest, parent_w, front);
        limb.bend = bend_of_hinge(limb.upper_bone, hinge.axis);
        limb.bend_source = hinge.source;
    }
    limb.bound = bind_rest(rest, limb.bend);
    for (float& length : limb.bound.lengths) length = static_cast<float>(limb.scale * static_cast<double>(length));
    limb.axes_w = axes_of(limb.bound, parent_w);
    limb.side_twists = side_twists(clip, limb.chain);
    return limb;
}

void require_parts_between(const Clip& clip, const Limb& limb)
{
    const LimbChain& chain = limb.chain;
    require_parts_on({clip, chain, 0, chain.lower});
    require_parts_on({clip, chain, chain.lower, chain.joints.size() - 1});
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
#include "tools/rig/limb_bind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/formats/clip.h"
#include "tools/formats/printable.h"
#include "tools/rig/limb_chain.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

struct Bend {
    Eigen::Vector3d direction;  // where flexion carries the lower bone: in the upper joint's axes, unit
    std::string source;         // who says so, for people
};

using Eigen::Vector3d;
using formats::Clip;
using formats::JointPose;
using formats::LimbKind;
using formats::LimbName;

// The sine of 10 degrees: above what modelling and noise leave of straight limbs.
constexpr double kSine10 = 0.17364817766693033;
// A rest pose that bends a limb clearly: twice that. Among 1,072 limbs of files in use one rested bent by 10.5 degrees,
// and its clip bent it by 90 in the mean, 77 degrees away from there.
constexpr double kSine20 = 0.3420201433256687;
// A clip that bends a limb clearly: three times that in the mean, and one way in so many tenths of its frames. One
// tenth is left for frames that pass through straight.
constexpr double kSine30 = 0.5;
constexpr std::ptrdiff_t kTenthsOneWay = 9;
constexpr double kCosine30 = 0.8660254037844386;

// The axis that two bones are bent about, as long as the sine of the bend: the cross product of the unit bones, lower
// by upper. It is in the upper joint's axes, with the upper bone turned to where it is at rest.
Vector3d axis_of(const ChainPose& pose, const Vector3d& rest_upper)
{
    const Vector3d upper = pose.upper_bone().normalized();
    const Vector3d lower = (pose.turn[0].conjugate() * (pose.turn[1] * pose.lower_bone())).normalized();
    return aim(rest_upper, upper).conjugate() * lower.cross(upper);
}

// The axis of each frame; zero where a bone has no length.
std::vector<Vector3d> frame_axes(const Clip& clip, const LimbChain& chain, const Vector3d& rest_upper)
{
    std::vector<Vector3d> axes;
    axes.reserve(clip.frame_count);
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const Vector3d axis = axis_of(chain_pose(clip, frame, chain), rest_upper);
        axes.push_back(axis.allFinite() ? axis : Vector3d(Vector3d::Zero()));
    }
    return axes;
}

// Zero without frames.
Vector3d mean_of(std::span<const Vector3d> axes)
{
    const Vector3d sum = std::accumulate(axes.begin(), axes.end(), Vector3d(Vector3d::Zero()));
    return sum / static_cast<double>(std::max<std::size_t>(axes.size(), 1));
}

// A bend by the rest pose or by the clip.
struct Said {
    Vector3d axis;     // as long as the sine of the bend
    bool is_clear;     // beyond doubt
    std::string text;  // for people

    bool tells() const { return axis.norm() > kSine10; }
};

Said rest_says(const ChainPose& rest, const Vector3d& upper)
{
    const Vector3d axis = axis_of(rest, upper);
    const double degrees = degrees_between(rest.turn[0] * rest.upper_bone(), rest.turn[1] * rest.lower_bone());
    return {axis, axis.norm() > kSine20, fmt::format("the rest pose, bent by {:.1f} degrees", degrees)};
}

Said clip_says(std::span<const Vector3d> axes)
{
    const Vector3d mean = mean_of(axes);
    const auto one_way = std::ranges::count_if(axes, [&](const Vector3d& axis) { return axis.dot(mean) > 0; });
    const bool is_steady = 10 * one_way >= kTenthsOneWay * std::ssize(axes);
    return {mean, mean.norm() > kSine30 && is_steady,
            fmt::format("the clip, bent by {:.1f} degrees in the mean",
                        std::asin(std::min(mean.norm(), 1.0)) * (180 / std::numbers::pi))};
}

// Where flexion carries a lower bone that turns about the opposite of this axis: across the bone, unit.
Vector3d bend_of_hinge(const Vector3d& upper_bone, const Vector3d& axis) { return upper_bone.cross(axis).normalized(); }

// Tries the rest pose, then the clip. The first that bends the limb clearly is taken, else the first that bends it at
// all.
// - The rest pose bends it by more than 10 degrees, and clearly by more than 20. Its sine counts: a limb folded by 170
//   tells as little as a straight one.
// - The clip bends it by more than 10 degrees in the mean. It is clear above 30, and one way in nine of ten frames.
//   The mean is of the cross products of the unit bones, in the upper joint's axes, so that noise cancels.
// If neither bends it, the figure's front decides: elbows bend forwards and knees backwards.
//
// rest: of the chain; parent_w: the upper joint's parent at rest. Throws CannotBind where the body must tell and the
// upper bone points within 30 degrees along that way, or against it; the advice has a bend to write.
Bend choose_bend(const Clip& clip, LimbName limb, const LimbChain& chain, const ChainPose& rest,
                 const JointPose& parent_w, const Facing& facing)
{
    const Vector3d upper = rest.upper_bone().normalized();
    const Said by_rest = rest_says(rest, upper), by_clip = clip_says(frame_axes(clip, chain, upper));
    if (by_clip.is_clear && by_rest.tells() && !by_rest.is_clear)
        return {bend_of_hinge(upper, by_clip.axis), by_clip.text + "; it is clearer than " + by_rest.text};
    for (const Said& said : {by_rest, by_clip})
        if (said.tells()) return {bend_of_hinge(upper, said.axis), said.text};

    const bool is_arm = limb.kind == LimbKind::arm;
    const auto seen = [&](const Vector3d& v) { return parent_w.mirrored ? formats::mirrored(v) : v; };
    const auto in_joint = [&](const Vector3d& v_w) -> Vector3d {
        const Vector3d v = rest.turn[0].conjugate() * seen(parent_w.rotation.conjugate() * v_w);
        return (v - v.dot(upper) * upper).normalized();
    };
    const Vector3d upper_w = parent_w.rotation * seen(rest.turn[0] * upper);
    const Vector3d way_w = is_arm ? facing.forwards_w : Vector3d(-facing.forwards_w);
    if (std::abs(upper_w.dot(way_w)) > kCosine30)
        throw CannotBind(
            fmt::format("it is straight and points {} (forwards is told by {}), so nothing tells which way it bends",
                        upper_w.dot(facing.forwards_w) > 0 ? "ahead" : "behind", facing.forwards_source),
            fmt::format("write bend = {} under [limb.{}] in a crowd file, if it hung and was swung there",
                        toml_row(in_joint(aim(-facing.up_w, upper_w) * way_w)), limb_word(limb)));
    return {in_joint(way_w),
            fmt::format("{}; forwards is told by {}", is_arm ? "elbows bend forwards" : "knees bend backwards",
                        facing.forwards_source)};
}

// The clip's objection to a bend: it bends the limb to the other side, in the mean, and by more than 30 degrees in
// some frame. One line for people that offers the clip's bend for a crowd file; empty if nothing does.
std::string clip_against(const Clip& clip, LimbName limb, const LimbChain& chain, const ChainPose& rest,
                         const Vector3d& bend)
{
    const Vector3d upper = rest.upper_bone().normalized(), mean = mean_of(frame_axes(clip, chain, upper));
    if (!(bend_of_hinge(upper, mean).dot(bend) < 0)) return "";
    double max = 0;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const ChainPose pose = chain_pose(clip, frame, chain);
        if (bend_of_hinge(upper, axis_of(pose, upper)).dot(bend) < 0)
            max = std::max(max, degrees_between(pose.turn[0] * pose.upper_bone(), pose.turn[1] * pose.lower_bone()));
    }
    if (!(max > 30)) return "";
    return fmt::format(
        "the clip bends it to the other side, by up to {:.0f} degrees; to follow the clip, write bend = {} under "
        "[limb.{}] in a crowd file",
        max, toml_row(bend_of_hinge(upper, mean)), limb_word(limb));
}

constexpr double kMaxUneven = 1e-3;

// A frame of the clip, or the rest pose.
struct Moment {
    const Clip& clip;
    std::optional<std::size_t> frame;

    JointPose local(int joint) const
    {
        if (!frame) return formats::local_rest_pose(joint_at(clip, joint));
        return formats::local_pose(clip, *frame, static_cast<std::size_t>(joint));
    }
    std::vector<JointPose> world() const
    {
        return frame ? formats::world_pose(clip, *frame) : formats::rest_pose(clip);
    }
    std::string words() const { return frame ? fmt::format("in frame {}", *frame) : "at rest"; }
};

void require_can_solve(const Moment& at, int joint)
{
    const JointPose pose = at.local(joint);
    const std::string name = printable_name(joint_at(at.clip, joint));
    if (joint_at(at.clip, joint).is_sheared)
        throw CannotBind(fmt::format("the matrix of '{}' is sheared, so its bones change shape as they turn", name),
                         "apply the scale where the rig was made");
    if (!(pose.scale > 0))
        throw CannotBind(
            fmt::format("'{}' is scaled to nothing {}", name, at.words()),
            at.frame ? "use a clip that does not hide the figure" : "give it a scale where the rig was made");
    const bool is_mirrored_at_rest = formats::local_rest_pose(joint_at(at.clip, joint)).mirrored;
    if (pose.mirrored != is_mirrored_at_rest)
        throw CannotBind(
            fmt::format("'{}' is mirrored {} and not {}, and a limb is solved on one side of a mirror", name,
                        pose.mirrored ? at.words() : "at rest", pose.mirrored ? "at rest" : at.words()),
            "use a clip that keeps the rest pose's");
}

// The joints whose scale moves the wrist: all above the end joint, from there up.
std::vector<int> above_end(const Clip& clip, const LimbChain& chain)
{
    std::vector<int> joints;
    for (int up = joint_at(clip, chain.end()).parent; up >= 0; up = joint_at(clip, up).parent) joints.push_back(up);
    return joints;
}

// How far uneven scales may put the end joint off, in the world.
double distance_off(const Moment& at, const std::vector<int>& joints, int end)
{
    const std::vector<JointPose> pose_w = at.world();
    const auto place = [&](int joint) { return pose_w[static_cast<std::size_t>(joint)].position; };
    double off = 0, sum = 0, max = 0;
    int worst = end;
    for (const int joint : joints) {
        const double uneven = at.local(joint).unevenness;
        sum += uneven;
        off += uneven * (place(end) - place(joint)).norm();
        if (uneven > max) max = uneven, worst = joint;
    }
    if (sum > kMaxUneven)
        throw CannotBind(fmt::format("the joints above its end are scaled unevenly {}, by {:.2g} in all and most at "
                                     "'{}', so bones change shape as they turn; at most {} can be solved",
                                     at.words(), sum, printable_name(joint_at(at.clip, worst)), kMaxUneven),
                         "apply the scale where the rig was made");
    return off;
}

// A bound on how far uneven scales put the wrist off, as a share of the limb's length at rest. An uneven scale is
// solved by its mean. So each joint above puts the wrist off by its unevenness times its distance to the wrist at most.
// The bound is the sum over these joints, in the pose where it is largest, of the rest pose and all frames. Throws
// CannotBind for scales that are uneven by more than 1e-3 in all, sheared or nothing, and for mirrors that come or go.
double scale_error(const Clip& clip, const LimbChain& chain)
{
    const std::vector<int> joints = above_end(clip, chain);
    bool is_even = true;
    for (const int joint : joints) {
        const bool changes = joint_at(clip, joint).scale_track >= 0;
        for (std::size_t n = 0; n < (changes ? clip.frame_count + 1 : 1); ++n) {
            const Moment at{clip, n > 0 ? std::optional(n - 1) : std::nullopt};
            require_can_solve(at, joint);
            is_even = is_even && at.local(joint).unevenness == 0;
        }
    }
    if (is_even) return 0;
    double max = distance_off({clip, {}}, joints, chain.end());
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
        max = std::max(max, distance_off({clip, frame}, joints, chain.end()));
    const JointPose parent_w = parent_at_rest(clip, chain.upper());
    const ChainPose rest = rest_pose(clip, chain);
    return max / (parent_w.scale * (rest.upper_bone().norm() + rest.lower_bone().norm()));
}

using Eigen::Quaterniond;

void check_lengths(const Clip& clip, const LimbJoints& joints, const ChainPose& rest)
{
    const double lengths[] = {rest.upper_bone().norm(), rest.lower_bone().norm()};
    for (std::size_t n = 0; n < 2; ++n) {
        if (lengths[n] > 1e-6 * (lengths[0] + lengths[1])) continue;
        const std::string end = printable_name(joint_at(clip, joints[n + 1]));
        throw CannotBind(
            fmt::format("the bone from '{}' to '{}' has no length", printable_name(joint_at(clip, joints[n])), end),
            fmt::format("give '{}' an OFFSET or translation where the figure is made, or name other joints", end));
    }
}

formats::LimbRest rest_of(const ChainPose& pose, const Vector3d& bend)
{
    formats::LimbRest rest;
    put(pose.turn[0].coeffs(), rest.shoulder_rotation);
    put((pose.turn[0].conjugate() * pose.turn[1]).coeffs(), rest.elbow_rotation);
    put((pose.turn[1].conjugate() * pose.turn[2]).coeffs(), rest.wrist_rotation);
    put(pose.upper_bone(), rest.elbow_offset);
    put(pose.lower_bone(), rest.wrist_offset);
    put(bend, rest.bend);
    return rest;
}

// The limb at rest in the axes that it is solved in, with lengths as they are in the world.
formats::LimbRest solved_rest(const Limb& limb, ChainPose pose)
{
    for (Quaterniond& turn : pose.turn) turn = limb.as_solved(turn);
    for (Vector3d& position : pose.position) position = limb.scale * limb.as_solved(position);
    return rest_of(pose, limb.as_solved(limb.bend));
}

swivel_binding bind_rest(const formats::LimbRest& rest)
{
    try {
        return binding_of(rest);
    } catch (const Error& error) {
        throw CannotBind(error.what(), "");
    }
}

// The bend that the user gave the limb.
std::optional<Bend> given_bend(std::span<const GivenBend> bends, LimbName limb, const Vector3d& upper)
{
    const auto given = std::ranges::find(bends, limb, &GivenBend::limb);
    if (given == bends.end()) return std::nullopt;
    const std::string source = fmt::format("{} of {}", given->key, given->file);
    if (given->direction.cross(upper).norm() < 0.1)  // about 6 degrees: no one means that
        throw CannotBind(fmt::format("its bend, {}, is along its upper bone ({:.3f} {:.3f} {:.3f})", source, upper.x(),
                                     upper.y(), upper.z()),
                         "give a direction across it");
    return Bend{given->direction, source};
}

// Joints between two of the limb's keep their own motion, which may hardly move the later one. first, last: places of
// the two in the chain.
void require_still_between(const Clip& clip, const LimbChain& chain, std::size_t first, std::size_t last)
{
    constexpr double kMax = 1e-3;  // of the bone
    double max = 0;
    std::size_t worst = 0;
    for (std::size_t frame = 0; frame < clip.frame_count && last - first > 1; ++frame)
        if (const double moved = moved_between(clip, frame, chain, first, last); !(moved <= max))
            max = moved, worst = frame;
    if (max <= kMax) return;
    const auto name = [&](std::size_t n) { return printable_name(joint_at(clip, chain.joints[n])); };
    std::string between;
    for (std::size_t n = first + 1; n < last; ++n) between += fmt::format("{}'{}'", n > first + 1 ? ", " : "", name(n));
    throw CannotBind(
        fmt::format("{} between '{}' and '{}' {} the latter by {:.2g} of the bone in frame {}, more than {}",
                    formats::printable(between, formats::kMaxQuoted), name(first), name(last),
                    last - first > 2 ? "move" : "moves", max, worst, kMax),
        "name other joints, or use a clip that does not move it");
}

}  // namespace

formats::LimbRest limb_rest(const Clip& clip, const LimbChain& chain, const Vector3d& bend)
{
    return rest_of(rest_pose(clip, chain), bend);
}

swivel_binding binding_of(const formats::LimbRest& rest)
{
    struct Joint {
        std::int32_t parent;
        std::array<float, 3> translation;
        std::array<float, 4> rotation;
    };
    const std::array joints = {
        Joint{-1, {0, 0, 0}, std::to_array(rest.shoulder_rotation)},
        Joint{0, std::to_array(rest.elbow_offset), std::to_array(rest.elbow_rotation)},
        Joint{1, std::to_array(rest.wrist_offset), std::to_array(rest.wrist_rotation)},
    };
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.joint_count = 3;
    skeleton.parents = stream(joints, &Joint::parent);
    skeleton.translations = stream(joints, &Joint::translation);
    skeleton.rotations = stream(joints, &Joint::rotation);
    swivel_limb_joints limb = swivel_default_limb_joints(0, 1, 2);
    std::ranges::copy(rest.bend, limb.bend);
    return bind(skeleton, limb);
}

Limb bind_limb(const Clip& clip, formats::LimbName name, const LimbJoints& joints, const Facing& facing,
               std::span<const GivenBend> bends)
{
    Limb limb;
    limb.name = name;
    limb.joints = joints;
    limb.chain = chain_of(clip, joints);
    const ChainPose rest = rest_pose(clip, limb.chain);
    check_lengths(clip, joints, rest);
    limb.unevenness = scale_error(clip, limb.chain);
    if (limb.unevenness > 1e-5)  // what solves keep to otherwise
        limb.notes.push_back(fmt::format("uneven scales put the {} off by at most {:.1e} of the limb's length",
                                         words_of(name.kind).end_joint, limb.unevenness));
    require_still_between(clip, limb.chain, 0, limb.chain.lower);
    require_still_between(clip, limb.chain, limb.chain.lower, limb.chain.joints.size() - 1);
    const JointPose parent_w = parent_at_rest(clip, limb.upper());
    limb.scale = parent_w.scale;
    limb.mirrored = parent_w.mirrored;
    limb.upper_bone = rest.upper_bone().normalized();
    limb.lower_bone = rest.lower_bone().normalized();
    const std::optional<Bend> given = given_bend(bends, name, limb.upper_bone);
    const Bend bend = given ? *given : choose_bend(clip, name, limb.chain, rest, parent_w, facing);
    limb.bend = bend.direction;
    limb.bend_source = bend.source;
    if (!given)
        if (std::string note = clip_against(clip, name, limb.chain, rest, bend.direction); !note.empty())
            limb.notes.push_back(std::move(note));
    limb.rest = solved_rest(limb, rest);
    limb.bound = bind_rest(limb.rest);
    limb.axes_w = (parent_w.rotation * quaternion(limb.bound.parent_from_arm)).toRotationMatrix();
    return limb;
}

}  // namespace swivel::tools

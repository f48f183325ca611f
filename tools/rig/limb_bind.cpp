// SPDX-License-Identifier: MIT
#include "tools/rig/limb_bind.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "tools/formats/clip.h"
#include "tools/formats/printable.h"
#include "tools/rig/limb_bend.h"
#include "tools/rig/limb_chain.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using formats::Clip;
using formats::JointPose;

constexpr double kMostUneven = 1e-3;

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
    double off = 0, sum = 0, most = 0;
    int worst = end;
    for (const int joint : joints) {
        const double uneven = at.local(joint).unevenness;
        sum += uneven;
        off += uneven * (place(end) - place(joint)).norm();
        if (uneven > most) most = uneven, worst = joint;
    }
    if (sum > kMostUneven)
        throw CannotBind(fmt::format("the joints above its end are scaled unevenly {}, by {:.2g} in all and most at "
                                     "'{}', so bones change shape as they turn; at most {} can be solved",
                                     at.words(), sum, printable_name(joint_at(at.clip, worst)), kMostUneven),
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
    double most = distance_off({clip, {}}, joints, chain.end());
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
        most = std::max(most, distance_off({clip, frame}, joints, chain.end()));
    const JointPose parent_w = parent_at_rest(clip, chain.upper());
    const ChainPose rest = rest_pose(clip, chain);
    return most / (parent_w.scale * (rest.upper_bone().norm() + rest.lower_bone().norm()));
}

using Eigen::Quaterniond;
using Eigen::Vector3d;

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

// The limb at rest in the axes that it is solved in, with lengths as they are in the world.
swivel_chain solved_chain(const Limb& limb, ChainPose rest)
{
    for (Quaterniond& turn : rest.turn) turn = limb.as_solved(turn);
    for (Vector3d& position : rest.position) position = limb.scale * limb.as_solved(position);
    return chain_at(rest, limb.as_solved(limb.bend));
}

swivel_binding bind_chain(const swivel_chain& chain)
{
    try {
        return bind(chain);
    } catch (const Error& error) {
        throw CannotBind(error.what(), "");
    }
}

// The arm frame's axes in the world, by those of the upper joint's parent.
Eigen::Matrix3d axes_of(const swivel_binding& binding, const JointPose& parent_w)
{
    return (parent_w.rotation * quaternion(binding.parent_from_arm)).toRotationMatrix();
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
        throw CannotBind(fmt::format("its bend, {}, is along its upper bone ({:.3f} {:.3f} {:.3f})", place_of(*given),
                                     upper.x(), upper.y(), upper.z()),
                         "give a direction across it");
    return &*given;
}

// A joint between two of the limb's, first and last by their places in the chain, keeps its own motion. So that may
// hardly move the later one.
void require_still_between(const Clip& clip, const LimbChain& chain, std::size_t first, std::size_t last)
{
    constexpr double kMost = 1e-3;  // of the bone
    double most = 0;
    std::size_t worst = 0;
    for (std::size_t frame = 0; frame < clip.frame_count && last - first > 1; ++frame)
        if (const double moved = moved_between(clip, frame, chain, first, last); !(moved <= most))
            most = moved, worst = frame;
    if (most <= kMost) return;
    const auto name = [&](std::size_t n) { return printable_name(joint_at(clip, chain.joints[n])); };
    std::string between;
    for (std::size_t n = first + 1; n < last; ++n) between += fmt::format("{}'{}'", n > first + 1 ? ", " : "", name(n));
    throw CannotBind(
        fmt::format("{} between '{}' and '{}' {} the latter by {:.2g} of the bone in frame {}, more than {}",
                    formats::printable(between, formats::kMostQuoted), name(first), name(last),
                    last - first > 2 ? "move" : "moves", most, worst, kMost),
        "name other joints, or use a clip that does not move it");
}

}  // namespace

swivel_chain rest_chain(const Clip& clip, const LimbChain& chain, const Vector3d& bend)
{
    return chain_at(rest_pose(clip, chain), bend);
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
    if (const GivenBend* const given = given_bend(bends, limb)) {
        limb.bend = given->direction;
        limb.bend_source = place_of(*given);
    } else {
        const Bend bend = choose_bend(clip, name, limb.chain, rest, parent_w, facing);
        limb.bend = bend.direction;
        limb.bend_source = bend.source;
        if (std::string note = clip_against(clip, name, limb.chain, rest, bend.direction); !note.empty())
            limb.notes.push_back(std::move(note));
    }
    limb.rest = solved_chain(limb, rest);
    limb.bound = bind_chain(limb.rest);
    limb.axes_w = axes_of(limb.bound, parent_w);
    return limb;
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
#include "tools/rig/limb_chain.h"

#include <algorithm>
#include <cmath>

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;
using formats::JointPose;

// A joint relative to its parent: `bare` before its own scale, `whole` after it.
struct Step {
    JointPose bare, whole;
};

Step step_at_rest(const Clip& clip, int joint)
{
    const formats::Joint& at = formats::joint_at(clip, joint);
    return {{at.offset, at.rest_rotation}, formats::local_rest_pose(at)};
}

Step step_in(const Clip& clip, std::size_t frame, int joint)
{
    const auto at = static_cast<std::size_t>(joint);
    return {{formats::local_translation(clip, frame, at), clip.rotation[frame * clip.joints.size() + at]},
            formats::local_pose(clip, frame, at)};
}

template <class StepOf>
ChainPose walk(const LimbChain& chain, const StepOf& step_of)
{
    ChainPose pose;
    JointPose above;
    const std::size_t last = chain.joints.size() - 1;
    for (std::size_t n = 0; n <= last; ++n) {
        const Step step = step_of(chain.joints[n]);
        if (n == 0 || n == chain.lower || n == last) {
            const std::size_t part = n == 0 ? 0 : n == last ? 2 : 1;
            const JointPose here = above * step.bare;
            pose.position[part] = here.position;
            pose.turn[part] = here.rotation;
        }
        if (n == last) break;  // its own scale moves nothing of the limb
        above = above * step.whole;
    }
    return pose;
}

template <class StepAt>
Vector3d bone_between(std::size_t first, std::size_t last, const StepAt& step_at)
{
    JointPose at = step_at(first).whole;
    const Vector3d start = at.position;
    for (std::size_t n = first + 1; n <= last; ++n) at = at * step_at(n).whole;
    return at.position - start;
}

}  // namespace

std::vector<int> LimbChain::between() const
{
    std::vector<int> inner(joints.begin() + 1, joints.end() - 1);
    inner.erase(inner.begin() + static_cast<std::ptrdiff_t>(lower) - 1);
    return inner;
}

LimbChain chain_of(const Clip& clip, const LimbJoints& joints)
{
    LimbChain chain;
    for (int joint = joints[2]; joint != joints[0]; joint = formats::joint_at(clip, joint).parent)
        chain.joints.push_back(joint);
    chain.joints.push_back(joints[0]);
    std::reverse(chain.joints.begin(), chain.joints.end());
    chain.lower =
        static_cast<std::size_t>(std::find(chain.joints.begin(), chain.joints.end(), joints[1]) - chain.joints.begin());
    chain.is_plain = chain.joints.size() == 3;
    for (const int joint : chain.joints) {
        const formats::Joint& at = formats::joint_at(clip, joint);
        if (at.scale_track >= 0 || at.rest_scale.minCoeff() < 0) chain.is_plain = false;
    }
    return chain;
}

JointPose parent_at_rest(const Clip& clip, int joint)
{
    JointPose pose;
    for (int up = formats::joint_at(clip, joint).parent; up >= 0; up = formats::joint_at(clip, up).parent)
        pose = formats::local_rest_pose(formats::joint_at(clip, up)) * pose;
    return pose;
}

ChainPose rest_pose(const Clip& clip, const LimbChain& chain)
{
    return walk(chain, [&](int joint) { return step_at_rest(clip, joint); });
}

ChainPose chain_pose(const Clip& clip, std::size_t frame, const LimbChain& chain)
{
    return walk(chain, [&](int joint) { return step_in(clip, frame, joint); });
}

double moved_between(const Clip& clip, std::size_t frame, const LimbChain& chain, std::size_t first, std::size_t last)
{
    const auto at_rest = [&](std::size_t n) { return step_at_rest(clip, chain.joints[n]); };
    const auto moved = [&](std::size_t n) {
        return n == first || n == last ? at_rest(n) : step_in(clip, frame, chain.joints[n]);
    };
    const Vector3d bone = bone_between(first, last, at_rest);
    return (bone_between(first, last, moved) - bone).norm() / bone.norm();
}

std::array<Quaterniond, 3> local_rotations(const Clip& clip, std::size_t frame, const LimbChain& chain,
                                           const std::array<Quaterniond, 3>& turn)
{
    std::array<Quaterniond, 3> local;
    JointPose above;
    const std::size_t last = chain.joints.size() - 1;
    for (std::size_t n = 0; n <= last; ++n) {
        JointPose step = step_in(clip, frame, chain.joints[n]).whole;
        if (n == 0 || n == chain.lower || n == last) {
            const std::size_t part = n == 0 ? 0 : n == last ? 2 : 1;
            const Quaterniond against = above.rotation.conjugate() * turn[part];
            local[part] = above.mirrored ? formats::mirrored(against) : against;
            const Quaterniond& before =
                clip.rotation[frame * clip.joints.size() + static_cast<std::size_t>(chain.joints[n])];
            step.rotation = local[part] * before.conjugate() * step.rotation;  // a mirror's half turn stays
        }
        above = above * step;
    }
    return local;
}

Quaterniond aim(const Vector3d& from, const Vector3d& to)
{
    const Vector3d start = from.normalized(), end = to.normalized(), across = start.cross(end);
    const double cosine = start.dot(end), sine = across.norm();
    const bool has_axis = sine > 1e-9;  // far below what a float of the solver holds: what agrees is not touched
    if (!has_axis && !(cosine < 0)) return Quaterniond::Identity();
    const Vector3d axis = has_axis ? Vector3d(across / sine) : start.unitOrthogonal();
    return Quaterniond(Eigen::AngleAxisd(std::atan2(sine, cosine), axis));
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
#include "tools/rig/limb_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

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

}  // namespace

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

}  // namespace swivel::tools

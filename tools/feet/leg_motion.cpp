// SPDX-License-Identifier: MIT
#include "tools/feet/leg_motion.h"

#include <algorithm>
#include <numeric>

#include "tools/rig/limb_joints.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using formats::Clip;
using formats::joint_at;

}  // namespace

double LegMotion::leg_length() const
{
    const auto add = [](double sum, const LegPath& leg) { return sum + leg.length; };
    return std::accumulate(legs.begin(), legs.end(), 0.0, add) / static_cast<double>(legs.size());
}

double largest_jump(std::span<const Vector3d> places_w)
{
    double most = 0;
    for (std::size_t n = 2; n < places_w.size(); ++n)
        most = std::max(most, (places_w[n - 2] - 2 * places_w[n - 1] + places_w[n]).norm());
    return most;
}

int toe_of(const Clip& clip, const Limb& leg)
{
    const std::vector<int> toes = toes_of(clip, leg.name.side, leg.end());
    return toes.empty() ? leg.end() : toes.front();
}

int carrier_of(const Clip& clip, const FigureJoints& figure)
{
    std::optional<int> carrier;
    for (const LimbFound& limb : figure)
        if (const auto& joints = limb.joints.joints) {
            const int above = joint_at(clip, (*joints)[0]).parent;
            carrier = carrier ? fork_of(clip, *carrier, above) : above;
        }
    for (int joint = carrier.value_or(-1); joint >= 0; joint = joint_at(clip, joint).parent)
        if (joint_at(clip, joint).track >= 0) return joint;
    return carrier.value_or(-1);
}

LegMotion leg_motion(const Clip& clip, std::span<const Limb> legs, int carrier, const Vector3d& up_w)
{
    LegMotion motion{nearest_axis(up_w), clip.frame_time, carrier, {}, {}};
    for (const Limb& leg : legs) {
        const int toe = toe_of(clip, leg);
        motion.legs.push_back(
            {leg.name, toe, toe != leg.end(), leg.bound.lengths[0] + leg.bound.lengths[1], {}, {}, {}, {}});
    }
    std::vector<formats::JointPose> pose_w(clip.joints.size());
    const auto place_w = [&](int joint) -> const Vector3d& { return pose_w[static_cast<std::size_t>(joint)].position; };
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        formats::world_pose(clip, frame, pose_w);
        motion.carrier_w.push_back(place_w(carrier));
        for (std::size_t n = 0; n < legs.size(); ++n) {
            LegPath& path = motion.legs[n];
            path.hip_w.push_back(place_w(legs[n].upper()));
            path.knee_w.push_back(place_w(legs[n].lower()));
            path.ankle_w.push_back(place_w(legs[n].end()));
            path.toe_w.push_back(place_w(path.toe));
        }
    }
    return motion;
}

}  // namespace swivel::tools

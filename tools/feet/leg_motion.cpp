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
using JointPoses = std::vector<formats::JointPose>;

constexpr double kToes = 0.56;  // times the level way from ankle to ball: 0.27 and 0.48 of people's foot lengths

const formats::JointPose& pose_at(const JointPoses& pose_w, int joint)
{
    return pose_w[static_cast<std::size_t>(joint)];
}

// A point that goes along with a joint.
struct CarriedPoint {
    int joint;
    Vector3d offset;

    Vector3d place_w(const JointPoses& pose_w) const { return to_outer(pose_at(pose_w, joint), offset); }
};

CarriedPoint tip_of(const Clip& clip, const JointPoses& rest_w, int ankle, int toe, const Vector3d& up_w)
{
    const Vector3d toe_w = pose_at(rest_w, toe).position, foot_w = toe_w - pose_at(rest_w, ankle).position;
    CarriedPoint tip{toe, to_inner(pose_at(rest_w, toe), toe_w + kToes * (foot_w - foot_w.dot(up_w) * up_w))};
    double furthest = 0;
    for (int joint = toe; joint < static_cast<int>(clip.joints.size()); ++joint) {
        if (joint != toe && !is_above(clip, toe, joint)) continue;
        const CarriedPoint end{joint, joint_at(clip, joint).end.value_or(Vector3d::Zero())};
        const double away = (end.place_w(rest_w) - toe_w).norm();
        if (away <= furthest) continue;
        furthest = away;
        tip = end;
    }
    return tip;
}

// A point beside the ankle, across the foot at rest.
CarriedPoint side_of(const JointPoses& rest_w, int ankle, int toe, const Vector3d& up_w)
{
    const Vector3d ankle_w = pose_at(rest_w, ankle).position, foot_w = pose_at(rest_w, toe).position - ankle_w;
    return {ankle, to_inner(pose_at(rest_w, ankle), ankle_w + foot_w.cross(up_w))};
}

}  // namespace

double LegMotion::leg_length() const
{
    const auto add = [](double sum, const LegPath& leg) { return sum + leg.length; };
    return std::accumulate(legs.begin(), legs.end(), 0.0, add) / static_cast<double>(legs.size());
}

double largest_jump(std::span<const Vector3d> places_w)
{
    double max = 0;
    for (std::size_t n = 2; n < places_w.size(); ++n)
        max = std::max(max, (places_w[n - 2] - 2 * places_w[n - 1] + places_w[n]).norm());
    return max;
}

int toe_of(const Clip& clip, const Limb& leg)
{
    const int toe = toe_of(clip, leg.name.side, leg.end());
    return toe < 0 ? leg.end() : toe;
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
    const JointPoses rest_w = formats::rest_pose(clip);
    std::vector<CarriedPoint> tips, sides;
    for (const Limb& leg : legs) {
        LegPath& path = motion.legs.emplace_back();
        path.name = leg.name;
        path.toe = toe_of(clip, leg);
        path.has_toe = path.toe != leg.end();
        path.length = leg.bound.lengths[0] + leg.bound.lengths[1];
        tips.push_back(tip_of(clip, rest_w, leg.end(), path.toe, motion.up_w));
        sides.push_back(side_of(rest_w, leg.end(), path.toe, motion.up_w));
        path.tip_rise = (tips.back().place_w(rest_w) - pose_at(rest_w, path.toe).position).dot(motion.up_w);
    }
    JointPoses pose_w(clip.joints.size());
    const auto place_w = [&](int joint) -> const Vector3d& { return pose_at(pose_w, joint).position; };
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        formats::world_pose(clip, frame, pose_w);
        motion.carrier_w.push_back(place_w(carrier));
        for (std::size_t n = 0; n < legs.size(); ++n) {
            LegPath& path = motion.legs[n];
            path.hip_w.push_back(place_w(legs[n].upper()));
            path.knee_w.push_back(place_w(legs[n].lower()));
            path.ankle_w.push_back(place_w(legs[n].end()));
            path.toe_w.push_back(place_w(path.toe));
            path.tip_w.push_back(tips[n].place_w(pose_w));
            path.across_w.push_back((sides[n].place_w(pose_w) - path.ankle_w.back()).normalized());
        }
    }
    return motion;
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
//
// What a solved crowd's errors are, and how far it is from its clip, by forward kinematics in double.
#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include "tools/crowd/clip_crowd.h"
#include "tools/crowd/parallel.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kBentSine = 0.08715574274765817;  // sin 5 degrees

// Of a rotation: its whole angle, and its parts about an axis and across it.
double angle(const Quaterniond& q) { return 2 * std::atan2(q.vec().norm(), std::fabs(q.w())); }
double twist(const Quaterniond& q, const Vector3d& axis)
{
    return 2 * std::atan2(std::fabs(q.vec().dot(axis)), std::fabs(q.w()));
}
double swing(const Quaterniond& q, const Vector3d& axis)
{
    const Vector3d turned = q * axis;
    return std::atan2(turned.cross(axis).norm(), turned.dot(axis));
}

}  // namespace

void ClipCrowd::measure(Statistics& statistics) const
{
    std::mutex mutex;
    for (std::size_t limb = 0; limb < limbs_.size(); ++limb)
        for_ranges(character_count(), [&](std::uint32_t begin, std::uint32_t end) {
            LimbStatistics range;
            measure_range(limb, begin, end, range);
            const std::lock_guard lock(mutex);
            statistics.of(limbs_[limb].name.kind).add(range);
        });
}

void ClipCrowd::measure_range(std::size_t limb, std::uint32_t begin, std::uint32_t end,
                              LimbStatistics& statistics) const
{
    struct Reached {
        double elbow[3], wrist[3], hand[4];
    };
    std::vector<Reached> reached(end - begin);
    std::vector<std::uint32_t> flags(end - begin);
    const LimbPlan& plan = plans_[limb];
    const bool hand = plan.has(SWIVEL_WITH_HAND), aims = plan.has(SWIVEL_WITH_AIM);
    statistics.has_effector = !plan.effector.isZero(0);
    crowds().forward(limb, begin, end - begin, {reached[0].elbow, sizeof(Reached)}, {reached[0].wrist, sizeof(Reached)},
                     {hand ? reached[0].hand : nullptr, sizeof(Reached)});
    crowds().read(limb, SWIVEL_FLAGS, begin, end - begin, {flags.data(), sizeof flags[0]});
    std::vector<double> residuals(end - begin);
    if (aims) crowds().residuals(limb, begin, end - begin, {residuals.data(), sizeof residuals[0]});
    for (std::uint32_t n = begin; n < end; ++n) {
        if (!crowds().solved(limb, n)) continue;
        const Reached& at = reached[n - begin];
        const goal wanted = asked(limb, n);
        const float(&lengths)[2] = crowd_.input(limb, n).lengths;
        const double length = double{lengths[0]} + lengths[1];
        const PoseName pose{frame_, n, limbs_[limb].name};
        const Vector3d effector = characters()[n].size * (Quaterniond(at.hand) * plan.effector);
        const double distance =
            aims ? residuals[n - begin] : (Vector3d(at.wrist) + effector - Vector3d(wanted.target)).norm() / length;
        const std::uint32_t word = flags[n - begin];
        statistics.add_flags(word, distance, pose);
        if (word & SWIVEL_BAD_INPUT) continue;  // it is counted; its errors mean nothing
        if (aims)
            (word & SWIVEL_REACHED ? statistics.aimed : statistics.aim_missed).add(distance, pose);
        else if (!plan.blends_position)
            (word & SWIVEL_REACHED ? statistics.reached : statistics.missed).add(distance, pose);
        if (hand && !plan.blends_hand && !aims)
            statistics.orientation.add(angle(Quaterniond(wanted.hand).conjugate() * Quaterniond(at.hand)), pose);
        measure_against_clip(limb, pose, Vector3d(at.elbow), statistics);
    }
}

void ClipCrowd::measure_against_clip(std::size_t limb, const PoseName& pose, const Vector3d& elbow,
                                     LimbStatistics& statistics) const
{
    const std::uint32_t character = pose.character;
    const LimbInClip& from = in_clip(limb, character);
    const Vector3d wanted = characters()[character].size * from.elbow;
    const float(&lengths)[2] = crowd_.input(limb, character).lengths;
    const double difference = (elbow - wanted).norm() / (double{lengths[0]} + lengths[1]);
    if (!follows_clip(limb, character)) return statistics.given.add(difference, pose);
    const Vector3d upper = from.elbow.normalized(), fore = (from.wrist - from.elbow).normalized();
    const bool bent = upper.cross(fore).norm() > kBentSine || upper.dot(fore) < 0;
    (bent ? statistics.bent : statistics.straight).add(difference, pose);
    if (character != 0) return;

    const formats::PoseRow row = solved_pose(limb, character);
    const Quaterniond shoulder_w = from.parent * quaternion(row.shoulder);
    const Quaterniond turned = from.upper.conjugate() * shoulder_w;
    statistics.upper_swing.add(swing(turned, limbs_[limb].upper_bone), pose);
    statistics.upper_twist.add(twist(turned, limbs_[limb].upper_bone), pose);
    statistics.lower.add(angle(from.fore.conjugate() * shoulder_w * quaternion(row.elbow)), pose);
}

}  // namespace swivel::tools

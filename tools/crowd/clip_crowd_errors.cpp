// SPDX-License-Identifier: MIT
//
// Measures a solved crowd's errors, and its differences from its clip, by forward kinematics of its poses in double.
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

constexpr swivel_features kSent = SWIVEL_WITH_PLANT | SWIVEL_WITH_LINK;  // the library makes their goals
constexpr double kBentSine = 0.08715574274765817;                        // sin 5 degrees

// The angles of a rotation: the whole, and its parts about an axis and across it.
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
    if (setups_.size() == limbs_.size()) return;
    std::vector<std::uint32_t> flags(character_count());
    crowd_.read(limbs_.size(), SWIVEL_FLAGS, 0, character_count(), {flags.data(), sizeof flags[0]});
    for (std::uint32_t n = 0; n < character_count(); ++n)
        if (crowd_.solved(n)) statistics.looks.add_flags(flags[n]);
}

ClipCrowd::Reached ClipCrowd::reached(std::size_t limb, const formats::PoseRow& row, double stretch) const
{
    const goal_input& input = crowd_.input(limb, row.character);
    const double size = characters()[row.character].size, bone = size * stretch;
    const auto place = [&](std::size_t joint) { return Vector3d(Eigen::Vector3f(input.places[joint]).cast<double>()); };
    const auto as_solved = [&](const std::array<float, 4>& q) { return limbs_[limb].as_solved(quaternion(q)); };
    const Quaterniond parent = setups_[limb].has(SWIVEL_WITH_CLAVICLE)
                                   ? quaternion(crowd_.rotation(limb, row.character, 0))
                                   : quaternion(input.rotations[0]);
    const Quaterniond upper = parent * as_solved(row.shoulder), fore = upper * as_solved(row.elbow);
    const goal_root& root = crowd_.root(row.character);
    const Vector3d shoulder =
        Vector3d(root.place) + double{root.shift} * Vector3d::UnitY() + size * (place(0) + parent * place(1));
    const Vector3d elbow = shoulder + bone * (upper * place(2));
    return {elbow, elbow + bone * (fore * place(3)), upper, fore, fore * as_solved(row.wrist)};
}

// The limb's solved goal: that of a standing foot or a holding hand differs from the clip's.
Vector3d ClipCrowd::target_point(std::size_t limb, std::uint32_t character) const
{
    if (!setups_[limb].has(kSent)) return Vector3d(crowd_.input(limb, character).target);
    float goal[7];
    crowd_.read(limb, SWIVEL_SOLVED_GOAL, character, 1, {goal, sizeof goal});
    return Vector3d(crowd_.root(character).place) + Vector3d(goal[0], goal[1], goal[2]);
}

void ClipCrowd::measure_range(std::size_t limb, std::uint32_t begin, std::uint32_t end,
                              LimbStatistics& statistics) const
{
    const LimbSetup& setup = setups_[limb];
    const bool hand = setup.has(SWIVEL_WITH_HAND), aims = setup.has(SWIVEL_WITH_AIM);
    const Vector3d effector(setup.goals.effector);
    statistics.has_effector = !effector.isZero(0);
    const std::uint32_t count = end - begin;
    std::vector<double> residuals(count);
    if (aims) crowd_.residuals(limb, begin, count, {residuals.data(), sizeof residuals[0]});
    std::vector<std::uint32_t> flags(count);
    crowd_.read(limb, SWIVEL_FLAGS, begin, count, {flags.data(), sizeof flags[0]});
    std::vector<float> stretches(count, 1.0f);
    if (crowd_.has(limb, SWIVEL_STRETCH))
        crowd_.read(limb, SWIVEL_STRETCH, begin, count, {stretches.data(), sizeof stretches[0]});
    for (std::uint32_t n = begin; n < end; ++n) {
        if (!crowd_.solved(n)) continue;
        const Reached at = reached(limb, solved_pose(limb, n), double{stretches[n - begin]});
        const std::uint32_t word = flags[n - begin];
        const PoseName pose{frame_, n, limbs_[limb].name};
        const Vector3d end_point = at.wrist + characters()[n].size * (at.hand * effector);
        const float(&weights)[3] = crowd_.input(limb, n).weights;
        const double limb_length = length(limb, n);
        const double distance = weights[0] == 0 ? 0
                                : aims          ? residuals[n - begin]
                                                : (end_point - target_point(limb, n)).norm() / limb_length;
        statistics.add_flags(word, distance, pose);
        if (word & SWIVEL_BAD_INPUT) continue;  // it is counted; its errors mean nothing
        const bool is_reached = (word & SWIVEL_REACHED) != 0;
        if (aims)
            (is_reached ? statistics.aimed : statistics.aim_missed).add(distance, pose, limb_length);
        else if (weights[0] == 1)
            (is_reached ? statistics.reached : statistics.missed).add(distance, pose, limb_length);
        if (hand && weights[1] == 1 && !aims && !setup.has(kSent))
            statistics.orientation.add(angle(target(limb, n).orientation.conjugate() * at.hand), pose);
        measure_against_clip(limb, pose, at, statistics);
    }
}

void ClipCrowd::measure_against_clip(std::size_t limb, const PoseName& pose, const Reached& at,
                                     LimbStatistics& statistics) const
{
    const std::uint32_t character = pose.character;
    const LimbInClip& from = in_clip(limb, character);
    const goal_character& who = characters()[character];
    const Vector3d elbow = who.size * (motion_.origin(clip_frame(character), limb) + from.elbow);
    Vector3d wanted = Vector3d(who.place) + headed(character, elbow);
    wanted.y() += double{crowd_.rise(character)} - double{crowd_.root(character).shift};
    const double limb_length = length(limb, character), difference = (at.elbow - wanted).norm() / limb_length;
    if (crowd_.input(limb, character).weights[0] == 0 && crowd_.has_ground()) return;  // it goes along with its body
    if (!follows_clip(limb, character)) return statistics.given.add(difference, pose, limb_length);
    const Vector3d upper = from.elbow.normalized(), fore = (from.wrist - from.elbow).normalized();
    const bool bent = upper.cross(fore).norm() > kBentSine || upper.dot(fore) < 0;
    (bent ? statistics.bent : statistics.straight).add(difference, pose, limb_length);
    if (character != 0) return;

    const Quaterniond turned = headed(character, from.upper).conjugate() * at.upper;
    const Vector3d bone = limbs_[limb].as_solved(limbs_[limb].upper_bone);
    statistics.upper_swing.add(swing(turned, bone), pose);
    statistics.upper_twist.add(twist(turned, bone), pose);
    statistics.lower.add(angle(headed(character, from.fore).conjugate() * at.fore), pose);
}

}  // namespace swivel::tools

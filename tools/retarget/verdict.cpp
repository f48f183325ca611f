// SPDX-License-Identifier: MIT
#include "tools/retarget/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tools/rig/limb_words.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using formats::Clip;
using formats::position_of;
using Poses = std::vector<formats::JointPose>;

constexpr double kAway_deg = 45;               // between a bone and the source's
constexpr double kMissed = 0.05, kLost = 0.5;  // limb lengths
constexpr double kSunk = 0.03;                 // leg lengths below the ground, 3 cm of a grown man's
constexpr double kFast_deg = 720;              // a second
constexpr double kMostly = 0.25;               // of the frames

// How often a value is too large, and where it is largest.
struct Excess {
    double bound, sum = 0;
    std::size_t count = 0;
    Peak peak{};

    void add(double value, std::size_t frame)
    {
        sum += value;
        if (value > bound) ++count;
        peak.raise(frame, value);
    }
    bool is_mostly(std::size_t all) const { return static_cast<double>(count) >= kMostly * static_cast<double>(all); }
    std::string where(std::size_t all) const
    {
        return fmt::format("over {:g} in {} of {} frames, most in frame {}", bound, count, all, peak.frame);
    }
};

// One limb of both bodies, over all frames.
struct LimbCourse {
    const LimbJoints &from, &to;
    std::array<Excess, 2> away{Excess{kAway_deg}, Excess{kAway_deg}};
    Excess missed{kMissed}, lost{kLost}, sunk{kSunk};
    Peak turn_deg{}, source_turn_deg{};        // of knee or elbow, a frame
    double bend_deg = 0, source_bend_deg = 0;  // in the frame before

    static Vector3d bone(const Poses& pose_w, const LimbJoints& joints, std::size_t n)
    {
        return position_of(pose_w, joints[n + 1]) - position_of(pose_w, joints[n]);
    }
    void take(std::size_t frame, const RestFigure& source, const Poses& source_w, const RestFigure& target,
              const Poses& pose_w, const Vector3d& goal_w)
    {
        for (std::size_t n = 0; n < 2; ++n)
            away[n].add(degrees_between(source.own(bone(source_w, from, n)), target.own(bone(pose_w, to, n))), frame);
        const double length = bone(pose_w, to, 0).norm() + bone(pose_w, to, 1).norm();
        const double miss = (position_of(pose_w, to[2]) - goal_w).norm() / length;
        missed.add(miss, frame);
        lost.add(miss, frame);
        const double bend = degrees_between(bone(pose_w, to, 0), bone(pose_w, to, 1));
        const double source_bend = degrees_between(bone(source_w, from, 0), bone(source_w, from, 1));
        if (frame > 0) {
            source_turn_deg.raise(frame, std::abs(source_bend - source_bend_deg));
            turn_deg.raise(frame, std::abs(bend - bend_deg));
        }
        bend_deg = bend;
        source_bend_deg = source_bend;
    }
};

// How far a joint is below the ground, in leg lengths; above it 0.
double depth(const RestFigure& figure, const Poses& pose_w, int joint, double ground)
{
    return std::max(0.0, (ground - position_of(pose_w, joint).dot(figure.up_w())) / figure.leg);
}

// From the middle of the hip joints to the shoulders or else to the head, as the figure has it; zero without them.
Vector3d trunk(const RestFigure& figure, const std::vector<BodyPart>& parts, const Poses& pose_w)
{
    const int head = first_joint(parts, "head");
    const auto middle_w = [&](std::size_t pair) -> Vector3d {
        return (position_of(pose_w, (*figure.limbs[pair])[0]) + position_of(pose_w, (*figure.limbs[pair + 1])[0])) / 2;
    };
    const auto has = [&](std::size_t pair) { return figure.limbs[pair] && figure.limbs[pair + 1]; };
    if (!has(2) || (!has(0) && head < 0)) return Vector3d::Zero();
    return figure.own((has(0) ? middle_w(0) : position_of(pose_w, head)) - middle_w(2));
}

void judge_away(const Excess& away, const std::string& what, std::size_t frames, Verdict& verdict)
{
    if (away.count == 0) return;
    (away.is_mostly(frames) ? verdict.faults : verdict.doubts)
        .push_back(fmt::format("the {} points up to {:.0f} degrees away from the source's: {}", what, away.peak.value,
                               away.where(frames)));
}

void judge(const LimbCourse& limb, formats::LimbName name, std::size_t frames, double frame_time, Verdict& verdict)
{
    const LimbWords& words = words_of(name.kind);
    for (std::size_t n = 0; n < 2; ++n)
        judge_away(limb.away[n], fmt::format("{} {}", side_name(name.side), n == 0 ? words.upper : words.lower), frames,
                   verdict);
    const bool is_lost = limb.lost.is_mostly(frames);
    const Excess& missed = is_lost ? limb.lost : limb.missed;
    if (missed.count > 0)
        (is_lost ? verdict.faults : verdict.doubts)
            .push_back(fmt::format("the {} {} is up to {:.2g} limb lengths from its goal: {}", side_name(name.side),
                                   words.end_joint, missed.peak.value, missed.where(frames)));
    if (limb.sunk.count > 0)
        verdict.doubts.push_back(
            fmt::format("the {} {} goes up to {:.2g} leg lengths deeper into the ground than the source's: {}",
                        side_name(name.side), words.end, limb.sunk.peak.value, limb.sunk.where(frames)));
    const auto& [frame, turn_deg] = limb.turn_deg;
    if (turn_deg > std::max(2 * limb.source_turn_deg.value, kFast_deg * frame_time))
        verdict.doubts.push_back(fmt::format(
            "the {} {} turns by {:.1f} degrees from frame {} to {}, the source's by at most {:.1f}",
            side_name(name.side), words.lower_joint, turn_deg, frame - 1, frame, limb.source_turn_deg.value));
}

}  // namespace

Verdict verdict_of(const Clip& source_clip, const Retargeted& motion, const JointPairs& pairs)
{
    const std::vector<BodyPart> from = parts_of(pairs, BodySide::source), to = parts_of(pairs, BodySide::target);
    const RestFigure source = rest_figure(source_clip, from), target = rest_figure(motion.clip, to);
    const std::size_t frames = motion.clip.frame_count;
    Excess trunk_away{kAway_deg};
    std::vector<LimbCourse> limbs;
    for (const formats::LimbName name : motion.limbs)
        limbs.push_back({*source.limbs[index_of(name)], *target.limbs[index_of(name)]});
    for (std::size_t frame = 0; frame < frames; ++frame) {
        const Poses source_w = formats::world_pose(source_clip, frame),
                    pose_w = formats::world_pose(motion.clip, frame);
        trunk_away.add(degrees_between(trunk(source, from, source_w), trunk(target, to, pose_w)), frame);
        for (std::size_t n = 0; n < limbs.size(); ++n) {
            limbs[n].take(frame, source, source_w, target, pose_w, motion.goals[frame * limbs.size() + n].position);
            // Where ankles stand in place of toes, the ground is lower than their height, and hands may be, too.
            if (!motion.ground || (!motion.ground->of_toes && motion.limbs[n].kind == formats::LimbKind::arm)) continue;
            const std::size_t limb = index_of(motion.limbs[n]);
            const auto& [source_ground, ground, of_toes] = *motion.ground;
            limbs[n].sunk.add(depth(target, pose_w, target.ground_joint(limb, of_toes), ground) -
                                  depth(source, source_w, source.ground_joint(limb, of_toes), source_ground),
                              frame);
        }
    }
    Verdict verdict;
    judge_away(trunk_away, "trunk", frames, verdict);
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        const Excess& missed = limbs[n].missed;
        verdict.misses.push_back({missed.sum / static_cast<double>(frames), missed.peak.value, missed.peak.frame});
        judge(limbs[n], motion.limbs[n], frames, motion.clip.frame_time, verdict);
    }
    return verdict;
}

}  // namespace swivel::tools

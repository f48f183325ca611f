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
using Poses = std::vector<formats::JointPose>;

constexpr double kAway_deg = 45;               // between a bone and the source's
constexpr double kMissed = 0.05, kLost = 0.5;  // limb lengths
constexpr double kFast_deg = 720;              // a second
constexpr double kMostly = 0.25;               // of the frames

// In how many frames something is too much, and where it is most.
struct Excess {
    double bound, most = 0;
    std::size_t count = 0, most_frame = 0;

    void add(double value, std::size_t frame)
    {
        if (value > bound) ++count;
        if (value <= most) return;
        most = value;
        most_frame = frame;
    }
    bool is_mostly(std::size_t all) const { return static_cast<double>(count) >= kMostly * static_cast<double>(all); }
};

// One limb of both bodies, over all frames.
struct LimbCourse {
    const LimbJoints &from, &to;
    std::array<Excess, 2> away{Excess{kAway_deg}, Excess{kAway_deg}};
    Excess missed{kMissed}, lost{kLost};
    double turn_deg = 0, source_turn_deg = 0;  // the fastest of knee or elbow, a frame
    double bend_deg = 0, source_bend_deg = 0;  // in the frame before
    std::size_t turn_frame = 0;

    static Vector3d bone(const Poses& pose_w, const LimbJoints& joints, std::size_t n)
    {
        const auto place_w = [&](std::size_t joint) {
            return pose_w[static_cast<std::size_t>(joints[joint])].position;
        };
        return place_w(n + 1) - place_w(n);
    }
    void take(std::size_t frame, const RestFigure& source, const Poses& source_w, const RestFigure& target,
              const Poses& pose_w, const Vector3d& goal_w)
    {
        for (std::size_t n = 0; n < 2; ++n)
            away[n].add(degrees_between(source.own(bone(source_w, from, n)), target.own(bone(pose_w, to, n))), frame);
        const double length = bone(pose_w, to, 0).norm() + bone(pose_w, to, 1).norm();
        const double miss = (pose_w[static_cast<std::size_t>(to[2])].position - goal_w).norm() / length;
        missed.add(miss, frame);
        lost.add(miss, frame);
        const double bend = degrees_between(bone(pose_w, to, 0), bone(pose_w, to, 1));
        const double source_bend = degrees_between(bone(source_w, from, 0), bone(source_w, from, 1));
        if (frame > 0) {
            source_turn_deg = std::max(source_turn_deg, std::abs(source_bend - source_bend_deg));
            if (const double turn = std::abs(bend - bend_deg); turn > turn_deg) {
                turn_deg = turn;
                turn_frame = frame;
            }
        }
        bend_deg = bend;
        source_bend_deg = source_bend;
    }
};

void judge(const LimbCourse& limb, formats::LimbName name, std::size_t frames, double frame_time, Verdict& verdict)
{
    const LimbWords& words = words_of(name.kind);
    const auto where = [&](const Excess& excess) {
        return fmt::format("in {} of {} frames, most in frame {}", excess.count, frames, excess.most_frame);
    };
    for (std::size_t n = 0; n < 2; ++n) {
        if (limb.away[n].count == 0) continue;
        (limb.away[n].is_mostly(frames) ? verdict.faults : verdict.doubts)
            .push_back(fmt::format("the {} {} points up to {:.0f} degrees away from the source's: over {:g} {}",
                                   side_name(name.side), n == 0 ? words.upper : words.lower, limb.away[n].most,
                                   kAway_deg, where(limb.away[n])));
    }
    const bool is_lost = limb.lost.is_mostly(frames);
    const Excess& missed = is_lost ? limb.lost : limb.missed;
    if (missed.count > 0)
        (is_lost ? verdict.faults : verdict.doubts)
            .push_back(fmt::format("the {} {} is up to {:.2g} limb lengths from its goal: over {:g} {}",
                                   side_name(name.side), words.end_joint, missed.most, missed.bound, where(missed)));
    if (limb.turn_deg > std::max(2 * limb.source_turn_deg, kFast_deg * frame_time))
        verdict.doubts.push_back(
            fmt::format("the {} {} turns by {:.1f} degrees from frame {} to {}, the source's by at "
                        "most {:.1f}",
                        side_name(name.side), words.lower_joint, limb.turn_deg, limb.turn_frame - 1, limb.turn_frame,
                        limb.source_turn_deg));
}

}  // namespace

Verdict verdict_of(const Clip& source_clip, const Retargeted& motion, const JointPairs& pairs)
{
    const RestFigure source = rest_figure(source_clip, parts_of(pairs, BodySide::source));
    const RestFigure target = rest_figure(motion.clip, parts_of(pairs, BodySide::target));
    std::vector<LimbCourse> limbs;
    for (const formats::LimbName name : motion.limbs) {
        const auto n =
            static_cast<std::size_t>(std::ranges::find(formats::kLimbNames, name) - formats::kLimbNames.begin());
        limbs.push_back({*source.limbs[n], *target.limbs[n]});
    }
    for (std::size_t frame = 0; frame < motion.clip.frame_count; ++frame) {
        const Poses source_w = formats::world_pose(source_clip, frame),
                    pose_w = formats::world_pose(motion.clip, frame);
        for (std::size_t n = 0; n < limbs.size(); ++n)
            limbs[n].take(frame, source, source_w, target, pose_w, motion.goals[frame * limbs.size() + n].position);
    }
    Verdict verdict;
    for (std::size_t n = 0; n < limbs.size(); ++n)
        judge(limbs[n], motion.limbs[n], motion.clip.frame_count, motion.clip.frame_time, verdict);
    return verdict;
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
#include "tools/retarget/retarget_limbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "tools/crowd/clip_crowd.h"
#include "tools/rig/limbs.h"

namespace swivel::tools {

namespace {

using formats::Clip;
using formats::LimbName;
using formats::Target;

constexpr double kMet = 1e-6;  // limb lengths: what the solver itself meets

LimbChoice choice_of(const Clip& clip, const KnownLimbs& limbs, const std::vector<LimbName>& wanted)
{
    LimbChoice choice;
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        const LimbName name = formats::kLimbNames[n];
        if (std::ranges::find(wanted, name) == wanted.end()) continue;
        NamedLimb named{{}, name.side, {"--map"}};
        for (const int joint : *limbs[n]) named.joints.push_back(fmt::format("#{}", joint_at(clip, joint).number));
        (name.kind == formats::LimbKind::arm ? choice.arms : choice.legs).push_back(named);
    }
    return choice;
}

double length_of(const Limb& limb) { return double{limb.bound.lengths[0]} + double{limb.bound.lengths[1]}; }

// A joint's place in the world.
Eigen::Vector3d place_w(const std::vector<formats::JointPose>& pose_w, int joint)
{
    return pose_w[static_cast<std::size_t>(joint)].position;
}

// The goals of a frame that are not met, of these limbs.
std::vector<Target> unmet(const Retargeted& motion, std::size_t frame, const std::vector<Limb>& limbs)
{
    std::vector<Target> goals;
    const auto pose_w = formats::world_pose(motion.clip, frame);
    for (std::size_t n = 0; n < motion.limbs.size(); ++n) {
        const Target& goal = motion.eased[frame * motion.limbs.size() + n];
        const auto limb = std::ranges::find(limbs, goal.limb, &Limb::name);
        if (limb == limbs.end() || (place_w(pose_w, limb->end()) - goal.position).norm() <= kMet * length_of(*limb))
            continue;
        goals.push_back(goal);
    }
    return goals;
}

// Which joints take which rotations, in Clip::rotation.
using NewRotations = std::map<std::size_t, Eigen::Quaterniond>;

void put(const Clip& clip, std::size_t frame, const Limb& limb, const std::array<Eigen::Quaterniond, 3>& turns,
         NewRotations& rotations)
{
    for (std::size_t n = 0; n < 3; ++n)
        rotations[frame * clip.joints.size() + static_cast<std::size_t>(limb.joints[n])] = turns[n];
}

NewRotations new_rotations(const Retargeted& motion, const std::vector<Limb>& limbs)
{
    const CrowdPlan plan = plan_crowd(nullptr, motion.clip, limbs);
    ClipCrowd crowd(motion.clip, limbs, plan);
    Statistics statistics;
    NewRotations rotations;
    for (std::size_t frame = 0; frame < motion.clip.frame_count; ++frame) {
        const std::vector<Target> goals = unmet(motion, frame, limbs);
        crowd.set_frame(frame, goals);
        crowd.solve(statistics);
        for (const Target& goal : goals) {
            const auto at = std::ranges::find(limbs, goal.limb, &Limb::name);
            const formats::PoseRow row = crowd.pose(static_cast<std::size_t>(at - limbs.begin()), 0);
            put(motion.clip, frame, *at, {quaternion(row.shoulder), quaternion(row.elbow), quaternion(row.wrist)},
                rotations);
        }
    }
    return rotations;
}

void measure(const Retargeted& motion, const KnownLimbs& joints, std::vector<GoalMiss>& misses)
{
    for (std::size_t frame = 0; frame < motion.clip.frame_count; ++frame) {
        const auto pose_w = formats::world_pose(motion.clip, frame);
        for (std::size_t n = 0; n < misses.size(); ++n) {
            const Target& goal = motion.goals[frame * misses.size() + n];
            const LimbJoints& at = *joints[static_cast<std::size_t>(std::ranges::find(formats::kLimbNames, goal.limb) -
                                                                    formats::kLimbNames.begin())];
            const double length = (place_w(pose_w, at[0]) - place_w(pose_w, at[1])).norm() +
                                  (place_w(pose_w, at[1]) - place_w(pose_w, at[2])).norm();
            const double miss = (place_w(pose_w, at[2]) - goal.position).norm() / length;
            misses[n].mean += miss / static_cast<double>(motion.clip.frame_count);
            if (miss > misses[n].most) {
                misses[n].most = miss;
                misses[n].most_frame = frame;
            }
        }
    }
}

}  // namespace

std::vector<GoalMiss> solve_limbs(Retargeted& motion, const std::vector<BodyPart>& parts,
                                  const std::filesystem::path& file)
{
    const KnownLimbs joints = limbs_of(parts);
    const LimbChoice choice = choice_of(motion.clip, joints, motion.limbs);
    const LimbSearch search = bind_limbs(motion.clip, choose_joints(motion.clip, file, choice), choice);
    std::vector<Limb> limbs;
    std::vector<GoalMiss> misses;
    for (const LimbName name : motion.limbs) misses.push_back({name, 0, 0, 0, {}});
    for (const LimbFinding& finding : search.findings) {
        if (finding.limb) limbs.push_back(*finding.limb);
        const auto miss = std::ranges::find(misses, finding.name, &GoalMiss::limb);
        if (!finding.limb && miss != misses.end()) miss->problem = problem_text(finding);
    }
    if (!limbs.empty())
        for (const auto& [joint, turn] : new_rotations(motion, limbs)) motion.clip.rotation[joint] = turn;
    measure(motion, joints, misses);
    return misses;
}

}  // namespace swivel::tools

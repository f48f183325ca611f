// SPDX-License-Identifier: MIT
#include "tools/retarget/retarget_limbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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

// The goals of a frame that are not met, of these limbs.
std::vector<Target> unmet(const Retargeted& motion, std::size_t frame, const std::vector<Limb>& limbs)
{
    std::vector<Target> goals;
    const auto pose_w = formats::world_pose(motion.clip, frame);
    for (std::size_t n = 0; n < motion.limbs.size(); ++n) {
        const Target& goal = motion.eased[frame * motion.limbs.size() + n];
        const auto limb = std::ranges::find(limbs, goal.limb, &Limb::name);
        if (limb == limbs.end() ||
            (formats::position_of(pose_w, limb->end()) - goal.position).norm() <= kMet * length_of(*limb))
            continue;
        goals.push_back(goal);
    }
    return goals;
}

void solve(Retargeted& motion, const std::vector<Limb>& limbs)
{
    Clip& clip = motion.clip;
    const CrowdPlan plan = plan_crowd(nullptr, clip, limbs);
    ClipCrowd crowd(clip, limbs, plan);
    Statistics statistics;
    std::vector<Eigen::Quaterniond> rotations = clip.rotation;  // the crowd reads the clip's own
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const std::vector<Target> goals = unmet(motion, frame, limbs);
        crowd.set_frame(frame, goals);
        crowd.solve(statistics);
        for (const Target& goal : goals) {
            const auto limb = std::ranges::find(limbs, goal.limb, &Limb::name);
            const formats::PoseRow row = crowd.pose(static_cast<std::size_t>(limb - limbs.begin()), 0);
            const Eigen::Quaterniond turns[] = {quaternion(row.shoulder), quaternion(row.elbow), quaternion(row.wrist)};
            for (std::size_t n = 0; n < 3; ++n)
                rotations[frame * clip.joints.size() + static_cast<std::size_t>(limb->joints[n])] = turns[n];
        }
    }
    clip.rotation = std::move(rotations);
}

}  // namespace

std::vector<std::string> solve_limbs(Retargeted& motion, const std::vector<BodyPart>& parts,
                                     const std::filesystem::path& file)
{
    const LimbChoice choice = choice_of(motion.clip, limbs_of(parts), motion.limbs);
    const LimbSearch search = bind_limbs(motion.clip, choose_joints(motion.clip, file, choice), choice);
    std::vector<Limb> limbs;
    std::vector<std::string> problems(motion.limbs.size());
    for (const LimbFinding& finding : search.findings) {
        if (finding.limb) limbs.push_back(*finding.limb);
        const auto at = std::ranges::find(motion.limbs, finding.name);
        if (!finding.limb && at != motion.limbs.end())
            problems[static_cast<std::size_t>(at - motion.limbs.begin())] = problem_text(finding);
    }
    if (!limbs.empty()) solve(motion, limbs);
    return problems;
}

}  // namespace swivel::tools

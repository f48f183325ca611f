// SPDX-License-Identifier: MIT
#include "tools/swivel/motion_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "tools/crowd/heading.h"
#include "tools/formats/error.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;

bool turns(const Clip& clip, std::size_t joint)
{
    const Quaterniond rest = pose_without_keys(clip.joints[joint]).rotation;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
        if (clip.rotation[frame * clip.joints.size() + joint].coeffs() != rest.coeffs()) return true;
    return false;
}
bool moves(const Clip& clip, std::size_t joint)
{
    const Vector3d rest = pose_without_keys(clip.joints[joint]).offset;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
        if (formats::local_translation(clip, frame, joint) != rest) return true;
    return false;
}
bool scales(const Clip& clip)
{
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
        for (std::size_t n = 0; n < clip.joints.size(); ++n)
            if (const int track = clip.joints[n].scale_track; track >= 0) {
                const Vector3d& scale = clip.scale[frame * clip.scale_track_count + static_cast<std::size_t>(track)];
                if (!scale.isApprox(pose_without_keys(clip.joints[n]).scale, 1e-5)) return true;
            }
    return false;
}

}  // namespace

MotionKeys::MotionKeys(const Clip& clip, std::span<const Limb> limbs, const CrowdPlan& plan, bool has_new_frames)
    : clip_(clip), has_new_frames_(has_new_frames), characters_(plan.characters), limb_count_(limbs.size())
{
    for (const PlannedAgent& agent : plan.agents) names_.push_back(agent.name);
    for (std::size_t limb = 0; limb < limbs.size(); ++limb) {
        for (std::size_t n = 0; n < (plan.limbs[limb].has(SWIVEL_WITH_HAND) ? 3 : 2); ++n)
            solved_.push_back({limb, n, limbs[limb].joints[n]});
        if (plan.limbs[limb].has(SWIVEL_WITH_CLAVICLE))
            solved_.push_back({limb, 3, joint_at(clip, limbs[limb].upper()).parent});
    }
    if (plan.look)
        for (std::size_t n = 0; n < plan.look->joints.size(); ++n)
            solved_.push_back({limbs.size(), n, plan.look->joints[n]});
    if (plan.ground) raised_ = root_of(clip, limbs[0].upper());
    if (has_new_frames) {
        for (std::size_t n = 0; n < clip.joints.size(); ++n) {
            const int joint = static_cast<int>(n);
            if (std::ranges::count(solved_, joint, &Solved::joint) > 0 || turns(clip, n)) turning_.push_back(joint);
            if (moves(clip, n) || raised_ == joint) moving_.push_back(joint);
        }
    } else {
        std::ranges::transform(solved_, std::back_inserter(turning_), &Solved::joint);
    }
    for (Solved& each : solved_)
        each.turning = static_cast<std::size_t>(std::ranges::find(turning_, each.joint) - turning_.begin());
    rotations_.resize(characters_ * turning_.size()), places_.resize(characters_ * moving_.size());
}

void MotionKeys::require_can_write(const std::filesystem::path& out, const MotionFile& file,
                                   std::size_t frame_count) const
{
    const double bytes = static_cast<double>(characters_) * static_cast<double>(frame_count) *
                         static_cast<double>(16 * turning_.size() + 12 * moving_.size());
    constexpr double kMaxBytes = 3e9;  // of 4 GiB that a GLB may have, also beside its meshes
    if (bytes > kMaxBytes)
        throw formats::InputError(
            out, fmt::format("{} frames of {} characters would take {:.1f} GB; give fewer, or write a .csv",
                             frame_count, characters_, bytes / 1e9));
    for (const std::vector<int>& joints : {turning_, moving_})
        for (const int joint : joints) file.require_can_key(joint);
    if (has_new_frames_ && scales(clip_))
        throw formats::InputError(out,
                                  "joints of the clip change their size, which new frames do not hold; write a .csv");
}

void MotionKeys::add(const ClipCrowd& crowd)
{
    for (std::uint32_t c = 0; c < characters_; ++c) {
        const std::size_t frame = crowd.goal_crowd().clip_frame(c);
        const std::span rotations = std::span(rotations_).subspan(c * turning_.size(), turning_.size());
        for (std::size_t n = 0; n < turning_.size(); ++n)
            rotations[n].push_back(clip_.rotation[frame * clip_.joints.size() + static_cast<std::size_t>(turning_[n])]);
        const GoalCrowd& solved = crowd.goal_crowd();
        for (std::size_t n = 0; n < moving_.size(); ++n) {
            Vector3d place = formats::local_translation(clip_, frame, static_cast<std::size_t>(moving_[n]));
            if (moving_[n] == raised_) place.y() += double{solved.rise(c)} / solved.characters()[c].size;
            places_[c * moving_.size() + n].push_back(place);
        }
        for (const Solved& each : solved_) {
            if (each.limb == limb_count_) {
                rotations[each.turning].back() = crowd.looking(each.part, c);
                continue;
            }
            const formats::PoseRow row = crowd.pose(each.limb, c);
            const auto& q = each.part == 0 ? row.shoulder : each.part == 1 ? row.elbow : row.wrist;
            rotations[each.turning].back() =
                each.part == 3 ? crowd.clavicle(each.limb, c) : Quaterniond(q[3], q[0], q[1], q[2]);
        }
    }
}

void MotionKeys::write(const std::filesystem::path& out, const MotionFile& file,
                       std::span<const goal_character> characters) const
{
    const std::size_t frames = rotations_.empty() ? places_.front().size() : rotations_.front().size();
    std::vector<formats::GltfCharacter> whole;
    for (std::size_t c = 0; c < characters.size(); ++c) {
        formats::GltfCharacter& figure = whole.emplace_back();
        if (!names_.empty())
            figure.name = names_[c];
        else if (characters.size() > 1)
            figure.name = fmt::format("character {}", c);
        figure.place = Vector3d(characters[c].place), figure.size = characters[c].size;
        const HalfTurn turn = half_turn_of(characters[c]);
        figure.rotation = Quaterniond(turn.w, 0, turn.y, 0);
        for (std::size_t n = 0; n < turning_.size(); ++n)
            figure.keys.push_back({turning_[n], rotations_[c * turning_.size() + n], {}});
        for (std::size_t n = 0; n < moving_.size(); ++n) {
            const auto found = std::ranges::find(figure.keys, moving_[n], &formats::JointKeys::joint);
            formats::JointKeys& keys = found == figure.keys.end() ? figure.keys.emplace_back() : *found;
            keys.joint = moving_[n], keys.translation = places_[c * moving_.size() + n];
        }
    }
    file.write(out, whole,
               has_new_frames_ ? std::optional(formats::NewFrames{frames, clip_.frame_time, "swivel"}) : std::nullopt);
}

}  // namespace swivel::tools

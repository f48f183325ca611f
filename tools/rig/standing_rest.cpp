// SPDX-License-Identifier: MIT
#include "tools/rig/standing_rest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/rig/body_parts.h"
#include "tools/rig/facing.h"
#include "tools/rig/limb_chain.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;
using formats::position_of;
using Poses = std::vector<formats::JointPose>;

constexpr double kLeaning = 0.5;    // the cosine of 60 degrees
constexpr double kUnlike_deg = 20;  // between a leg and the other's mirror image
constexpr double kChanged = 0.1;    // of a length: bones that differ by more are not as at rest

// The parts of a figure that are upright where it stands.
class UprightParts {
public:
    UprightParts(const Clip& clip, const KnownLimbs& limbs)
    {
        for (const std::size_t arm : {0u, 1u})
            if (limbs[arm]) tops_.push_back((*limbs[arm])[0]);
        if (tops_.size() < 2) tops_ = joints_of(body_parts(clip, limbs), "head");
        for (const std::size_t leg : {2u, 3u})
            if (limbs[leg]) {
                legs_.emplace_back(limbs[leg]->begin(), limbs[leg]->end());
                if (const int toe = toe_of(clip, formats::kLimbNames[leg].side, legs_.back()[2]); toe >= 0)
                    legs_.back().push_back(toe);
            }
    }

    // From the middle of the feet to the shoulders, or else to the head or the hips; zero where no leg is known.
    Vector3d height_w(const Poses& pose_w) const
    {
        return legs_.empty() ? Vector3d(Vector3d::Zero()) : Vector3d(top_w(pose_w) - middle_w(pose_w, 2));
    }
    // The cosine between up and the least upright part: 1 for a figure that stands to attention, -1 if no leg is known.
    double uprightness(const Poses& pose_w, const Vector3d& up_w) const
    {
        if (legs_.empty()) return -1;
        double min = 1;
        const auto add = [&](const Vector3d& way_w) { min = std::min(min, way_w.normalized().dot(up_w)); };
        if (!tops_.empty()) add(top_w(pose_w) - middle_w(pose_w, 0));
        for (const std::vector<int>& leg : legs_) {
            add(position_of(pose_w, leg[0]) - position_of(pose_w, leg[1]));
            add(position_of(pose_w, leg[1]) - position_of(pose_w, leg[2]));
        }
        return min;
    }
    // Why a pose cannot stand; empty if it can.
    std::string problem(const Poses& pose_w, const Vector3d& up_w) const
    {
        Vector3d other_w = Vector3d::Zero();
        for (const std::vector<int>& leg : legs_) {
            const Vector3d down_w = (position_of(pose_w, leg[2]) - position_of(pose_w, leg[0])).normalized();
            if (down_w.dot(up_w) > kLeaning) return "a foot is above its hip";
            if (down_w.dot(other_w) < -kLeaning) return "the legs point apart";
            other_w = down_w;
        }
        return {};
    }
    // How far legs and feet are from each other's mirror images, in degrees: much in mid-step, little at rest.
    double unlikeness_deg(const Poses& pose_w) const
    {
        if (legs_.size() < 2) return 0;
        const Vector3d across_w = (position_of(pose_w, legs_[0][0]) - position_of(pose_w, legs_[1][0])).normalized();
        double max_deg = 0;
        for (std::size_t n = 0; n + 1 < std::min(legs_[0].size(), legs_[1].size()); ++n) {
            const auto bone_w = [&](const std::vector<int>& leg) -> Vector3d {
                return position_of(pose_w, leg[n + 1]) - position_of(pose_w, leg[n]);
            };
            const Vector3d left_w = bone_w(legs_[0]);
            const Vector3d image_w = left_w - 2 * left_w.dot(across_w) * across_w;
            max_deg = std::max(max_deg, degrees_between(image_w, bone_w(legs_[1])));
        }
        return max_deg;
    }

private:
    // The middle of the legs' hips (0), knees or ankles (2).
    Vector3d middle_w(const Poses& pose_w, std::size_t part) const
    {
        Vector3d sum_w = Vector3d::Zero();
        for (const std::vector<int>& leg : legs_) sum_w += position_of(pose_w, leg[part]);
        return sum_w / std::max(1.0, static_cast<double>(legs_.size()));
    }
    Vector3d top_w(const Poses& pose_w) const
    {
        if (tops_.empty()) return middle_w(pose_w, 0);
        Vector3d sum_w = Vector3d::Zero();
        for (const int joint : tops_) sum_w += position_of(pose_w, joint);
        return sum_w / static_cast<double>(tops_.size());
    }

    std::vector<int> tops_;               // both shoulders, or else the head
    std::vector<std::vector<int>> legs_;  // hip, knee and ankle, and the toe where it is known
};

// The mean direction from feet to shoulders in all frames, the shorter the less they agree; zero where no leg is known.
Vector3d mean_height_w(const Clip& clip, const UprightParts& body)
{
    Vector3d sum_w = Vector3d::Zero();
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
        sum_w += body.height_w(formats::world_pose(clip, frame)).normalized();
    return sum_w / std::max(1.0, static_cast<double>(clip.frame_count));
}

// Files stand along +Y or +Z at rest, or else as their frames do. Empty for one that does.
std::string problem_of_up(const Vector3d& axis_w, const Vector3d& height_w)
{
    if (axis_w == Vector3d::UnitY() || axis_w == Vector3d::UnitZ() || height_w.dot(axis_w) > kLeaning) return {};
    return fmt::format("its trunk points along {}, and that of its frames does not", axis_name(axis_w));
}

// The number of frames where none is upright.
std::size_t most_upright_frame(const Clip& clip, const UprightParts& body, const Vector3d& up_w)
{
    Peak best{clip.frame_count, kLeaning};
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
        best.raise(frame, body.uprightness(formats::world_pose(clip, frame), up_w));
    return best.frame;
}

// Turns a joint, and all below it, at rest.
void turn_at_rest(Clip& clip, int joint, const Quaterniond& turn_w)
{
    const int parent = joint_at(clip, joint).parent;
    const formats::JointPose above_w =
        parent < 0 ? formats::JointPose() : formats::rest_pose(clip)[static_cast<std::size_t>(parent)];
    const Quaterniond turn = above_w.rotation.conjugate() * turn_w * above_w.rotation;
    Quaterniond& rotation = clip.joints[static_cast<std::size_t>(joint)].rest_rotation;
    rotation = ((above_w.mirrored ? formats::mirrored(turn) : turn) * rotation).normalized();
}

// Makes a pose in mid-step one to start from: the figure faces the front, its hips, shoulders and feet are square to
// it, and all bones of its back are upright, from the lowest joint of the spine to the head.
void straighten(Clip& clip, const KnownLimbs& limbs, const Vector3d& up_w)
{
    const std::vector<BodyPart> parts = body_parts(clip, limbs);
    const int hips = first_joint(parts, "hips");
    const std::vector<int> spine = joints_of(parts, "spine");
    const bool has_trunk = limbs[0] && limbs[1] && limbs[2] && limbs[3] && hips >= 0 && !spine.empty();
    if (!has_trunk) return;
    const auto position_w = [&](int joint) -> Vector3d { return position_of(formats::rest_pose(clip), joint); };
    const auto to_left_w = [&](std::size_t pair) -> Vector3d {
        return position_w((*limbs[pair])[0]) - position_w((*limbs[pair + 1])[0]);
    };
    // The turn about up that brings the level part of one direction to that of the other.
    const auto yaw = [&](const Vector3d& from_w, const Vector3d& to_w) {
        const double along = from_w.dot(to_w) - from_w.dot(up_w) * to_w.dot(up_w);
        return Quaterniond(Eigen::AngleAxisd(std::atan2(up_w.dot(from_w.cross(to_w)), along), up_w));
    };
    const Vector3d front_w = up_w.z() == 0 ? Vector3d::UnitZ() : Vector3d(-Vector3d::UnitY());
    const bool is_mirrored = formats::rest_pose(clip)[static_cast<std::size_t>(hips)].mirrored;
    turn_at_rest(clip, root_of(clip, hips), yaw(to_left_w(2), (is_mirrored ? -1 : 1) * up_w.cross(front_w)));
    std::vector<int> back = spine;
    for (const char* part : {"neck", "head"})
        for (const int joint : joints_of(parts, part)) back.push_back(joint);
    for (std::size_t n = 0; n + 1 < back.size(); ++n)
        turn_at_rest(clip, back[n], aim(position_w(back[n + 1]) - position_w(back[n]), up_w));
    turn_at_rest(clip, spine.back(), yaw(to_left_w(0), to_left_w(2)));
    for (const std::size_t leg : {2u, 3u}) {
        const int foot = (*limbs[leg])[2], toe = toe_of(clip, formats::kLimbNames[leg].side, foot);
        if (toe >= 0) turn_at_rest(clip, foot, yaw(position_w(toe) - position_w(foot), front_w));
    }
}

// The joints rest as in this frame, straightened.
void take_frame(Clip& clip, const KnownLimbs& limbs, std::size_t frame, const Vector3d& up_w)
{
    for (std::size_t n = 0; n < clip.joints.size(); ++n) {
        formats::Joint& joint = clip.joints[n];
        joint.unkeyed = pose_without_keys(joint);
        joint.rest_rotation = clip.rotation[frame * clip.joints.size() + n];
    }
    straighten(clip, limbs, up_w);
}

// The median ratio of the limbs' bone lengths, first frame to rest, without bones of no length in that frame. Infinite
// for bones of no length at rest, 1 without bones.
double change_of_length(const Clip& clip, const KnownLimbs& limbs)
{
    const Poses rest_w = formats::rest_pose(clip), first_w = formats::world_pose(clip, 0);
    std::vector<double> changes;
    for (const auto& limb : limbs)
        for (std::size_t n = 0; limb && n < 2; ++n) {
            const auto length = [&](const Poses& pose_w) {
                return (position_of(pose_w, (*limb)[n + 1]) - position_of(pose_w, (*limb)[n])).norm();
            };
            if (length(first_w) > 0) changes.push_back(length(first_w) / length(rest_w));
        }
    return changes.empty() ? 1 : quantile(changes, 0.5);
}

}  // namespace

std::string stand_at_rest(Clip& clip, const KnownLimbs& limbs, const RestChoice& choice)
{
    const UprightParts body(clip, limbs);
    if (choice.frame && *choice.frame >= clip.frame_count)
        throw CannotBind(fmt::format("--rest {}: it has {} frames", *choice.frame, clip.frame_count),
                         "frames count from 0");
    const Poses rest_w = formats::rest_pose(clip);
    const Vector3d height_w = mean_height_w(clip, body), rest_up_w = facing_of(clip, limbs).up_w;
    std::string problem = body.problem(rest_w, rest_up_w);
    const bool is_needed = !problem.empty() || choice.frame || choice.up_w;
    const bool has_motion = clip.frame_count > 1;
    if (problem.empty() && has_motion) problem = problem_of_up(nearest_axis(rest_up_w), height_w);
    if (const double apart = body.unlikeness_deg(rest_w); problem.empty() && has_motion && apart > kUnlike_deg)
        problem = fmt::format("its legs differ by {:.0f} degrees, as in mid-step", apart);
    if (problem.empty() && !is_needed) return {};
    const Vector3d frames_up_w = height_w.isZero(0) ? Vector3d(Vector3d::UnitY()) : nearest_axis(height_w);
    const Vector3d up_w = choice.up_w ? *choice.up_w : frames_up_w;
    const std::size_t frame = choice.frame ? *choice.frame : most_upright_frame(clip, body, up_w);
    if (frame == clip.frame_count && !is_needed) return {};
    if (frame == clip.frame_count)
        throw CannotBind(
            fmt::format("{}no frame stands along {}",
                        problem.empty() ? "" : fmt::format("its rest pose cannot stand, {}, and ", problem),
                        axis_name(up_w)),
            choice.up_w ? "--rest says which frame is the rest pose, besides --up"
                        : "--up says which way is up, and --rest which frame is the rest pose");
    take_frame(clip, limbs, frame, up_w);
    return fmt::format("{}frame {} is taken as the rest pose, and {} is up",
                       problem.empty() ? "" : fmt::format("the file's rest pose cannot stand, {}: ", problem), frame,
                       axis_name(up_w));
}

std::string size_at_rest(Clip& clip, const KnownLimbs& limbs)
{
    const int hips = first_joint(body_parts(clip, limbs), "hips");
    if (hips < 0 || clip.frame_count == 0) return {};
    const double change = change_of_length(clip, limbs);
    if (std::abs(change - 1) <= kChanged) return {};
    for (std::size_t n = 0; n < clip.joints.size(); ++n) {
        formats::Joint& joint = clip.joints[n];
        joint.unkeyed = pose_without_keys(joint);
        if (is_above(clip, hips, static_cast<int>(n))) joint.offset = formats::local_translation(clip, 0, n);
        joint.rest_scale = formats::local_scale(clip, 0, n);
    }
    return std::isinf(change)
               ? "at rest the clip's bones have no length; those of its first frame are taken"
               : fmt::format("the clip's bones are {:.3g} times as long as at rest; those of its first frame are taken",
                             change);
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
#include "tools/rig/standing_rest.h"

#include <fmt/format.h>

#include <algorithm>
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
using Poses = std::vector<formats::JointPose>;

constexpr double kLeaning = 0.5;  // the cosine of 60 degrees

// What is upright in a figure that stands, as directions that then point up.
class UprightParts {
public:
    UprightParts(const Clip& clip, const KnownLimbs& limbs)
    {
        const std::vector<int> head = joints_of(body_parts(clip, limbs), "head");
        for (const std::size_t arm : {0u, 1u})
            if (limbs[arm]) tops_.push_back((*limbs[arm])[0]);
        if (tops_.size() < 2) tops_ = head;
        for (const std::size_t leg : {2u, 3u})
            if (limbs[leg]) legs_.push_back(*limbs[leg]);
    }

    // From the middle of the feet to the shoulders, or else to the head or the hips; zero where no leg is known.
    Vector3d height_w(const Poses& pose_w) const
    {
        return legs_.empty() ? Vector3d(Vector3d::Zero()) : Vector3d(top_w(pose_w) - middle_w(pose_w, 2));
    }
    // How upright the least upright part is: 1 for a figure that stands to attention, -1 where no leg is known.
    double uprightness(const Poses& pose_w, const Vector3d& up_w) const
    {
        if (legs_.empty()) return -1;
        double least = 1;
        const auto add = [&](const Vector3d& way_w) { least = std::min(least, way_w.normalized().dot(up_w)); };
        if (!tops_.empty()) add(top_w(pose_w) - middle_w(pose_w, 0));
        for (const LimbJoints& leg : legs_) {
            add(place(pose_w, leg[0]) - place(pose_w, leg[1]));
            add(place(pose_w, leg[1]) - place(pose_w, leg[2]));
        }
        return least;
    }
    // Why a rest pose cannot be one; empty if it can.
    std::string problem(const Poses& pose_w, const Vector3d& up_w) const
    {
        Vector3d other_w = Vector3d::Zero();
        for (const LimbJoints& leg : legs_) {
            const Vector3d down_w = (place(pose_w, leg[2]) - place(pose_w, leg[0])).normalized();
            if (down_w.dot(up_w) > kLeaning) return "a foot is above its hip";
            if (down_w.dot(other_w) < -kLeaning) return "the legs point apart";
            other_w = down_w;
        }
        return {};
    }

private:
    static const Vector3d& place(const Poses& pose_w, int joint)
    {
        return pose_w[static_cast<std::size_t>(joint)].position;
    }
    // The middle of the legs' hips (0), knees or ankles (2).
    Vector3d middle_w(const Poses& pose_w, std::size_t part) const
    {
        Vector3d sum_w = Vector3d::Zero();
        for (const LimbJoints& leg : legs_) sum_w += place(pose_w, leg[part]);
        return sum_w / std::max(1.0, static_cast<double>(legs_.size()));
    }
    Vector3d top_w(const Poses& pose_w) const
    {
        if (tops_.empty()) return middle_w(pose_w, 0);
        Vector3d sum_w = Vector3d::Zero();
        for (const int joint : tops_) sum_w += place(pose_w, joint);
        return sum_w / static_cast<double>(tops_.size());
    }

    std::vector<int> tops_;  // both shoulders, or else the head
    std::vector<LimbJoints> legs_;
};

// +Y, as facing_of() has it, where no leg is known.
Vector3d up_of_frames(const Clip& clip, const UprightParts& body)
{
    Vector3d sum_w = Vector3d::Zero();
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
        sum_w += body.height_w(formats::world_pose(clip, frame)).normalized();
    return sum_w.isZero(0) ? Vector3d(Vector3d::UnitY()) : nearest_axis(sum_w);
}

// Of no frames, nothing stands: the one after the last.
std::size_t most_upright_frame(const Clip& clip, const UprightParts& body, const Vector3d& up_w)
{
    double most = kLeaning;
    std::size_t best = clip.frame_count;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const double uprightness = body.uprightness(formats::world_pose(clip, frame), up_w);
        if (uprightness <= most) continue;
        most = uprightness;
        best = frame;
    }
    return best;
}

// Turns a joint, and all below it, at rest.
void turn_at_rest(Clip& clip, int joint, const Quaterniond& turn_w)
{
    const int parent = joint_at(clip, joint).parent;
    const Quaterniond above_w =
        parent < 0 ? Quaterniond::Identity() : formats::rest_pose(clip)[static_cast<std::size_t>(parent)].rotation;
    Quaterniond& rotation = clip.joints[static_cast<std::size_t>(joint)].rest_rotation;
    rotation = (above_w.conjugate() * turn_w * above_w * rotation).normalized();
}

// A pose in mid-step made one to start from: the figure faces the front, its hips and shoulders are square to it, and
// all bones of its back are upright.
class Straightener {
public:
    Straightener(Clip& clip, const KnownLimbs& limbs, const Vector3d& up_w) : clip_(clip), limbs_(limbs), up_w_(up_w) {}

    void straighten()
    {
        const std::vector<BodyPart> parts = body_parts(clip_, limbs_);
        const std::vector<int> hips = joints_of(parts, "hips"), spine = joints_of(parts, "spine");
        if (!has(0) || !has(2) || hips.empty() || spine.empty()) return;  // there is no trunk
        int root = hips[0];
        while (joint_at(clip_, root).parent >= 0) root = joint_at(clip_, root).parent;
        const Vector3d front_w = up_w_.z() == 0 ? Vector3d::UnitZ() : Vector3d(-Vector3d::UnitY());
        turn_at_rest(clip_, root, aim(level(to_left_w(2)), up_w_.cross(front_w)));
        std::vector<int> back = spine;
        for (const char* part : {"neck", "head"})
            for (const int joint : joints_of(parts, part)) back.push_back(joint);
        for (std::size_t n = 0; n + 1 < back.size(); ++n)
            turn_at_rest(clip_, back[n], aim(place_w(back[n + 1]) - place_w(back[n]), up_w_));
        turn_at_rest(clip_, spine.back(), aim(level(to_left_w(0)), level(to_left_w(2))));
    }

private:
    bool has(std::size_t pair) const { return limbs_[pair] && limbs_[pair + 1]; }
    Vector3d place_w(int joint) const { return formats::rest_pose(clip_)[static_cast<std::size_t>(joint)].position; }
    Vector3d start_w(std::size_t limb) const { return place_w((*limbs_[limb])[0]); }
    Vector3d to_left_w(std::size_t pair) const { return start_w(pair) - start_w(pair + 1); }
    Vector3d level(const Vector3d& way_w) const { return way_w - way_w.dot(up_w_) * up_w_; }

    Clip& clip_;
    const KnownLimbs& limbs_;
    const Vector3d up_w_;
};

// The joints rest as in this frame, straightened.
void take_frame(Clip& clip, const KnownLimbs& limbs, std::size_t frame, const Vector3d& up_w)
{
    for (std::size_t n = 0; n < clip.joints.size(); ++n) {
        formats::Joint& joint = clip.joints[n];
        joint.unkeyed = pose_without_keys(joint);
        joint.rest_rotation = clip.rotation[frame * clip.joints.size() + n];
    }
    Straightener(clip, limbs, up_w).straighten();
}

// How long the first bone of a limb is in the first frame that is not within a tenth of its length at rest; as a share
// of that. 1 if there is none.
double change_of_length(const Clip& clip, const KnownLimbs& limbs)
{
    const Poses rest_w = formats::rest_pose(clip), first_w = formats::world_pose(clip, 0);
    const auto length = [](const Poses& pose_w, int from, int to) {
        return (pose_w[static_cast<std::size_t>(to)].position - pose_w[static_cast<std::size_t>(from)].position).norm();
    };
    for (const auto& limb : limbs)
        for (std::size_t n = 0; limb && n < 2; ++n) {
            const double change =
                length(first_w, (*limb)[n], (*limb)[n + 1]) / length(rest_w, (*limb)[n], (*limb)[n + 1]);
            if (!(std::abs(change - 1) < 0.1)) return change;
        }
    return 1;
}

}  // namespace

std::string stand_at_rest(Clip& clip, const KnownLimbs& limbs, const RestChoice& choice)
{
    const UprightParts body(clip, limbs);
    if (choice.frame && *choice.frame >= clip.frame_count)
        throw CannotBind(fmt::format("--rest {}: it has {} frames", *choice.frame, clip.frame_count),
                         "frames count from 0");
    const std::string problem = body.problem(formats::rest_pose(clip), facing_of(clip, limbs).up_w);
    if (problem.empty() && !choice.frame && !choice.up_w) return {};
    const Vector3d up_w = choice.up_w ? *choice.up_w : up_of_frames(clip, body);
    const std::size_t frame = choice.frame ? *choice.frame : most_upright_frame(clip, body, up_w);
    if (frame == clip.frame_count)
        throw CannotBind(
            fmt::format("{}no frame stands along {}",
                        problem.empty() ? "" : fmt::format("its rest pose cannot stand, {}, and ", problem),
                        axis_name(up_w)),
            "say which way is up by --up AXIS, or which frame is the rest pose by --rest FRAME");
    take_frame(clip, limbs, frame, up_w);
    return fmt::format("{}frame {} is taken as the rest pose, and {} is up",
                       problem.empty() ? "" : fmt::format("the file's rest pose cannot stand, {}: ", problem), frame,
                       axis_name(up_w));
}

std::string size_at_rest(Clip& clip, const KnownLimbs& limbs)
{
    const std::vector<int> hips = joints_of(body_parts(clip, limbs), "hips");
    if (hips.empty() || clip.frame_count == 0) return {};
    const double change = change_of_length(clip, limbs);
    if (change == 1) return {};
    for (std::size_t n = 0; n < clip.joints.size(); ++n) {
        formats::Joint& joint = clip.joints[n];
        joint.unkeyed = pose_without_keys(joint);
        if (is_above(clip, hips[0], static_cast<int>(n))) joint.offset = formats::local_translation(clip, 0, n);
        if (joint.scale_track >= 0) joint.rest_scale = clip.scale[static_cast<std::size_t>(joint.scale_track)];
    }
    return fmt::format("the clip's bones are {:.3g} times as long as at rest; those of its first frame are taken",
                       change);
}

}  // namespace swivel::tools

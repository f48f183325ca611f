// SPDX-License-Identifier: MIT
#include "tools/rig/clip_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/rig/facing.h"
#include "tools/rig/limb_chain.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using Places = BodyFrames::Places;

constexpr double kOtherLength = 1.1;  // a bone beside the other side's, or beside its own at rest
constexpr double kBent_deg = 20;      // a knee or an elbow that shows which way it bends
constexpr double kBackwards = 0.3;    // the sine of 17 degrees: of a limb that bends the wrong way

class BodyJudge {
public:
    explicit BodyJudge(const BodyFrames& body) : body_(body) {}

    std::vector<ClipDoubt> judge()
    {
        judge_up();
        if (!doubts_.all.empty()) return std::move(doubts_.all);
        judge_sides();
        judge_exchange();
        judge_bends();
        return std::move(doubts_.all);
    }

private:
    Vector3d level(const Vector3d& way_w) const { return way_w - way_w.dot(body_.up_w()) * body_.up_w(); }

    void judge_sides()
    {
        for (const std::size_t pair : {0u, 2u})
            for (std::size_t bone = 0; body_.has(pair) && bone < 2; ++bone) {
                const double left = body_.bone_w(body_.rest_w(), pair, bone).norm(),
                             right = body_.bone_w(body_.rest_w(), pair + 1, bone).norm();
                if (is_other_length(left, right))
                    doubts_.look("the left {} is {:.2f} times as long as the right one", bone_name(pair, bone),
                                 left / right);
            }
    }
    void judge_exchange()
    {
        if (!body_.has(2)) return;
        std::array<SomeFrames, 2> feet{SomeFrames{body_.count()}, SomeFrames{body_.count()}};
        for (std::size_t side = 0; side < 2; ++side)
            if (body_.has_toes(side))
                feet[side] = body_.where([&](const Places& places_w) {
                    return level(body_.toe_way_w(places_w, side)).dot(body_.front_w(places_w, 2)) < 0;
                });
        // A runner's foot points back in up to a third of the frames.
        const bool is_left = feet[0].are_over(0.5), is_right = feet[1].are_over(0.5);
        if (is_left && is_right)
            doubts_.garbage("the left leg is on the right of where the toes point {}", feet[0].words());
        else if (is_left || is_right)
            doubts_.garbage("the {} foot points backwards {}", is_left ? "left" : "right",
                            feet[is_left ? 0 : 1].words());
        if (!body_.has(0)) return;
        const SomeFrames arms = body_.where(
            [&](const Places& places_w) { return body_.to_left_w(places_w, 0).dot(body_.to_left_w(places_w, 2)) < 0; });
        if (arms.are_over(0.5)) doubts_.garbage("the left arm is on the side of the right leg {}", arms.words());
    }
    // How far a limb bends the way that people's do: 1 as theirs, -1 the other way, 0 where it is too straight to tell.
    // In a limb that hangs, the axis of a knee points to the left and that of an elbow to the right; the limb takes the
    // axis along, on the shortest way. Above the shoulder an arm may turn any way, but bends forwards.
    double bend(const Places& places_w, std::size_t limb) const
    {
        const std::size_t pair = limb / 2 * 2;
        const Vector3d upper_w = body_.bone_w(places_w, limb, 0).normalized(),
                       lower_w = body_.bone_w(places_w, limb, 1).normalized();
        const Vector3d down_w = down(places_w), left = body_.left_w(places_w, pair);
        if (degrees_between(upper_w, lower_w) < kBent_deg) return 0;
        const Vector3d across_w = (lower_w - lower_w.dot(upper_w) * upper_w).normalized();
        if (upper_w.dot(down_w) < 0) return across_w.dot(left.cross(-down_w));
        const Vector3d axis_w = (pair == 0 ? -1 : 1) * (aim(down_w, upper_w) * left);
        return upper_w.cross(across_w).dot(axis_w);
    }
    // From the shoulders to the hip joints, else away from up.
    Vector3d down(const Places& places_w) const
    {
        if (!body_.has(0) || !body_.has(2)) return -body_.up_w();
        const auto sum_w = [&](std::size_t pair) -> Vector3d {
            return body_.place(places_w, (*body_.limbs()[pair])[0]) +
                   body_.place(places_w, (*body_.limbs()[pair + 1])[0]);
        };
        return (sum_w(2) - sum_w(0)).normalized();
    }
    void judge_bends()
    {
        for (std::size_t limb = 0; limb < body_.limbs().size(); ++limb) {
            if (!body_.has(limb / 2 * 2)) continue;
            const SomeFrames wrong =
                body_.where([&](const Places& places_w) { return bend(places_w, limb) < -kBackwards; });
            if (wrong.are_over(kMostly))
                doubts_.garbage("the {} {} bends {} {}", side_name(formats::kLimbNames[limb].side),
                                words_of(formats::kLimbNames[limb].kind).lower_joint,
                                limb < 2 ? "backwards" : "forwards", wrong.words());
        }
    }
    void judge_up()
    {
        if (!body_.has(0) || !body_.has(2)) return;
        Vector3d sum_w = Vector3d::Zero();
        for (const Places& places_w : body_.frames_w()) {
            Vector3d height_w = Vector3d::Zero();
            for (std::size_t side = 0; side < 2; ++side)
                height_w += body_.place(places_w, (*body_.limbs()[side])[0]) -
                            body_.place(places_w, (*body_.limbs()[2 + side])[2]);
            sum_w += height_w.normalized();
        }
        const Vector3d mean_w = sum_w / static_cast<double>(body_.count());
        const Vector3d axis_w = nearest_axis(mean_w);
        if (axis_w != body_.up_w() && mean_w.dot(axis_w) > 0.8)
            doubts_.look(
                "heads are above feet along {} in its frames and along {} in its rest pose; --up or --rest says "
                "which is right",
                axis_name(axis_w), axis_name(body_.up_w()));
        else if (body_.up_w().y() + body_.up_w().z() != 1 && mean_w.dot(body_.up_w()) < 0.5)
            doubts_.look(
                "heads are above feet along {} in its rest pose and not in its frames; --up and --rest say what "
                "is right",
                axis_name(body_.up_w()));
        for (ClipDoubt& each : doubts_.all) each.is_up_wrong = true;
    }

    const BodyFrames& body_;
    DoubtList doubts_;
};

}  // namespace

using formats::Clip;

std::vector<std::string> texts_of(const std::vector<ClipDoubt>& doubts)
{
    std::vector<std::string> texts;
    for (const ClipDoubt& doubt : doubts) texts.push_back(doubt.text);
    return texts;
}

std::string SomeFrames::words() const { return fmt::format("in {} of {} frames, from frame {}", count, all, first); }

BodyFrames::BodyFrames(const Clip& clip, const std::vector<BodyPart>& parts)
    : clip_(clip),
      parts_(parts),
      limbs_(limbs_of(parts)),
      up_w_(nearest_axis(facing_of(clip, limbs_).up_w)),
      hips_(first_joint(parts, "hips")),
      slots_(clip.joints.size())
{
    for (std::size_t side = 0; side < 2; ++side) toes_[side] = first_joint(parts, side == 0 ? "leftToes" : "rightToes");
    const std::vector<formats::JointPose> rest_w = formats::rest_pose(clip);
    is_mirrored_ = hips_ >= 0 && rest_w[static_cast<std::size_t>(hips_)].mirrored;
    const auto see = [&](int joint) {
        if (joint < 0) return;
        slots_[static_cast<std::size_t>(joint)] = seen_.size();
        seen_.push_back(static_cast<std::size_t>(joint));
    };
    for (const auto& limb : limbs_)
        for (std::size_t n = 0; limb && n < 3; ++n) see((*limb)[n]);
    for (const int joint : {toes_[0], toes_[1], hips_}) see(joint);
    rest_w_ = places_of(rest_w);
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
        frames_w_.push_back(places_of(formats::world_pose(clip, frame)));
}

double BodyFrames::leg_length() const
{
    const std::size_t leg = limbs_[2] ? 2 : 3;
    return bone_w(rest_w_, leg, 0).norm() + bone_w(rest_w_, leg, 1).norm();
}

BodyFrames::Places BodyFrames::places_of(const std::vector<formats::JointPose>& pose_w) const
{
    Places places_w;
    for (const std::size_t joint : seen_) places_w.push_back(pose_w[joint].position);
    return places_w;
}

std::string_view bone_name(std::size_t limb, std::size_t bone)
{
    const LimbWords& words = words_of(formats::kLimbNames[limb].kind);
    return bone == 0 ? words.upper : words.lower;
}

bool is_other_length(double a, double b) { return a > 0 && b > 0 && std::max(a, b) > kOtherLength * std::min(a, b); }

std::vector<ClipDoubt> body_doubts(const BodyFrames& body)
{
    return body.count() == 0 ? std::vector<ClipDoubt>() : BodyJudge(body).judge();
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
#include "tools/rig/clip_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tools/rig/facing.h"
#include "tools/rig/limb_chain.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;

constexpr double kOtherLength = 1.1;              // a bone beside the other side's, or beside its own at rest
constexpr double kMostly = 0.25;                  // of the frames
constexpr double kBent_deg = 20;                  // a knee or an elbow that shows which way it bends
constexpr double kBackwards = 0.3;                // the sine of 17 degrees: of a limb that bends the wrong way
constexpr double kBehind = 0.75;                  // the sine of 49 degrees: an upper arm that points backwards
constexpr double kPop_deg = 10;                   // out of the middle of the frames beside it,
constexpr double kPopRatio = 4;                   // and this much further than in the frames around
constexpr double kJump = 200;                     // leg lengths/s^2, 17 times what falls; a landing has 100 at most
constexpr double kSeen = 0.05;                    // leg lengths: a jump that people see
constexpr double kStill_deg = 0.1;                // a limb that does not move, while the other
constexpr double kMoved_deg = 10;                 // turns by this
constexpr double kSunk = 0.03, kElsewhere = 0.5;  // leg lengths below height 0; a body that is about another height

std::string_view bone_name(std::size_t limb, std::size_t bone)
{
    const LimbWords& words = words_of(formats::kLimbNames[limb].kind);
    return bone == 0 ? words.upper : words.lower;
}

// A bone of no length tells nothing.
bool is_other_length(double a, double b) { return a > 0 && b > 0 && std::max(a, b) > kOtherLength * std::min(a, b); }

// In which frames something is so.
struct Frames {
    std::size_t count = 0, first = 0;

    void add(std::size_t frame)
    {
        if (count++ == 0) first = frame;
    }
    std::string words(std::size_t all) const
    {
        return fmt::format("in {} of {} frames, from frame {}", count, all, first);
    }
};

// What is asked of a pose: where the joints of limbs, toes and hips are, in ClipJudge::seen_'s order.
using BodyMoment = std::vector<Vector3d>;

class ClipJudge {
public:
    ClipJudge(const Clip& clip, const std::vector<BodyPart>& parts)
        : clip_(clip), parts_(parts), limbs_(limbs_of(parts)), up_w_(nearest_axis(facing_of(clip, limbs_).up_w))
    {
        for (std::size_t side = 0; side < 2; ++side)
            if (const std::vector<int> toes = joints_of(parts, side == 0 ? "leftToes" : "rightToes"); !toes.empty())
                toes_[side] = toes.front();
        if (const std::vector<int> hips = joints_of(parts, "hips"); !hips.empty()) {
            hips_ = hips.front();
            is_mirrored_ = formats::rest_pose(clip)[static_cast<std::size_t>(hips_)].mirrored;
        }
        slots_.resize(clip.joints.size());
        for (const auto& limb : limbs_)
            for (std::size_t n = 0; limb && n < 3; ++n) see((*limb)[n]);
        for (const int joint : {toes_[0], toes_[1], hips_}) see(joint);
        rest_w_ = moment_of(formats::rest_pose(clip));
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
            poses_w_.push_back(moment_of(formats::world_pose(clip, frame)));
    }

    // of_motion: of the motion, too, and not of the body alone.
    std::vector<std::string> judge(bool of_motion)
    {
        judge_up();
        if (!doubts_.empty()) return std::move(doubts_);  // all else would follow from it
        judge_sides();
        judge_exchange();
        judge_bends();
        if (of_motion) {
            judge_arms();
            judge_lengths();
            judge_pops();
            judge_first_frame();
            judge_jumps();
            judge_stillness();
            judge_height();
        }
        return std::move(doubts_);
    }

private:
    template <class... Words>
    void doubt(fmt::format_string<Words...> text, Words&&... words)
    {
        doubts_.push_back(fmt::format(text, std::forward<Words>(words)...));
    }
    void see(int joint)
    {
        if (joint < 0) return;
        slots_[static_cast<std::size_t>(joint)] = seen_.size();
        seen_.push_back(static_cast<std::size_t>(joint));
    }
    BodyMoment moment_of(const std::vector<formats::JointPose>& pose_w) const
    {
        BodyMoment moment;
        for (const std::size_t joint : seen_) moment.push_back(pose_w[joint].position);
        return moment;
    }
    std::size_t count() const { return clip_.frame_count; }
    bool has(std::size_t pair) const { return limbs_[pair] && limbs_[pair + 1]; }
    bool has_toes(std::size_t side) const { return limbs_[2 + side] && toes_[side] >= 0; }
    const Vector3d& place(const BodyMoment& pose_w, int joint) const
    {
        return pose_w[slots_[static_cast<std::size_t>(joint)]];
    }
    Vector3d bone_w(const BodyMoment& pose_w, std::size_t limb, std::size_t bone) const
    {
        return place(pose_w, (*limbs_[limb])[bone + 1]) - place(pose_w, (*limbs_[limb])[bone]);
    }
    Vector3d to_left_w(const BodyMoment& pose_w, std::size_t pair) const
    {
        return place(pose_w, (*limbs_[pair])[0]) - place(pose_w, (*limbs_[pair + 1])[0]);
    }
    // To the left of where a pair of limbs faces, unit.
    Vector3d left_w(const BodyMoment& pose_w, std::size_t pair) const
    {
        return (is_mirrored_ ? -1 : 1) * to_left_w(pose_w, pair).normalized();
    }
    Vector3d toe_way_w(const BodyMoment& pose_w, std::size_t side) const
    {
        return place(pose_w, toes_[side]) - place(pose_w, (*limbs_[2 + side])[2]);
    }
    Vector3d level(const Vector3d& way_w) const { return way_w - way_w.dot(up_w_) * up_w_; }
    double leg_length() const
    {
        const std::size_t leg = limbs_[2] ? 2 : 3;
        return bone_w(rest_w_, leg, 0).norm() + bone_w(rest_w_, leg, 1).norm();
    }

    // The frames of which this is so.
    template <class IsSo>
    Frames frames_where(const IsSo& is_so) const
    {
        Frames frames;
        for (std::size_t frame = 0; frame < count(); ++frame)
            if (is_so(poses_w_[frame])) frames.add(frame);
        return frames;
    }
    bool is_mostly(const Frames& frames) const
    {
        return static_cast<double>(frames.count) > kMostly * static_cast<double>(count());
    }
    bool is_in_half(const Frames& frames) const { return 2 * frames.count > count(); }
    static const char* side_of_limb(std::size_t limb) { return limb % 2 == 0 ? "left" : "right"; }

    void judge_sides()
    {
        for (const std::size_t pair : {0u, 2u})
            for (std::size_t bone = 0; has(pair) && bone < 2; ++bone) {
                const double left = bone_w(rest_w_, pair, bone).norm(), right = bone_w(rest_w_, pair + 1, bone).norm();
                if (is_other_length(left, right))
                    doubt("the left {} is {:.2f} times as long as the right one", bone_name(pair, bone), left / right);
            }
    }
    void judge_lengths()
    {
        for (std::size_t limb = 0; limb < limbs_.size(); ++limb)
            for (std::size_t bone = 0; limbs_[limb] && bone < 2; ++bone) {
                const double at_rest = bone_w(rest_w_, limb, bone).norm();
                const Frames frames = frames_where([&](const BodyMoment& pose_w) {
                    return is_other_length(bone_w(pose_w, limb, bone).norm(), at_rest);
                });
                if (frames.count > 0)
                    doubt("the {} {} is not as long as at rest {}", side_of_limb(limb), bone_name(limb, bone),
                          frames.words(count()));
            }
    }
    // Where hips or shoulders face, which a mirrored figure's left and right say the other way round.
    Vector3d front_w(const BodyMoment& pose_w, std::size_t pair) const
    {
        return left_w(pose_w, pair).cross(up_w_).normalized();
    }
    void judge_exchange()
    {
        if (!has(2)) return;
        std::array<Frames, 2> feet;
        for (std::size_t side = 0; side < 2; ++side)
            if (has_toes(side))
                feet[side] = frames_where([&](const BodyMoment& pose_w) {
                    return level(toe_way_w(pose_w, side)).dot(front_w(pose_w, 2)) < 0;
                });
        // A runner's foot points back in up to a third of the frames.
        const bool is_left = is_in_half(feet[0]), is_right = is_in_half(feet[1]);
        if (is_left && is_right)
            doubt("the left leg is on the right of where the toes point {}", feet[0].words(count()));
        else if (is_left || is_right)
            doubt("the {} foot points backwards {}", is_left ? "left" : "right", feet[is_left ? 0 : 1].words(count()));
        if (!has(0)) return;
        const Frames arms =
            frames_where([&](const BodyMoment& pose_w) { return to_left_w(pose_w, 0).dot(to_left_w(pose_w, 2)) < 0; });
        if (is_in_half(arms)) doubt("the left arm is on the side of the right leg {}", arms.words(count()));
    }
    // How far a limb bends the way that people's do: 1 as theirs, -1 the other way, 0 where it is too straight to tell.
    // In a limb that hangs, the axis of a knee points to the left and that of an elbow to the right; the limb takes the
    // axis along, on the shortest way. Above the shoulder an arm may turn any way, but bends forwards.
    double bend(const BodyMoment& pose_w, std::size_t limb) const
    {
        const std::size_t pair = limb / 2 * 2;
        const Vector3d upper_w = bone_w(pose_w, limb, 0).normalized(), lower_w = bone_w(pose_w, limb, 1).normalized();
        const Vector3d down_w = down(pose_w), left = left_w(pose_w, pair);
        if (degrees_between(upper_w, lower_w) < kBent_deg) return 0;
        const Vector3d across_w = (lower_w - lower_w.dot(upper_w) * upper_w).normalized();
        if (upper_w.dot(down_w) < 0) return across_w.dot(left.cross(-down_w));
        const Vector3d axis_w = (pair == 0 ? -1 : 1) * (aim(down_w, upper_w) * left);
        return upper_w.cross(across_w).dot(axis_w);
    }
    // From the shoulders to the hip joints, else away from up.
    Vector3d down(const BodyMoment& pose_w) const
    {
        if (!has(0) || !has(2)) return -up_w_;
        const auto sum_w = [&](std::size_t pair) -> Vector3d {
            return place(pose_w, (*limbs_[pair])[0]) + place(pose_w, (*limbs_[pair + 1])[0]);
        };
        return (sum_w(2) - sum_w(0)).normalized();
    }
    void judge_bends()
    {
        for (std::size_t limb = 0; limb < limbs_.size(); ++limb) {
            if (!has(limb / 2 * 2)) continue;
            const Frames wrong =
                frames_where([&](const BodyMoment& pose_w) { return bend(pose_w, limb) < -kBackwards; });
            if (is_mostly(wrong))
                doubt("the {} {} bends {} {}", side_of_limb(limb), words_of(formats::kLimbNames[limb].kind).lower_joint,
                      limb < 2 ? "backwards" : "forwards", wrong.words(count()));
        }
    }
    void judge_arms()
    {
        for (std::size_t arm = 0; has(0) && arm < 2; ++arm) {
            const Frames behind = frames_where([&](const BodyMoment& pose_w) {
                return bone_w(pose_w, arm, 0).normalized().dot(front_w(pose_w, 0)) < -kBehind;
            });
            if (is_mostly(behind))
                doubt("the {} upper arm points backwards {}", side_of_limb(arm), behind.words(count()));
            if (hips_ < 0) continue;
            const Frames inside = frames_where([&](const BodyMoment& pose_w) { return is_inside(pose_w, arm); });
            if (is_mostly(inside))
                doubt("the {} elbow is inside the trunk {}", side_of_limb(arm), inside.words(count()));
        }
    }
    // Whether the elbow is nearer to the line from hips to shoulders than half of the way to a shoulder.
    bool is_inside(const BodyMoment& pose_w, std::size_t arm) const
    {
        const Vector3d base_w = place(pose_w, hips_), way_w = place(pose_w, (*limbs_[arm])[1]) - base_w;
        const Vector3d back_w = (place(pose_w, (*limbs_[0])[0]) + place(pose_w, (*limbs_[1])[0])) / 2 - base_w;
        const double share = way_w.dot(back_w) / back_w.squaredNorm();
        return share > 0 && share < 1 && (way_w - share * back_w).norm() < to_left_w(pose_w, 0).norm() / 4;
    }
    // How far a joint turns against its parent between two frames.
    double turn_deg(std::size_t joint, std::size_t from, std::size_t to) const
    {
        const auto rotation = [&](std::size_t frame) { return clip_.rotation[frame * clip_.joints.size() + joint]; };
        return rotation(from).angularDistance(rotation(to)) * (180 / std::numbers::pi);
    }
    // How far a joint's own rotation in a frame is out of the middle of those before and after, in degrees.
    double out_of_middle_deg(std::size_t joint, std::size_t frame) const
    {
        if (frame == 0 || frame + 1 >= count()) return 0;
        const auto rotation = [&](std::size_t at) { return clip_.rotation[at * clip_.joints.size() + joint]; };
        const Quaterniond middle = rotation(frame - 1).slerp(0.5, rotation(frame + 1));
        return middle.angularDistance(rotation(frame)) * (180 / std::numbers::pi);
    }
    void judge_pops()
    {
        double most = 0;
        std::size_t worst_frame = 0;
        int worst = -1;
        for (const BodyPart& part : parts_)
            for (const int joint : part.joints)
                for (std::size_t frame = 2; frame + 1 < count(); ++frame) {
                    const auto at = static_cast<std::size_t>(joint);
                    const double out = out_of_middle_deg(at, frame);
                    if (out < kPop_deg || out <= most) continue;
                    if (turn_deg(at, frame - 1, frame + 1) > out) continue;  // it goes there alone
                    if (out < kPopRatio * std::max(out_of_middle_deg(at, frame - 2), out_of_middle_deg(at, frame + 2)))
                        continue;
                    most = out;
                    worst = joint;
                    worst_frame = frame;
                }
        if (worst >= 0)
            doubt("'{}' turns there and back, by {:.0f} degrees in frame {}", printable_name(joint_at(clip_, worst)),
                  most, worst_frame);
    }
    // Many files begin with a T-pose.
    void judge_first_frame()
    {
        if (count() < 3) return;
        double most = 0, after = 0;
        for (const BodyPart& part : parts_)
            for (const int joint : part.joints) {
                most = std::max(most, turn_deg(static_cast<std::size_t>(joint), 0, 1));
                after = std::max(after, turn_deg(static_cast<std::size_t>(joint), 1, 2));
            }
        if (most > 2 * kPop_deg && most > kPopRatio * after)
            doubt("frame 0 is a pose of its own: joints turn by up to {:.0f} degrees to frame 1, then by {:.1f}", most,
                  after);
    }
    // A body has weight: it gains speed over some frames.
    void judge_jumps()
    {
        if (hips_ < 0 || (!limbs_[2] && !limbs_[3])) return;
        double most = leg_length() * std::max(kSeen, kJump * clip_.frame_time * clip_.frame_time);
        std::size_t worst_frame = 0;
        for (std::size_t frame = 2; frame + 1 < count(); ++frame) {
            const auto hips_w = [&](std::size_t at) { return place(poses_w_[at], hips_); };
            const double change = (hips_w(frame + 1) - 2 * hips_w(frame) + hips_w(frame - 1)).norm();
            if (change <= most) continue;
            most = change;
            worst_frame = frame;
        }
        if (worst_frame > 0)
            doubt("the body jumps by {:.2f} leg lengths beside frame {}", most / leg_length(), worst_frame);
    }
    // The most that a limb's joints turn away from the first frame, in degrees.
    double movement_deg(std::size_t limb) const
    {
        double most = 0;
        for (const int joint : *limbs_[limb])
            for (std::size_t frame = 1; frame < count(); ++frame)
                most = std::max(most, turn_deg(static_cast<std::size_t>(joint), 0, frame));
        return most;
    }
    void judge_stillness()
    {
        for (std::size_t limb = 0; limb < limbs_.size(); ++limb) {
            const std::size_t other = limb ^ 1;
            if (!limbs_[limb] || !limbs_[other] || movement_deg(limb) > kStill_deg) continue;
            if (const double moves = movement_deg(other); moves > kMoved_deg)
                doubt("the {} {} never moves, the other turns by up to {:.0f} degrees", side_of_limb(limb),
                      words_of(formats::kLimbNames[limb].kind).limb, moves);
        }
    }
    void judge_height()
    {
        if (!limbs_[2] && !limbs_[3]) return;
        std::vector<double> heights;
        for (const BodyMoment& pose_w : poses_w_) {
            double lowest = HUGE_VAL;
            for (std::size_t side = 0; side < 2; ++side)
                if (limbs_[2 + side])
                    lowest = std::min(lowest,
                                      place(pose_w, has_toes(side) ? toes_[side] : (*limbs_[2 + side])[2]).dot(up_w_));
            heights.push_back(lowest);
        }
        if (heights.empty()) return;
        const double ground = quantile(heights, 0.05) / leg_length();
        if (ground < -kSunk && ground > -kElsewhere)
            doubt("its feet stand at a height of {:.2f} leg lengths, below 0", ground);
    }
    void judge_up()
    {
        if (!has(0) || !has(2)) return;
        Vector3d sum_w = Vector3d::Zero();
        for (const BodyMoment& pose_w : poses_w_) {
            Vector3d height_w = Vector3d::Zero();
            for (std::size_t side = 0; side < 2; ++side)
                height_w += place(pose_w, (*limbs_[side])[0]) - place(pose_w, (*limbs_[2 + side])[2]);
            sum_w += height_w.normalized();
        }
        const Vector3d mean_w = sum_w / static_cast<double>(count());
        const Vector3d axis_w = nearest_axis(mean_w);
        if (axis_w != up_w_ && mean_w.dot(axis_w) > 0.8)
            doubt(
                "heads are above feet along {} in its frames and along {} in its rest pose; --up or --rest says "
                "which is right",
                axis_name(axis_w), axis_name(up_w_));
        else if (up_w_.y() + up_w_.z() != 1 && mean_w.dot(up_w_) < 0.5)
            doubt(
                "heads are above feet along {} in its rest pose and not in its frames; --up and --rest say what is "
                "right",
                axis_name(up_w_));
    }

    const Clip& clip_;
    const std::vector<BodyPart>& parts_;
    const KnownLimbs limbs_;
    std::array<int, 2> toes_{-1, -1};
    const Vector3d up_w_;
    int hips_ = -1;
    bool is_mirrored_ = false;               // as a whole: its left side is on the right of where it faces
    std::vector<std::size_t> seen_, slots_;  // joints, and where each is among them
    BodyMoment rest_w_;
    std::vector<BodyMoment> poses_w_;
    std::vector<std::string> doubts_;
};

}  // namespace

std::vector<std::string> clip_doubts(const Clip& clip, const std::vector<BodyPart>& parts)
{
    if (clip.frame_count == 0) return {};
    return ClipJudge(clip, parts).judge(true);
}

std::vector<std::string> body_doubts(const Clip& clip, const std::vector<BodyPart>& parts)
{
    if (clip.frame_count == 0) return {};
    return ClipJudge(clip, parts).judge(false);
}

}  // namespace swivel::tools

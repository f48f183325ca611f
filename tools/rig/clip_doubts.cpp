// SPDX-License-Identifier: MIT
#include "tools/rig/clip_doubts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/rig/limb_words.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Places = BodyFrames::Places;

constexpr double kBehind = 0.75;                  // the sine of 49 degrees: an upper arm that points backwards
constexpr double kPop_deg = 10;                   // out of the middle of the frames beside it,
constexpr double kPopRatio = 4;                   // and this much further than in the frames around
constexpr double kJump = 200;                     // leg lengths/s^2, 17 times what falls; a landing has 100 at most
constexpr double kSeen = 0.05;                    // leg lengths: a jump that people see
constexpr double kStill_deg = 0.1;                // a limb that does not move, while the other
constexpr double kMoved_deg = 10;                 // turns by this
constexpr double kSunk = 0.03, kElsewhere = 0.5;  // leg lengths below height 0; a body that is about another height

class MotionJudge {
public:
    explicit MotionJudge(const BodyFrames& body) : body_(body) {}

    std::vector<ClipDoubt> judge()
    {
        judge_arms();
        judge_lengths();
        judge_pops();
        judge_first_frame();
        judge_jumps();
        judge_stillness();
        judge_height();
        return std::move(doubts_.all);
    }

private:
    void judge_lengths()
    {
        for (std::size_t limb = 0; limb < body_.limbs().size(); ++limb)
            for (std::size_t bone = 0; body_.limbs()[limb] && bone < 2; ++bone) {
                const double at_rest = body_.bone_w(body_.rest_w(), limb, bone).norm();
                const SomeFrames frames = body_.where([&](const Places& places_w) {
                    return is_other_length(body_.bone_w(places_w, limb, bone).norm(), at_rest);
                });
                if (frames.count > 0)
                    doubts_.look("the {} {} is not as long as at rest {}", side_name(formats::kLimbNames[limb].side),
                                 bone_name(limb, bone), frames.words());
            }
    }
    void judge_arms()
    {
        for (std::size_t arm = 0; body_.has(0) && arm < 2; ++arm) {
            const std::string_view side = side_name(formats::kLimbNames[arm].side);
            const SomeFrames behind = body_.where([&](const Places& places_w) {
                return body_.bone_w(places_w, arm, 0).normalized().dot(body_.front_w(places_w, 0)) < -kBehind;
            });
            if (behind.are_over(kMostly)) doubts_.look("the {} upper arm points backwards {}", side, behind.words());
            if (body_.hips() < 0) continue;
            const SomeFrames inside = body_.where([&](const Places& places_w) { return is_inside(places_w, arm); });
            if (inside.are_over(kMostly)) doubts_.garbage("the {} elbow is inside the trunk {}", side, inside.words());
        }
    }
    // Whether the elbow is nearer to the line from hips to shoulders than half of the way to a shoulder.
    bool is_inside(const Places& places_w, std::size_t arm) const
    {
        const Vector3d base_w = body_.place(places_w, body_.hips()),
                       way_w = body_.place(places_w, (*body_.limbs()[arm])[1]) - base_w;
        const Vector3d back_w =
            (body_.place(places_w, (*body_.limbs()[0])[0]) + body_.place(places_w, (*body_.limbs()[1])[0])) / 2 -
            base_w;
        const double share = way_w.dot(back_w) / back_w.squaredNorm();
        return share > 0 && share < 1 && (way_w - share * back_w).norm() < body_.to_left_w(places_w, 0).norm() / 4;
    }
    // A joint's rotation against its parent.
    const Quaterniond& rotation(int joint, std::size_t frame) const
    {
        return body_.clip().rotation[frame * body_.clip().joints.size() + static_cast<std::size_t>(joint)];
    }
    // How far it turns between two frames.
    double turn_deg(int joint, std::size_t from, std::size_t to) const
    {
        return rotation(joint, from).angularDistance(rotation(joint, to)) * (180 / std::numbers::pi);
    }
    // How far a joint's own rotation in a frame is out of the middle of those before and after, in degrees.
    double out_of_middle_deg(int joint, std::size_t frame) const
    {
        if (frame == 0 || frame + 1 >= body_.count()) return 0;
        const Quaterniond middle = rotation(joint, frame - 1).slerp(0.5, rotation(joint, frame + 1));
        return middle.angularDistance(rotation(joint, frame)) * (180 / std::numbers::pi);
    }
    void judge_pops()
    {
        Peak pop;
        int worst = -1;
        for (const BodyPart& part : body_.parts())
            for (const int joint : part.joints)
                for (std::size_t frame = 2; frame + 1 < body_.count(); ++frame) {
                    const double out = out_of_middle_deg(joint, frame);
                    if (out < kPop_deg || out <= pop.value) continue;
                    if (turn_deg(joint, frame - 1, frame + 1) > out) continue;  // it goes there alone
                    const double beside =
                        std::max(out_of_middle_deg(joint, frame - 2), out_of_middle_deg(joint, frame + 2));
                    if (out < kPopRatio * beside) continue;
                    pop = {frame, out};
                    worst = joint;
                }
        if (worst >= 0)
            doubts_.look("'{}' turns there and back, by {:.0f} degrees in frame {}",
                         printable_name(joint_at(body_.clip(), worst)), pop.value, pop.frame);
    }
    // Many files begin with a T-pose.
    void judge_first_frame()
    {
        if (body_.count() < 3) return;
        double max = 0, after = 0;
        for (const BodyPart& part : body_.parts())
            for (const int joint : part.joints) {
                max = std::max(max, turn_deg(joint, 0, 1));
                after = std::max(after, turn_deg(joint, 1, 2));
            }
        if (max > 2 * kPop_deg && max > kPopRatio * after)
            doubts_.look("frame 0 is a pose of its own: joints turn by up to {:.0f} degrees to frame 1, then by {:.1f}",
                         max, after);
    }
    // A body has weight: it gains speed over some frames.
    void judge_jumps()
    {
        if (body_.hips() < 0 || (!body_.limbs()[2] && !body_.limbs()[3])) return;
        const double time = body_.clip().frame_time, leg = body_.leg_length();
        const auto hips_w = [&](std::size_t at) { return body_.place(body_.frames_w()[at], body_.hips()); };
        Peak jump{0, leg * std::max(kSeen, kJump * time * time)};
        for (std::size_t frame = 2; frame + 1 < body_.count(); ++frame)
            jump.raise(frame, (hips_w(frame + 1) - 2 * hips_w(frame) + hips_w(frame - 1)).norm());
        if (jump.frame > 0)
            doubts_.look("the body jumps by {:.2f} leg lengths beside frame {}", jump.value / leg, jump.frame)
                .leg_lengths = jump.value / leg;
    }
    // The most that a limb's joints turn away from the first frame, in degrees.
    double movement_deg(std::size_t limb) const
    {
        double max = 0;
        for (const int joint : *body_.limbs()[limb])
            for (std::size_t frame = 1; frame < body_.count(); ++frame) max = std::max(max, turn_deg(joint, 0, frame));
        return max;
    }
    void judge_stillness()
    {
        for (std::size_t limb = 0; limb < body_.limbs().size(); ++limb) {
            const std::size_t other = limb ^ 1;
            if (!body_.limbs()[limb] || !body_.limbs()[other] || movement_deg(limb) > kStill_deg) continue;
            if (const double moves = movement_deg(other); moves > kMoved_deg)
                doubts_.look("the {} never moves, the other turns by up to {:.0f} degrees",
                             plain_name(formats::kLimbNames[limb]), moves);
        }
    }
    void judge_height()
    {
        if (!body_.limbs()[2] && !body_.limbs()[3]) return;
        std::vector<double> heights;
        for (const Places& places_w : body_.frames_w()) {
            double lowest = HUGE_VAL;
            for (std::size_t side = 0; side < 2; ++side)
                if (body_.limbs()[2 + side]) lowest = std::min(lowest, body_.low_w(places_w, side).dot(body_.up_w()));
            heights.push_back(lowest);
        }
        if (heights.empty()) return;
        const double ground = quantile(heights, 0.05) / body_.leg_length();
        if (ground < -kSunk && ground > -kElsewhere)
            doubts_.look("its feet stand at a height of {:.2f} leg lengths, below 0", ground).leg_lengths = ground;
    }
    const BodyFrames& body_;
    DoubtList doubts_;
};

}  // namespace

std::vector<ClipDoubt> clip_doubts(const BodyFrames& body)
{
    std::vector<ClipDoubt> doubts = body_doubts(body);
    if (body.count() > 0 && std::ranges::none_of(doubts, &ClipDoubt::is_up_wrong))
        std::ranges::move(MotionJudge(body).judge(), std::back_inserter(doubts));
    return doubts;
}

}  // namespace swivel::tools

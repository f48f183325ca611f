// SPDX-License-Identifier: MIT
#include "tools/feet/judge_feet.h"

#include <algorithm>
#include <cmath>

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using Kind = FeetDoubt::Kind;

constexpr double kOffGround = 0.012, kWorse = 2, kKneeSpeed = 720, kToeJump = 60, kBodyJump = 30;

// In leg lengths a second.
Peak jump_peak(const LegMotion& motion, std::span<const Vector3d> places_w)
{
    Peak peak;
    for (std::size_t frame = 1; frame + 1 < places_w.size(); ++frame)
        peak.raise(frame, largest_jump(places_w.subspan(frame - 1, 3)) / motion.frame_time / motion.leg_length());
    return peak;
}

}  // namespace

double bend_deg(const LegPath& leg, std::size_t frame)
{
    return degrees_between(leg.knee_w[frame] - leg.hip_w[frame], leg.ankle_w[frame] - leg.knee_w[frame]);
}

double knee_turn_deg(const LegPath& leg, std::size_t frame)
{
    return std::abs(bend_deg(leg, frame) - bend_deg(leg, frame - 1));
}

Skating skating_of(const LegMotion& motion, const Contacts& contacts, const Floor& floor)
{
    Skating max;
    double way = 0, times = 0, contact_count = 0;
    double begun_way = 0, begun_count = 0;  // of contacts that begin within the clip
    Peak drift, off_ground;
    const auto raise = [](double& value, double candidate) { value = std::max(value, candidate); };
    for (std::size_t n = 0; n < motion.legs.size(); ++n) {
        const LegPath& leg = motion.legs[n];
        const std::vector<Vector3d>& toe_w = leg.toe_w;
        for (std::size_t frame = 1; frame < toe_w.size(); ++frame) raise(max.knee_deg, knee_turn_deg(leg, frame));
        for (std::size_t frame = 0; leg.has_toe && frame < toe_w.size(); ++frame)
            raise(max.tip_depth, leg.tip_rise - floor.over(leg.tip_w[frame]));
        raise(max.jump, largest_jump(toe_w) / motion.frame_time);
        for (const Contact& contact : contacts_of(contacts[n])) {
            const bool is_begun = contact.first > 0;
            ++contact_count;
            if (is_begun) ++begun_count;
            for (std::size_t frame = contact.first; frame < contact.end; ++frame) {
                off_ground.raise(frame, std::abs(floor.over(toe_w[frame])));
                drift.raise(frame, motion.level(toe_w[frame] - toe_w[contact.first]).norm());
                if (frame == contact.first) continue;
                const double slide = motion.level(toe_w[frame] - toe_w[frame - 1]).norm();
                raise(max.max_speed, slide / motion.frame_time);
                way += slide;
                if (is_begun) begun_way += slide;
                times += motion.frame_time;
            }
        }
    }
    max.drift = drift.value, max.drift_frame = drift.frame;
    max.off_ground = off_ground.value, max.off_ground_frame = off_ground.frame;
    max.body_jump = largest_jump(motion.carrier_w) / motion.frame_time;
    max.mean_speed = times > 0 ? way / times : 0;
    max.step = begun_count > 0 ? begun_way / begun_count : way / std::max(contact_count, 1.0);
    for (double* const length : {&max.mean_speed, &max.max_speed, &max.step, &max.drift, &max.off_ground,
                                 &max.tip_depth, &max.jump, &max.body_jump})
        *length /= motion.leg_length();
    return max;
}

std::vector<FeetDoubt> feet_doubts(const LegMotion& after, const LegMotion& before, const Skating& skating,
                                   const Contacts& contacts, const ContactBars& bars, const Floor& floor)
{
    std::vector<FeetDoubt> doubts;
    const auto judge = [&](Kind kind, std::size_t leg, const Peak& now, double own, double seen,
                           const std::vector<Vector3d>& places_w) {
        if (now.value > kWorse * own && now.value > seen * after.frame_time)
            doubts.push_back({kind, leg, now.frame, now.frame, now.value, own, places_w[now.frame]});
    };
    for (std::size_t n = 0; n < after.legs.size(); ++n) {
        const LegPath& leg = after.legs[n];
        for (const Contact& contact : contacts_of(contacts[n])) {
            const double height = stand_height(before, before.legs[n], contact, bars, floor);
            Peak off;
            for (std::size_t frame = contact.first; frame < contact.end; ++frame)
                off.raise(frame, std::abs(floor.over(leg.toe_w[frame]) - height) / after.leg_length());
            if (off.value > kOffGround)
                doubts.push_back(
                    {Kind::off_ground, n, contact.first, contact.end - 1, off.value, 0, leg.toe_w[off.frame]});
        }
        Peak knee;
        for (std::size_t frame = 1; frame < leg.toe_w.size(); ++frame) knee.raise(frame, knee_turn_deg(leg, frame));
        judge(Kind::knee, n, knee, skating.knee_deg, kKneeSpeed, leg.toe_w);
        judge(Kind::toe_jump, n, jump_peak(after, leg.toe_w), skating.jump, kToeJump, leg.toe_w);
    }
    judge(Kind::body_jump, after.legs.size(), jump_peak(after, after.carrier_w), skating.body_jump, kBodyJump,
          after.carrier_w);
    return doubts;
}

}  // namespace swivel::tools

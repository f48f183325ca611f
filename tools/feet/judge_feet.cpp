// SPDX-License-Identifier: MIT
#include "tools/feet/judge_feet.h"

#include <cmath>

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using Kind = FeetDoubt::Kind;

constexpr double kOffGround = 0.012, kWorse = 2, kKneeSpeed = 720, kToeJump = 60, kBodyJump = 30;

// The frame with the largest value, and that.
struct Peak {
    std::size_t frame = 0;
    double value = 0;

    void raise(std::size_t at, double to)
    {
        if (to > value) *this = {at, to};
    }
};

Peak knee_peak(const LegPath& leg)
{
    Peak peak;
    for (std::size_t frame = 1; frame < leg.toe_w.size(); ++frame)
        peak.raise(frame, std::abs(bend_deg(leg, frame) - bend_deg(leg, frame - 1)));
    return peak;
}

// In leg lengths a second.
Peak jump_peak(const LegMotion& motion, std::span<const Vector3d> places_w)
{
    Peak peak;
    for (std::size_t frame = 1; frame + 1 < places_w.size(); ++frame)
        peak.raise(frame, largest_jump(places_w.subspan(frame - 1, 3)) / motion.frame_time / motion.leg_length());
    return peak;
}

void add_off_ground(const LegMotion& after, const LegMotion& before, std::size_t leg, const Contact& contact,
                    const ContactBars& bars, const Floor& floor, std::vector<FeetDoubt>& doubts)
{
    const double height = stand_height(before, before.legs[leg], contact, bars, floor);
    const std::vector<Vector3d>& toe_w = after.legs[leg].toe_w;
    Peak peak;
    for (std::size_t frame = contact.first; frame < contact.end; ++frame)
        peak.raise(frame, std::abs(floor.over(toe_w[frame]) - height) / after.leg_length());
    if (peak.value > kOffGround)
        doubts.push_back({Kind::off_ground, leg, contact.first, contact.end - 1, peak.value, 0, toe_w[peak.frame]});
}

}  // namespace

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
        for (const Contact& contact : contacts_of(contacts[n]))
            add_off_ground(after, before, n, contact, bars, floor, doubts);
        judge(Kind::knee, n, knee_peak(leg), skating.knee_deg, kKneeSpeed, leg.toe_w);
        judge(Kind::toe_jump, n, jump_peak(after, leg.toe_w), skating.jump, kToeJump, leg.toe_w);
    }
    judge(Kind::body_jump, after.legs.size(), jump_peak(after, after.carrier_w), skating.body_jump, kBodyJump,
          after.carrier_w);
    return doubts;
}

}  // namespace swivel::tools

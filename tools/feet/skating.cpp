// SPDX-License-Identifier: MIT
#include "tools/feet/skating.h"

#include <algorithm>
#include <cmath>

#include "tools/rig/vectors.h"

namespace swivel::tools {

using Eigen::Vector3d;

double bend_deg(const LegPath& leg, std::size_t frame)
{
    return degrees_between(leg.knee_w[frame] - leg.hip_w[frame], leg.ankle_w[frame] - leg.knee_w[frame]);
}

Skating skating_of(const LegMotion& motion, const Contacts& contacts, const Floor& floor)
{
    Skating most;
    double way = 0, steps = 0, times = 0;
    const auto raise = [](double& value, double to) { value = std::max(value, to); };
    for (std::size_t n = 0; n < motion.legs.size(); ++n) {
        const LegPath& leg = motion.legs[n];
        const std::vector<Vector3d>& toe_w = leg.toe_w;
        for (std::size_t frame = 1; frame < toe_w.size(); ++frame)
            raise(most.knee_deg, std::abs(bend_deg(leg, frame) - bend_deg(leg, frame - 1)));
        for (std::size_t frame = 0; leg.has_toe && frame < toe_w.size(); ++frame)
            raise(most.tip_depth, leg.tip_rise - floor.over(leg.tip_w[frame]));
        raise(most.jump, largest_jump(toe_w) / motion.frame_time);
        for (const Contact& contact : contacts_of(contacts[n])) {
            if (contact.first > 0) ++steps;
            for (std::size_t frame = contact.first; frame < contact.end; ++frame) {
                raise(most.off_ground, std::abs(floor.over(toe_w[frame])));
                raise(most.drift, motion.level(toe_w[frame] - toe_w[contact.first]).norm());
                if (frame == contact.first) continue;
                const double slide = motion.level(toe_w[frame] - toe_w[frame - 1]).norm();
                raise(most.most_speed, slide / motion.frame_time);
                way += slide;
                times += motion.frame_time;
            }
        }
    }
    most.body_jump = largest_jump(motion.carrier_w) / motion.frame_time;
    most.mean_speed = times > 0 ? way / times : 0;
    most.step = way / std::max(steps, 1.0);
    for (double* const length : {&most.mean_speed, &most.most_speed, &most.step, &most.drift, &most.off_ground,
                                 &most.tip_depth, &most.jump, &most.body_jump})
        *length /= motion.leg_length();
    return most;
}

}  // namespace swivel::tools

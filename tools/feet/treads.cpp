// SPDX-License-Identifier: MIT
#include "tools/feet/treads.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swivel::tools {

namespace {

using Eigen::Vector3d;

// A sole reaches from half of the way between toe joint and ankle before the toe joint to a quarter of it behind the
// ankle. Its ground is looked at a sixteenth of that way apart, and so are the places that it may go to.
constexpr int kParts = 16, kBefore = 8, kBehind = 4, kDirections = 16;
constexpr double kShortest = 0.1;  // leg lengths: of that way, where the ankle stands or a toe hangs down
constexpr double kLowArc = 0.5;    // of an arc's height

// From one of the points of a sole to the next, towards the ankle.
Vector3d sole_part_w(const LegMotion& motion, const LegPath& path, std::size_t frame)
{
    const Vector3d part_w = motion.level(path.ankle_w[frame] - path.toe_w[frame]) / kParts;
    const double min_part = kShortest * path.length / kParts;
    return part_w.norm() < min_part ? min_part * motion.up_w.unitOrthogonal() : part_w;
}

bool is_tread(const Vector3d& toe_w, const Vector3d& part_w, const Floor& floor)
{
    const double steep = std::cos(std::numbers::pi / 4);
    double last = 0;
    for (int n = -kBefore; n <= kParts + kBehind; ++n) {
        const Vector3d position_w = toe_w + n * part_w;
        const double height = floor.hill(position_w);
        if (n > -kBefore && std::abs(height - last) > part_w.norm()) return false;
        if (floor.normal_w(position_w).dot(floor.up_w) < steep) return false;
        last = height;
    }
    return true;
}

// Where a foot goes while it stands.
struct Anchor {
    std::size_t first, end;
    Vector3d move_w;
    Vector3d normal_w;
};

Anchor anchor_at(const LegMotion& motion, const LegPath& path, const Contact& frames, const Floor& floor)
{
    const std::size_t middle = middle_of(frames);
    const Vector3d toe_w = path.toe_w[middle], tread_w = tread_near(motion, path, middle, floor).value_or(toe_w);
    return {frames.first, frames.end, tread_w - toe_w + floor.hill(tread_w) * floor.up_w, floor.normal_w(tread_w)};
}

// In the air the toe goes evenly from one anchor to the other, and over the ground between by an arc, just high enough
// that it is no deeper in the ground than in the clip. Where the arc is lower than kLowArc of its height, in the first
// and last sevenths of the swing, it does not rise for that: the whole foot would fly up for a ridge that it just
// leaves. What it lacks there is left to place_feet().
void add_swing(const LegMotion& motion, const LegPath& path, const Anchor& from, const Anchor& next, const Floor& floor,
               LegLift& lift)
{
    const auto time_at = [&](std::size_t frame) {
        return static_cast<double>(frame - from.end + 1) / static_cast<double>(next.first - from.end + 1);
    };
    const auto arc_at = [&](std::size_t frame) { return 4 * time_at(frame) * (1 - time_at(frame)); };
    double arc = 0;
    for (std::size_t frame = from.end; frame < next.first; ++frame) {
        const double time = time_at(frame), share = time * time * (3 - 2 * time);
        lift.move_w.push_back(from.move_w + share * (next.move_w - from.move_w));
        lift.normal_w.push_back((from.normal_w + share * (next.normal_w - from.normal_w)).normalized());
        const Vector3d toe_w = path.toe_w[frame] + lift.move_w.back();
        const double own = path.toe_w[frame].dot(motion.up_w) - floor.level;
        const double lacks = std::min(own, 0.0) - floor.over(toe_w);
        arc = std::max(arc, lacks / std::max(arc_at(frame), kLowArc));
    }
    for (std::size_t frame = from.end; frame < next.first; ++frame)
        lift.move_w[frame] += arc * arc_at(frame) * floor.up_w;
}

LegLift lift_of_leg(const LegMotion& motion, std::size_t leg, const std::vector<bool>& contact, const Floor& floor)
{
    std::vector<Anchor> anchors;
    for (const Contact& stand : stands_of(contact, motion.frame_time))
        anchors.push_back(anchor_at(motion, motion.legs[leg], stand, floor));
    LegLift lift;
    for (std::size_t n = 0; n < anchors.size(); ++n) {
        if (n > 0) add_swing(motion, motion.legs[leg], anchors[n - 1], anchors[n], floor, lift);
        const std::size_t end = n + 1 < anchors.size() ? anchors[n].end : contact.size();
        lift.move_w.resize(end, anchors[n].move_w);
        lift.normal_w.resize(end, anchors[n].normal_w);
    }
    return lift;
}

}  // namespace

bool can_stand(const LegMotion& motion, const LegPath& path, std::size_t frame, const Vector3d& toe_w,
               const Floor& floor)
{
    return !floor.hills || is_tread(toe_w, sole_part_w(motion, path, frame), floor);
}

std::optional<Vector3d> tread_near(const LegMotion& motion, const LegPath& path, std::size_t frame, const Floor& floor)
{
    const Vector3d toe_w = path.toe_w[frame];
    if (can_stand(motion, path, frame, toe_w, floor)) return toe_w;
    const Vector3d part_w = sole_part_w(motion, path, frame), side_w = part_w.cross(floor.up_w);
    for (int ring = 1; ring <= kBefore + kParts + kBehind; ++ring)
        for (int n = 0; n < kDirections; ++n) {
            const double angle = 2 * std::numbers::pi * n / kDirections;
            const Vector3d tread_w = toe_w + ring * (std::cos(angle) * part_w + std::sin(angle) * side_w);
            if (is_tread(tread_w, part_w, floor)) return tread_w;
        }
    return std::nullopt;
}

Lift lift_of(const LegMotion& motion, const Contacts& contacts, const Floor& floor)
{
    Lift lift{std::vector<double>(motion.frame_count()), {}};
    for (std::size_t leg = 0; leg < motion.legs.size(); ++leg) {
        lift.legs.push_back(lift_of_leg(motion, leg, contacts[leg], floor));
        for (std::size_t frame = 0; frame < motion.frame_count(); ++frame)
            lift.body[frame] += lift.legs[leg].move_w[frame].dot(motion.up_w) / static_cast<double>(motion.legs.size());
    }
    return lift;
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
#include "tools/crowd/strides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "tools/crowd/ground.h"
#include "tools/crowd/heading.h"

namespace swivel::tools {

namespace {

constexpr std::uint32_t kSamples = 6;  // of the ground below a swing

// A leg of a character, and its ground.
struct Leg {
    const goal_plan& plan;
    const goal_source* sources;
    const goal_character& character;
    const goal_ground& ground;
    const float* heights;

    GroundPoint ground_below(double x, double z) const { return ground_at(ground, heights, x, z); }
    // The ankle in the world, on x and z.
    std::array<double, 2> ankle(std::uint32_t frame) const
    {
        const goal_source& from = sources[frame];
        double x = character.size * (from.origin[0] + from.wrist[0]),
               z = character.size * (from.origin[2] + from.wrist[2]);
        turn_with(character, x, z);
        return {character.place[0] + x, character.place[2] + z};
    }
};

struct Toe {
    double x, z, room;
};

Toe toe_at(const Leg& leg, std::uint32_t frame)
{
    const goal toe = swivel_goal(&leg.plan, &leg.sources[frame], &leg.character);
    const double lowest =
        leg.character.place[1] + leg.character.size * (leg.sources[frame].root[1] + double{leg.plan.clearance});
    return {toe.target[0], toe.target[2], std::max(0.0, toe.target[1] - lowest)};
}

// From ankle to toe, or a tenth of the leg where the ankle itself stands.
double foot_length(const Leg& leg, std::uint32_t frame)
{
    const double(&toe)[3] = leg.plan.effector;
    const double(&bones)[2] = leg.sources[frame].lengths;
    const double length = std::sqrt(toe[0] * toe[0] + toe[1] * toe[1] + toe[2] * toe[2]);
    return leg.character.size * std::max(length, 0.1 * (bones[0] + bones[1]));
}

// The ground that a foot stands on.
struct Tread {
    double x, z;              // of the toe in the middle of the stand
    double aside_x, aside_z;  // to where the ground is
    GroundPoint ground;

    double level_at(double at_x, double at_z) const
    {
        return ground.height + ground.slope_x * (at_x - x) + ground.slope_z * (at_z - z);
    }
    double level_at(const Toe& toe) const { return level_at(toe.x, toe.z); }
};

// Whether the ground below and around the ball of a foot is no steeper than 45 degrees, edges between the samples
// included.
bool is_tread(const Leg& leg, double x, double z, double ball)
{
    constexpr double kAround[9][2] = {{0, 0}, {0.5, 0}, {-0.5, 0}, {0, 0.5}, {0, -0.5},
                                      {1, 0}, {-1, 0},  {0, 1},    {0, -1}};
    const double middle = leg.ground_below(x, z).height;
    return std::all_of(std::begin(kAround), std::end(kAround), [&](const double(&way)[2]) {
        const GroundPoint below = leg.ground_below(x + ball * way[0], z + ball * way[1]);
        const double rise = below.height - middle, far2 = ball * ball * (way[0] * way[0] + way[1] * way[1]);
        return below.slope_x * below.slope_x + below.slope_z * below.slope_z <= 1 && rise * rise <= far2;
    });
}

// Which way a foot points, level and of unit length, on x and z.
std::array<double, 2> ahead_of(const Leg& leg, const Toe& toe, std::uint32_t frame)
{
    const auto [ankle_x, ankle_z] = leg.ankle(frame);
    const double x = toe.x - ankle_x, z = toe.z - ankle_z, length = std::sqrt(x * x + z * z);
    return length > 0 ? std::array{x / length, z / length} : std::array{1.0, 0.0};
}

// The foot stands below its toe. At an edge it stands at the nearest place ahead or beside without one, because a leg
// left behind is stretched already. Without such a place within a foot's length, it stands below its toe all the same.
Tread tread_at(const Leg& leg, std::uint32_t frame)
{
    constexpr int kRings = 16;
    constexpr double kAcross = 0.70710678118654752;                                                     // 1 / sqrt(2)
    constexpr double kWays[5][2] = {{1, 0}, {kAcross, kAcross}, {kAcross, -kAcross}, {0, 1}, {0, -1}};  // ahead, aside
    const Toe toe = toe_at(leg, frame);
    const auto [ahead_x, ahead_z] = ahead_of(leg, toe, frame);
    const double foot = foot_length(leg, frame);
    for (int ring = 0; ring <= kRings; ++ring)
        for (const double(&way)[2] : kWays) {
            const double far = foot * ring / kRings;
            const double aside_x = far * (way[0] * ahead_x - way[1] * ahead_z),
                         aside_z = far * (way[0] * ahead_z + way[1] * ahead_x);
            const double x = toe.x + aside_x, z = toe.z + aside_z;
            if (is_tread(leg, x, z, foot / 4)) return {toe.x, toe.z, aside_x, aside_z, leg.ground_below(x, z)};
        }
    return {toe.x, toe.z, 0, 0, leg.ground_below(toe.x, toe.z)};
}

// The height of a tread's plane below the ankle in the middle of the stand: of a foot that points up a slope it is
// lower than below the toe.
double ankle_level(const Leg& leg, const Tread& tread, std::uint32_t stand)
{
    const auto [x, z] = leg.ankle(stand);
    return tread.level_at(x, z);
}

// The way of a foot through the air.
struct Swing {
    std::uint32_t leaves, lands;
    Tread from, next;
    double left, landed;  // heights of the treads' planes below the toe as it leaves the one and lands on the other
    double levels[2];     // heights of the same planes below the ankle in the middle of the stands

    double time_at(std::uint32_t frame) const { return (1.0 + frame - leaves) / (1.0 + lands - leaves); }
};

Swing swing_from(const Leg& leg, const goal_stride& way)
{
    const Tread from = tread_at(leg, way.stand), next = tread_at(leg, way.next);
    return {way.leaves,
            way.lands,
            from,
            next,
            from.level_at(toe_at(leg, way.leaves - 1)),
            next.level_at(toe_at(leg, way.lands)),
            {ankle_level(leg, from, way.stand), ankle_level(leg, next, way.next)}};
}

double between(double from, double to, double share) { return from + share * (to - from); }

// The stride at a time of the swing, without an arc.
Stride stride_in(const Swing& swing, const Toe& toe, double time)
{
    const auto& [leaves, lands, from, next, left, landed, levels] = swing;
    const double share = time * time * (3 - 2 * time);
    const double aside_x = between(from.aside_x, next.aside_x, share),
                 aside_z = between(from.aside_z, next.aside_z, share);
    return {{toe.x + aside_x, between(left, landed, share), toe.z + aside_z},
            {between(from.ground.slope_x, next.ground.slope_x, share),
             between(from.ground.slope_z, next.ground.slope_z, share)},
            share * toe.room,
            {levels[0], levels[1]},
            share};
}

double arc_at(double time) { return 4 * time * (1 - time); }

// As high as the toe needs so as not to be deeper in the ground than in the clip. The first seventh of the way does not
// count, nor the last: the whole foot would fly up for an edge that it just leaves.
double arc_over(const Leg& leg, const Swing& swing)
{
    double arc = 0;
    for (std::uint32_t n = 1; n <= kSamples; ++n) {
        const std::uint64_t way = swing.lands - swing.leaves;
        const std::uint32_t frame = swing.leaves + static_cast<std::uint32_t>(way * n / (kSamples + 1));
        const double time = swing.time_at(frame);
        const Stride stride = stride_in(swing, toe_at(leg, frame), time);
        const double lacks = leg.ground_below(stride.plane[0], stride.plane[2]).height - stride.plane[1] - stride.room;
        arc = std::max(arc, lacks / arc_at(time));
    }
    return arc;
}

}  // namespace

Stride stride_at(const goal_plan& plan, const goal_source* sources, uint32_t frame, const goal_character& character,
                 const goal_ground& ground, const float* heights)
{
    const Leg leg{plan, sources, character, ground, heights};
    const goal_stride& way = sources[frame].stride;
    const Toe toe = toe_at(leg, frame);
    if (frame < way.leaves) {
        const Tread tread = tread_at(leg, way.stand);
        const double level = ankle_level(leg, tread, way.stand);
        return {{toe.x + tread.aside_x, tread.level_at(toe), toe.z + tread.aside_z},
                {tread.ground.slope_x, tread.ground.slope_z},
                0,
                {level, level},
                0};
    }
    const Swing swing = swing_from(leg, way);
    Stride stride = stride_in(swing, toe, swing.time_at(frame));
    stride.plane[1] += arc_over(leg, swing) * arc_at(swing.time_at(frame));
    return stride;
}

double body_level(std::span<const Stride> strides)
{
    double sum = 0;
    for (unsigned feet = 0; feet < 1u << strides.size(); ++feet) {  // bit n: foot n counts as at its next stand
        double share = 1, lowest = strides[0].levels[feet & 1];
        for (std::size_t n = 0; n < strides.size(); ++n) {
            const unsigned is_next = feet >> n & 1;
            share *= is_next ? strides[n].share : 1 - strides[n].share;
            lowest = std::min(lowest, strides[n].levels[is_next]);
        }
        sum += share * lowest;
    }
    return sum;
}

}  // namespace swivel::tools

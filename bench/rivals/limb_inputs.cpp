// SPDX-License-Identifier: MIT
//
// What whole limbs have beside their targets: an incoming pose, weights, limits as bodies have them, and further goals,
// each limb's its own. The limits leave most targets a swivel; for some they do not, as in a game.
#include <array>
#include <cmath>
#include <numbers>

#include "bench/rivals/limbs.h"

namespace bench {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

// xorshift* (Vigna, 2016).
struct Random {
    std::uint64_t state = 0x853c49e6748fea9bu;

    double operator()(double from, double to)
    {
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        return from + (to - from) * static_cast<double>((state * 0x2545f4914f6cdd1du) >> 11) * 0x1p-53;
    }
};

template <std::size_t N, class Make>
void write(swivel::Crowd& crowd, std::uint32_t first, std::uint32_t count, swivel_field field, Make make)
{
    if (swivel_field_row_count(crowd.get(), 0, field) == 0) return;
    std::vector<std::array<float, N>> values(count);
    for (std::array<float, N>& value : values) make(value.data());
    crowd.write(field, 0, values, first);
}

void write_poses(swivel::Crowd& crowd, std::uint32_t count, Random& random)
{
    const auto rotation = [&](float* to) {
        for (int n = 0; n < 4; ++n) to[n] = static_cast<float>(random(-1, 1));
        to[3] += 2;
    };
    for (const swivel_field q : {SWIVEL_INCOMING_SHOULDER, SWIVEL_INCOMING_ELBOW, SWIVEL_INCOMING_WRIST})
        write<4>(crowd, 0, count, q, rotation);
    write<3>(crowd, 0, count, SWIVEL_WEIGHTS, [&](float* to) {
        for (int n = 0; n < 3; ++n) to[n] = static_cast<float>(random(0.5, 1));
    });
    write<2>(crowd, 0, count, SWIVEL_FLEXION_LIMIT, [&](float* to) {
        swivel::check(swivel_flexion(random(0, 10) * kDegree, random(130, 160) * kDegree, to));
    });
}

void write_limits(swivel::Crowd& crowd, std::uint32_t first, std::uint32_t count, double width, Random& random)
{
    const auto range = [&](float* to, double least, double most) {
        const double middle = random(-20, 20), half = width * random(least, most);
        swivel::check(swivel_range((middle - half) * kDegree, (middle + half) * kDegree, to));
    };
    const auto cone = [&](float* to) {
        const double axis[] = {random(-0.5, 0.5), random(-0.5, 0.5), 1};
        swivel::check(swivel_cone(axis, width * random(90, 130) * kDegree, to));
    };
    const auto box = [&](float* to) {
        for (int angle = 0; angle < 3; ++angle) range(to + 4 * angle, 80, 140);
    };
    write<4>(crowd, first, count, SWIVEL_SHOULDER_CONE, cone);
    write<4>(crowd, first, count, SWIVEL_HAND_CONE, cone);
    write<4>(crowd, first, count, SWIVEL_HUMERAL_TWIST, [&](float* to) { range(to, 60, 120); });
    write<4>(crowd, first, count, SWIVEL_FOREARM_TWIST, [&](float* to) { range(to, 60, 120); });
    write<12>(crowd, first, count, SWIVEL_SHOULDER_BOX, box);
    write<12>(crowd, first, count, SWIVEL_WRIST_BOX, box);
}

void write_goals(swivel::Crowd& crowd, std::uint32_t count, Random& random)
{
    write<3>(crowd, 0, count, SWIVEL_EFFECTOR, [&](float* to) {
        for (int n = 0; n < 3; ++n) to[n] = static_cast<float>(random(-0.05, 0.05));
    });
    write<4>(crowd, 0, count, SWIVEL_REACH, [&](float* to) {
        const double reach[] = {random(0, 0.1), random(0, 0.1), random(1, 1.2), random(0, 0.3)};
        for (int n = 0; n < 4; ++n) to[n] = static_cast<float>(reach[n]);
    });
    write<2>(crowd, 0, count, SWIVEL_MOST_SWIVEL, [&](float* to) { swivel_turn(random(5, 60) * kDegree, to); });
    write<5>(crowd, 0, count, SWIVEL_AIM, [&](float* to) {
        const double axis[] = {random(-0.2, 0.2), random(-0.2, 0.2), 1};
        swivel::check(swivel_aim(axis, random(20, 100) * kDegree, to));
    });
    write<4>(crowd, 0, count, SWIVEL_CLAVICLE, [&](float* to) {
        const double clavicle[] = {random(0.1, 0.2), random(-0.05, 0.05), random(-0.05, 0.05), random(0, 1)};
        for (int n = 0; n < 4; ++n) to[n] = static_cast<float>(clavicle[n]);
    });
}

}  // namespace

void write_limb_inputs(swivel::Crowd& crowd, std::uint32_t count)
{
    Random random;
    write_poses(crowd, count, random);
    write_limits(crowd, 0, count, 1, random);
    write_goals(crowd, count, random);
}

void write_limits(swivel::Crowd& crowd, std::uint32_t first, std::uint32_t count, double width)
{
    Random random;
    write_limits(crowd, first, count, width, random);
}

}  // namespace bench

// SPDX-License-Identifier: MIT
//
// What whole limbs have beside their targets: an incoming pose, weights, limits as bodies have them, and reach, each
// limb's its own. The limits leave most targets a swivel; for some they do not, as in a game.
#include <array>
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
void write(swivel::Crowd& crowd, std::uint32_t count, swivel_field field, Make make)
{
    if (swivel_field_row_count(crowd.get(), 0, field) == 0) return;
    std::vector<std::array<float, N>> values(count);
    for (std::array<float, N>& value : values) make(value.data());
    crowd.write(field, 0, values);
}

}  // namespace

void write_limb_inputs(swivel::Crowd& crowd, std::uint32_t count)
{
    Random random;
    const auto rotation = [&](float* to) {
        for (int n = 0; n < 4; ++n) to[n] = static_cast<float>(random(-1, 1));
        to[3] += 2;
    };
    for (const swivel_field q : {SWIVEL_INCOMING_SHOULDER, SWIVEL_INCOMING_ELBOW, SWIVEL_INCOMING_WRIST})
        write<4>(crowd, count, q, rotation);
    write<3>(crowd, count, SWIVEL_WEIGHTS, [&](float* to) {
        for (int n = 0; n < 3; ++n) to[n] = static_cast<float>(random(0.5, 1));
    });
    write<2>(crowd, count, SWIVEL_FLEXION_LIMIT, [&](float* to) {
        swivel::check(swivel_flexion(random(0, 10) * kDegree, random(130, 160) * kDegree, to));
    });
    write<4>(crowd, count, SWIVEL_SHOULDER_CONE, [&](float* to) {
        const double axis[] = {random(-0.5, 0.5), random(-0.5, 0.5), 1};
        swivel::check(swivel_cone(axis, random(90, 130) * kDegree, to));
    });
    write<4>(crowd, count, SWIVEL_REACH, [&](float* to) {
        const double reach[] = {random(0, 0.1), random(0, 0.1), random(1, 1.2), random(0, 0.3)};
        for (int n = 0; n < 4; ++n) to[n] = static_cast<float>(reach[n]);
    });
}

}  // namespace bench

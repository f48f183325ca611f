// SPDX-License-Identifier: MIT
//
// The promise: a crowd's results agree with forward kinematics by Eigen, which is in double and shares no code. This
// checks the arm frame, the world and hands. A crowd far from the origin is as exact as one near it: its positions are
// doubles, from which an origin is subtracted before they are rounded. The test `interface` has doubles in frames.
#include <array>
#include <bit>
#include <cmath>

#include <rapidcheck/catch.h>

#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

TEST_CASE("arms in the arm frame and in the world: wrist on the target, elbow on the pole's side, hand as wanted")
{
    const swivel_features w = SWIVEL_WORLD, h = SWIVEL_WITH_HAND, d = SWIVEL_POLE_DIRECTION;
    for (const swivel_features features : {swivel_features{0}, h, w, w | h, w | d, w | h | d}) {
        constexpr std::uint32_t count = 400;
        Crowd crowd = crowd_of(features, count);
        Random random{features + 11};
        std::vector<Limb> limbs;
        for (std::uint32_t n = 0; n < count; ++n) {
            const Float2 lengths = {static_cast<float>(random.spread(0.2, 5)),
                                    static_cast<float>(random.spread(0.2, 5))};
            limbs.push_back(random_limb(random, features, lengths));
            write_limb(crowd, 0, n, limbs.back());
        }
        crowd.solve();
        const auto shoulders = read<Float4>(crowd, SWIVEL_SHOULDER);
        const auto elbows = read<Float2>(crowd, SWIVEL_ELBOW);
        const auto wrists =
            features & h ? read<Float4>(crowd, SWIVEL_WRIST) : std::vector<Float4>(count, Float4{0, 0, 0, 1});
        const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
        std::vector<Places> places;
        for (std::uint32_t n = 0; n < count; ++n) {
            INFO("features " << features << ", limb " << n);
            places.push_back(places_of(limbs[n], shoulders[n], elbows[n], wrists[n]));
            check_places(limbs[n], features, places.back(), flags[n]);
            CHECK(is_unit(shoulders[n]));
            CHECK(is_unit(wrists[n]));
            CHECK(is_in_hemisphere(shoulders[n]));
            CHECK(is_in_hemisphere(wrists[n]));
        }
        check_forward(crowd, 0, limbs, places, 1e-12);
    }
}

TEST_CASE("residuals of what cannot be reached, of no arm and of bad input")
{
    Crowd crowd = crowd_of(0, 4);
    crowd.write(SWIVEL_TARGET, 0, std::vector<Float3>{{0, 6, 0}, {0, 0.25f, 0}, {0, 1, 0}, {kNan, 1, 0}});
    crowd.write(SWIVEL_LENGTHS, 0, std::vector<Float2>{{1, 1}, {3, 1}, {0, 0}, {1, 1}});
    crowd.solve();
    std::vector<double> residuals(4);
    crowd.residuals(0, residuals);
    CHECK(std::fabs(residuals[0] - 2) <= 1e-6);
    CHECK(std::fabs(residuals[1] - 1.75 / 4) <= 1e-6);
    CHECK(residuals[2] == 0);
    CHECK(std::isnan(residuals[3]));
}

using Double3 = std::array<double, 3>;

TEST_CASE("rows hold the difference, rounded once, for any stride and place")
{
    rc::prop("random doubles", [](std::uint64_t seed) {
        Random random{seed};
        const std::uint32_t count = 1 + random.below(70);
        Crowd crowd = crowd_of(SWIVEL_WORLD, count);
        const std::uint32_t first = random.below(count), limbs = random.below(count - first + 1);
        const swivel_field fields[] = {SWIVEL_TARGET, SWIVEL_POLE, SWIVEL_SHOULDER_POSITION};
        const swivel_field field = fields[random.below(3)];
        const std::size_t stride = 24 + random.below(20), origin_stride = random.below(2) ? 24 + random.below(20) : 0;
        const bool with_origin = random.below(4) > 0;
        std::vector<unsigned char> values(3 + limbs * stride), origins(3 + limbs * origin_stride + 24);
        unsigned char *const value = values.data() + random.below(4), *const origin = origins.data() + random.below(4);
        std::vector<float> expected;
        const auto far = [&] { return random.spread(1e-3, 1e9) * (random.below(2) ? 1 : -1); };
        Double3 from;
        for (std::uint32_t n = 0; n < limbs; ++n) {
            if (n == 0 || origin_stride > 0)
                for (double& x : from) x = far();
            Double3 at;
            for (std::size_t c = 0; c < 3; ++c) {
                at[c] = random.below(2) ? from[c] + random.between(-3, 3) : far();
                expected.push_back(static_cast<float>(with_origin ? at[c] - from[c] : at[c]));
            }
            if (n + 1 < limbs || stride >= 24) std::memcpy(value + n * stride, &at, sizeof at);
            std::memcpy(origin + n * origin_stride, &from, sizeof from);
        }
        const auto before = read<Float3>(crowd, field);
        const swivel_status status = swivel_write_doubles(crowd.get(), field, 0, first, limbs, {value, stride},
                                                          with_origin ? swivel_in{origin, origin_stride} : swivel_in{});
        RC_ASSERT(status == SWIVEL_OK);
        const auto after = read<Float3>(crowd, field);
        for (std::uint32_t n = 0; n < count; ++n)
            for (std::size_t c = 0; c < 3; ++c) {
                const bool written = n >= first && n < first + limbs;
                const float wanted = written ? expected[(n - first) * 3 + c] : before[n][c];
                RC_ASSERT(std::bit_cast<std::uint32_t>(after[n][c]) == std::bit_cast<std::uint32_t>(wanted));
            }
    });
}

TEST_CASE("doubles that no float holds are bad input of their own limb")
{
    Crowd crowd = crowd_of(SWIVEL_WORLD, 4);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Double3 targets[] = {{0, 0, 1}, {1e300, 0, 0}, {0, nan, 0}, {0, 1, 1}};
    crowd.write_doubles(SWIVEL_TARGET, 0, targets);
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0, 0, 0});
    crowd.solve();
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    CHECK(flags == std::vector<std::uint32_t>{SWIVEL_REACHED, SWIVEL_BAD_INPUT, SWIVEL_BAD_INPUT, SWIVEL_REACHED});
}

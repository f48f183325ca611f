// SPDX-License-Identifier: MIT
//
// The promise: a crowd's results agree with forward kinematics by Eigen, which is in double and shares no code. This
// checks the arm frame, the world and hands.
#include "tests/test_crowd.h"
#include "tests/test_limb.h"

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

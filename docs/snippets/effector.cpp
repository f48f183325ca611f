// SPDX-License-Identifier: MIT
#include "check.h"

TEST_CASE("docs: effector")
{
    // [shown]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR)});
    // The palm, as the hand has it.
    crowd.write_all(SWIVEL_EFFECTOR, 0, Float3{0, -0.02f, 0.09f});
    crowd.write_all(SWIVEL_HAND, 0, Float4{0, 0.6f, 0, 0.8f});
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.3f, 0.1f, 0.3f});  // where the palm goes
    // [end]
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{0.30f, 0.26f});
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
    crowd.solve();
    std::array<Double3, 1> wrist;
    std::array<Double4, 1> hand;
    crowd.wrists(0, wrist);
    crowd.hands(0, hand);
    const Eigen::Vector3d palm =
        vec(wrist[0]) + quat(hand[0]) * Eigen::Vector3d(0, -0.02, 0.09);
    CHECK((palm - Eigen::Vector3d(0.3, 0.1, 0.3)).norm() < 1e-6);
    CHECK(distance(wrist[0], Float3{0.3f, 0.1f, 0.3f}) > 0.05);
}

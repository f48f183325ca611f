// SPDX-License-Identifier: MIT
#include "check.h"

TEST_CASE("docs: hand orientation")
{
    // [shown]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_HAND)});
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.3f, 0.1f, 0.3f});
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{0.30f, 0.26f});
    // A quarter turn about y.
    crowd.write_all(SWIVEL_HAND, 0, Float4{0, 0.7071068f, 0, 0.7071068f});
    crowd.solve();

    std::array<Float4, 1> wrist;  // the hand relative to the forearm
    crowd.read(SWIVEL_WRIST, 0, wrist);
    // [end]
    std::array<Double4, 1> hand;
    crowd.hands(0, hand);
    CHECK(turn_between(hand[0], Float4{0, 1, 0, 1}) < 1e-6);
    CHECK(turn_between(wrist[0], Float4{0, 0, 0, 1}) > 0.1);
}

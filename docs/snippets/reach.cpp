// SPDX-License-Identifier: MIT
#include "check.h"

TEST_CASE("docs: soft reach and stretch")
{
    // [shown]
    swivel::Crowd crowd({swivel::limbs(3, SWIVEL_WITH_REACH)});
    // Shares of both bones' length: eased 0.1 before the far end, not at the near one;
    // stretched up to 1.05; no wrist nearer than 0.2.
    crowd.write_all(SWIVEL_REACH, 0, Float4{0.1f, 0, 1.05f, 0.2f});
    // [end]
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{0.5f, 0.5f});
    crowd.write(SWIVEL_TARGET, 0,
                std::array<Float3, 3>{{{0, 0, 0.98f}, {0, 0, 2}, {0, 0, 0.1f}}});
    crowd.solve();
    std::array<std::array<float, 1>, 3> stretch;
    std::array<std::uint32_t, 3> flags;
    crowd.read(SWIVEL_STRETCH, 0, stretch);
    crowd.read(SWIVEL_FLAGS, 0, flags);
    std::array<Double3, 3> wrists;
    crowd.wrists(0, wrists);
    // Eased, and stretched by what that took.
    CHECK(distance(wrists[0], Float3{0, 0, 0.98f}) < 1e-6);
    CHECK(stretch[0][0] == Approx(0.98 / (0.98 - 0.08 * 0.08 / 0.4)).epsilon(1e-6));
    CHECK(flags[0] == (SWIVEL_REACHED | SWIVEL_STRETCHED));
    CHECK(distance(wrists[1], Float3{0, 0, 1.05f}) < 1e-6);
    CHECK(flags[1] & SWIVEL_CLAMPED_FAR);
    CHECK(distance(wrists[2], Float3{0, 0, 0.2f}) < 1e-6);
    CHECK(flags[2] == SWIVEL_CLAMPED_NEAR);
}

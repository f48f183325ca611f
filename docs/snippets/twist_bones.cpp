// SPDX-License-Identifier: MIT
#include "check.h"

TEST_CASE("docs: twist bones")
{
    // [shown]
    swivel_limb_def arm = swivel::limbs(1, SWIVEL_WITH_HAND);
    arm.twist_bone_count = 3;
    swivel::Crowd crowd({arm});
    // [end]
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.2f, 0.1f, 1.6f});
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
    crowd.write_all(SWIVEL_HAND, 0, Float4{0, 0, 0.6f, 0.8f});
    crowd.solve();
    // Children of the forearm, from elbow to wrist.
    std::array<std::array<Float4, 3>, 1> twist;
    crowd.read(SWIVEL_TWIST_BONES, 0, twist);
    std::array<Float4, 1> wrist;
    crowd.read(SWIVEL_WRIST, 0, wrist);
    const auto about_forearm = [](const Float4& q) {
        return 2 * std::atan2(quat(q).z(), quat(q).w());
    };
    const double whole = about_forearm(wrist[0]);
    CHECK(std::abs(whole) > 0.3);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(std::abs(about_forearm(twist[0][i]) -
                       whole * static_cast<double>(i + 1) / 4) < 0.0022);
}

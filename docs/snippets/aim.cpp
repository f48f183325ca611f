// SPDX-License-Identifier: MIT
#include "check.h"

TEST_CASE("docs: aiming")
{
    // [shown]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_AIM)});
    // Along the hand, +z at rest, with the elbow bent by half a radian.
    const Double3 along_hand{0, 0, 1};
    crowd.write_all(SWIVEL_AIM, 0, swivel::aim(along_hand, 0.5));
    crowd.write_all(SWIVEL_TARGET, 0, Float3{2, 1, 5});  // what to point at
    // [end]
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
    crowd.solve();
    std::array<Double3, 1> elbow, wrist;
    crowd.elbows(0, elbow);
    crowd.wrists(0, wrist);
    const Eigen::Vector3d upper = vec(elbow[0]), fore = vec(wrist[0]) - vec(elbow[0]);
    const Eigen::Vector3d ray = Eigen::Vector3d(2, 1, 5) - vec(wrist[0]);
    CHECK(ray.normalized().cross(fore.normalized()).norm() < 1e-6);
    CHECK(ray.dot(fore) > 0);
    CHECK(std::acos(upper.normalized().dot(fore.normalized())) == Approx(0.5));
}

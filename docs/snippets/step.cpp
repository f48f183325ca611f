// SPDX-License-Identifier: MIT
#include "check.h"

TEST_CASE("docs: step limit")
{
    const Float3 target{0, 0.3f, 1.5f};
    std::array<Double3, 1> before, after;
    // [shown]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_MAX_SWIVEL)});
    // Radians for each solve: 0.1 at 60 a second is 6 a second.
    crowd.write_all(SWIVEL_MAX_SWIVEL, 0, swivel::cos_sin(0.1));
    // [end]
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
    crowd.write_all(SWIVEL_TARGET, 0, target);
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
    crowd.solve();
    crowd.elbows(0, before);
    crowd.write_all(SWIVEL_POLE, 0, Float3{1, 0, 0});  // a quarter turn away
    crowd.solve();  // the elbow starts towards it: SWIVEL_LIMITED_STEP
    crowd.elbows(0, after);
    const Eigen::Vector3d line = vec(target).normalized();
    const auto side = [&](const Double3& elbow) {
        return (vec(elbow) - vec(elbow).dot(line) * line).normalized();
    };
    CHECK(std::acos(side(before[0]).dot(side(after[0]))) == Approx(0.1).epsilon(1e-4));
    // [reset]
    // After a teleport: the group's next solve goes straight to its wish.
    crowd.reset(0);
    crowd.solve();
    // [end]
    crowd.elbows(0, after);
    CHECK(std::abs(side(before[0]).dot(side(after[0]))) < 1e-5);
}

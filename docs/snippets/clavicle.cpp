// SPDX-License-Identifier: MIT
#include "check.h"

TEST_CASE("docs: clavicle")
{
    // [shown]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WORLD | SWIVEL_WITH_CLAVICLE)});
    // The shoulder, as the clavicle's joint has it, and a third of the way.
    crowd.write_all(SWIVEL_CLAVICLE, 0, Float4{0.15f, 0, 0, 0.33f});
    // As they are without this turn.
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0.2f, 1.4f, 0});
    crowd.write_all(SWIVEL_PARENT_ROTATION, 0, Float4{0, 0, 0, 1});
    // [end]
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{0.30f, 0.26f});
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.3f, 1.8f, 0.2f});
    crowd.write_all(SWIVEL_POLE, 0, Float3{0.5f, 1, -1});
    crowd.solve();
    std::array<Float4, 1> turn;
    crowd.read(SWIVEL_CLAVICLE_ROTATION, 0, turn);
    std::array<Double3, 1> elbow, wrist;
    crowd.elbows(0, elbow);
    crowd.wrists(0, wrist);
    const Eigen::Vector3d joint(0.05, 1.4, 0), bone(0.15, 0, 0);
    const Eigen::Vector3d shoulder = joint + quat(turn[0]) * bone;
    CHECK((shoulder - Eigen::Vector3d(0.2, 1.4, 0)).norm() > 0.02);
    CHECK((vec(elbow[0]) - shoulder).norm() == Approx(0.30));
    CHECK((vec(wrist[0]) - Eigen::Vector3d(0.3, 1.8, 0.2)).norm() < 1e-6);
}

// SPDX-License-Identifier: MIT
#include "check.h"

TEST_CASE("docs: legs")
{
    // [leg]
    // Thigh, shin and foot joints at rest: bones down -y, knees forward, +z.
    swivel_chain leg = swivel_default_chain();
    leg.elbow_offset[1] = -0.45f;
    leg.wrist_offset[1] = -0.42f;
    leg.bend[2] = -1;  // the knee bends backwards
    const swivel_binding left_leg = swivel::bind(leg);
    // [end]
    const swivel_group_def legs = swivel::group(1, left_leg);
    swivel::Crowd crowd(SWIVEL_WORLD | SWIVEL_JOINTS, {&legs, 1});
    // [leg_solve]
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0.1f, 0.95f, 0});  // the hip
    // The ankle, on a step.
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.1f, 0.25f, 0.1f});
    // In front: where the knee points.
    crowd.write_all(SWIVEL_POLE, 0, Float3{0.1f, 0.5f, 2});
    crowd.solve();
    // [end]
    std::array<Float4, 1> thigh, shin;
    crowd.read(SWIVEL_SHOULDER, 0, thigh);
    crowd.read(SWIVEL_ELBOW, 0, shin);
    const Eigen::Vector3d hip(0.1, 0.95, 0),
        knee = hip + quat(thigh[0]) * Eigen::Vector3d(0, -0.45, 0);
    const Eigen::Vector3d ankle =
        knee + quat(thigh[0]) * (quat(shin[0]) * Eigen::Vector3d(0, -0.42, 0));
    CHECK((ankle - Eigen::Vector3d(0.1, 0.25, 0.1)).norm() < 1e-6);
    CHECK(knee.z() > 0.2);
}

TEST_CASE("docs: mirrored limits")
{
    // [mirror]
    const std::array<float, 4> left = swivel::range(-1.5, 0.4);
    std::array<float, 4> right;
    swivel::check(
        swivel_mirror(SWIVEL_HUMERAL_TWIST, SWIVEL_XYZ, left.data(), right.data()));
    // [end]
    const swivel_group_def arms[] = {swivel::group(1), swivel::group(1)};
    swivel::Crowd crowd(SWIVEL_WITH_HUMERAL_TWIST, arms);
    for (const std::uint32_t side : {0u, 1u})
        crowd.write_all(SWIVEL_LENGTHS, side, Float2{1, 1});
    crowd.write_all(SWIVEL_HUMERAL_TWIST, 0, left);
    crowd.write_all(SWIVEL_HUMERAL_TWIST, 1, right);
    std::array<Double3, 1> elbow[2];
    for (std::uint32_t side = 0; side < 2; ++side) {  // mirrored in x
        const float sign = side == 0 ? 1.0f : -1.0f;
        crowd.write_all(SWIVEL_TARGET, side, Float3{sign * 0.7f, 0.4f, 1});
        crowd.write_all(SWIVEL_POLE, side, Float3{sign, 2, 0});
    }
    crowd.solve();
    crowd.elbows(0, elbow[0]);
    crowd.elbows(1, elbow[1]);
    elbow[1][0][0] = -elbow[1][0][0];
    CHECK(distance(elbow[0][0], elbow[1][0]) < 1e-5);
    std::array<std::uint32_t, 1> flags;
    crowd.read(SWIVEL_FLAGS, 0, flags);
    CHECK(flags[0] & SWIVEL_LIMITED_HUMERAL_TWIST);
}

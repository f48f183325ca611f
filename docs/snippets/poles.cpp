// SPDX-License-Identifier: MIT
#include "check.h"

namespace {

const Float3 target{0.3f, 0.1f, 0.3f};

void give_arm(swivel::Crowd& crowd)
{
    crowd.write_all(SWIVEL_TARGET, 0, target);
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{0.30f, 0.26f});
}

Eigen::Vector3d elbow_of(const swivel::Crowd& crowd)
{
    std::array<Double3, 1> elbow;
    crowd.elbows(0, elbow);
    return vec(elbow[0]);
}

// The elbow is in the half plane of the line and the pole.
void check_side(const Eigen::Vector3d& elbow, const Eigen::Vector3d& pole)
{
    const Eigen::Vector3d normal = vec(target).cross(pole).normalized(),
                          side = normal.cross(vec(target)).normalized();
    CHECK(std::abs(elbow.dot(normal)) < 1e-6);
    CHECK(elbow.dot(side) > 0.05);
}

}  // namespace

TEST_CASE("docs: pole directions")
{
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WORLD | SWIVEL_POLE_DIRECTION)});
    // Downwards, wherever the character stands.
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0, 0, 0});
    give_arm(crowd);
    crowd.solve();
    check_side(elbow_of(crowd), {0, -1, 0});
}

TEST_CASE("docs: pole normals")
{
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_POLE_NORMAL)});
    // Across shoulder, elbow and wrist: the elbow's axis.
    crowd.write_all(SWIVEL_POLE, 0, Float3{1, 0, -1});
    give_arm(crowd);
    crowd.solve();
    check_side(elbow_of(crowd), Eigen::Vector3d(1, 0, -1).cross(vec(target)));
}

TEST_CASE("docs: the hand as the pole")
{
    // [hand]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_HAND | SWIVEL_POLE_HAND)});
    // The hand points to the side, so the forearm comes from the other.
    crowd.write_all(SWIVEL_HAND, 0, Float4{0, 0.6f, 0, 0.8f});
    // [end]
    give_arm(crowd);
    crowd.solve();
    const Eigen::Vector3d hand =
        Eigen::Quaterniond(0.8, 0, 0.6, 0) * Eigen::Vector3d::UnitZ();
    check_side(elbow_of(crowd), -hand);
}

TEST_CASE("docs: swivel angle")
{
    // [angle]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_ANGLE)});
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
    // Radians on from the pole, about the line to the wrist.
    crowd.write_all(SWIVEL_ANGLE, 0, swivel::cos_sin(0.35));
    // [end]
    give_arm(crowd);
    crowd.solve();
    const Eigen::AngleAxisd on(0.35, vec(target).normalized());
    check_side(elbow_of(crowd), on * Eigen::Vector3d(0, -1, 0));
}

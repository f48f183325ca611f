// SPDX-License-Identifier: MIT
#include "check.h"

#include <limits>

namespace {

struct Character {
    Float3 hip, ankle, knee_hint;
    Float4 thigh = {}, shin = {};
    Float3 shoulder, grip, elbow_hint;
    Float4 palm;
    Float4 upper_arm = {}, forearm = {}, hand = {};
};

// The last joint's place, by the skeleton's own forward kinematics.
Eigen::Vector3d end_of(const Float3& start, const Float4& first, const Float3& upper,
                       const Float4& second, const Float3& fore)
{
    return vec(start) + quat(first) * (vec(upper) + quat(second) * vec(fore));
}

}  // namespace

TEST_CASE("docs: groups of different features")
{
    const Float3 thigh{0, -0.45f, 0}, shin{0, -0.42f, 0};
    const Float3 upper_arm{0.30f, 0, 0}, forearm{0.26f, 0, 0};
    const swivel_binding left_leg = bound(thigh, shin, {0, 0, -1});  // backwards
    const swivel_binding left_arm = bound(upper_arm, forearm, {0, 0, 1});
    const Character one{.hip = {0.1f, 0.95f, 0},
                        .ankle = {0.1f, 0.25f, 0.1f},
                        .knee_hint = {0.1f, 0.5f, 2},
                        .shoulder = {0.2f, 1.4f, 0},
                        .grip = {0.3f, 1.3f, -0.3f},  // behind the back
                        .elbow_hint = {0.2f, 1.4f, -1},
                        .palm = {0.6f, 0, 0, 0.8f}};
    const std::uint32_t count = 20;
    std::vector<Character> characters(count, one);
    // [crowd]
    // Each group takes memory and time for its own features alone.
    const swivel_features own_joints = SWIVEL_WORLD | SWIVEL_JOINTS;
    swivel_limb_def left_legs = swivel::limbs(count, own_joints);
    left_legs.binding = left_leg;
    swivel_limb_def left_arms =
        swivel::limbs(count, own_joints | SWIVEL_WITH_HAND | SWIVEL_WITH_SHOULDER_CONE);
    left_arms.binding = left_arm;
    swivel::Crowd crowd({left_legs, left_arms});
    const std::uint32_t legs = 0, arms = 1;  // groups, in this order
    // Upper arms stay within 80 degrees of forwards and down.
    const std::array<double, 3> axis =
        swivel::arm_axis(left_arm, {0, 0, 0, 1}, {0, -1, 1});
    crowd.write_all(SWIVEL_SHOULDER_CONE, arms,
                    swivel::cone(axis, swivel::degrees(80)));
    // [end]
    // [streams]
    swivel::Streams leg;
    leg.in(SWIVEL_SHOULDER_POSITION, swivel::stream(characters, &Character::hip));
    leg.in(SWIVEL_TARGET, swivel::stream(characters, &Character::ankle));
    leg.in(SWIVEL_POLE, swivel::stream(characters, &Character::knee_hint));
    leg.out(SWIVEL_SHOULDER, swivel::stream(characters, &Character::thigh));
    leg.out(SWIVEL_ELBOW, swivel::stream(characters, &Character::shin));

    swivel::Streams arm;
    arm.in(SWIVEL_SHOULDER_POSITION, swivel::stream(characters, &Character::shoulder));
    arm.in(SWIVEL_TARGET, swivel::stream(characters, &Character::grip));
    arm.in(SWIVEL_POLE, swivel::stream(characters, &Character::elbow_hint));
    arm.in(SWIVEL_HAND, swivel::stream(characters, &Character::palm));
    arm.out(SWIVEL_SHOULDER, swivel::stream(characters, &Character::upper_arm));
    arm.out(SWIVEL_ELBOW, swivel::stream(characters, &Character::forearm));
    arm.out(SWIVEL_WRIST, swivel::stream(characters, &Character::hand));

    crowd.solve({.streams = {leg, arm}});  // one job; streams for each group
    // [end]
    for (const Character& each : characters) {
        CHECK((end_of(each.hip, each.thigh, thigh, each.shin, shin) - vec(each.ankle))
                  .norm() < 1e-6);
        CHECK((end_of(each.shoulder, each.upper_arm, upper_arm, each.forearm, forearm) -
               vec(each.grip))
                  .norm() < 1e-6);
        const Eigen::Quaterniond hand =
            quat(each.upper_arm) * quat(each.forearm) * quat(each.hand);
        CHECK(hand.angularDistance(quat(each.palm)) < 1e-6);
        const Eigen::Vector3d upper = quat(each.upper_arm) * Eigen::Vector3d::UnitX();
        CHECK(upper.dot(Eigen::Vector3d(0, -1, 1).normalized()) >
              std::cos(swivel::degrees(80)) - 1e-5);
    }
    std::vector<std::uint32_t> flags(count);
    crowd.read(SWIVEL_FLAGS, legs, flags);
    CHECK(flags[0] == SWIVEL_REACHED);
    crowd.read(SWIVEL_FLAGS, arms, flags);
    CHECK(flags[0] == (SWIVEL_REACHED | SWIVEL_LIMITED_SHOULDER_CONE));
    CHECK(swivel_field_row_count(crowd.get(), legs, SWIVEL_SHOULDER_CONE) == 0);
    CHECK(swivel_group_features(crowd.get(), legs) == own_joints);

    const Float4 before = characters[7].thigh;
    for (Character& each : characters) {
        each.ankle = {0.1f, 0.2f, 0};
        each.grip = {0.4f, 1.3f, 0.3f};
    }
    // [some]
    const std::uint32_t solved =
        crowd.solve({.groups = std::array{arms}, .streams = {arm}});
    // [end]
    CHECK(solved == count);
    CHECK(characters[7].thigh == before);
    crowd.read(SWIVEL_FLAGS, arms, flags);
    CHECK(flags[7] == SWIVEL_REACHED);
}

TEST_CASE("docs: bad input that keeps the pose")
{
    // [keep]
    swivel_limb_def arms = swivel::limbs(2);
    arms.on_bad_input = SWIVEL_KEEP_POSE;
    swivel::Crowd crowd({arms});
    // [end]
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{0.30f, 0.26f});
    std::array<Float3, 2> targets{{{0.3f, 0.1f, 0.3f}, {0.2f, 0.2f, 0.3f}}};
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.solve();
    std::array<Float4, 2> before, after;
    crowd.read(SWIVEL_SHOULDER, 0, before);
    targets[0] = {0.1f, 0.1f, 0.4f};
    targets[1][0] = std::numeric_limits<float>::quiet_NaN();  // the tracker lost it
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.solve();
    crowd.read(SWIVEL_SHOULDER, 0, after);
    CHECK(after[0] != before[0]);
    CHECK(after[1] == before[1]);
    std::array<std::uint32_t, 2> flags;
    crowd.read(SWIVEL_FLAGS, 0, flags);
    CHECK(flags[0] == SWIVEL_REACHED);
    CHECK(flags[1] == SWIVEL_BAD_INPUT);
}

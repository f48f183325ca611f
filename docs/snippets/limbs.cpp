// SPDX-License-Identifier: MIT
#include "check.h"

TEST_CASE("docs: legs")
{
    // [leg]
    // Pelvis, hip, knee and ankle at rest: bones down -y, knees forward, +z.
    const std::int32_t parents[] = {-1, 0, 1, 2};
    const Float3 translations[] = {
        {0, 0.95f, 0}, {0.1f, 0, 0}, {0, -0.45f, 0}, {0, -0.42f, 0}};
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.joint_count = 4;
    skeleton.parents = swivel::stream(parents);
    skeleton.translations = swivel::stream(translations);
    swivel_limb_joints leg = swivel_default_limb_joints(1, 2, 3);
    leg.bend[2] = -1;  // the knee bends backwards
    swivel_limb_def left_leg = swivel::limbs(1, SWIVEL_WORLD | SWIVEL_JOINTS);
    left_leg.binding = swivel::bind(skeleton, leg);
    swivel::Crowd crowd({left_leg});
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0.1f, 0.95f, 0});  // the hip
    // The ankle, on a step.
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.1f, 0.25f, 0.1f});
    // In front: where the knee points.
    crowd.write_all(SWIVEL_POLE, 0, Float3{0.1f, 0.5f, 2});
    crowd.solve();
    std::array<Float4, 1> thigh, shin;  // local rotations, x, y, z, w
    crowd.read(SWIVEL_SHOULDER, 0, thigh);
    crowd.read(SWIVEL_ELBOW, 0, shin);
    // [end]
    const Eigen::Vector3d hip(0.1, 0.95, 0),
        knee = hip + quat(thigh[0]) * Eigen::Vector3d(0, -0.45, 0);
    const Eigen::Vector3d ankle =
        knee + quat(thigh[0]) * (quat(shin[0]) * Eigen::Vector3d(0, -0.42, 0));
    CHECK((ankle - Eigen::Vector3d(0.1, 0.25, 0.1)).norm() < 1e-6);
    CHECK(knee.z() > 0.2);
}

TEST_CASE("docs: joints of a skeleton")
{
    // [skeleton]
    struct Joint {
        std::int32_t parent;
        Float3 place;     // in the parent's frame
        Float4 rotation;  // relative to the parent
    };
    const Float4 none = {0, 0, 0, 1};
    const std::vector<Joint> joints = {
        {-1, {0, 1.4f, 0}, none},  // 0: chest
        {0, {0.2f, 0, 0}, none},   // 1: upper arm
        {1, {0.15f, 0, 0}, none},  // 2: a roll joint in it
        {2, {0.15f, 0, 0}, none},  // 3: forearm
        {3, {0.13f, 0, 0}, none},  // 4: its twist bone
        {3, {0.26f, 0, 0}, none},  // 5: hand
    };
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.joint_count = 6;
    skeleton.parents = swivel::stream(joints, &Joint::parent);
    skeleton.translations = swivel::stream(joints, &Joint::place);
    skeleton.rotations = swivel::stream(joints, &Joint::rotation);

    swivel_limb_joints left = swivel_default_limb_joints(1, 3, 5);
    const std::uint32_t twist_bones[] = {4};
    left.twist_bones = twist_bones;
    left.twist_bone_count = 1;
    left.bend[2] = 1;  // the elbow bends forwards
    swivel_limb_def left_arm =
        swivel::limbs(1, SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND);
    left_arm.binding = swivel::bind(skeleton, left);
    left_arm.twist_bone_count = 1;
    // [end]
    swivel::Crowd crowd({left_arm});
    const Eigen::Vector3d shoulder(0.2, 1.4, 0), target(0.3, 1.2, 0.35);
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0.2f, 1.4f, 0});
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.3f, 1.2f, 0.35f});
    crowd.write_all(SWIVEL_POLE, 0, Float3{0.5f, 0, 0});
    crowd.write_all(SWIVEL_HAND, 0, Float4{0.6f, 0, 0, 0.8f});
    crowd.solve();
    std::array<Float4, 1> upper, fore, hand, twist;
    crowd.read(SWIVEL_SHOULDER, 0, upper);
    crowd.read(SWIVEL_ELBOW, 0, fore);
    crowd.read(SWIVEL_WRIST, 0, hand);
    crowd.read(SWIVEL_TWIST_BONES, 0, twist);
    const Eigen::Quaterniond elbow_w = quat(upper[0]) * quat(fore[0]);
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX(),
                          wrist = shoulder + quat(upper[0]) * (0.3 * x) +
                                  elbow_w * (0.26 * x);
    CHECK((wrist - target).norm() < 1e-6);
    CHECK(
        (elbow_w * quat(hand[0])).angularDistance(Eigen::Quaterniond(0.8, 0.6, 0, 0)) <
        1e-5);
    const auto about_x = [](const Float4& q) { return 2 * std::atan2(q[0], q[3]); };
    CHECK(std::abs(about_x(twist[0]) - about_x(hand[0]) / 2) < 0.0022);
}

TEST_CASE("docs: mirrored limits")
{
    // [mirror]
    const std::array<float, 4> left = swivel::range(-1.5, 0.4);
    std::array<float, 4> right;
    swivel::check(
        swivel_mirror(SWIVEL_HUMERAL_TWIST, SWIVEL_XYZ, left.data(), right.data()));
    // [end]
    const swivel_limb_def arm = swivel::limbs(1, SWIVEL_WITH_HUMERAL_TWIST);
    swivel::Crowd crowd({arm, arm});
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

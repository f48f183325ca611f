// SPDX-License-Identifier: MIT
#include "check.h"

namespace {

enum Joint {
    kSpine,
    kRightArm,
    kRightForearm,
    kRightHand,
    kLeftArm,
    kLeftForearm,
    kLeftHand,
    kSeat,
    kJoints
};
const Bones<kJoints> bones = {{-1, 0, 1, 2, 0, 4, 5, -1},
                              {{{0, 1.4f, 0},
                                {-0.2f, 0, 0},
                                {0, -0.3f, 0},
                                {0, -0.26f, 0},
                                {0.2f, 0, 0},
                                {0, -0.3f, 0},
                                {0, -0.26f, 0},
                                {0, 0.8f, 0.4f}}}};
const swivel_skeleton skeleton = bones.skeleton();
const swivel_limb_joints right = bones.limb(kRightArm, 1),
                         left = bones.limb(kLeftArm, 1);
using Grip = std::array<float, 7>;  // place, rotation

// Both forearms ahead.
struct Character : Posed<kJoints> {
    Grip rifle;
    std::uint32_t left_flags;

    Character()
    {
        for (const std::size_t arm : {kRightArm, kLeftArm}) {
            pose[arm] = {-std::sin(0.3f), 0, 0, std::cos(0.3f)};
            pose[arm + 1] = {-std::sin(0.5f), 0, 0, std::cos(0.5f)};
        }
        solved = pose;
    }
};

// How far the left hand is from its grip in the frame of the right one.
double off(const Character& character, const Eigen::Vector3d& grip)
{
    return (bones.frame(character, kRightHand) * grip -
            bones.frame(character, kLeftHand).translation())
        .norm();
}

}  // namespace

TEST_CASE("docs: a hand that holds the other one")
{
    // [hand]
    const swivel_features features = SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND;
    const swivel_body_limb_def leading = swivel::body_limb(right, features);
    swivel_body_limb_def holding = swivel::body_limb(left, features | SWIVEL_WITH_LINK);
    holding.link = 0;  // the group of right arms
    swivel::Crowd crowd(skeleton, 40, {leading, holding});
    const Grip grip = {0.05f, 0, 0.1f, 0, 0, 0, 1};  // in the right hand's frame
    crowd.write_all(SWIVEL_GRIP, 1, grip);
    // [end]
    std::vector<Character> characters(40);
    crowd.write_all(SWIVEL_TARGET, 0, Float3{-0.05f, 1.3f, 0.4f});
    const swivel_pose pose = pose_of(characters);
    crowd.solve({.pose = &pose});
    for (const Character& each : characters) CHECK(off(each, {0.05, 0, 0.1}) < 2e-6);
}

TEST_CASE("docs: a rifle in both hands")
{
    std::vector<Character> characters(40);
    const swivel_pose pose = pose_of(characters);
    // [prop]
    const swivel_features features =
        SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND | SWIVEL_WITH_LINK;
    swivel_body_limb_def right_hand = swivel::body_limb(right, features);
    swivel_body_limb_def left_hand = swivel::body_limb(left, features);
    right_hand.link = left_hand.link = 2;  // the rifle is the third group
    swivel::Crowd crowd(skeleton, 40,
                        {right_hand, left_hand, swivel_default_prop_def()});
    // On the rifle: the right hand at its origin, the left one ahead of it.
    crowd.write_all(SWIVEL_GRIP, 0, Grip{0, 0, 0, 0, 0, 0, 1});
    crowd.write_all(SWIVEL_GRIP, 1, Grip{0.1f, 0, 0.25f, 0, 0, 0, 1});
    // [end]
    // [frame]
    swivel::Streams right_arm, left_arm, rifle;
    rifle.out(SWIVEL_PROP_TRANSFORM, swivel::stream(characters, &Character::rifle));
    left_arm.out(SWIVEL_FLAGS, swivel::stream(characters, &Character::left_flags));
    crowd.solve({.streams = {right_arm, left_arm, rifle}, .pose = &pose});
    // [end]
    for (const Character& each : characters) {
        CHECK(each.left_flags == SWIVEL_REACHED);
        CHECK(off(each, {0.1, 0, 0.25}) < 2e-6);
        CHECK(distance(each.rifle, bones.frame(each, kRightHand).translation()) < 1e-6);
    }
}

TEST_CASE("docs: a wheel, and a thing on a joint")
{
    const swivel_features features =
        SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND | SWIVEL_WITH_LINK;
    swivel_body_limb_def right_hand = swivel::body_limb(right, features);
    swivel_body_limb_def left_hand = swivel::body_limb(left, features);
    right_hand.link = left_hand.link = 2;
    // [wheel]
    swivel_prop_def wheel = swivel_default_prop_def();
    wheel.joint = kSeat;  // its place and turn are in this joint's frame
    wheel.max_move = 0;   // it does not come to the hands
    // [end]
    swivel::Crowd crowd(skeleton, 40, {right_hand, left_hand, wheel});
    crowd.write_all(SWIVEL_GRIP, 0, Grip{-0.2f, 0, 0, 0, 0, 0, 1});
    crowd.write_all(SWIVEL_GRIP, 1, Grip{0.2f, 0, 0, 0, 0, 0, 1});
    const Float4 turned = {0, 0, std::sin(0.2f), std::cos(0.2f)};
    crowd.write_all(SWIVEL_PROP_POSITION, 2, Float3{0, 0.4f, 0});
    crowd.write_all(SWIVEL_PROP_ROTATION, 2, turned);
    std::vector<Character> characters(40);
    const swivel_pose pose = pose_of(characters);
    crowd.solve({.pose = &pose});
    const Character& each = characters[3];
    const Eigen::Vector3d rim = quat(turned) * Eigen::Vector3d(0.2, 0, 0),
                          hub(0, 0.4, 0);
    const Eigen::Isometry3d seat = bones.frame(each, kSeat);
    CHECK(distance(bones.frame(each, kLeftHand).translation(), seat * (hub + rim)) <
          2e-6);
    CHECK(distance(bones.frame(each, kRightHand).translation(), seat * (hub - rim)) <
          2e-6);
}

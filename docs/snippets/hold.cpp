// SPDX-License-Identifier: MIT
#include "check.h"

#include <swivel/swivel_bodies.hpp>

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
const std::array<std::int32_t, kJoints> kParents = {-1, 0, 1, 2, 0, 4, 5, -1};
const std::array<Float3, kJoints> kOffsets = {{{0, 1.4f, 0},
                                               {-0.2f, 0, 0},
                                               {0, -0.3f, 0},
                                               {0, -0.26f, 0},
                                               {0.2f, 0, 0},
                                               {0, -0.3f, 0},
                                               {0, -0.26f, 0},
                                               {0, 0.8f, 0.4f}}};
using Grip = std::array<float, 7>;  // place, rotation

struct Character {
    Float3 place;
    Float4 rotation;
    std::array<Float4, kJoints> pose, solved;
    Grip rifle;
    std::uint32_t left_flags;
};

// Both forearms ahead.
Character armed(float x)
{
    Character made{{x, 0, 0}, {0, 0, 0, 1}, {}, {}, {}, 0};
    made.pose.fill({0, 0, 0, 1});
    for (const Joint arm : {kRightArm, kLeftArm}) {
        made.pose[arm] = {-std::sin(0.3f), 0, 0, std::cos(0.3f)};
        made.pose[arm + 1] = {-std::sin(0.5f), 0, 0, std::cos(0.5f)};
    }
    made.solved = made.pose;
    return made;
}

// Where a joint is in the world, and how it is turned.
struct Frame {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
};
Frame frame_of(const Character& character, std::int32_t joint)
{
    if (joint < 0) return {vec(character.place), quat(character.rotation)};
    const auto n = static_cast<std::size_t>(joint);
    const Frame above = frame_of(character, kParents[n]);
    return {above.place + above.turn * vec(kOffsets[n]),
            above.turn * quat(character.solved[n])};
}

struct Scene {
    swivel_limb_joints right = swivel_default_limb_joints(kRightArm, kRightForearm,
                                                          kRightHand),
                       left = swivel_default_limb_joints(kLeftArm, kLeftForearm,
                                                         kLeftHand);
    std::vector<Character> characters;
    swivel_pose pose = swivel_default_pose();

    Scene()
    {
        right.bend[2] = left.bend[2] = 1;
        for (int n = 0; n < 40; ++n) characters.push_back(armed(static_cast<float>(n)));
        pose.rotations = {characters[0].pose.data(), sizeof(Character), sizeof(Float4),
                          nullptr};
        pose.results = {characters[0].solved.data(), sizeof(Character), sizeof(Float4),
                        nullptr};
        pose.root_position = swivel::stream(characters, &Character::place);
        pose.root_rotation = swivel::stream(characters, &Character::rotation);
    }
    // How far the worst left hand is from a place in the right hand's frame.
    double worst(const Float3& grip) const
    {
        double max = 0;
        for (const Character& each : characters) {
            const Frame leader = frame_of(each, kRightHand);
            const Eigen::Vector3d at = leader.place + leader.turn * vec(grip);
            max = std::max(max, (frame_of(each, kLeftHand).place - at).norm());
        }
        return max;
    }
};

swivel_skeleton trunk()
{
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = swivel::stream(kParents);
    skeleton.translations = swivel::stream(kOffsets);
    skeleton.joint_count = kJoints;
    return skeleton;
}

}  // namespace

TEST_CASE("docs: a hand that holds the other one")
{
    Scene scene;
    const swivel_skeleton skeleton = trunk();
    const swivel_limb_joints right = scene.right, left = scene.left;
    // [hand]
    const swivel_features features = SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND;
    const swivel_body_limb_def leading = swivel::body_limb(right, features);
    swivel_body_limb_def holding = swivel::body_limb(left, features | SWIVEL_WITH_LINK);
    holding.link = 0;  // the group of right arms
    swivel::Crowd crowd(skeleton, 40, {leading, holding});
    const Grip grip = {0.05f, 0, 0.1f, 0, 0, 0, 1};  // in the right hand's frame
    crowd.write_all(SWIVEL_GRIP, 1, grip);
    // [end]
    std::vector<Float3> targets;
    for (const Character& each : scene.characters)
        targets.push_back({each.place[0] - 0.05f, 1.3f, 0.4f});
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.solve({.pose = &scene.pose});
    CHECK(scene.worst({0.05f, 0, 0.1f}) < 2e-6);
}

TEST_CASE("docs: a rifle in both hands")
{
    Scene scene;
    std::vector<Character>& characters = scene.characters;
    const swivel_skeleton skeleton = trunk();
    const swivel_limb_joints right = scene.right, left = scene.left;
    const swivel_pose& pose = scene.pose;
    const std::vector<Character> animated = characters;
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
    CHECK(scene.worst({0.1f, 0, 0.25f}) < 2e-6);
    for (std::size_t n = 0; n < characters.size(); ++n) {
        CHECK(characters[n].left_flags == SWIVEL_REACHED);
        CHECK(characters[n].solved[kRightArm] == animated[n].pose[kRightArm]);
        CHECK(distance(characters[n].rifle, frame_of(animated[n], kRightHand).place) <
              1e-6);
    }

    crowd.write_all(SWIVEL_HAND_BLEND, 2, std::array{0.5f});
    crowd.solve({.pose = &pose});
    CHECK(scene.worst({0.1f, 0, 0.25f}) < 3e-6);
    CHECK(characters[3].solved[kRightArm] != animated[3].pose[kRightArm]);
}

TEST_CASE("docs: a wheel, and a thing on a joint")
{
    Scene scene;
    const swivel_skeleton skeleton = trunk();
    const swivel_features features =
        SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND | SWIVEL_WITH_LINK;
    swivel_body_limb_def right_hand = swivel::body_limb(scene.right, features);
    swivel_body_limb_def left_hand = swivel::body_limb(scene.left, features);
    right_hand.link = left_hand.link = 2;
    // [wheel]
    swivel_prop_def wheel = swivel_default_prop_def();
    wheel.joint = kSeat;  // its place and turn are in this joint's frame
    wheel.max_move = 0;   // it does not come to the hands
    // [end]
    swivel::Crowd crowd(skeleton, 40, {right_hand, left_hand, wheel});
    crowd.write_all(SWIVEL_GRIP, 0, Grip{-0.2f, 0, 0, 0, 0, 0, 1});
    crowd.write_all(SWIVEL_GRIP, 1, Grip{0.2f, 0, 0, 0, 0, 0, 1});
    const float angle = 0.4f;
    const Float4 turned = {0, 0, std::sin(angle / 2), std::cos(angle / 2)};
    crowd.write_all(SWIVEL_PROP_POSITION, 2, Float3{0, 0.4f, 0});
    crowd.write_all(SWIVEL_PROP_ROTATION, 2, turned);
    crowd.solve({.pose = &scene.pose});
    for (const Character& each : scene.characters) {
        const Frame seat = frame_of(each, kSeat);
        const Eigen::Vector3d hub = seat.place + seat.turn * Eigen::Vector3d(0, 0.4, 0);
        const Eigen::Vector3d rim =
            seat.turn * (quat(turned) * Eigen::Vector3d(0.2, 0, 0));
        CHECK((frame_of(each, kLeftHand).place - (hub + rim)).norm() < 2e-6);
        CHECK((frame_of(each, kRightHand).place - (hub - rim)).norm() < 2e-6);
    }
}

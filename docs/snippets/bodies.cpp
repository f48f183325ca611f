// SPDX-License-Identifier: MIT
#include "check.h"

#include <string>
#include <swivel/swivel_bodies.hpp>
#include <swivel/swivel_explain.hpp>

namespace {

// hips, upper leg, lower leg, foot; chest, upper arm, forearm, hand
enum Joint { kHips, kThigh, kShin, kFoot, kChest, kUpperArm, kForearm, kHand, kJoints };
const std::array<std::int32_t, kJoints> kParents = {-1, 0, 1, 2, 0, 4, 5, 6};
const std::array<Float3, kJoints> kOffsets = {{{0, 1, 0},
                                               {-0.1f, 0, 0},
                                               {0, -0.45f, 0},
                                               {0, -0.45f, 0},
                                               {0, 0.4f, 0},
                                               {-0.2f, 0.1f, 0},
                                               {-0.3f, 0, 0},
                                               {-0.26f, 0, 0}}};

struct Character {
    Float3 place;  // of the root, in the world
    Float4 rotation;
    std::array<Float4, kJoints> pose;    // local rotations, as the animation has them
    std::array<Float4, kJoints> solved;  // a copy with the limbs solved: draw this one
    Float3 hand_target, foot_target;
};

// Where a joint is in the world: the skeleton's own forward kinematics.
Eigen::Vector3d place_of(const Character& character, int joint)
{
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    for (; joint >= 0; joint = kParents[static_cast<std::size_t>(joint)]) {
        const auto n = static_cast<std::size_t>(joint);
        at = vec(kOffsets[n]) + quat(character.solved[n]) * at;
    }
    return vec(character.place) + quat(character.rotation) * at;
}

}  // namespace

TEST_CASE("docs: bodies")
{
    Character stands{{2, 0, 3}, {0, 0, 0, 1},       {},
                     {},        {1.6f, 1.3f, 3.3f}, {1.9f, 0.2f, 3.2f}};
    stands.pose.fill({0, 0, 0, 1});
    std::vector<Character> characters(40, stands);
    characters[7].hand_target[0] = std::nanf("");
    const Character before = characters[7];
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = swivel::stream(kParents);
    skeleton.translations = swivel::stream(kOffsets);
    skeleton.joint_count = kJoints;
    swivel_limb_joints arm = swivel_default_limb_joints(kUpperArm, kForearm, kHand),
                       leg = swivel_default_limb_joints(kThigh, kShin, kFoot);
    arm.bend[2] = 1;   // where flexion carries the forearm, in the upper arm's frame
    leg.bend[2] = -1;  // and the shin: backwards
    swivel::Crowd crowd(skeleton, 40,
                        {swivel::body_limb(arm, SWIVEL_POLE_INCOMING),
                         swivel::body_limb(leg, SWIVEL_POLE_INCOMING)});
    for (Character& each : characters) each.solved = each.pose;
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {characters[0].pose.data(), sizeof(Character), sizeof(Float4),
                      nullptr};
    pose.results = {characters[0].solved.data(), sizeof(Character), sizeof(Float4),
                    nullptr};
    pose.root_position = swivel::stream(characters, &Character::place);
    pose.root_rotation = swivel::stream(characters, &Character::rotation);
    swivel::Streams arms, legs;
    arms.in(SWIVEL_TARGET, swivel::stream(characters, &Character::hand_target));
    legs.in(SWIVEL_TARGET, swivel::stream(characters, &Character::foot_target));
    crowd.solve({.streams = {arms, legs}, .pose = &pose});
    for (const Character& character : characters) {
        if (&character == &characters[7]) continue;
        CHECK((place_of(character, kHand) - vec(character.hand_target)).norm() < 2e-6);
        CHECK((place_of(character, kFoot) - vec(character.foot_target)).norm() < 2e-6);
    }
    CHECK(characters[7].solved[kUpperArm] == before.pose[kUpperArm]);
    // [places]
    std::vector<std::array<Float3, kJoints>> places(characters.size());
    pose.joint_positions = {places.data(), sizeof places[0], sizeof(Float3), nullptr};
    crowd.solve({.streams = {arms, legs}, .pose = &pose});
    const Float3 foot_from_root = places[3][kFoot];  // in the root's frame
    // [end]
    const Eigen::Vector3d foot = vec(stands.place) + vec(foot_from_root);
    CHECK((foot - vec(stands.foot_target)).norm() < 2e-6);
    const std::vector<Character> still = characters;
    for (Character& character : characters) character.hand_target[1] += 0.1f;
    std::vector<std::uint32_t> mask((swivel_block_count(crowd.get()) + 1) / 2);
    for (const std::uint32_t body : {3u, 5u}) mask[body / 32] |= 1u << (body % 32);
    crowd.solve({.mask = mask, .streams = {arms, legs}, .pose = &pose});
    CHECK((place_of(characters[5], kHand) - vec(characters[5].hand_target)).norm() <
          2e-6);
    CHECK(characters[4].solved == still[4].solved);
    CHECK((place_of(characters[7], kFoot) - vec(before.foot_target)).norm() < 2e-6);

    // Mistakes show in a pose that is bent.
    for (Character& each : characters) each.pose = each.solved;
    const auto engine_place = [&](int joint) {
        const Eigen::Vector3d at = place_of(characters[3], joint);
        return Double3{at.x(), at.y(), at.z()};
    };
    std::vector<std::string> log;
    const auto compare = [&] {
        // [compare]
        const Double3 shoulder = engine_place(kUpperArm),
                      elbow = engine_place(kForearm),
                      wrist = engine_place(kHand);  // in the world, of character 3
        // Of group 0, body 3:
        const auto said = swivel::compare(crowd, 0, 3, pose, shoulder, elbow, wrist);
        if (!said.agrees) log.push_back(said.text);
        // [end]
    };
    compare();
    CHECK(log.empty());
    std::vector<Character> w_first = characters;
    for (Float4& q : w_first[3].pose) q = {q[3], q[0], q[1], q[2]};
    pose.rotations.data = w_first[0].pose.data();
    compare();
    REQUIRE(log.size() == 1);
    CHECK(
        log[0].starts_with("The pose's joint rotations are stored as w, x, y, z, but "
                           "swivel takes x, y, z, w. "
                           "Reorder them. With that the three places agree, within "));
}

TEST_CASE("docs: bodies in the body's space")
{
    constexpr std::array<std::int32_t, 5> parents = {-1, 0, 1, 2, 1};
    constexpr std::array<Float3, 5> offsets = {
        {{0, 1.4f, 0}, {0.3f, 0, 0}, {0.26f, 0, 0}, {0.08f, 0, 0}, {0.13f, 0, 0}}};
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = swivel::stream(parents);
    skeleton.translations = swivel::stream(offsets);
    skeleton.joint_count = 5;
    const std::uint32_t twist_bones[] = {4};  // between elbow and wrist
    swivel_limb_joints arm = swivel_default_limb_joints(0, 1, 2);
    arm.bend[2] = 1;
    arm.twist_bones = twist_bones;
    arm.twist_bone_count = 1;
    const swivel_body_limb_def twisted = swivel::body_limb(
        arm, SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND | SWIVEL_WITH_RECORD);
    swivel::Crowd crowd(skeleton, 10, {twisted});
    struct Model {  // each joint relative to the root
        std::array<Float4, 5> rotations;
        std::array<Float3, 5> places;
    };
    Model rests{{},
                {{{0, 1.4f, 0},
                  {0.3f, 1.4f, 0},
                  {0.56f, 1.4f, 0},
                  {0.64f, 1.4f, 0},
                  {0.43f, 1.4f, 0}}}};
    rests.rotations.fill({0, 0, 0, 1});
    std::vector<Model> models(10, rests);
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.3f, 1.3f, 0.3f});
    // [whole]
    std::vector<Model> solved = models;  // draw these
    swivel_pose pose = swivel_default_pose();
    pose.space = SWIVEL_IN_BODY;
    pose.rotations = {models[0].rotations.data(), sizeof(Model), sizeof(Float4),
                      nullptr};
    pose.translations = {models[0].places.data(), sizeof(Model), sizeof(Float3),
                         nullptr};
    pose.results = {solved[0].rotations.data(), sizeof(Model), sizeof(Float4), nullptr};
    pose.translation_results = {solved[0].places.data(), sizeof(Model), sizeof(Float3),
                                nullptr};
    crowd.solve({.pose = &pose});
    // [end]
    for (const Model& model : solved) {
        CHECK((vec(model.places[2]) - Eigen::Vector3d(0.3, 1.3, 0.3)).norm() < 2e-6);
        CHECK(
            (vec(model.places[3]) - vec(model.places[2]) - Eigen::Vector3d(0.08, 0, 0))
                .norm() < 2e-6);
    }
    CHECK(swivel::explain(crowd, 0, 3).starts_with("The target is reached"));
}

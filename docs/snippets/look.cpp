// SPDX-License-Identifier: MIT
#include "check.h"

#include <algorithm>
#include <limits>
#include <swivel/swivel_bodies.hpp>

namespace {

enum Joint { kHips, kSpine, kChest, kNeck, kHead, kLeftEye, kRightEye, kJoints };
const std::array<std::int32_t, kJoints> kParents = {-1, 0, 1, 2, 3, 4, 4};
const std::array<Float3, kJoints> kOffsets = {{{0, 1, 0},
                                               {0, 0.1f, 0},
                                               {0, 0.2f, 0},
                                               {0, 0.25f, 0},
                                               {0, 0.1f, 0.02f},
                                               {0.03f, 0.08f, 0.1f},
                                               {-0.03f, 0.08f, 0.1f}}};

struct Character {
    Float3 place;
    std::array<Float4, kJoints> pose, solved;
    Float3 looks_at;
    float time;
};

// How far a line of sight is from a target, in radians: of a joint, from a place in its
// frame, along its z axis.
double off(const Character& character, std::size_t joint, const Float3& eye,
           const Eigen::Vector3d& axis = Eigen::Vector3d::UnitZ())
{
    Eigen::Vector3d place = vec(eye), line = axis;
    for (auto n = static_cast<std::int32_t>(joint); n >= 0;
         n = kParents[static_cast<std::size_t>(n)]) {
        const Eigen::Quaterniond turn =
            quat(character.solved[static_cast<std::size_t>(n)]);
        place = vec(kOffsets[static_cast<std::size_t>(n)]) + turn * place;
        line = turn * line;
    }
    const Eigen::Vector3d to = vec(character.looks_at) - vec(character.place) - place;
    return std::atan2(line.cross(to).norm(), line.dot(to));
}

struct Scene {
    std::vector<Character> characters;
    swivel_skeleton skeleton = swivel_default_skeleton();

    Scene()
    {
        for (int n = 0; n < 40; ++n) {
            const auto x = static_cast<float>(n);
            characters.push_back({{x, 0, 0}, {}, {}, {x + 0.4f, 1.7f, 2}, 1.0f / 60});
        }
        for (Character& each : characters) {
            each.pose.fill({0, 0, 0, 1});
            each.solved = each.pose;
        }
        skeleton.parents = swivel::stream(kParents);
        skeleton.translations = swivel::stream(kOffsets);
        skeleton.joint_count = kJoints;
    }
};

}  // namespace

TEST_CASE("docs: a head that looks")
{
    Scene scene;
    std::vector<Character>& characters = scene.characters;
    const swivel_skeleton& skeleton = scene.skeleton;
    // [crowd]
    swivel_look_def look = swivel::look({kSpine, kChest, kNeck, kHead});
    look.eye[1] = 0.08f, look.eye[2] = 0.1f;  // between the eyes, in the head's frame
    look.axis[2] = 1;                         // ahead
    swivel::Crowd crowd(skeleton, 40, {look});
    // [end]
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {characters[0].pose.data(), sizeof(Character), sizeof(Float4),
                      nullptr};
    pose.results = {characters[0].solved.data(), sizeof(Character), sizeof(Float4),
                    nullptr};
    pose.root_position = swivel::stream(characters, &Character::place);
    // [frame]
    pose.time = swivel::stream(characters, &Character::time);
    swivel::Streams head;
    head.in(SWIVEL_LOOK_TARGET, swivel::stream(characters, &Character::looks_at));
    crowd.solve({.streams = {head}, .pose = &pose});
    // [end]
    const Float3 eye = {0, 0.08f, 0.1f};
    for (const Character& each : characters) CHECK(off(each, kHead, eye) < 2e-6);
    CHECK(turn_between(characters[3].solved[kSpine], Float4{0, 0, 0, 1}) > 0.01);

    // A new target: the line turns there at its rate, unless it begins anew.
    const std::uint32_t moved = 7;
    for (Character& each : characters) each.looks_at[0] -= 1.5f;
    // [reset]
    swivel_reset(crowd.get(), 0, moved, 1);
    // [end]
    crowd.solve({.streams = {head}, .pose = &pose});
    for (std::size_t n = 0; n < 40; ++n)
        CHECK((off(characters[n], kHead, eye) < 2e-6) == (n == moved));

    const float none = std::numeric_limits<float>::quiet_NaN();
    for (Character& each : characters) each.looks_at = {none, none, none};
    crowd.reset(0);
    crowd.solve({.streams = {head}, .pose = &pose});
    CHECK(characters[3].solved == std::array<Float4, kJoints>{{{0, 0, 0, 1},
                                                               {0, 0, 0, 1},
                                                               {0, 0, 0, 1},
                                                               {0, 0, 0, 1},
                                                               {0, 0, 0, 1},
                                                               {0, 0, 0, 1},
                                                               {0, 0, 0, 1}}});
}

TEST_CASE("docs: shares, an axis from the rest pose, and eyes")
{
    Scene scene;
    std::vector<Character>& characters = scene.characters;
    const swivel_skeleton& skeleton = scene.skeleton;
    swivel_look_def look = swivel::look({kSpine, kChest, kNeck, kHead});
    look.eye[1] = 0.08f, look.eye[2] = 0.1f;
    look.rate = 0;
    // [shares]
    const float shares[] = {1, 1, 2, 4};
    const float max[] = {0.99f, 0.98f, 0.85f, 0.5f};  // 8, 11, 32 and 60 degrees
    std::ranges::copy(shares, look.share);
    std::ranges::copy(max, look.cos_max);
    // [end]
    const Eigen::Quaternionf head_at_rest(
        Eigen::AngleAxisf(0.7f, Eigen::Vector3f(1, 2, 3).normalized()));
    const Eigen::Vector3f ahead = Eigen::Vector3f::UnitZ();
    // [axis]
    const Eigen::Vector3f axis = head_at_rest.conjugate() * ahead;
    std::copy_n(axis.data(), 3, look.axis);
    // [end]
    CHECK((head_at_rest * Eigen::Vector3f(look.axis[0], look.axis[1], look.axis[2]) -
           ahead)
              .norm() < 1e-6f);
    look.axis[0] = look.axis[1] = 0, look.axis[2] = 1;
    // [eyes]
    swivel_look_def left_eye = swivel::look({kLeftEye});
    left_eye.cos_max[0] = 0.87f;  // 30 degrees
    left_eye.rate = 0;            // the head is eased, the eyes are quick
    swivel_look_def right_eye = left_eye;
    right_eye.joints[0] = kRightEye;
    swivel::Crowd crowd(skeleton, 40, {look, left_eye, right_eye});
    // [end]
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {characters[0].pose.data(), sizeof(Character), sizeof(Float4),
                      nullptr};
    pose.results = {characters[0].solved.data(), sizeof(Character), sizeof(Float4),
                    nullptr};
    pose.root_position = swivel::stream(characters, &Character::place);
    std::vector<Float3> targets;
    for (const Character& each : characters) targets.push_back(each.looks_at);
    for (std::uint32_t group = 0; group < 3; ++group)
        crowd.write(SWIVEL_LOOK_TARGET, group, targets);
    crowd.solve({.pose = &pose});
    for (const Character& each : characters) {
        CHECK(off(each, kHead, {0, 0.08f, 0.1f}) < 2e-6);
        CHECK(off(each, kLeftEye, {0, 0, 0}) < 2e-6);
        CHECK(off(each, kRightEye, {0, 0, 0}) < 2e-6);
        CHECK(turn_between(each.solved[kNeck], Float4{0, 0, 0, 1}) >
              1.5 * turn_between(each.solved[kChest], Float4{0, 0, 0, 1}));
    }
}

TEST_CASE("docs: turrets")
{
    enum Part { kBase, kBarrel, kParts };
    const std::array<std::int32_t, kParts> parents = {-1, kBase};
    const std::array<Float3, kParts> offsets = {{{0, 2, 0}, {0, 0.5f, 0}}};
    swivel_skeleton mount = swivel_default_skeleton();
    mount.parents = swivel::stream(parents);
    mount.translations = swivel::stream(offsets);
    mount.joint_count = kParts;
    // [turret]
    swivel_look_def aim = swivel::look({kBarrel});
    aim.cos_max[0] = -1;  // all the way round
    aim.cos_full = -0.99f, aim.cos_none = -1;
    aim.rate = 0;
    swivel::Crowd turrets(mount, 40, {aim});
    // [end]
    std::vector<std::array<Float4, kParts>> rotations(40,
                                                      {{{0, 0, 0, 1}, {0, 0, 0, 1}}});
    std::vector<std::array<Float4, kParts>> solved = rotations;
    std::vector<Float3> targets;
    for (int n = 0; n < 40; ++n)
        targets.push_back({5 * std::cos(0.15f * static_cast<float>(n)), 1,
                           5 * std::sin(0.15f * static_cast<float>(n))});
    turrets.write(SWIVEL_LOOK_TARGET, 0, targets);
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {rotations.data(), sizeof rotations[0], sizeof(Float4), nullptr};
    pose.results = {solved.data(), sizeof solved[0], sizeof(Float4), nullptr};
    turrets.solve({.pose = &pose});
    for (std::size_t n = 0; n < 40; ++n) {
        const Eigen::Vector3d to = vec(targets[n]) - Eigen::Vector3d(0, 2.5, 0),
                              line =
                                  quat(solved[n][kBarrel]) * Eigen::Vector3d::UnitZ();
        CHECK(line.cross(to).norm() / to.norm() < 2e-6);
    }
}

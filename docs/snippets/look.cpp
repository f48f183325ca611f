// SPDX-License-Identifier: MIT
#include "check.h"

namespace {

enum Joint { kHips, kSpine, kChest, kNeck, kHead, kLeftEye, kRightEye, kJoints };
const Bones<kJoints> bones = {{-1, 0, 1, 2, 3, 4, 4},
                              {{{0, 1, 0},
                                {0, 0.1f, 0},
                                {0, 0.2f, 0},
                                {0, 0.25f, 0},
                                {0, 0.1f, 0.02f},
                                {0.03f, 0.08f, 0.1f},
                                {-0.03f, 0.08f, 0.1f}}}};
const swivel_skeleton skeleton = bones.skeleton();

struct Character : Posed<kJoints> {
    Float3 looks_at = {0.4f, 1.7f, 2};
    float time = 1 / 60.0f;
};

// How far a line along z is from the target, in radians.
double off(const Eigen::Isometry3d& frame, const Eigen::Vector3d& eye,
           const Float3& target)
{
    const Eigen::Vector3d to = vec(target) - frame * eye,
                          line = frame.linear() * Eigen::Vector3d::UnitZ();
    return std::atan2(line.cross(to).norm(), line.dot(to));
}
double head_off(const Character& character)
{
    return off(bones.frame(character, kHead), {0, 0.08, 0.1}, character.looks_at);
}

}  // namespace

TEST_CASE("docs: a head that looks")
{
    std::vector<Character> characters(40);
    // [crowd]
    swivel_look_def look = swivel::look({kSpine, kChest, kNeck, kHead});
    look.eye[1] = 0.08f, look.eye[2] = 0.1f;  // between the eyes, in the head's frame
    look.axis[2] = 1;                         // ahead
    swivel::Crowd crowd(skeleton, 40, {look});
    // [end]
    swivel_pose pose = pose_of(characters);
    // [frame]
    pose.time = swivel::stream(characters, &Character::time);
    swivel::Streams head;
    head.in(SWIVEL_LOOK_TARGET, swivel::stream(characters, &Character::looks_at));
    crowd.solve({.streams = {head}, .pose = &pose});
    // [end]
    for (const Character& each : characters) CHECK(head_off(each) < 2e-6);

    // A new target: the line turns there at its rate, unless it begins anew.
    const std::uint32_t moved = 7;
    for (Character& each : characters) each.looks_at[0] -= 1.5f;
    // [reset]
    swivel_reset(crowd.get(), 0, moved, 1);
    // [end]
    crowd.solve({.streams = {head}, .pose = &pose});
    for (std::size_t n = 0; n < 40; ++n)
        CHECK((head_off(characters[n]) < 2e-6) == (n == moved));
}

TEST_CASE("docs: shares, an axis from the rest pose, and eyes")
{
    std::vector<Character> characters(40);
    swivel_look_def look = swivel::look({kSpine, kChest, kNeck, kHead});
    look.eye[1] = 0.08f, look.eye[2] = 0.1f;
    // [shares]
    const float shares[] = {1, 1, 2, 4};
    const float max[] = {0.99f, 0.98f, 0.85f, 0.5f};  // 8, 11, 32 and 60 degrees
    std::ranges::copy(shares, look.share);
    std::ranges::copy(max, look.cos_max);
    // [end]
    const Eigen::Quaternionf head_at_rest = Eigen::Quaternionf::Identity();
    const Eigen::Vector3f ahead = Eigen::Vector3f::UnitZ();
    // [axis]
    const Eigen::Vector3f axis = head_at_rest.conjugate() * ahead;
    std::copy_n(axis.data(), 3, look.axis);
    // [end]
    // [eyes]
    swivel_look_def left_eye = swivel::look({kLeftEye});
    left_eye.cos_max[0] = 0.87f;  // 30 degrees
    left_eye.rate = 0;            // the head is eased, the eyes are quick
    swivel_look_def right_eye = left_eye;
    right_eye.joints[0] = kRightEye;
    swivel::Crowd crowd(skeleton, 40, {look, left_eye, right_eye});
    // [end]
    swivel_pose pose = pose_of(characters);
    pose.time = swivel::stream(characters, &Character::time);
    for (std::uint32_t group = 0; group < 3; ++group)
        crowd.write_all(SWIVEL_LOOK_TARGET, group, characters[0].looks_at);
    crowd.solve({.pose = &pose});
    const Character& each = characters[3];
    CHECK(head_off(each) < 2e-6);
    for (const std::size_t eye : {kLeftEye, kRightEye})
        CHECK(off(bones.frame(each, eye), {0, 0, 0}, each.looks_at) < 2e-6);
    CHECK(turn_between(each.solved[kNeck], each.pose[kNeck]) >
          1.5 * turn_between(each.solved[kChest], each.pose[kChest]));
}

TEST_CASE("docs: turrets")
{
    enum Part { kBase, kBarrel, kParts };
    const Bones<kParts> parts = {{-1, kBase}, {{{0, 2, 0}, {0, 0.5f, 0}}}};
    const swivel_skeleton mount = parts.skeleton();
    // [turret]
    swivel_look_def aim = swivel::look({kBarrel});
    aim.cos_max[0] = -1;  // all the way round
    aim.cos_full = -0.99f, aim.cos_none = -1;
    aim.rate = 0;
    swivel::Crowd turrets(mount, 40, {aim});
    // [end]
    std::vector<Posed<kParts>> all(40);
    std::vector<Float3> targets;
    for (int n = 0; n < 40; ++n)
        targets.push_back({5 * std::cos(0.15f * static_cast<float>(n)), 1,
                           5 * std::sin(0.15f * static_cast<float>(n))});
    turrets.write(SWIVEL_LOOK_TARGET, 0, targets);
    const swivel_pose pose = pose_of(all);
    turrets.solve({.pose = &pose});
    for (std::size_t n = 0; n < 40; ++n)
        CHECK(off(parts.frame(all[n], kBarrel), {0, 0, 0}, targets[n]) < 2e-6);
}

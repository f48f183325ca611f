// SPDX-License-Identifier: MIT
#include "check.h"

namespace {

enum Joint { kHips, kThigh, kShin, kFoot, kChest, kUpperArm, kForearm, kHand, kJoints };
const Bones<kJoints> bones = {{-1, 0, 1, 2, 0, 4, 5, 6},
                              {{{0, 1, 0},
                                {-0.1f, 0, 0},
                                {0, -0.45f, 0},
                                {0, -0.45f, 0},
                                {0, 0.4f, 0},
                                {-0.2f, 0.1f, 0},
                                {-0.3f, 0, 0},
                                {-0.26f, 0, 0}}}};

struct Character : Posed<kJoints> {
    Float3 hand_target = {-0.4f, 1.3f, 0.3f}, foot_target = {-0.1f, 0.2f, 0.2f};
    float time = 1 / 60.0f;
};

}  // namespace

TEST_CASE("docs: bodies")
{
    std::vector<Character> characters(40);
    const swivel_limb_joints arm = bones.limb(kUpperArm, 1),
                             leg = bones.limb(kThigh, -1);
    swivel::Crowd crowd(bones.skeleton(), 40,
                        {swivel::body_limb(arm, SWIVEL_POLE_INCOMING),
                         swivel::body_limb(leg, SWIVEL_POLE_INCOMING)});
    swivel_pose pose = pose_of(characters);
    swivel::Streams arms, legs;
    arms.in(SWIVEL_TARGET, swivel::stream(characters, &Character::hand_target));
    legs.in(SWIVEL_TARGET, swivel::stream(characters, &Character::foot_target));
    // [places]
    std::vector<std::array<Float3, kJoints>> places(characters.size());
    pose.joint_positions = {places.data(), sizeof places[0], sizeof(Float3), nullptr};
    crowd.solve({.streams = {arms, legs}, .pose = &pose});
    const Float3 foot_from_root = places[3][kFoot];  // in the root's frame
    // [end]
    CHECK(distance(bones.frame(characters[3], kHand).translation(),
                   characters[3].hand_target) < 2e-6);
    CHECK(distance(foot_from_root, characters[3].foot_target) < 2e-6);

    // Mistakes show in a pose that is bent.
    for (Character& each : characters) each.pose = each.solved;
    const auto engine_place = [&](Joint joint) {
        const Eigen::Vector3d at = bones.frame(characters[3], joint).translation();
        return Double3{at.x(), at.y(), at.z()};
    };
    std::vector<std::string> log;
    const auto compare = [&] {
        // [compare]
        const Double3 shoulder = engine_place(kUpperArm),
                      elbow = engine_place(kForearm),
                      wrist = engine_place(kHand);  // in the world, of character 3
        // Group 0, body 3:
        const auto said = swivel::compare(crowd, 0, 3, pose, shoulder, elbow, wrist);
        if (!said.agrees) log.push_back(said.text);
        // [end]
    };
    compare();
    CHECK(log.empty());

    std::size_t drawn = 0;
    const auto debug_line = [&](const double* from, const double* to, std::uint32_t) {
        drawn += distance(Double3{from[0], from[1], from[2]},
                          Double3{to[0], to[1], to[2]}) < 9;
    };
    const std::uint32_t body = 3;
    // [draw]
    constexpr std::uint32_t room = 1024;
    swivel_shape shapes[room];
    std::uint32_t count;
    swivel::check(swivel_draw(crowd.get(), SWIVEL_EVERY_GROUP, body, &pose, shapes,
                              room, &count));
    for (std::uint32_t n = 0; n < std::min(count, room); ++n)
        debug_line(shapes[n].from, shapes[n].to, shapes[n].color);  // 0xRRGGBBAA
    // [end]
    CHECK(count <= room);
    CHECK(drawn == count);
    CHECK(count > 10);

    for (Float4& q : characters[3].pose) q = {q[3], q[0], q[1], q[2]};
    compare();
    REQUIRE(log.size() == 1);
    CHECK(
        log[0].starts_with("The pose's joint rotations are stored as w, x, y, z, but "
                           "swivel takes x, y, z, w. Reorder them."));
}

TEST_CASE("docs: joints relative to the root")
{
    struct Model {
        std::array<Float4, kJoints> rotations;
        std::array<Float3, kJoints> places;
    };
    Model rest;
    rest.rotations.fill({0, 0, 0, 1});
    for (std::size_t n = 0; n < kJoints; ++n) {
        const Eigen::Vector3f at =
            bones.frame(Character(), n).translation().cast<float>();
        rest.places[n] = {at.x(), at.y(), at.z()};
    }
    std::vector<Model> models(10, rest);
    const swivel_limb_joints arm = bones.limb(kUpperArm, 1);
    swivel::Crowd crowd(bones.skeleton(), 10,
                        {swivel::body_limb(arm, SWIVEL_POLE_INCOMING)});
    const Float3 target = {-0.4f, 1.3f, 0.3f};
    crowd.write_all(SWIVEL_TARGET, 0, target);
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
    for (const Model& model : solved)
        CHECK(distance(model.places[kHand], target) < 2e-6);
}

TEST_CASE("docs: no pole, in bodies")
{
    std::vector<Character> characters(1);
    characters[0].hand_target = {-0.2f, 1.5f, 0.4f};  // forwards from the shoulder
    const swivel_limb_joints arm_joints = bones.limb(kUpperArm, 1),
                             leg_joints = bones.limb(kThigh, -1);
    // [half_line]
    swivel_body_limb_def arm = swivel::body_limb(arm_joints, SWIVEL_POLE_HALF_LINE);
    arm.pole_behind[1] = 1;   // above
    arm.pole_behind[2] = -1;  // and behind
    swivel_body_limb_def leg = swivel::body_limb(leg_joints, SWIVEL_POLE_HALF_LINE);
    leg.pole_behind[2] = -1;
    // [end]
    const auto solve = [&](Joint upper, Joint lower) {
        swivel::Crowd crowd(bones.skeleton(), 1, {arm, leg});
        const swivel_pose pose = pose_of(characters);
        swivel::Streams arms, legs;
        arms.in(SWIVEL_TARGET, swivel::stream(characters, &Character::hand_target));
        legs.in(SWIVEL_TARGET, swivel::stream(characters, &Character::foot_target));
        crowd.solve({.streams = {arms, legs}, .pose = &pose});
        const auto at = [&](Joint joint) -> Eigen::Vector3d {
            return bones.frame(characters[0], joint).translation();
        };
        return Eigen::Vector3d(at(lower) - at(upper));
    };
    const Eigen::Vector3d elbow = solve(kUpperArm, kForearm);
    CHECK(elbow.y() == Approx(elbow.x()).margin(1e-5));  // as far down as out
    CHECK(elbow.y() < -0.1);
    CHECK(solve(kThigh, kShin).z() > 0.2);  // the knee is in front
    arm.pole_behind[1] = arm.pole_behind[2] = 0;
    CHECK(solve(kUpperArm, kForearm).y() == Approx(0).margin(1e-5));
}

TEST_CASE("docs: what bodies carry is saved, loaded and reset")
{
    const std::uint32_t body_count = 3;
    std::vector<Character> characters(body_count);
    const swivel_limb_joints leg = bones.limb(kThigh, -1);
    const auto made = [&] {
        swivel::Crowd crowd(
            bones.skeleton(), body_count,
            {swivel::body_limb(leg, SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT),
             swivel::look({kChest})});
        crowd.write_all(SWIVEL_CONTACT, 0, {1});
        crowd.write_all(SWIVEL_LOOK_TARGET, 1, {9, 1, 1});
        return crowd;
    };
    swivel::Crowd crowd = made(), other = made();
    swivel_pose pose = pose_of(characters);
    pose.time = swivel::stream(characters, &Character::time);
    const auto play = [&](swivel::Crowd& played) {
        for (int frame = 0; frame < 3; ++frame) {
            for (Character& each : characters) each.place[2] += 0.005f;
            played.solve({.pose = &pose});
        }
        return characters;
    };
    const std::vector<Character> then = play(crowd);
    const std::uint32_t body = 2;
    // [state]
    std::vector<std::byte> state(body_count * swivel_state_bytes(crowd.get()));
    crowd.save(state);            // all bodies; swivel_save(): some
    other.load(state);            // or crowd, later
    crowd.reset_bodies(body, 1);  // it was teleported, or is somebody else now
    // [end]
    CHECK(crowd.state_digest() != other.state_digest());
    const std::vector<Character> next = play(crowd);
    std::ranges::copy(then, characters.begin());
    const std::vector<Character> loaded = play(other);
    CHECK(loaded[0].solved == next[0].solved);
    CHECK(loaded[body].solved != next[body].solved);
    crowd.load(state);
    std::ranges::copy(then, characters.begin());
    CHECK(play(crowd)[body].solved == loaded[body].solved);
    CHECK(crowd.state_digest() == other.state_digest());
}

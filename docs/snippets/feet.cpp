// SPDX-License-Identifier: MIT
#include "check.h"

#include <algorithm>
#include <swivel/swivel_bodies.hpp>
#include <swivel/swivel_explain.hpp>

namespace {

enum Joint {
    kHips,
    kLeftThigh,
    kLeftShin,
    kLeftFoot,
    kRightThigh,
    kRightShin,
    kRightFoot,
    kJoints
};
const std::array<std::int32_t, kJoints> kParents = {-1, 0, 1, 2, 0, 4, 5};
const std::array<Float3, kJoints> kOffsets = {{{0, 0.85f, 0},
                                               {0.1f, 0, 0},
                                               {0, -0.45f, 0},
                                               {0, -0.45f, 0},
                                               {-0.1f, 0, 0},
                                               {0, -0.45f, 0},
                                               {0, -0.45f, 0}}};
constexpr float kFrame = 1 / 60.0f;

struct Character {
    Float3 place;
    Float4 rotation;
    std::array<Float4, kJoints> pose, solved;
    // [character]
    float left_down, right_down;  // 1 while the clip has the foot down, else 0
    float time;                   // seconds since this character's last solve
    // [end]
};

swivel_skeleton legs()
{
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = swivel::stream(kParents);
    skeleton.translations = swivel::stream(kOffsets);
    skeleton.joint_count = kJoints;
    return skeleton;
}
swivel_limb_joints leg(std::uint32_t thigh)
{
    swivel_limb_joints joints = swivel_default_limb_joints(thigh, thigh + 1, thigh + 2);
    joints.bend[2] = -1;
    return joints;
}

// Both knees bent, both feet down.
Character standing()
{
    Character made{{1, 0, 2}, {0, 0, 0, 1}, {}, {}, 1, 1, kFrame};
    made.pose.fill({0, 0, 0, 1});
    for (const Joint thigh : {kLeftThigh, kRightThigh}) {
        made.pose[thigh] = {-std::sin(0.2f), 0, 0, std::cos(0.2f)};
        made.pose[thigh + 1] = {std::sin(0.4f), 0, 0, std::cos(0.4f)};
    }
    made.solved = made.pose;
    return made;
}

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

// A crowd of some bodies that the parts of the page start from.
struct Legs {
    swivel_limb_joints left = leg(kLeftThigh), right = leg(kRightThigh);
    swivel::Crowd crowd;
    std::vector<Character> characters;
    swivel_pose pose = swivel_default_pose();

    explicit Legs(swivel_features features, std::uint32_t count = 3)
        : crowd(
              legs(), count,
              {swivel::body_limb(left, features), swivel::body_limb(right, features)}),
          characters(count, standing())
    {
        pose.rotations = {characters[0].pose.data(), sizeof(Character), sizeof(Float4),
                          nullptr};
        pose.results = {characters[0].solved.data(), sizeof(Character), sizeof(Float4),
                        nullptr};
        pose.root_position = swivel::stream(characters, &Character::place);
        pose.time = swivel::stream(characters, &Character::time);
    }
    // A frame in which every root glides and the animation stands.
    void glide(float speed, float down = 1)
    {
        for (Character& each : characters) each.place[2] += speed * kFrame;
        if (swivel_field_row_count(crowd.get(), 0, SWIVEL_CONTACT))
            for (const std::uint32_t group : {0u, 1u})
                crowd.write_all(SWIVEL_CONTACT, group, std::array{down});
        crowd.solve({.pose = &pose});
    }
};

}  // namespace

TEST_CASE("docs: feet that stand")
{
    std::vector<Character> characters(40, standing());
    const swivel_skeleton skeleton = legs();
    const swivel_limb_joints left = leg(kLeftThigh), right = leg(kRightThigh);
    // [crowd]
    constexpr swivel_features features = SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT;
    swivel::Crowd crowd(
        skeleton, 40,
        {swivel::body_limb(left, features), swivel::body_limb(right, features)});
    // [end]
    Eigen::Vector3d stood = Eigen::Vector3d::Zero();
    for (int n = 0; n < 20; ++n) {
        for (Character& each : characters)
            each.place[2] +=
                0.3f * kFrame;  // in two thirds of a step the root glides on
        swivel_pose pose = swivel_default_pose();
        pose.rotations = {characters[0].pose.data(), sizeof(Character), sizeof(Float4),
                          nullptr};
        pose.results = {characters[0].solved.data(), sizeof(Character), sizeof(Float4),
                        nullptr};
        pose.root_position = swivel::stream(characters, &Character::place);
        pose.root_rotation = swivel::stream(characters, &Character::rotation);
        // [frame]
        pose.time = swivel::stream(characters, &Character::time);
        swivel::Streams left_leg, right_leg;
        left_leg.in(SWIVEL_CONTACT, swivel::stream(characters, &Character::left_down));
        right_leg.in(SWIVEL_CONTACT,
                     swivel::stream(characters, &Character::right_down));
        crowd.solve({.streams = {left_leg, right_leg}, .pose = &pose});
        // [end]
        if (n == 0) stood = place_of(characters[7], kLeftFoot);
        CHECK((place_of(characters[7], kLeftFoot) - stood).norm() < 2e-6);
    }
    // [reset]
    swivel_reset(crowd.get(), 0, 7, 1);  // group, first body, how many
    swivel_reset(crowd.get(), 1, 7, 1);
    // [end]
    std::array<std::array<float, 11>, 40> state;
    crowd.read(SWIVEL_PLANT, 0, state);
    CHECK(state[7][10] == 0);
    CHECK(state[8][10] == 9);
}

TEST_CASE("docs: feet by motion")
{
    const swivel_skeleton skeleton = legs();
    const swivel_limb_joints left = leg(kLeftThigh);
    swivel_body_limb_def left_leg = swivel::body_limb(
        left, SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT | SWIVEL_PLANT_BY_MOTION);
    // In limb lengths, of 0.9 m here. To begin a contact, then to go on with it:
    left_leg.plant.speed[0] = 0.4f, left_leg.plant.speed[1] = 0.6f;    // a second
    left_leg.plant.height[0] = 0.1f, left_leg.plant.height[1] = 0.2f;  // over the root
    swivel::Crowd crowd(skeleton, 1, {left_leg});
    std::vector<Character> one(1, standing());
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {one[0].pose.data(), sizeof(Character), sizeof(Float4), nullptr};
    pose.results = {one[0].solved.data(), sizeof(Character), sizeof(Float4), nullptr};
    pose.root_position = swivel::stream(one, &Character::place);
    pose.time = swivel::stream(one, &Character::time);
    std::uint32_t flags[2] = {};
    for (const float speed : {1.0f, 0.2f})
        for (int n = 0; n < 5; ++n) {
            one[0].place[2] += speed * kFrame;
            crowd.solve({.pose = &pose});
            crowd.read(SWIVEL_FLAGS, 0, std::span(&flags[speed < 1], 1));
        }
    CHECK((flags[0] & SWIVEL_PLANTED) == 0);
    CHECK((flags[1] & SWIVEL_PLANTED) != 0);
}

TEST_CASE("docs: feet on tiles, platforms, and from one to the other")
{
    struct Walker {
        // [walker]
        Double3 place;    // in a large world
        Double3 support;  // what it stands on: a tile's origin, a lift's place
        Float4 support_rotation;
        // [end]
        std::array<Float4, kJoints> pose, solved;
        float time;
    };
    const Walker first{{4e6 + 1, 0, 2}, {4e6, 0, 0},       {0, 0, 0, 1},
                       standing().pose, standing().solved, kFrame};
    std::vector<Walker> walkers(2, first);
    const swivel_limb_joints left = leg(kLeftThigh);
    swivel::Crowd crowd(
        legs(), 2, {swivel::body_limb(left, SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT)});
    crowd.write_all(SWIVEL_CONTACT, 0, std::array{1.0f});
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {walkers[0].pose.data(), sizeof(Walker), sizeof(Float4), nullptr};
    pose.results = {walkers[0].solved.data(), sizeof(Walker), sizeof(Float4), nullptr};
    pose.time = swivel::stream(walkers, &Walker::time);
    // [double]
    pose.root_is_double = 1;
    pose.root_position = swivel::stream(walkers, &Walker::place);
    pose.support_position = swivel::stream(walkers, &Walker::support);
    pose.support_rotation = swivel::stream(walkers, &Walker::support_rotation);
    // [end]
    const auto foot = [&] {
        Character as = standing();
        as.place = {};
        as.solved = walkers[0].solved;
        return Eigen::Vector3d(vec(walkers[0].place) + place_of(as, kLeftFoot));
    };
    crowd.solve({.pose = &pose});
    const Eigen::Vector3d stood = foot();
    for (int n = 0; n < 10; ++n) {
        for (Walker& each : walkers) each.place[0] += 0.005;
        crowd.solve({.pose = &pose});
        CHECK((foot() - stood).norm() < 2e-6);
    }
    struct Lift {
        Double3 place;
        Float4 rotation;
    };
    Lift lift{{4e6 + 1, -0.1, 2}, {0, 0, 0, 1}};
    // [change]
    const std::uint32_t body = 0;
    const swivel_supports ground = {{&walkers[body].support, 0},
                                    {&walkers[body].support_rotation, 0}};
    const swivel_supports on_lift = {{&lift.place, 0}, {&lift.rotation, 0}};
    swivel::check(swivel_change_support(crowd.get(), 0, body, 1, ground,
                                        on_lift));  // for each leg
    // [end]
    const auto ride = [&] {
        // [ride]
        walkers[body].support = lift.place;  // of each body on the lift, in each frame
        walkers[body].support_rotation = lift.rotation;
        // [end]
    };
    ride();
    crowd.solve({.pose = &pose});
    CHECK((foot() - stood).norm() < 2e-6);
    lift.place[1] += 0.05;
    ride();
    crowd.solve({.pose = &pose});
    CHECK((foot() - stood - Eigen::Vector3d(0, 0.05, 0)).norm() < 2e-6);
}

TEST_CASE("docs: legs that a cap and a shift help to reach")
{
    const swivel_skeleton skeleton = legs();
    const swivel_limb_joints left = leg(kLeftThigh), right = leg(kRightThigh);
    // [fit]
    constexpr swivel_features features = SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT |
                                         SWIVEL_WITH_CAP | SWIVEL_WITH_PELVIS_FIT |
                                         SWIVEL_WITH_NEXT_TARGET;
    swivel::Crowd crowd(
        skeleton, 40,
        {swivel::body_limb(left, features), swivel::body_limb(right, features),
         swivel_default_shift_def()});
    // [end]
    std::vector<Character> characters(40, standing());
    struct Steps {
        Float3 left_next, right_next;  // where each foot lands next, in the world
        float left_in, right_in;       // in how many seconds
        Float3 shift;                  // of the body: a result
    };
    std::vector<Steps> steps(40, Steps{{}, {}, 9, 9, {}});
    std::vector<Float3> shown(40);
    for (const std::uint32_t group : {0u, 1u}) {
        crowd.write_all(SWIVEL_CONTACT, group, std::array{1.0f});
        // [cap]
        crowd.write_all(SWIVEL_CAP, group, Float3{0.02f, 0.9f, 0});  // for each leg
        // [end]
    }
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {characters[0].pose.data(), sizeof(Character), sizeof(Float4),
                      nullptr};
    pose.results = {characters[0].solved.data(), sizeof(Character), sizeof(Float4),
                    nullptr};
    pose.root_position = swivel::stream(characters, &Character::place);
    pose.time = swivel::stream(characters, &Character::time);
    Float3 shift{};
    Eigen::Vector3d stood = Eigen::Vector3d::Zero();
    for (int n = 0; n < 60; ++n) {
        if (n == 1)
            for (Character& each : characters) each.place[1] += 0.1f;
        // [shift]
        swivel::Streams left_leg, right_leg, pelvis;
        left_leg.in(SWIVEL_NEXT_TARGET, swivel::stream(steps, &Steps::left_next));
        left_leg.in(SWIVEL_NEXT_TIME, swivel::stream(steps, &Steps::left_in));
        right_leg.in(SWIVEL_NEXT_TARGET, swivel::stream(steps, &Steps::right_next));
        right_leg.in(SWIVEL_NEXT_TIME, swivel::stream(steps, &Steps::right_in));
        pelvis.out(SWIVEL_SHIFT, swivel::stream(steps, &Steps::shift));
        crowd.solve({.streams = {left_leg, right_leg, pelvis}, .pose = &pose});
        for (std::size_t body = 0; body < characters.size(); ++body) {
            shown[body] = characters[body].place;    // the animation's own root stays
            shown[body][1] += steps[body].shift[0];  // draw the body here
        }
        // [end]
        Character as = characters[7];
        as.place = shown[7];
        shift = steps[7].shift;
        if (n == 0) stood = place_of(as, kLeftFoot);
        // At the end of its reach the eased zone takes a quarter of the margin.
        if (n == 59)
            CHECK((place_of(as, kLeftFoot) - stood).norm() < 0.25 * 0.02 * 0.9 + 1e-5);
    }
    CHECK(shift[0] < -0.02f);
    CHECK(shift[2] == 1);
}

TEST_CASE("docs: palms and standing feet keep their rotation")
{
    const swivel_skeleton skeleton = legs();
    const swivel_limb_joints left = leg(kLeftThigh);
    const swivel_body_limb_def left_leg = swivel::body_limb(
        left, SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT | SWIVEL_WITH_HAND |
                  SWIVEL_WITH_PLANT_ROTATION | SWIVEL_WITH_EFFECTOR);
    swivel::Crowd crowd(skeleton, 40, {left_leg});
    crowd.write_all(SWIVEL_EFFECTOR, 0,
                    Float3{0, -0.07f, 0.1f});  // the ball of the foot
    std::vector<Character> characters(40, standing());
    crowd.write_all(SWIVEL_CONTACT, 0, std::array{1.0f});
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {characters[0].pose.data(), sizeof(Character), sizeof(Float4),
                      nullptr};
    pose.results = {characters[0].solved.data(), sizeof(Character), sizeof(Float4),
                    nullptr};
    pose.root_position = swivel::stream(characters, &Character::place);
    pose.root_rotation = swivel::stream(characters, &Character::rotation);
    pose.time = swivel::stream(characters, &Character::time);
    const auto foot = [&] {
        const Character& of = characters[3];
        return Eigen::Quaterniond(
            quat(of.rotation) * quat(of.solved[kHips]) * quat(of.solved[kLeftThigh]) *
            quat(of.solved[kLeftShin]) * quat(of.solved[kLeftFoot]));
    };
    crowd.solve({.pose = &pose});
    const Eigen::Quaterniond stood = foot();
    for (int n = 1; n < 10; ++n) {
        const float half = 0.01f * static_cast<float>(n);  // it turns in place
        for (Character& each : characters)
            each.rotation = {0, std::sin(half), 0, std::cos(half)};
        crowd.solve({.pose = &pose});
        CHECK(foot().angularDistance(stood) < 2e-6);
    }
}

TEST_CASE("docs: feet that are not solved in every frame")
{
    Legs scene(SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT);
    scene.glide(0.3f);
    std::vector<Character>& characters = scene.characters;
    swivel::Crowd& crowd = scene.crowd;
    const swivel_pose& pose = scene.pose;
    const float dt = kFrame;
    for (Character& each : characters) each.time = 0;
    const std::vector<std::uint32_t> chosen = {0, 2}, mask = {0b101};
    for (int n = 0; n < 3; ++n) {
        for (Character& each : characters) each.time += dt;  // of every character
        crowd.solve({.mask = mask, .pose = &pose});
        for (const std::uint32_t body : chosen) characters[body].time = 0;
    }
    CHECK(characters[0].time == 0);
    CHECK(characters[1].time == Approx(3 * dt));
}

TEST_CASE("docs: the state of feet, saved and restored")
{
    Legs scene(SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT);
    for (int n = 0; n < 9; ++n) scene.glide(0.3f, n < 4 ? 0 : 1);
    swivel::Crowd& crowd = scene.crowd;
    // [save]
    std::vector<std::array<float, 11>> saved(3);  // a value for each body
    crowd.read(SWIVEL_PLANT, 0, saved);           // group 0: the left legs
    // [end]
    const std::vector<Character> then = scene.characters;
    scene.glide(0.3f);
    const std::vector<Character> next = scene.characters;
    for (int n = 0; n < 9; ++n) scene.glide(1, 0);
    std::ranges::copy(then, scene.characters.begin());
    // [restore]
    crowd.write(SWIVEL_PLANT, 0, saved);
    // [end]
    scene.glide(0.3f);
    for (std::size_t n = 0; n < 3; ++n) {
        CHECK(scene.characters[n].solved[kLeftThigh] == next[n].solved[kLeftThigh]);
        CHECK(scene.characters[n].solved[kLeftShin] == next[n].solved[kLeftShin]);
    }
}

TEST_CASE("docs: why a foot slid")
{
    Legs scene(SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT | SWIVEL_WITH_RECORD);
    swivel::Crowd& crowd = scene.crowd;
    const std::vector<Character>& characters = scene.characters;
    std::vector<std::string> log;
    for (int n = 0; n < 30; ++n) {
        scene.glide(0.7f);
        std::vector<std::uint32_t> flags(characters.size());
        for (const std::uint32_t leg : {0u, 1u}) {  // groups
            crowd.read(SWIVEL_FLAGS, leg, flags);
            for (std::uint32_t body = 0; body < flags.size(); ++body)
                if (flags[body] & (SWIVEL_BROKE_AWAY | SWIVEL_CUT))
                    log.push_back(swivel::explain(crowd, leg, body));
        }
    }
    REQUIRE(log.size() == 6);  // both feet of three
    CHECK(log[0].starts_with(
        "It broke away, though in contact: the animated point was further"));
}

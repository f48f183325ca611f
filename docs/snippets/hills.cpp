// SPDX-License-Identifier: MIT
#include "check.h"

#include <swivel/swivel_bodies.hpp>

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
const std::array<Float3, kJoints> kOffsets = {{{0, 0.9f, 0},
                                               {0.1f, 0, 0},
                                               {0, -0.45f, 0},
                                               {0, -0.45f, 0},
                                               {-0.1f, 0, 0},
                                               {0, -0.45f, 0},
                                               {0, -0.45f, 0}}};
// The ball of the foot and the heel, both on the sole.
constexpr Float3 kBall = {0, -0.08f, 0.14f}, kHeel = {0, -0.08f, -0.06f};

struct Character {
    Float3 place;
    Float4 rotation;
    std::array<Float4, kJoints> pose, solved;
    float time;
    // Of the left foot and the right one:
    std::array<float, 2> down;
    std::array<Float3, 2> probe, ground, normal;
    std::array<std::array<float, 7>, 2> ankle;
};

struct Terrain {
    float height(double x, double z) const
    {
        return static_cast<float>(0.15 * std::sin(0.9 * x) + 0.1 * std::sin(0.7 * z));
    }
    Float3 normal(double x, double z) const  // of any length
    {
        return {static_cast<float>(-0.135 * std::cos(0.9 * x)), 1,
                static_cast<float>(-0.07 * std::cos(0.7 * z))};
    }
};
const Terrain terrain;

// Knees bent, both feet flat and down.
Character standing(float x)
{
    Character made{};
    made.place = {x, terrain.height(x, 2), 2};
    made.rotation = {0, 0, 0, 1};
    made.time = 1 / 60.0f;
    made.down = {1, 1};
    made.ground.fill({NAN, NAN, NAN});  // none is known yet
    made.normal.fill({0, 1, 0});
    made.pose.fill({0, 0, 0, 1});
    for (const Joint thigh : {kLeftThigh, kRightThigh}) {
        made.pose[thigh] = {-std::sin(0.2f), 0, 0, std::cos(0.2f)};
        made.pose[thigh + 1] = {std::sin(0.4f), 0, 0, std::cos(0.4f)};
        made.pose[thigh + 2] = {-std::sin(0.2f), 0, 0, std::cos(0.2f)};
    }
    made.solved = made.pose;
    return made;
}

struct Scene {
    std::array<swivel_limb_joints, 2> legs = {
        swivel_default_limb_joints(kLeftThigh, kLeftShin, kLeftFoot),
        swivel_default_limb_joints(kRightThigh, kRightShin, kRightFoot)};
    std::vector<Character> characters;
    swivel_pose pose = swivel_default_pose();

    Scene()
    {
        for (swivel_limb_joints& leg : legs) leg.bend[2] = -1;
        for (int n = 0; n < 40; ++n)
            characters.push_back(standing(static_cast<float>(n)));
        take_pose();
    }
    void take_pose()
    {
        pose.rotations = {characters[0].pose.data(), sizeof(Character), sizeof(Float4),
                          nullptr};
        pose.results = {characters[0].solved.data(), sizeof(Character), sizeof(Float4),
                        nullptr};
        pose.root_position = swivel::stream(characters, &Character::place);
        pose.root_rotation = swivel::stream(characters, &Character::rotation);
        pose.time = swivel::stream(characters, &Character::time);
    }
    // How far the worst ball of a foot is from the ground.
    double worst() const
    {
        double max = 0;
        for (const Character& each : characters)
            for (const std::array<float, 7>& ankle : each.ankle) {
                const Eigen::Quaterniond turn =
                    quat(Float4{ankle[3], ankle[4], ankle[5], ankle[6]});
                const Eigen::Vector3d ball = vec(ankle) + turn * vec(kBall);
                const float height = terrain.height(static_cast<float>(ball[0]),
                                                    static_cast<float>(ball[2]));
                max = std::max(max, std::fabs(ball[1] - double{height}));
            }
        return max;
    }
};

swivel_skeleton skeleton_of_legs()
{
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = swivel::stream(kParents);
    skeleton.translations = swivel::stream(kOffsets);
    skeleton.joint_count = kJoints;
    return skeleton;
}

}  // namespace

TEST_CASE("docs: feet on hills")
{
    Scene scene;
    std::vector<Character>& characters = scene.characters;
    const swivel_skeleton skeleton = skeleton_of_legs();
    const std::array<swivel_limb_joints, 2>& legs = scene.legs;
    // [crowd]
    const swivel_features features = SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND |
                                     SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_PLANT |
                                     SWIVEL_WITH_GROUND |  // feet that stand, on ground
                                     SWIVEL_WITH_PELVIS_FIT |  // the pelvis follows
                                     SWIVEL_HAND_YIELDS | SWIVEL_WITH_HAND_TRANSFORM;
    std::vector<swivel::Definition> groups;
    for (const swivel_limb_joints& joints : legs) {
        swivel_body_limb_def leg = swivel::body_limb(joints, features);
        std::copy(kHeel.begin(), kHeel.end(), leg.ground.heel);
        groups.push_back(leg);
    }
    groups.push_back(swivel_default_shift_def());
    swivel::Crowd crowd(skeleton, 40, groups);
    for (std::uint32_t leg = 0; leg < 2; ++leg)
        crowd.write_all(SWIVEL_EFFECTOR, leg, kBall);
    // [end]
    const swivel_pose& pose = scene.pose;
    // [streams]
    std::array<swivel::Streams, 2> feet;
    swivel::Streams pelvis;  // the last group's, which lists nothing
    constexpr std::size_t step = sizeof(Character);
    for (std::size_t leg = 0; leg < 2; ++leg) {
        feet[leg].in(SWIVEL_CONTACT, {&characters[0].down[leg], step});
        feet[leg].out(SWIVEL_HAND_TRANSFORM, {&characters[0].ankle[leg], step});
    }
    // [end]
    const auto reset = [&] {
        for (std::uint32_t group = 0; group < 3; ++group)
            swivel::check(swivel_reset(crowd.get(), group, 0, 40));
    };
    for (int n = 0; n < 30; ++n) {
        // [sample]
        const auto sample = [](const swivel_probes& probes) {
            for (std::size_t foot = 0; foot < probes.count; ++foot) {
                const auto& at = probes.places[foot];
                probes.grounds[foot][0] = at[0];
                probes.grounds[foot][1] = terrain.height(at[0], at[2]);
                probes.grounds[foot][2] = at[2];
                const Float3 normal = terrain.normal(at[0], at[2]);
                std::copy(normal.begin(), normal.end(), probes.normals[foot]);
            }
        };
        crowd.solve(
            {.streams = {feet[0], feet[1], pelvis}, .pose = &pose, .sample = sample});
        // [end]
    }
    CHECK(scene.worst() < 1e-4);
    const std::vector<Character> as_asked = characters;
    const auto check_same = [&] {
        for (std::size_t n = 0; n < characters.size(); ++n)
            for (std::size_t joint = 0; joint < kJoints; ++joint)
                CHECK(turn_between(characters[n].solved[joint],
                                   as_asked[n].solved[joint]) < 1e-3);
    };

    // Who does not move is on the same ground a frame later.
    // [late]
    for (std::size_t leg = 0; leg < 2; ++leg) {
        feet[leg].in(SWIVEL_GROUND, {&characters[0].ground[leg], step});
        feet[leg].in(SWIVEL_GROUND_NORMAL, {&characters[0].normal[leg], step});
        feet[leg].out(SWIVEL_PROBE, {&characters[0].probe[leg], step});
    }
    // [end]
    reset();
    for (int n = 0; n < 31; ++n) {
        // [next]
        crowd.solve({.streams = {feet[0], feet[1], pelvis}, .pose = &pose});
        for (Character& each : characters)  // for the next frame
            for (std::size_t leg = 0; leg < 2; ++leg) {
                const Float3& at = each.probe[leg];
                each.ground[leg] = {at[0], terrain.height(at[0], at[2]), at[2]};
                each.normal[leg] = terrain.normal(at[0], at[2]);
            }
        // [end]
        if (n == 0) reset();
    }
    CHECK(scene.worst() < 1e-4);
    check_same();

    // The same with roots in doubles.
    std::vector<Double3> roots;
    for (const Character& each : characters)
        roots.push_back(
            {double{each.place[0]}, double{each.place[1]}, double{each.place[2]}});
    swivel_pose far = pose;
    far.root_position = {roots.data(), sizeof roots[0]};
    far.root_is_double = 1;
    std::array<swivel::Streams, 2> contacts;
    for (std::size_t leg = 0; leg < 2; ++leg)
        contacts[leg].in(SWIVEL_CONTACT, {&characters[0].down[leg], step});
    reset();
    for (int n = 0; n < 30; ++n) {
        const auto sample = [&](const swivel_probes& probes) {
            for (std::size_t foot = 0; foot < probes.count; ++foot) {
                // [far]
                const auto& at = probes.places[foot];              // from the root
                const Double3& root = roots[probes.bodies[foot]];  // in the world
                const double x = root[0] + double{at[0]}, z = root[2] + double{at[2]};
                const double height = double{terrain.height(x, z)} - root[1];
                // [end]
                probes.grounds[foot][0] = at[0];
                probes.grounds[foot][1] = static_cast<float>(height);
                probes.grounds[foot][2] = at[2];
                const Float3 normal = terrain.normal(x, z);
                std::copy(normal.begin(), normal.end(), probes.normals[foot]);
            }
        };
        crowd.solve({.streams = {contacts[0], contacts[1], pelvis},
                     .pose = &far,
                     .sample = sample});
    }
    check_same();
}

// SPDX-License-Identifier: MIT
#include "check.h"

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
const Bones<kJoints> bones = {{-1, 0, 1, 2, 0, 4, 5},
                              {{{0, 0.9f, 0},
                                {0.1f, 0, 0},
                                {0, -0.45f, 0},
                                {0, -0.45f, 0},
                                {-0.1f, 0, 0},
                                {0, -0.45f, 0},
                                {0, -0.45f, 0}}}};
const swivel_skeleton skeleton = bones.skeleton();
const swivel_limb_joints left = bones.limb(kLeftThigh, -1),
                         right = bones.limb(kRightThigh, -1);
// The ball of the foot and the heel, both on the sole.
constexpr Float3 kBall = {0, -0.08f, 0.14f}, kHeel = {0, -0.08f, -0.06f};
constexpr float kFrame = 1 / 60.0f;

// Both knees bent, both feet flat.
struct Standing : Posed<kJoints> {
    Standing()
    {
        for (const std::size_t thigh : {kLeftThigh, kRightThigh}) {
            pose[thigh] = pose[thigh + 2] = {-std::sin(0.2f), 0, 0, std::cos(0.2f)};
            pose[thigh + 1] = {std::sin(0.4f), 0, 0, std::cos(0.4f)};
        }
        solved = pose;
    }
};

}  // namespace

TEST_CASE("docs: feet that stand while the root glides")
{
    struct Character : Standing {
        // [character]
        float left_down, right_down;  // 1 while the clip has the foot down, else 0
        float time;                   // seconds since this character's last solve
        // [end]
    };
    std::vector<Character> characters(40);
    for (Character& each : characters)
        each.left_down = each.right_down = 1, each.time = kFrame;
    // [crowd]
    constexpr swivel_features features = SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT;
    swivel::Crowd crowd(
        skeleton, 40,
        {swivel::body_limb(left, features), swivel::body_limb(right, features)});
    // [end]
    swivel_pose pose = pose_of(characters);
    Eigen::Vector3d stood = Eigen::Vector3d::Zero();
    for (int n = 0; n < 20; ++n) {
        for (Character& each : characters) each.place[2] += 0.3f * kFrame;
        // [frame]
        pose.time = swivel::stream(characters, &Character::time);
        swivel::Streams left_leg, right_leg;
        left_leg.in(SWIVEL_CONTACT, swivel::stream(characters, &Character::left_down));
        right_leg.in(SWIVEL_CONTACT,
                     swivel::stream(characters, &Character::right_down));
        crowd.solve({.streams = {left_leg, right_leg}, .pose = &pose});
        // [end]
        const Eigen::Vector3d foot =
            bones.frame(characters[7], kLeftFoot).translation();
        if (n == 0) stood = foot;
        CHECK((foot - stood).norm() < 2e-6);
    }
}

TEST_CASE("docs: feet on tiles, platforms, and from one to the other")
{
    struct Walker : Standing {
        // [walker]
        Double3 place;    // in a large world
        Double3 support;  // what it stands on: a tile's origin, a lift's place
        Float4 support_rotation;
        // [end]
    };
    std::vector<Walker> walkers(2);
    for (Walker& each : walkers)
        each.place = {4e6 + 1, 0, 2}, each.support = {4e6, 0, 0},
        each.support_rotation = {0, 0, 0, 1};
    swivel::Crowd crowd(
        skeleton, 2,
        {swivel::body_limb(left, SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT)});
    crowd.write_all(SWIVEL_CONTACT, 0, {1});
    swivel_pose pose = pose_of(walkers);
    pose.time = {&kFrame, 0};
    // [double]
    pose.root_is_double = 1;
    pose.root_position = swivel::stream(walkers, &Walker::place);
    pose.support_position = swivel::stream(walkers, &Walker::support);
    pose.support_rotation = swivel::stream(walkers, &Walker::support_rotation);
    // [end]
    const auto foot = [&] {
        crowd.solve({.pose = &pose});
        const Eigen::Isometry3d from_root = bones.frame(walkers[0], kLeftFoot);
        return Eigen::Vector3d(vec(walkers[0].place) + from_root.translation());
    };
    const Eigen::Vector3d stood = foot();
    walkers[0].place[0] += 0.005;
    CHECK((foot() - stood).norm() < 2e-6);
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
    lift.place[1] += 0.05;
    // [ride]
    walkers[body].support = lift.place;  // of each body on the lift, in each frame
    walkers[body].support_rotation = lift.rotation;
    // [end]
    CHECK((foot() - stood - Eigen::Vector3d(0, 0.05, 0)).norm() < 2e-6);
}

TEST_CASE("docs: legs that a cap and a shift help to reach")
{
    // [fit]
    constexpr swivel_features features = SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT |
                                         SWIVEL_WITH_CAP | SWIVEL_WITH_PELVIS_FIT |
                                         SWIVEL_WITH_NEXT_TARGET;
    swivel::Crowd crowd(
        skeleton, 40,
        {swivel::body_limb(left, features), swivel::body_limb(right, features),
         swivel_default_shift_def()});
    // [end]
    std::vector<Standing> characters(40);
    struct Steps {
        Float3 left_next, right_next;  // where each foot lands next, in the world
        float left_in, right_in;       // in how many seconds
        Float3 shift;                  // of the body: a result
    };
    std::vector<Steps> steps(40, Steps{{}, {}, 9, 9, {}});
    std::vector<Float3> shown(40);
    for (const std::uint32_t group : {0u, 1u}) {
        crowd.write_all(SWIVEL_CONTACT, group, {1});
        // [cap]
        crowd.write_all(SWIVEL_CAP, group, Float3{0.02f, 0.9f, 0});  // for each leg
        // [end]
    }
    swivel_pose pose = pose_of(characters);
    pose.time = {&kFrame, 0};
    Eigen::Vector3d stood = Eigen::Vector3d::Zero(), foot = stood;
    for (int n = 0; n < 60; ++n) {
        if (n == 1)
            for (Standing& each : characters) each.place[1] += 0.1f;
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
        Standing drawn = characters[7];
        drawn.place = shown[7];
        foot = bones.frame(drawn, kLeftFoot).translation();
        if (n == 0) stood = foot;
    }
    CHECK(steps[7].shift[0] < -0.02f);
    // At the end of its reach the eased zone takes a quarter of the margin.
    CHECK((foot - stood).norm() < 0.25 * 0.02 * 0.9 + 1e-5);
}

TEST_CASE("docs: feet on hills")
{
    struct Terrain {
        float height(double x, double z) const
        {
            return static_cast<float>(0.15 * std::sin(0.9 * x) +
                                      0.1 * std::sin(0.7 * z));
        }
        Float3 normal(double x, double z) const  // of any length
        {
            return {static_cast<float>(-0.135 * std::cos(0.9 * x)), 1,
                    static_cast<float>(-0.07 * std::cos(0.7 * z))};
        }
    };
    const Terrain terrain;
    struct Character : Standing {
        std::array<float, 2> down = {1, 1};  // of the left foot and the right one
        std::array<Float3, 2> probe, ground, normal;
        Float3 shift;
    };
    std::vector<Character> characters(40);
    std::vector<Double3> roots;
    for (Character& each : characters) {
        const auto x = static_cast<float>(roots.size());
        each.place = {x, terrain.height(x, 2), 2};
        each.ground.fill({NAN, NAN, NAN});  // none is known yet
        each.normal.fill({0, 1, 0});
        roots.push_back({x, each.place[1], 2});
    }
    const std::array<swivel_limb_joints, 2> legs = {left, right};
    // [hill_crowd]
    const swivel_features features = SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND |
                                     SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_PLANT |
                                     SWIVEL_WITH_GROUND |      // stand on the ground
                                     SWIVEL_WITH_PELVIS_FIT |  // the pelvis follows
                                     SWIVEL_HAND_YIELDS;       // heels lift
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
    swivel_pose pose = pose_of(characters);
    pose.time = {&kFrame, 0};
    // [streams]
    std::array<swivel::Streams, 2> feet;
    swivel::Streams pelvis;
    constexpr std::size_t step = sizeof(Character);
    for (std::size_t leg = 0; leg < 2; ++leg)
        feet[leg].in(SWIVEL_CONTACT, {&characters[0].down[leg], step});
    pelvis.out(SWIVEL_SHIFT, swivel::stream(characters, &Character::shift));
    // [end]
    const auto reset = [&] {
        for (std::uint32_t group = 0; group < 3; ++group) crowd.reset(group);
    };
    // Solves frames; then all feet stand with their balls on the ground.
    const auto check = [&](auto solve) {
        reset();
        for (int n = 0; n < 30; ++n) solve();
        double max = 0;
        for (Character drawn : characters) {
            drawn.place[1] += drawn.shift[0];
            for (const std::size_t foot : {kLeftFoot, kRightFoot}) {
                const Eigen::Vector3d ball = bones.frame(drawn, foot) * vec(kBall);
                const float height = terrain.height(ball.x(), ball.z());
                max = std::max(max, std::abs(ball.y() - double{height}));
            }
        }
        CHECK(max < 1e-4);
    };
    check([&] {
        // [sample]
        const auto sample = [&](const swivel_probes& probes) {
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
    });
    check([&] {
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
        swivel_pose far = pose;
        far.root_is_double = 1;
        far.root_position = {roots.data(), sizeof roots[0]};
        crowd.solve(
            {.streams = {feet[0], feet[1], pelvis}, .pose = &far, .sample = sample});
    });
    // [late]
    for (std::size_t leg = 0; leg < 2; ++leg) {
        feet[leg].in(SWIVEL_GROUND, {&characters[0].ground[leg], step});
        feet[leg].in(SWIVEL_GROUND_NORMAL, {&characters[0].normal[leg], step});
        feet[leg].out(SWIVEL_PROBE, {&characters[0].probe[leg], step});
    }
    // [end]
    const auto solve_late = [&] {
        // [next]
        crowd.solve({.streams = {feet[0], feet[1], pelvis}, .pose = &pose});
        for (Character& each : characters)  // for the next frame
            for (std::size_t leg = 0; leg < 2; ++leg) {
                const Float3& at = each.probe[leg];
                each.ground[leg] = {at[0], terrain.height(at[0], at[2]), at[2]};
                each.normal[leg] = terrain.normal(at[0], at[2]);
            }
        // [end]
    };
    reset();
    solve_late();
    check(solve_late);
}

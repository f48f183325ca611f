// SPDX-License-Identifier: MIT
#include "check.h"

#include <thread>

TEST_CASE("docs: active limbs, and a budget")
{
    // [budget]
    swivel::Crowd crowd({swivel::limbs(64)});
    // Yours, kept from frame to frame: a float for each block, zeros at first.
    std::vector<float> urgency(swivel_block_count(crowd.get()));
    std::vector<std::uint32_t> mask((urgency.size() + 1) / 2);
    std::vector<float> priority(64, 1.0f);  // for each arm; size on screen, say
    const swivel_in priorities[] = {swivel::stream(priority)};
    // At most two blocks of 16 in this frame.
    crowd.choose(priorities, urgency, 2, mask);
    crowd.solve({.mask = mask});
    // [end]
    const std::vector<std::uint32_t> first = mask;
    CHECK(crowd.choose(priorities, urgency, 2, mask) == 32);
    CHECK((first[0] ^ mask[0]) == ~0u);

    // [active]
    std::vector<std::uint32_t> active((swivel_block_count(crowd.get()) + 1) / 2);
    for (std::uint32_t limb = 0; limb < 20; ++limb)
        active[limb / 32] |= 1u << (limb % 32);  // the nearest twenty
    crowd.solve({.mask = active});
    // [end]
    CHECK(crowd.solve({.mask = active}) == 20);
}

TEST_CASE("docs: groups of different features")
{
    struct Character {
        Float3 hip, ankle, knee_hint;
        Float4 thigh = {}, shin = {};
        Float3 shoulder, grip, elbow_hint;
        Float4 palm;
        Float4 upper_arm = {}, forearm = {}, hand = {};
    };
    const Float3 thigh{0, -0.45f, 0}, shin{0, -0.42f, 0};
    const Float3 upper_arm{0.30f, 0, 0}, forearm{0.26f, 0, 0};
    const swivel_binding left_leg = bound(thigh, shin, {0, 0, -1});  // backwards
    const swivel_binding left_arm = bound(upper_arm, forearm, {0, 0, 1});
    const Character one{.hip = {0.1f, 0.95f, 0},
                        .ankle = {0.1f, 0.25f, 0.1f},
                        .knee_hint = {0.1f, 0.5f, 2},
                        .shoulder = {0.2f, 1.4f, 0},
                        .grip = {0.3f, 1.3f, -0.3f},  // behind the back
                        .elbow_hint = {0.2f, 1.4f, -1},
                        .palm = {0.6f, 0, 0, 0.8f}};
    const std::uint32_t count = 20;
    std::vector<Character> characters(count, one);
    // [crowd]
    // Each group takes memory and time for its own features alone.
    const swivel_features own_joints = SWIVEL_WORLD | SWIVEL_JOINTS;
    swivel_limb_def left_legs = swivel::limbs(count, own_joints);
    left_legs.binding = left_leg;
    swivel_limb_def left_arms =
        swivel::limbs(count, own_joints | SWIVEL_WITH_HAND | SWIVEL_WITH_SHOULDER_CONE);
    left_arms.binding = left_arm;
    swivel::Crowd crowd({left_legs, left_arms});
    const std::uint32_t legs = 0, arms = 1;  // groups, in this order
    // Upper arms stay within 80 degrees of forwards and down.
    const std::array<double, 3> axis =
        swivel::arm_axis(left_arm, {0, 0, 0, 1}, {0, -1, 1});
    crowd.write_all(SWIVEL_SHOULDER_CONE, arms,
                    swivel::cone(axis, swivel::degrees(80)));
    // [end]
    // [streams]
    swivel::Streams leg;
    leg.in(SWIVEL_SHOULDER_POSITION, swivel::stream(characters, &Character::hip));
    leg.in(SWIVEL_TARGET, swivel::stream(characters, &Character::ankle));
    leg.in(SWIVEL_POLE, swivel::stream(characters, &Character::knee_hint));
    leg.out(SWIVEL_SHOULDER, swivel::stream(characters, &Character::thigh));
    leg.out(SWIVEL_ELBOW, swivel::stream(characters, &Character::shin));

    swivel::Streams arm;
    arm.in(SWIVEL_SHOULDER_POSITION, swivel::stream(characters, &Character::shoulder));
    arm.in(SWIVEL_TARGET, swivel::stream(characters, &Character::grip));
    arm.in(SWIVEL_POLE, swivel::stream(characters, &Character::elbow_hint));
    arm.in(SWIVEL_HAND, swivel::stream(characters, &Character::palm));
    arm.out(SWIVEL_SHOULDER, swivel::stream(characters, &Character::upper_arm));
    arm.out(SWIVEL_ELBOW, swivel::stream(characters, &Character::forearm));
    arm.out(SWIVEL_WRIST, swivel::stream(characters, &Character::hand));

    crowd.solve({.streams = {leg, arm}});  // one job; streams for each group
    // [end]
    const Character& each = characters[7];
    const Eigen::Vector3d ankle =
        vec(each.hip) + quat(each.thigh) * (vec(thigh) + quat(each.shin) * vec(shin));
    CHECK(distance(ankle, each.ankle) < 1e-6);
    CHECK((quat(each.upper_arm) * quat(each.forearm) * quat(each.hand))
              .angularDistance(quat(each.palm)) < 1e-6);
    std::vector<std::uint32_t> flags(count);
    crowd.read(SWIVEL_FLAGS, legs, flags);
    CHECK(flags[0] == SWIVEL_REACHED);
    crowd.read(SWIVEL_FLAGS, arms, flags);
    CHECK(flags[0] == (SWIVEL_REACHED | SWIVEL_LIMITED_SHOULDER_CONE));
    // [some]
    const std::uint32_t solved =
        crowd.solve({.groups = std::array{arms}, .streams = {arm}});
    // [end]
    CHECK(solved == count);
}

TEST_CASE("docs: bad input that keeps the pose")
{
    // [keep]
    swivel_limb_def arms = swivel::limbs(2);
    arms.on_bad_input = SWIVEL_KEEP_POSE;
    swivel::Crowd crowd({arms});
    // [end]
    crowd.write_all(SWIVEL_LENGTHS, 0, {0.30f, 0.26f});
    crowd.write_all(SWIVEL_TARGET, 0, {0.3f, 0.1f, 0.3f});
    crowd.solve();
    std::array<Float4, 2> before, after;
    crowd.read(SWIVEL_SHOULDER, 0, before);
    crowd.write_all(SWIVEL_TARGET, 0, {NAN, 0, 0});  // the tracker lost it
    crowd.solve();
    crowd.read(SWIVEL_SHOULDER, 0, after);
    CHECK(after == before);
}

TEST_CASE("docs: own threads")
{
    // [workspaces]
    const swivel_limb_def arms = swivel::limbs(200, SWIVEL_WITH_FLEXION_LIMIT);
    swivel_group_def group = swivel_default_group_def();
    group.limb = &arms;
    swivel_crowd_def def = swivel_default_crowd_def();
    def.groups = &group;
    def.group_count = 1;
    def.workspace_count = 2;  // as many as jobs that run together
    swivel::Crowd crowd(def);
    // [end]
    crowd.write_all(SWIVEL_LENGTHS, 0, {1, 1});
    crowd.write_all(SWIVEL_TARGET, 0, {0.5f, 0.5f, 1});
    // [threads]
    const std::uint32_t blocks = swivel_block_count(crowd.get()), half = blocks / 2;
    // Your job system, in ranges that do not overlap.
    std::thread job([&] {
        crowd.solve({.blocks = swivel_blocks{0, half}, .on_this_thread = true});
    });
    crowd.solve({.blocks = swivel_blocks{half, blocks - half}, .on_this_thread = true});
    job.join();
    // [end]
    std::vector<std::uint32_t> flags(200);
    crowd.read(SWIVEL_FLAGS, 0, flags);
    CHECK(std::ranges::count(flags, SWIVEL_REACHED) == 200);
}

TEST_CASE("docs: far from the origin")
{
    // [far]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WORLD)});
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{0.30f, 0.26f});
    // Thousands of kilometres out, in metres.
    const Double3 character{5.0e6, 20.0, -3.0e6};
    const swivel_in origin{&character, 0};  // one for all; a stride for one each
    const std::array<Double3, 1> shoulder{{{5.0e6 + 0.2, 21.4, -3.0e6}}};
    const std::array<Double3, 1> elbow_hint{{{5.0e6, 20.4, -3.0e6}}};
    const std::array<Double3, 1> grip{{{5.0e6 + 0.5, 21.2, -3.0e6 + 0.3}}};
    crowd.write_doubles(SWIVEL_SHOULDER_POSITION, 0, shoulder, origin);
    crowd.write_doubles(SWIVEL_POLE, 0, elbow_hint, origin);
    crowd.write_doubles(SWIVEL_TARGET, 0, grip, origin);
    crowd.solve();
    // [end]
    std::array<Double3, 1> wrist;
    crowd.wrists(0, wrist);  // from the origin, too
    CHECK(distance(wrist[0], Double3{0.5, 1.2, 0.3}) < 1e-6);
}

TEST_CASE("docs: errors")
{
    std::string text;
    // [errors]
    try {
        swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_EFFECTOR)});
    } catch (const swivel::Error& error) {
        text = error.what();  // one line: what, where, what to do
    }
    // [end]
    CHECK(text == "group 0: SWIVEL_WITH_EFFECTOR needs SWIVEL_WITH_HAND; add it");
}

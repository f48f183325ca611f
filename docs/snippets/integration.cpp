// SPDX-License-Identifier: MIT
#include "check.h"

#include <cstdlib>
#include <thread>

namespace {

struct Character {
    Float3 grip, elbow_hint;
    Float4 upper_arm, forearm;
};

swivel_binding bound_arm() { return bound({0.30f, 0, 0}, {0.26f, 0, 0}, {0, 0, 1}); }

// Where the wrist is, of bones along +x: the skeleton's own forward kinematics.
Eigen::Vector3d wrist_of(const Character& character)
{
    const Eigen::Quaterniond upper = quat(character.upper_arm);
    return upper * (Eigen::Vector3d(0.30, 0, 0) +
                    quat(character.forearm) * Eigen::Vector3d(0.26, 0, 0));
}

// The upper arm's twist about its bone, in degrees, from -180 to 180. A bend with the
// wrong sign adds half a turn.
double twist_of(const Character& character)
{
    const Eigen::Quaterniond upper = quat(character.upper_arm);
    return std::remainder(2 * std::atan2(upper.x(), upper.w()), 2 * std::acos(-1)) *
           180 / std::acos(-1);
}

}  // namespace

TEST_CASE("docs: streams in place")
{
    std::vector<Character> characters(
        40, {{0.3f, -0.2f, 0.3f}, {-0.2f, -0.5f, -0.3f}, {}, {}});
    swivel_limb_def limbs = swivel::limbs(40, SWIVEL_WORLD | SWIVEL_JOINTS);
    limbs.binding = bound_arm();
    swivel::Crowd crowd({limbs});
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0, 0, 0});
    swivel::Streams arms;  // what is not listed keeps its rows, or is not written
    arms.in(SWIVEL_TARGET, swivel::stream(characters, &Character::grip));
    arms.in(SWIVEL_POLE, swivel::stream(characters, &Character::elbow_hint));
    // May be the very pose that was read.
    arms.out(SWIVEL_SHOULDER, swivel::stream(characters, &Character::upper_arm));
    arms.out(SWIVEL_ELBOW, swivel::stream(characters, &Character::forearm));
    crowd.solve({.streams = {arms}});  // one for each group
    for (const Character& character : characters) {
        CHECK((wrist_of(character) - vec(character.grip)).norm() < 1e-6);
        CHECK(std::abs(twist_of(character)) < 90);
    }
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
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.5f, 0.5f, 1});
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
    // [threads]
    const std::uint32_t blocks = swivel_block_count(crowd.get()), half = blocks / 2;
    // Your job system, in ranges that do not overlap.
    std::thread job([&] {
        crowd.solve({.blocks = swivel_blocks{0, half}, .on_this_thread = true});
    });
    crowd.solve({.blocks = swivel_blocks{half, blocks - half}, .on_this_thread = true});
    job.join();
    // [end]
    std::vector<double> off(200);
    crowd.residuals(0, off);
    for (const double each : off) CHECK(each < 1e-6);
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

TEST_CASE("docs: own memory")
{
    const swivel_limb_def arms = swivel::limbs(100);
    swivel_group_def group = swivel_default_group_def();
    group.limb = &arms;
    swivel_crowd_def def = swivel_default_crowd_def();
    def.group_count = 1;
    def.groups = &group;
    def.memory_bytes = swivel_crowd_bytes(&def);
    // Yours: freed by you, after the crowd.
    def.memory = std::aligned_alloc(64, def.memory_bytes);
    {
        swivel::Crowd crowd(def);
        crowd.solve();
    }
    std::free(def.memory);
    CHECK(def.memory_bytes % 64 == 0);
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

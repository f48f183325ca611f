// SPDX-License-Identifier: MIT
#include "check.h"

#include <numeric>

namespace {

enum Joint { kChest, kUpperArm, kForearm, kHand, kJoints };
const Bones<kJoints> bones = {
    {-1, 0, 1, 2}, {{{0, 1.3f, 0}, {0.2f, 0, 0}, {0.3f, 0, 0}, {0.26f, 0, 0}}}};
constexpr std::uint32_t kCount = 200;
constexpr float kFadeSeconds = 0.3f;

struct Character : Posed<kJoints> {
    Float3 target;
    float weight = 0;
};

// In a row, out of order.
std::vector<Character> people()
{
    std::vector<Character> made(kCount);
    for (std::uint32_t n = 0; n < kCount; ++n) {
        const auto x = static_cast<float>(n * 37 % kCount);
        made[n].place = {x, 0, 0};
        made[n].target = {x + 0.3f, 1.5f, 0.3f};
    }
    return made;
}

}  // namespace

TEST_CASE("docs: bodies come near and go")
{
    std::vector<Character> characters = people();
    const swivel_limb_joints joints = bones.limb(kUpperArm, 1);
    swivel::Crowd crowd(bones.skeleton(), kCount,
                        {swivel::body_limb(joints, SWIVEL_POLE_INCOMING)});
    swivel_pose pose = pose_of(characters);
    swivel::Streams arm;
    arm.in(SWIVEL_TARGET, swivel::stream(characters, &Character::target));
    pose.weight = swivel::stream(characters, &Character::weight);
    std::vector<std::uint32_t> mask((swivel_block_count(crowd.get()) + 1) / 2);
    const float seconds = 1.0f / 60;
    double max = 0;
    std::vector<double> was(kCount);  // each forearm's turn from its animation
    float camera = 20;
    for (int frame = 0; frame < 120; ++frame) {
        camera += 1;
        for (Character& each : characters) each.solved = each.pose;
        const auto distance = [&](const Character& each) {
            return std::abs(each.place[0] - camera);
        };
        const auto reset = [&](const Character& each) {
            const auto body = static_cast<std::uint32_t>(&each - characters.data());
            crowd.reset_bodies(body, 1);
        };
        // [fade]
        for (Character& each : characters) {
            const float step = seconds / kFadeSeconds;  // 0.3 s from 0 to 1
            const bool is_near = distance(each) < 30;
            const bool returns = is_near && each.weight == 0;
            const float next = each.weight + (is_near ? step : -step);
            each.weight = std::clamp(next, 0.0f, 1.0f);
            if (returns) reset(each);
        }
        std::ranges::fill(mask, 0);
        for (std::uint32_t n = 0; n < characters.size(); ++n)
            if (characters[n].weight > 0) mask[n / 32] |= 1u << (n % 32);
        crowd.solve({.mask = mask, .streams = {arm}, .pose = &pose});
        // [end]
        for (std::uint32_t n = 0; n < kCount; ++n) {
            const double turn = turn_between(characters[n].solved[kForearm],
                                             characters[n].pose[kForearm]);
            max = std::max(max, std::abs(turn - was[n]));
            was[n] = turn;
        }
    }
    CHECK(max < 0.1);
    CHECK(std::ranges::count_if(was, [](double turn) { return turn > 0.5; }) > 40);
}

TEST_CASE("docs: neighbours share blocks")
{
    const std::vector<Character> characters = people();
    const Float3 camera{20, 0, 0};
    // [sort]
    std::vector<std::uint32_t> order(characters.size());  // slots, the nearest first
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](std::uint32_t n) {
        return std::abs(characters[n].place[0] - camera[0]);
    });
    // [end]
    CHECK(characters[order[0]].place[0] == 20);
    CHECK(characters[order[kCount - 1]].place[0] == kCount - 1);
}

// SPDX-License-Identifier: MIT
//
// The promise: what a run says of its worst and first poses does not depend on the threads that found them. Errors are
// those of the targets that were asked for.
#include <rapidcheck/catch.h>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "tools/crowd/clip_crowd.h"
#include "tools/crowd/demo_clip.h"
#include "tools/crowd/statistics.h"

namespace {

using namespace swivel::tools;
using swivel::formats::kLimbNames;

struct Pose {
    PoseName name;
    double error;
    std::uint32_t flags;
};

// Errors out of four, so that they repeat; each pose once.
std::vector<Pose> random_poses(std::mt19937& random)
{
    const double errors[] = {0, 0.25, 1.5, std::numeric_limits<double>::quiet_NaN()};
    const unsigned kinds = 1 + random() % 4;  // often without the NaN
    std::vector<Pose> poses;
    for (std::uint64_t frame = 0; frame < 1 + random() % 3; ++frame)
        for (std::uint32_t character = 0; character < 1 + random() % 4; ++character)
            for (const auto limb : kLimbNames)
                if (random() % 3 != 0)
                    poses.push_back(
                        {{frame, character, limb}, errors[random() % kinds], static_cast<std::uint32_t>(random())});
    return poses;
}

void add(LimbStatistics& to, const Pose& pose)
{
    to.reached.add(pose.error, pose.name);
    to.add_flags(pose.flags, pose.error, pose.name);
}

}  // namespace

TEST_CASE("statistics: a run went wrong where most limbs are out of reach or have bad input, each counted once")
{
    rc::prop("", [](std::uint32_t seed) {
        std::mt19937 random(seed);
        constexpr std::uint32_t words[] = {SWIVEL_REACHED, SWIVEL_CLAMPED_FAR, SWIVEL_CLAMPED_NEAR, SWIVEL_BAD_INPUT,
                                           SWIVEL_BAD_INPUT | SWIVEL_CLAMPED_FAR};
        Statistics statistics;
        std::uint64_t lost = 0, count = random() % 12;
        for (std::uint64_t n = 0; n < count; ++n) {
            const std::size_t kind = random() % 2 == 0 ? 0 : 1 + random() % 4;
            const auto limb = kLimbNames[random() % 4];
            const bool is_near = random() % 2 == 0;  // clamped by rounding at the end of the reach
            statistics.of(limb.kind).add_flags(words[kind], is_near ? 1e-6 : 1e-3, {n, 0, limb});
            lost += (words[kind] & SWIVEL_BAD_INPUT) != 0 || (kind != 0 && !is_near);
        }
        Statistics sum;
        sum.arms.add(statistics.arms);
        sum.legs.add(statistics.legs);
        RC_ASSERT(sum.limb_count() == count);
        RC_ASSERT(sum.unreached() + sum.bad() == lost);
        RC_ASSERT(went_wrong(sum) == (lost > count - lost));
    });
}

TEST_CASE("statistics: errors are counted from the targets as they were asked for, before the solver's are rounded")
{
    const swivel::formats::Clip clip = demo_clip(3);
    LimbChoice choice;
    for (const auto side : {swivel::formats::Side::left, swivel::formats::Side::right})
        choice.bends.push_back({{swivel::formats::LimbKind::arm, side}, Eigen::Vector3d::UnitZ(), "test", ""});
    const std::vector<Limb> limbs =
        require_limbs(bind_limbs(clip, choose_joints(clip, "test", choice), choice), "test");
    CrowdPlan plan = plan_crowd(nullptr, clip, limbs);
    plan.characters = 30;
    ClipCrowd crowd(clip, limbs, plan);
    swivel::formats::Target given;
    given.frame = 1;
    given.limb = limbs[0].name;
    given.position = crowd.motion().origin(1, 0) + Eigen::Vector3d(0.1, -0.2, 1.0 / 3);
    Statistics statistics;
    crowd.set_frame(1, {&given, 1});
    crowd.solve(statistics);
    crowd.measure(statistics);

    double worst = 0, worst_rounded = 0;
    for (const swivel::formats::Target& target : crowd.targets()) {
        const std::size_t limb = target.limb == limbs[0].name ? 0 : 1;
        const GoalCrowd& goals = crowd.goal_crowd();
        const std::uint32_t who = target.character;
        const goal_input& input = goals.input(limb, who);
        const auto place = [&](std::size_t n) { return Eigen::Vector3f(input.places[n]).cast<double>().eval(); };
        const auto row = crowd.pose(limb, who);
        const double size = goals.characters()[who].size;
        const Eigen::Quaterniond upper = quaternion(input.rotations[0]) * quaternion(row.shoulder);
        const Eigen::Vector3d arm = upper * (place(2) + quaternion(row.elbow) * place(3));
        const Eigen::Vector3d wrist = size * (place(0) + arm),
                              wanted = target.position - Eigen::Vector3d(goals.root(who).place);
        const auto& lengths = crowd.motion().sources(limb)[goals.clip_frame(who)].lengths;
        const double length = size * (lengths[0] + lengths[1]);
        worst = std::max(worst, (wrist - wanted).norm() / length);
        worst_rounded = std::max(worst_rounded, (wrist - wanted.cast<float>().cast<double>()).norm() / length);
    }
    CHECK(statistics.arms.reached.count == 2 * plan.characters);
    CHECK(std::fabs(statistics.arms.reached.max - worst) < 1e-14);
    CHECK(std::fabs(worst_rounded - worst) > 1e-10);  // else this would show nothing
}

TEST_CASE("statistics: in any order, in any parts, the worst and the first are the earliest poses of their kind")
{
    rc::prop("", [](std::uint32_t seed) {
        std::mt19937 random(seed);
        std::vector<Pose> poses = random_poses(random);
        const std::vector<Pose> ordered = poses;
        std::shuffle(poses.begin(), poses.end(), random);
        LimbStatistics parts[3], all;
        for (const Pose& pose : poses) add(parts[random() % 3], pose);
        for (const LimbStatistics& part : parts) all.add(part);

        RC_ASSERT(all.reached.count == ordered.size());
        RC_ASSERT(all.limb_count == ordered.size());
        const auto is_worse = [](const Pose& a, const Pose& b) {  // a NaN is worse than all numbers
            return std::isnan(b.error) ? false : std::isnan(a.error) || a.error > b.error;
        };
        const auto worst = std::min_element(ordered.begin(), ordered.end(), is_worse);  // the first of the worst
        if (worst != ordered.end()) {
            RC_ASSERT(all.reached.worst_pose == worst->name);
            RC_ASSERT((all.reached.max == worst->error || std::isnan(worst->error)));
            RC_ASSERT(std::isnan(all.reached.max) == std::isnan(worst->error));
        }
        for (std::size_t bit = 0; bit < all.flags.size(); ++bit) {
            const auto has_bit = [bit](const Pose& pose) { return (pose.flags >> bit & 1u) != 0; };
            const auto first = std::find_if(ordered.begin(), ordered.end(), has_bit);
            const auto count = static_cast<std::uint64_t>(std::count_if(ordered.begin(), ordered.end(), has_bit));
            RC_ASSERT(all.flags[bit].count == count);
            if (first != ordered.end()) RC_ASSERT(all.flags[bit].first_pose == first->name);
        }
    });
}

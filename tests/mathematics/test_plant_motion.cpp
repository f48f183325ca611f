// SPDX-License-Identifier: MIT
//
// The promise: a planted point's velocity jumps by no more than its frames explain, so less the more frames there are;
// frame rates hardly matter; and no finite input makes it less than a number.
#include <catch2/catch.hpp>

#include <cmath>

#include <rapidcheck/catch.h>

#include "tests/plant_story.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr double kLeg = 0.83;  // m: of a man

// The largest change of velocity from one frame to the next; frames after a flagged cut are left out.
struct Jumps {
    double target = 0, input = 0;
};
void add_jumps(std::uint64_t seed, double per_second, Jumps& most)
{
    swivel_plant plant = swivel_default_plant();
    plant.stop = plant.blend = 0.2f;
    Random random{seed};
    const Way way(random);
    PlantedPoint<float> point(rules_of(plant));
    RandomLabels labels;
    Vector3d x[3] = {}, y[3] = {};
    double time[3] = {}, t = 0;
    bool was_cut = false;
    for (int n = 0; t < 10; ++n) {
        for (auto* of : {x, y}) of[0] = of[1], of[1] = of[2];
        time[1] = time[2], time[2] = jittered(random, per_second), t += time[2];
        x[2] = way.place(t);
        y[2] = point.step(x[2], labels.next(random, time[2]), time[2], kLeg);
        const auto jump = [&](const Vector3d(&of)[3]) {
            return ((of[2] - of[1]) / time[2] - (of[1] - of[0]) / time[1]).norm();
        };
        if (n >= 2) most.input = std::max(most.input, jump(x));
        if (n >= 2 && !was_cut && !point.last.cut) most.target = std::max(most.target, jump(y));
        was_cut = point.last.cut;
    }
}

// Where a point is at multiples of a sixth of a second, when its label changes too, and between.
std::vector<Vector3d> at_common_times(std::uint64_t seed, int per_second, int looks_per_second)
{
    swivel_plant plant = swivel_default_plant();
    plant.unlock = 10;  // distances are passed in other frames at other rates
    Random random{seed};
    const Way way(random);
    std::vector<bool> labels(120);
    for (std::size_t n = 0; n < labels.size(); ++n) labels[n] = (n % 4 == 1 && random.below(4)) || n % 4 == 0;
    PlantedPoint<float> point(rules_of(plant));
    std::vector<Vector3d> places;
    for (int n = 0; n < 20 * per_second; ++n) {
        const double t = static_cast<double>(n) / per_second;
        const Vector3d y =
            point.step(way.place(t), labels[static_cast<std::size_t>(n * 6 / per_second)], 1.0 / per_second);
        if (n % (per_second / looks_per_second) == 0) places.push_back(y);
    }
    return places;
}

// A finite float of any bits, no larger than `most`; often 0 or of a usual size.
float random_float(Random& random, float most)
{
    const std::uint32_t n = random.below(8);
    if (n == 0) return 0;
    if (n == 1) return static_cast<float>(std::min<double>(most, random.between(-1, 1)));
    if (n == 2) return random.below(2) ? most : -most;
    for (;;) {
        const float x = bit_cast<float>(random.word());
        if (std::fabs(x) <= most) return x;
    }
}
float random_size(Random& random, float most) { return std::fabs(random_float(random, most)); }
PlantRules any_rules(Random& random)
{
    swivel_plant plant = swivel_default_plant();
    for (float* const each : {&plant.lock, &plant.unlock, &plant.stop, &plant.blend, &plant.again})
        if (random.below(2)) *each = random_size(random, 1000);
    plant.run = random_size(random, 1);
    plant.longest = random.below(4) ? 0 : random_size(random, 1e15f);
    return rules_of(plant);
}
bool is_finite(const Vector<float>& v)
{
    return std::isfinite(v.c[0]) && std::isfinite(v.c[1]) && std::isfinite(v.c[2]);
}
bool is_nan(const Vector<float>& v) { return std::isnan(v.c[0]) || std::isnan(v.c[1]) || std::isnan(v.c[2]); }

}  // namespace

TEST_CASE("the velocity jumps by less the more frames there are")
{
    struct Row {
        double per_second, most, input;
    };
    for (const auto& [per_second, most, input] :
         {Row{30, 1.8, 0.75}, Row{60, 1.1, 0.4}, Row{144, 0.45, 0.17}, Row{600, 0.15, 0.05}, Row{2400, 0.037, 0.012}}) {
        Jumps jumps;
        for (std::uint64_t seed = 0; seed < 200; ++seed) add_jumps(seed, per_second, jumps);
        INFO(per_second << " a second: " << jumps.target << ", of the input " << jumps.input);
        CHECK(jumps.target <= most);
        CHECK(jumps.input <= input);
    }
}

TEST_CASE("frame rates hardly matter")
{
    struct Row {
        int per_second;
        double most;
    };
    for (const auto& [per_second, most] : {Row{30, 3.5e-3}, Row{60, 1.7e-3}, Row{144, 0.7e-3}}) {
        double worst = 0;
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            const auto fine = at_common_times(seed, 2880, 6), coarse = at_common_times(seed, per_second, 6);
            for (std::size_t n = 0; n < fine.size(); ++n) worst = std::max(worst, (fine[n] - coarse[n]).norm());
        }
        INFO(per_second << " a second: " << worst);
        CHECK(worst <= most);
    }
}

// RC_PARAMS=max_success=10000 makes ten million steps.
TEST_CASE("no finite input makes a planted point or rotation less than a number")
{
    rc::prop("of any bits, from what such inputs have left", [](std::uint64_t seed) {
        Random random{seed};
        PlantState<float> state{};
        TurnState<float> turn{};
        PlantRules rules{};
        for (int n = 0; n < 1000; ++n) {
            if (n % 50 == 0) rules = any_rules(random), state.fresh = true;
            const float length = random.below(4) ? random_size(random, 2) : random_size(random, 1e15f);
            const Vector<float> x =
                vector(random_float(random, 5e14f), random_float(random, 5e14f), random_float(random, 5e14f));
            const float time = random_size(random, 1e15f);
            forget_old(state, time, rules);
            const Planted<float> is = plant(state, {x, random.below(2) == 1, time, length}, rules);
            const Rotor<float> rotation = plant_turn(turn, is.step, state.locked, mv<float>(random.rotation()), rules);
            RC_ASSERT(is_finite(is.target) && is_finite(state.mark) && is_finite(state.offset));
            RC_ASSERT(!is_nan(state.velocity) && std::isfinite(state.left));
            RC_ASSERT(std::fabs(len2(rotation) - 1) <= 1e-5f);
            RC_ASSERT(std::fabs(len2(turn.mark) - 1) <= 1e-5f);
            RC_ASSERT(is_finite(turn.offset) && is_finite(turn.velocity));
        }
    });
}

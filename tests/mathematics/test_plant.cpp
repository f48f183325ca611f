// SPDX-License-Identifier: MIT
//
// The promise: a point that is labelled stands, moves by no bit, and comes and goes without a jump, as a plain machine
// of states says. A rotation that is planted with it goes with the point. Velocities jump by no more than their frames
// explain, so less the more frames there are; frame rates hardly matter; and no finite input makes less than a number.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <string_view>

#include <rapidcheck/catch.h>

#include "tests/plant_story.h"

namespace {

using namespace swivel;
using namespace swivel::test;

template <class T>
bool is_same(const Vector<T>& a, const Vector<T>& b)
{
    return std::memcmp(a.c, b.c, sizeof a.c) == 0;
}
template <class T>
bool is_equal(const Vector<T>& a, const Vector<T>& b)  // -0 and 0 are
{
    return a.c[0] == b.c[0] && a.c[1] == b.c[1] && a.c[2] == b.c[2];
}

PlantRules random_rules(Random& random)
{
    swivel_plant plant = swivel_default_plant();
    if (random.below(3) == 0) return rules_of(plant);
    plant.lock_radius = static_cast<float>(random.between(0.02, 0.3));
    plant.unlock_radius = static_cast<float>(random.between(0.05, 0.6));
    plant.stop_time = random.below(5) ? static_cast<float>(random.between(0.02, 0.4)) : 0;
    plant.release_time = random.below(5) ? static_cast<float>(random.between(0.02, 0.4)) : 0;
    plant.relock_speed = random.below(3) ? static_cast<float>(random.between(0.02, 0.8)) : 0;
    plant.anchor_lead = static_cast<float>(random.unit());
    plant.reset_time = random.below(2) ? 0.5f : 0;
    return rules_of(plant);
}
double random_time(Random& random, double per_second)
{
    const std::uint32_t n = random.below(100);
    return n == 0 ? 0 : n == 1 ? 0.6 : jittered(random, per_second);
}

// The worst distance from the machine, in 4 seconds, as long as no decision is a matter of rounding. 1 and more: they
// decide otherwise, or say otherwise why. judged: counts steps.
template <class T>
double strayed_from_machine(std::uint64_t seed, double clearance, int& judged)
{
    Random random{seed};
    const PlantRules rules = random_rules(random);
    const Way way(random);
    const double length = static_cast<T>(random.spread(0.3, 3)), per_second = random.spread(15, 1000);
    PlantMachine machine(rules);
    PlantedPoint<T> point(rules);
    RandomLabels labels;
    bool moves = true;
    double t = 0, on_way = 0, worst = 0;
    while (t < 4) {
        const double time = static_cast<T>(random_time(random, per_second));
        t += time;
        if (random.below(30) == 0) moves = !moves;
        if (moves) on_way += time;
        const Vector3d x = eigen(mv<T>(way.place(on_way)));
        const bool label = labels.next(random, time);
        if (random.below(100) == 0) machine.stands = PlantMachine::Stands::starts, point.state.fresh = true;  // a reset
        const bool was_locked = machine.stands == PlantMachine::Stands::locked;
        const Vector3d want = machine.step(x, label, time, length), got = point.step(x, label, time, length);
        if (machine.clearance < clearance) break;
        ++judged;
        if ((machine.stands == PlantMachine::Stands::locked) != point.state.locked) return 1;
        if (machine.is_cut != point.last.cut) return 2;
        if ((was_locked && label && machine.stands == PlantMachine::Stands::releases) != point.last.too_far) return 3;
        worst = std::max(worst, (got - want).norm());
    }
    return worst;
}

// Calls look(before, point, x, label, time, length) after each step of a random point.
template <class T, class Look>
void for_each_step(std::uint64_t seed, const Look& look)
{
    Random random{seed};
    const PlantRules rules = random_rules(random);
    const Way way(random);
    const double length = random.spread(0.3, 3), per_second = random.spread(15, 1000);
    PlantedPoint<T> point(rules);
    RandomLabels labels;
    for (double t = 0; t < 4;) {
        const double time = random_time(random, per_second);
        t += time;
        const bool label = labels.next(random, time);
        const PlantState<T> before = point.state;
        const Vector3d x = way.place(t);
        point.step(x, label, time, length);
        look(before, point, x, label, time, length);
    }
}

PlantRules random_turn_rules(Random& random)
{
    swivel_plant plant = swivel_default_plant();
    plant.stop_time = static_cast<float>(random.between(0.05, 0.4));
    plant.release_time = static_cast<float>(random.between(0.05, 0.4));
    plant.anchor_lead = static_cast<float>(random.unit());
    return rules_of(plant);
}

// Calls look(rules, machine, was, state, target by the formula, target by the machine) for 4 seconds.
template <class T, class Look>
void for_each_turn(std::uint64_t seed, const Look& look)
{
    Random random{seed};
    const PlantRules rules = random_turn_rules(random);
    const Way way(random);
    const double per_second = random.spread(20, 500);
    PlantMachine machine(rules);
    TurnMachine turns(rules);
    PlantedPoint<T> point(rules);
    TurnState<T> state{};
    RandomLabels labels;
    for (double t = 0; t < 4;) {
        const double time = static_cast<T>(random.below(50) ? jittered(random, per_second) : 0);
        t += time;
        const bool label = labels.next(random, time);
        const Vector3d x = eigen(mv<T>(way.place(t)));
        const PlantMachine::Stands stood = machine.stands;
        machine.step(x, label, time, 1);
        point.step(x, label, time);
        const Rotor<T> animated = unit_rotation(mv<T>(way.rotation(t)));
        const Quaterniond want = turns.step(eigen(animated).normalized(), time, stood, machine);
        if (machine.clearance < 1e-4 || turns.clearance < 1e-2) return;
        const TurnState<T> before = state;
        const Rotor<T> got = plant_rotation(state, point.last.step, point.state.locked, animated, rules);
        look(point, before, state, got, want);
    }
}

constexpr double kLeg = 0.83;  // m: of a man

// The largest change of velocity from one frame to the next; frames after a flagged cut are left out.
struct Jumps {
    double target = 0, input = 0;
};
void add_jumps(std::uint64_t seed, double per_second, Jumps& max)
{
    swivel_plant plant = swivel_default_plant();
    plant.stop_time = plant.release_time = 0.2f;
    Random random{seed};
    const Way way(random);
    PlantedPoint<float> point(rules_of(plant));
    RandomLabels labels;
    Vector3d x[3] = {}, y[3] = {};
    double time[3] = {}, t = 0;
    bool was_cut = false;
    for (int n = 0; t < 10; ++n) {
        for (auto* places : {x, y}) places[0] = places[1], places[1] = places[2];
        time[1] = time[2], time[2] = jittered(random, per_second), t += time[2];
        x[2] = way.place(t);
        y[2] = point.step(x[2], labels.next(random, time[2]), time[2], kLeg);
        const auto jump = [&](const Vector3d(&places)[3]) {
            return ((places[2] - places[1]) / time[2] - (places[1] - places[0]) / time[1]).norm();
        };
        if (n >= 2) max.input = std::max(max.input, jump(x));
        if (n >= 2 && !was_cut && !point.last.cut) max.target = std::max(max.target, jump(y));
        was_cut = point.last.cut;
    }
}

// Where a point is at multiples of a sixth of a second, when its label changes too, and between.
std::vector<Vector3d> at_common_times(std::uint64_t seed, int per_second, int looks_per_second)
{
    swivel_plant plant = swivel_default_plant();
    plant.unlock_radius = 10;  // distances are passed in other frames at other rates
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
float random_float(Random& random, float max)
{
    const std::uint32_t n = random.below(8);
    if (n == 0) return 0;
    if (n == 1) return static_cast<float>(std::min<double>(max, random.between(-1, 1)));
    if (n == 2) return random.below(2) ? max : -max;
    for (;;) {
        const float x = bit_cast<float>(random.word());
        if (std::fabs(x) <= max) return x;
    }
}
float random_size(Random& random, float max) { return std::fabs(random_float(random, max)); }
PlantRules any_rules(Random& random)
{
    swivel_plant plant = swivel_default_plant();
    swivel_constant_info info;
    for (std::uint32_t n = 0; swivel_describe_constant(n, &info); ++n) {
        if (info.structure != std::string_view("plant")) continue;
        auto* const values = reinterpret_cast<float*>(reinterpret_cast<std::byte*>(&plant) + info.offset);
        for (std::uint32_t k = 0; k < info.count; ++k)
            if (random.below(2))
                values[k] = info.min < 0 ? random_float(random, info.max) : random_size(random, info.max);
    }
    return rules_of(plant);
}
bool is_finite(const Vector<float>& v)
{
    return std::isfinite(v.c[0]) && std::isfinite(v.c[1]) && std::isfinite(v.c[2]);
}
bool is_nan(const Vector<float>& v) { return std::isnan(v.c[0]) || std::isnan(v.c[1]) || std::isnan(v.c[2]); }

}  // namespace

TEST_CASE("a planted point is where a machine of states has it")
{
    int judged = 0;
    rc::prop("in double to rounding", [&](std::uint64_t seed) {
        for (std::uint64_t n = 0; n < 10; ++n)
            RC_ASSERT(strayed_from_machine<double>(seed * 10 + n, 1e-11, judged) <= 1e-12);
    });
    rc::prop("in float to 2e-6", [&](std::uint64_t seed) {
        for (std::uint64_t n = 0; n < 10; ++n)
            RC_ASSERT(strayed_from_machine<float>(seed * 10 + n, 1e-4, judged) <= 2e-6);
    });
    CHECK(judged > 0);
}

TEST_CASE("a locked point moves by no bit, and stands on its mark once it has stopped")
{
    int stood_count = 0;
    rc::prop("in float", [&](std::uint64_t seed) {
        double locked_for = 0;
        for_each_step<float>(seed, [&](const PlantState<float>& before, const PlantedPoint<float>& point,
                                       const Vector3d&, bool, double time, double) {
            const Planted<float>& planted = point.last;
            const bool stood = before.locked && !planted.step.fresh;
            locked_for = stood ? locked_for + time : 0;
            if (stood && point.state.locked) RC_ASSERT(is_same(point.state.mark, before.mark));
            if (stood && locked_for > point.rules.given.stop_time + 1e-5) {
                RC_ASSERT(is_equal(planted.target, before.mark));
                RC_ASSERT(point.state.left == 0);
                ++stood_count;
            }
            RC_ASSERT(!(planted.step.locks && planted.step.releases));
            RC_ASSERT(point.state.locked ==
                      ((before.locked && !planted.step.fresh && !planted.step.releases) || planted.step.locks));
        });
    });
    CHECK(stood_count > 0);
}

TEST_CASE("a released point is with the animation again after its time to blend")
{
    int free_count = 0;
    rc::prop("exactly", [&](std::uint64_t seed) {
        double free_for = 0;
        for_each_step<float>(seed, [&](const PlantState<float>&, const PlantedPoint<float>& point, const Vector3d& x,
                                       bool, double time, double) {
            free_for = point.last.step.fades ? time : point.state.locked || point.state.waiting ? 0 : free_for + time;
            if (free_for <= point.rules.given.release_time + 1e-5 || point.last.step.releases) return;
            RC_ASSERT(is_equal(point.last.target, mv<float>(x)));
            ++free_count;
        });
    });
    CHECK(free_count > 0);
}

TEST_CASE("without time nothing that is carried changes")
{
    rc::prop("whatever the label", [](std::uint64_t seed) {
        for_each_step<float>(seed, [](const PlantState<float>&, const PlantedPoint<float>& point, const Vector3d& x,
                                      bool label, double, double length) {
            PlantedPoint<float> still = point;
            still.step(x + Vector3d(0.3, -0.2, 0.1), !label, 0, length);
            RC_ASSERT(is_same(still.state.mark, point.state.mark));
            RC_ASSERT(is_equal(still.state.offset, point.state.offset));
            RC_ASSERT(is_equal(still.state.velocity, point.state.velocity));
            RC_ASSERT(still.state.left == point.state.left && still.state.fresh == point.state.fresh);
            RC_ASSERT(still.state.locked == point.state.locked && still.state.armed == point.state.armed);
            RC_ASSERT(still.state.waiting == point.state.waiting);
        });
    });
}

TEST_CASE("a point that locks goes on at its speed to its anchor, and never past it where `run` is 1")
{
    for (const double run : {0.0, 0.5, 1.0}) {
        swivel_plant plant = swivel_default_plant();
        plant.anchor_lead = static_cast<float>(run);
        PlantedPoint<double> point(rules_of(plant));
        for (int n = 0; n < 2000; ++n) point.step({0.5 * n / 2000, 0, 0}, n == 1999, 1 / 2000.0);
        const double at = point.last.target.c[0], anchor = point.state.mark.c[0];
        CHECK(anchor - at == Approx(run * 0.5 * 0.1 / 3).margin(1e-9));
        double max = 0;
        for (int n = 0; n < 200; ++n) max = std::max(max, point.step({0.5, 0, 0}, true, 1 / 2000.0).x() - anchor);
        // The offset's cubic swings out by most at the root of its derivative.
        CHECK(max == Approx(run == 0 ? 4.0 / 27 * 0.5 * 0.1 : run == 1 ? 0 : 0.00207).margin(3e-5));
    }
}

TEST_CASE("a planted rotation is where a machine of states has it")
{
    int judged = 0;
    rc::prop("in double to rounding", [&](std::uint64_t seed) {
        for_each_turn<double>(seed, [&](const PlantedPoint<double>&, const TurnState<double>&, const TurnState<double>&,
                                        const Rotor<double>& got, const Quaterniond& want) {
            RC_ASSERT(eigen(got).angularDistance(want) <= 1e-7);
            RC_ASSERT(distance(eigen(got), want) <= 1e-12);
            ++judged;
        });
    });
    rc::prop("in float to 1e-5", [&](std::uint64_t seed) {
        for_each_turn<float>(seed, [&](const PlantedPoint<float>&, const TurnState<float>&, const TurnState<float>&,
                                       const Rotor<float>& got, const Quaterniond& want) {
            RC_ASSERT(distance(eigen(got), want) <= 1e-5);
            ++judged;
        });
    });
    CHECK(judged > 0);
}

TEST_CASE("a locked rotation turns by no bit once it has stopped")
{
    int stood_count = 0;
    rc::prop("in float", [&](std::uint64_t seed) {
        Rotor<float> last{};
        bool stood = false;
        for_each_turn<float>(seed, [&](const PlantedPoint<float>& point, const TurnState<float>& before,
                                       const TurnState<float>& state, const Rotor<float>& got, const Quaterniond&) {
            const bool was_locked = (point.state.locked && !point.last.step.locks) || point.last.step.releases;
            if (was_locked && point.state.locked)
                RC_ASSERT(std::memcmp(state.mark.c, before.mark.c, sizeof state.mark.c) == 0);
            if (was_locked && stood) RC_ASSERT(std::memcmp(got.c, last.c, sizeof got.c) == 0);
            if (was_locked && point.last.step.share == 1) {
                RC_ASSERT(distance(eigen(got), eigen(before.mark)) <= 3e-7);
                stood = true, last = got;
                ++stood_count;
            }
            if (!point.state.locked) stood = false;
        });
    });
    CHECK(stood_count > 0);
}

TEST_CASE("a rotation is taken as far as a half-tangent goes")
{
    for (const double angle : {0.0, 1e-6, 1.0, 2.6, 3.0, 3.14, 3.3, 5.0, 6.2}) {
        const Vector3d axis = Vector3d(1, 2, -2) / 3;
        const Vector3d got = eigen(half_tangent(mv<double>(Quaterniond(Eigen::AngleAxisd(angle, axis)))));
        const double short_angle = std::min(angle, 2 * 3.14159265358979323846 - angle);
        const double size = std::tan(std::min(short_angle / 2, kMaxHalf));
        CHECK((got - (angle > 3.1416 ? -size : size) * axis).norm() <= 1e-9);
    }
}

TEST_CASE("the velocity jumps by less the more frames there are")
{
    struct Row {
        double per_second, max, input;
    };
    for (const auto& [per_second, max, input] :
         {Row{30, 1.8, 0.75}, Row{60, 1.1, 0.4}, Row{144, 0.45, 0.17}, Row{600, 0.15, 0.05}, Row{2400, 0.037, 0.012}}) {
        Jumps jumps;
        for (std::uint64_t seed = 0; seed < 200; ++seed) add_jumps(seed, per_second, jumps);
        INFO(per_second << " a second: " << jumps.target << ", of the input " << jumps.input);
        CHECK(jumps.target <= max);
        CHECK(jumps.input <= input);
    }
}

TEST_CASE("frame rates hardly matter")
{
    struct Row {
        int per_second;
        double max;
    };
    for (const auto& [per_second, max] : {Row{30, 3.5e-3}, Row{60, 1.7e-3}, Row{144, 0.7e-3}}) {
        double worst = 0;
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            const auto fine = at_common_times(seed, 2880, 6), coarse = at_common_times(seed, per_second, 6);
            for (std::size_t n = 0; n < fine.size(); ++n) worst = std::max(worst, (fine[n] - coarse[n]).norm());
        }
        INFO(per_second << " a second: " << worst);
        CHECK(worst <= max);
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
            const Planted<float> planted = plant(state, {x, random.below(2) == 1, time, length}, rules);
            const Rotor<float> rotation =
                plant_rotation(turn, planted.step, state.locked, mv<float>(random.rotation()), rules);
            RC_ASSERT(is_finite(planted.target) && is_finite(state.mark) && is_finite(state.offset));
            RC_ASSERT(!is_nan(state.velocity) && std::isfinite(state.left));
            RC_ASSERT(std::fabs(len2(rotation) - 1) <= 1e-5f);
            RC_ASSERT(std::fabs(len2(turn.mark) - 1) <= 1e-5f);
            RC_ASSERT(is_finite(turn.offset) && is_finite(turn.velocity));
        }
    });
}

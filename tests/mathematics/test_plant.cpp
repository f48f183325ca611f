// SPDX-License-Identifier: MIT
//
// The promise: a point that is labelled stands, moves by no bit, and comes and goes without a jump, as a plain machine
// of states says. A rotation that is planted with its point stands and comes and goes with it, by a machine of its own.
#include <cstring>

#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include "tests/plant_story.h"

using namespace swivel;
using namespace swivel::test;

namespace {

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
    plant.lock = static_cast<float>(random.between(0.02, 0.3));
    plant.unlock = static_cast<float>(random.between(0.05, 0.6));
    plant.stop = random.below(5) ? static_cast<float>(random.between(0.02, 0.4)) : 0;
    plant.blend = random.below(5) ? static_cast<float>(random.between(0.02, 0.4)) : 0;
    plant.again = random.below(3) ? static_cast<float>(random.between(0.02, 0.8)) : 0;
    plant.run = static_cast<float>(random.unit());
    plant.longest = random.below(2) ? 0.5f : 0;
    return rules_of(plant);
}
double random_time(Random& random, double per_second)
{
    const std::uint32_t n = random.below(100);
    return n == 0 ? 0 : n == 1 ? 0.6 : jittered(random, per_second);
}

// The worst distance from the machine, in 4 seconds, as long as no decision is a matter of rounding. 1 and more: they
// decide otherwise, or say otherwise why.
template <class T>
double strayed_from_machine(std::uint64_t seed, double clearance)
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

}  // namespace

TEST_CASE("a planted point is where a machine of states has it")
{
    rc::prop("in double to rounding", [](std::uint64_t seed) {
        for (std::uint64_t n = 0; n < 10; ++n) RC_ASSERT(strayed_from_machine<double>(seed * 10 + n, 1e-11) <= 1e-12);
    });
    rc::prop("in float to 2e-6", [](std::uint64_t seed) {
        for (std::uint64_t n = 0; n < 10; ++n) RC_ASSERT(strayed_from_machine<float>(seed * 10 + n, 1e-4) <= 2e-6);
    });
}

TEST_CASE("a locked point moves by no bit, and stands on its mark once it has stopped")
{
    rc::prop("in float", [](std::uint64_t seed) {
        double locked_for = 0;
        for_each_step<float>(seed, [&](const PlantState<float>& before, const PlantedPoint<float>& point,
                                       const Vector3d&, bool, double time, double) {
            const Planted<float>& is = point.last;
            const bool stood = before.locked && !is.step.fresh;
            locked_for = stood ? locked_for + time : 0;
            if (stood && point.state.locked) RC_ASSERT(is_same(point.state.mark, before.mark));
            if (stood && locked_for > point.rules.stop + 1e-5) {
                RC_ASSERT(is_equal(is.target, before.mark));
                RC_ASSERT(point.state.left == 0);
            }
            RC_ASSERT(!(is.step.locks && is.step.releases));
            RC_ASSERT(point.state.locked == ((before.locked && !is.step.fresh && !is.step.releases) || is.step.locks));
        });
    });
}

TEST_CASE("a released point is with the animation again after its time to blend")
{
    rc::prop("exactly", [](std::uint64_t seed) {
        double free_for = 0;
        for_each_step<float>(seed, [&](const PlantState<float>&, const PlantedPoint<float>& point, const Vector3d& x,
                                       bool, double time, double) {
            free_for = point.last.step.fades ? time : point.state.locked || point.state.waiting ? 0 : free_for + time;
            if (free_for > point.rules.blend + 1e-5 && !point.last.step.releases)
                RC_ASSERT(is_equal(point.last.target, mv<float>(x)));
        });
    });
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
        plant.run = static_cast<float>(run);
        PlantedPoint<double> point(rules_of(plant));
        for (int n = 0; n < 2000; ++n) point.step({0.5 * n / 2000, 0, 0}, n == 1999, 1 / 2000.0);
        const double at = point.last.target.c[0], anchor = point.state.mark.c[0];
        CHECK(anchor - at == Approx(run * 0.5 * 0.1 / 3).margin(1e-9));
        double most = 0;
        for (int n = 0; n < 200; ++n) most = std::max(most, point.step({0.5, 0, 0}, true, 1 / 2000.0).x() - anchor);
        // The offset's cubic swings out by most at the root of its derivative.
        CHECK(most == Approx(run == 0 ? 4.0 / 27 * 0.5 * 0.1 : run == 1 ? 0 : 0.00207).margin(3e-5));
    }
}

namespace {

constexpr double kMostHalf = 75 * 3.14159265358979323846 / 180;

// A rotation that goes with a point's machine. An offset is the axis times the tangent of half the angle.
class TurnMachine {
public:
    double clearance = 1;  // the least cosine of half an angle so far: at 0 there are two ways round

    explicit TurnMachine(const PlantRules& rules) : rules_(rules) {}

    // was: how the point stood before its machine's step.
    Quaterniond step(const Quaterniond& is, double time, PlantMachine::Stands was, const PlantMachine& point)
    {
        using Stands = PlantMachine::Stands;
        const bool is_locked = point.stands == Stands::locked, was_locked = was == Stands::locked;
        if (point.is_fresh) {
            mark_ = is;
            transition_ = {};
            return is;
        }
        if (!(time > 0)) return turn(transition_.place()) * (was_locked ? mark_ : is);
        const Vector3d speed =
            was_locked ? Vector3d(Vector3d::Zero()) : Vector3d(offset(is * mark_.conjugate()) / time);
        if (was == Stands::releases)
            transition_ = {transition_.place(), shortened(transition_.speed() - speed, rules_.turn_out), rules_.blend};
        transition_.since += time;
        const Quaterniond to = turn(transition_.place()) * (was_locked ? mark_ : is);
        if (is_locked && !was_locked) {
            const Vector3d entry = shortened(speed + transition_.speed(), rules_.turn_in), ahead = rules_.ahead * entry;
            mark_ = turn(ahead) * to;
            transition_ = {-ahead, entry, rules_.stop};
        } else if (was_locked && !is_locked) {
            transition_ = {offset(to * is.conjugate()), transition_.speed(), 1};
        }
        if (!is_locked) mark_ = is;
        return to;
    }

private:
    PlantRules rules_;
    Quaterniond mark_ = Quaterniond::Identity();
    Transition transition_;

    static Quaterniond turn(const Vector3d& offset)
    {
        const double size = offset.norm();
        if (size == 0) return Quaterniond::Identity();
        return Quaterniond(Eigen::AngleAxisd(2 * std::atan(size), offset / size));
    }
    Vector3d offset(Quaterniond q)
    {
        clearance = std::min(clearance, std::fabs(q.w()));
        if (q.w() < 0) q.coeffs() = -q.coeffs();
        const double half = std::min(std::atan2(q.vec().norm(), q.w()), kMostHalf);
        return half == 0 ? Vector3d(Vector3d::Zero()) : Vector3d(std::tan(half) * q.vec().normalized());
    }
    static Vector3d shortened(const Vector3d& v, double most) { return v.norm() > most ? most / v.norm() * v : v; }
};

PlantRules random_turn_rules(Random& random)
{
    swivel_plant plant = swivel_default_plant();
    plant.stop = static_cast<float>(random.between(0.05, 0.4));
    plant.blend = static_cast<float>(random.between(0.05, 0.4));
    plant.run = static_cast<float>(random.unit());
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
        const PlantMachine::Stands was = machine.stands;
        machine.step(x, label, time, 1);
        point.step(x, label, time);
        const Rotor<T> is = unit_rotation(mv<T>(way.rotation(t)));
        const Quaterniond want = turns.step(eigen(is).normalized(), time, was, machine);
        if (machine.clearance < 1e-4 || turns.clearance < 1e-2) return;
        const TurnState<T> before = state;
        const Rotor<T> got = plant_turn(state, point.last.step, point.state.locked, is, rules);
        look(point, before, state, got, want);
    }
}

}  // namespace

TEST_CASE("a planted rotation is where a machine of states has it")
{
    rc::prop("in double to rounding", [](std::uint64_t seed) {
        for_each_turn<double>(seed, [](const PlantedPoint<double>&, const TurnState<double>&, const TurnState<double>&,
                                       const Rotor<double>& got, const Quaterniond& want) {
            RC_ASSERT(eigen(got).angularDistance(want) <= 1e-7);
            RC_ASSERT(distance(eigen(got), want) <= 1e-12);
        });
    });
    rc::prop("in float to 1e-5", [](std::uint64_t seed) {
        for_each_turn<float>(seed, [](const PlantedPoint<float>&, const TurnState<float>&, const TurnState<float>&,
                                      const Rotor<float>& got,
                                      const Quaterniond& want) { RC_ASSERT(distance(eigen(got), want) <= 1e-5); });
    });
}

TEST_CASE("a locked rotation turns by no bit once it has stopped")
{
    rc::prop("in float", [](std::uint64_t seed) {
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
            }
            if (!point.state.locked) stood = false;
        });
    });
}

TEST_CASE("a rotation is taken as far as a half-tangent goes")
{
    for (const double angle : {0.0, 1e-6, 1.0, 2.6, 3.0, 3.14, 3.3, 5.0, 6.2}) {
        const Vector3d axis = Vector3d(1, 2, -2) / 3;
        const Vector3d got = eigen(half_tangent(mv<double>(Quaterniond(Eigen::AngleAxisd(angle, axis)))));
        const double short_angle = std::min(angle, 2 * 3.14159265358979323846 - angle);
        const double size = std::tan(std::min(short_angle / 2, kMostHalf));
        CHECK((got - (angle > 3.1416 ? -size : size) * axis).norm() <= 1e-9);
    }
}

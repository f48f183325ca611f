// SPDX-License-Identifier: MIT
//
// The promise: a rotation that is planted with its point stands by no bit, and comes and goes with the point, as a
// plain machine of states says.
#include <catch2/catch.hpp>

#include <cstring>

#include <rapidcheck/catch.h>

#include "tests/plant_story.h"

namespace {

using namespace swivel;
using namespace swivel::test;

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

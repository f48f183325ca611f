// SPDX-License-Identifier: MIT
//
// A point on a random way, with labels of contact, and what becomes of it where it is planted: a machine of plain
// states, in double. It keeps each change's curve from its beginning and looks it up at the time since then. Knows none
// of the library's formulas.
#pragma once

#include <algorithm>
#include <array>

#include "core/plant_rotation.h"
#include "swivel/swivel.h"
#include "tests/formula_arm.h"

namespace swivel::test {

// docs/fields.md's words: no speed may add more than `lock_radius` to a point's way.
inline PlantRules rules_of(const swivel_plant& plant)
{
    const double lock = plant.lock_radius, stop = std::max<double>(plant.stop_time, kShortestTime),
                 blend = std::max<double>(plant.release_time, kShortestTime);
    return {.given = plant,
            .ahead = static_cast<float>(double{plant.anchor_lead} * plant.stop_time / 3),
            .fastest_in = static_cast<float>(3 * lock / stop),
            .fastest_out = static_cast<float>(6.75 * lock / blend),
            .turn_in = static_cast<float>(1 / stop),
            .turn_out = static_cast<float>(2 / blend)};
}

// A smooth way of a point that turns, with speeds to 1.5 m/s and accelerations to 15 m/s^2.
class Way {
public:
    explicit Way(Random& random, double max_speed = 1.5)
    {
        double speed = 0;
        for (Wave& wave : waves_) {
            wave = {random.direction(), random.between(4, 10), random.between(0, 6.28)};
            speed += 1;
        }
        for (Wave& wave : waves_) wave.size *= max_speed / (speed * wave.pace);
        axis_ = random.direction();
    }
    Vector3d place(double t) const
    {
        Vector3d at = Vector3d::Zero();
        for (const Wave& wave : waves_) at += std::sin(wave.pace * t + wave.start) * wave.size;
        return at;
    }
    Quaterniond rotation(double t) const
    {
        const Vector3d at = place(t);
        return Eigen::AngleAxisd(2 * at.x() + 3 * at.y(), axis_) *
               Quaterniond(Eigen::AngleAxisd(3 * at.z(), Vector3d::UnitX()));
    }

private:
    struct Wave {
        Vector3d size;
        double pace, start;
    };
    std::array<Wave, 3> waves_;
    Vector3d axis_;
};

// A cubic from an offset and a velocity to rest.
struct Transition {
    Vector3d offset = Vector3d::Zero(), velocity = Vector3d::Zero();
    double lasts = 0, since = 0;

    Vector3d place() const
    {
        if (since >= lasts) return Vector3d::Zero();
        const double s = since / lasts;
        return (2 * s * s * s - 3 * s * s + 1) * offset + (s * s * s - 2 * s * s + s) * lasts * velocity;
    }
    Vector3d speed() const
    {
        if (since >= lasts) return Vector3d::Zero();
        const double s = since / lasts;
        return (6 * s * s - 6 * s) / lasts * offset + (3 * s * s - 4 * s + 1) * velocity;
    }
};

class PlantMachine {
public:
    enum class Stands { starts, follows, releases, locked };  // releases: until its speed is known
    Stands stands = Stands::starts;
    bool is_cut = false, is_fresh = false;  // of the last step
    double clearance = 1;  // the least distance of a decision from its threshold so far, as a share of it
    Vector3d anchor = Vector3d::Zero();
    Transition transition;

    explicit PlantMachine(const PlantRules& rules) : rules_(rules) {}

    // Where the point goes.
    Vector3d step(const Vector3d& x, bool label, double time, double length)
    {
        is_cut = is_fresh = false;
        if (rules_.given.reset_time > 0 && time > rules_.given.reset_time) stands = Stands::starts;
        if (stands == Stands::starts) {
            is_fresh = true;
            transition = {};
            last_ = anchor = x;
            stands = label ? Stands::locked : Stands::follows;
            transition.lasts = label ? rules_.given.stop_time : 0;
            is_armed_ = !label;
            return x;
        }
        if (!(time > 0)) return base(x) + transition.place();
        const bool was_locked = stands == Stands::locked;
        const Vector3d speed = was_locked ? Vector3d(Vector3d::Zero()) : Vector3d((x - last_) / time);
        if (stands == Stands::releases) {
            begin(transition.place(), shortened(transition.speed() - speed, rules_.fastest_out * length),
                  rules_.given.release_time);
            stands = Stands::follows;
        }
        transition.since += time;
        const Vector3d to = base(x) + transition.place();
        is_armed_ |= !label;
        if (was_locked) {
            const bool is_far = is_over((x - anchor).norm(), rules_.given.unlock_radius * length);
            if (label && !is_far) return to;
            stands = Stands::releases;
            begin(to - x, transition.speed(), 1);  // stands still until the speed is known
            last_ = x;
            return to;
        }
        last_ = x;
        if (!label || is_over(transition.place().norm(), rules_.given.lock_radius * length)) return to;
        const double relock_speed = rules_.given.relock_speed * length;
        if (!is_armed_ && (relock_speed == 0 || is_over(speed.norm(), relock_speed))) return to;
        const Vector3d entry = shortened(speed + transition.speed(), rules_.fastest_in * length);
        anchor = to + rules_.ahead * entry;
        begin(to - anchor, entry, rules_.given.stop_time);
        stands = Stands::locked;
        is_armed_ = false;
        return to;
    }

private:
    PlantRules rules_;
    Vector3d last_ = Vector3d::Zero();
    bool is_armed_ = false;

    Vector3d base(const Vector3d& x) const { return stands == Stands::locked ? anchor : x; }
    void begin(const Vector3d& offset, const Vector3d& velocity, double lasts)
    {
        transition = {offset, velocity, lasts, 0};
    }
    bool is_over(double value, double threshold)
    {
        clearance = std::min(clearance, std::fabs(value - threshold) / std::max(threshold, 1e-9));
        return value > threshold;
    }
    Vector3d shortened(const Vector3d& v, double max)
    {
        if (v.norm() <= max) return v;
        is_cut = true;
        return max / v.norm() * v;
    }
};

inline constexpr double kMaxHalf = 75 * 3.14159265358979323846 / 180;

// A rotation that goes with a point's machine. An offset is the axis times the tangent of half the angle.
class TurnMachine {
public:
    double clearance = 1;  // the least cosine of half an angle so far: at 0 there are two ways round

    explicit TurnMachine(const PlantRules& rules) : rules_(rules) {}

    // stood: how the point stood before its machine's step.
    Quaterniond step(const Quaterniond& now, double time, PlantMachine::Stands stood, const PlantMachine& point)
    {
        using Stands = PlantMachine::Stands;
        const bool is_locked = point.stands == Stands::locked, was_locked = stood == Stands::locked;
        if (point.is_fresh) {
            mark_ = now;
            transition_ = {};
            return now;
        }
        if (!(time > 0)) return turn(transition_.place()) * (was_locked ? mark_ : now);
        const Vector3d speed =
            was_locked ? Vector3d(Vector3d::Zero()) : Vector3d(offset(now * mark_.conjugate()) / time);
        if (stood == Stands::releases)
            transition_ = {transition_.place(), shortened(transition_.speed() - speed, rules_.turn_out),
                           rules_.given.release_time};
        transition_.since += time;
        const Quaterniond to = turn(transition_.place()) * (was_locked ? mark_ : now);
        if (is_locked && !was_locked) {
            const Vector3d entry = shortened(speed + transition_.speed(), rules_.turn_in), ahead = rules_.ahead * entry;
            mark_ = turn(ahead) * to;
            transition_ = {-ahead, entry, rules_.given.stop_time};
        } else if (was_locked && !is_locked) {
            transition_ = {offset(to * now.conjugate()), transition_.speed(), 1};
        }
        if (!is_locked) mark_ = now;
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
        const double half = std::min(std::atan2(q.vec().norm(), q.w()), kMaxHalf);
        return half == 0 ? Vector3d(Vector3d::Zero()) : Vector3d(std::tan(half) * q.vec().normalized());
    }
    static Vector3d shortened(const Vector3d& v, double max) { return v.norm() > max ? max / v.norm() * v : v; }
};

// A point planted by the library's formula, over any number type.
template <class T>
struct PlantedPoint {
    PlantState<T> state{};
    PlantRules rules;
    Planted<T> last{};

    explicit PlantedPoint(const PlantRules& of) : rules(of) { state.fresh = true; }
    Vector3d step(const Vector3d& x, bool label, double time, double length = 1)
    {
        forget_old(state, static_cast<T>(time), rules);
        last = plant(state, {mv<T>(x), label, static_cast<T>(time), static_cast<T>(length)}, rules);
        return eigen(last.target);
    }
};

// A time of a frame, off its usual one by up to 30%.
inline double jittered(Random& random, double per_second) { return random.between(0.7, 1.3) / per_second; }

// Labels that change at random times.
struct RandomLabels {
    bool is = false;
    double left = 0;

    bool next(Random& random, double time, double longest = 0.6)
    {
        left -= time;
        if (left > 0) return is;
        left = random.between(0.01, longest);
        return is = !is;
    }
};

}  // namespace swivel::test

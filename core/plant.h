// SPDX-License-Identifier: MIT
//
// A planted point: while a label says contact, it is locked to its support, and its offset from the animation fades
// after release. Our own design, after D. Holden, "Inverse Kinematics and Foot Locking" (2026).
//
// Everything is in the support's frame, so the carried state moves with a platform. The point goes to (locked ? mark :
// animated point) + offset. Each step restarts the cubic that brings the present offset and velocity to rest in the
// time left; this gives one smooth curve. So a change only adds to offset and velocity, even during another change.
//
// mark is the anchor while locked, else the animated point of the last step. One member is enough, because a release
// waits for the next step to measure the animation's speed.
#pragma once

#include "core/group_rules.h"
#include "core/joint_frame.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct PlantState {
    Vector<T> mark, offset, velocity;
    T left;                                 // time until offset and velocity are gone
    Mask<T> fresh, locked, armed, waiting;  // armed: may lock at any speed; waiting: released, not yet fading
};
template <class T>
struct PlantInput {
    Vector<T> point;  // as animated, in the support's frame
    Mask<T> label;    // contact
    T time;           // since the last step, 0 or more
    T length;         // of the limb: the unit of the rules' lengths
};
// The events of a step. A rotation that locks with the point shares them (plant_rotation.h).
template <class T>
struct PlantStep {
    Mask<T> fresh, moves, fades, locks, releases;  // fades: a release of the last step begins to fade
    T per_time;                                    // 0 where time stands still
    T left, per_left, share;                       // the cubic's time left, and the share of it that this step takes
};
template <class T>
struct Planted {
    Vector<T> target;
    Mask<T> too_far, cut;  // released by distance; a velocity was cut, so the point jumps
    PlantStep<T> step;
};

// The vector, shortened to max >= 0 where it is longer and counts. longer: gains these lanes.
template <class T>
SWIVEL_INLINE constexpr Vector<T> at_most(const Vector<T>& v, const T& max, const Mask<T>& counts, Mask<T>& longer)
{
    const T length2 = len2(v);
    const Mask<T> is_longer = counts & (length2 > max * max);
    longer = longer | is_longer;
    if (!any(is_longer)) return v;
    return select(is_longer, (max / sqrt(select(is_longer, length2, T(1)))) * v, v);
}

// A step of the cubic that brings offset and velocity to zero in the time left. A step of time 0 changes no bit.
template <class T>
SWIVEL_INLINE constexpr void fade(Vector<T>& offset, Vector<T>& velocity, const PlantStep<T>& step)
{
    const T u = step.share, rest = T(1) - u;
    const Vector<T> faded_offset = (rest * rest) * ((T(1) + u + u) * offset + (u * step.left) * velocity);
    const Vector<T> faded_velocity = rest * ((T(1) - T(3) * u) * velocity - (T(6) * u * step.per_left) * offset);
    velocity = select(step.moves, faded_velocity, velocity);
    offset = select(step.moves, faded_offset, offset);
}

// A point whose last step is longer ago than reset_time starts anew.
template <class T>
SWIVEL_INLINE constexpr void forget_old(PlantState<T>& s, const T& time, const PlantRules& rules)
{
    const float reset_time = rules.given.reset_time;
    if (reset_time > 0) s.fresh = s.fresh | (time > T(reset_time));
}

// One step. State and input must be finite, the input within kHuge.
template <class T>
SWIVEL_INLINE constexpr Planted<T> plant(PlantState<T>& s, const PlantInput<T>& in, const PlantRules& rules)
{
    const Vector<T> none = vector(T(0), T(0), T(0)), x = in.point;
    const T lock = T(rules.given.lock_radius) * in.length, unlock = T(rules.given.unlock_radius) * in.length,
            again = T(rules.given.relock_speed) * in.length;
    Planted<T> out;
    out.cut = no_lanes<T>();
    const Mask<T> fresh = s.fresh;
    const Mask<T> moves = (in.time > T(0)) & !fresh, was_locked = s.locked & !fresh, acts = moves | fresh;
    const T per_time = select(moves, T(1), T(0)) / select(moves, hi(in.time, T(kShortestTime)), T(1));
    Vector<T> mark = s.mark, offset = s.offset, velocity = s.velocity;
    T left = s.left;
    if (any(fresh)) {
        mark = select(fresh, x, mark);
        offset = select(fresh, none, offset), velocity = select(fresh, none, velocity);
        left = select(fresh, T(0), left);
    }
    Mask<T> waiting = s.waiting & !fresh;

    // The animated point's speed; 0 where the mark is an anchor.
    const Vector<T> speed = select(was_locked, none, per_time * (x - mark));
    const Mask<T> fades = waiting & moves;
    velocity = select(fades, at_most(velocity - speed, T(rules.fastest_out) * in.length, fades, out.cut), velocity);
    left = select(fades, T(rules.given.release_time), left);
    waiting = waiting & !moves;

    const Mask<T> is_left = left > T(kShortestTime);
    const T per_left = T(1) / select(is_left, left, T(1));
    const T share = select(moves, select(is_left, lo(in.time * per_left, T(1)), T(1)), T(0));
    out.step = {fresh, moves, fades, fresh, fresh, per_time, left, per_left, share};
    fade(offset, velocity, out.step);
    left = hi(left - select(moves, in.time, T(0)), T(0));
    out.target = select(was_locked, mark, x) + offset;  // the events below leave it

    const Mask<T> far = len2(x - mark) > unlock * unlock, releases = was_locked & moves & (far | !in.label);
    const Mask<T> armed = s.armed | fresh | (acts & !in.label), rests = (again > T(0)) & (len2(speed) <= again * again);
    const Mask<T> locks = acts & in.label & !was_locked & (armed | rests) & (len2(offset) <= lock * lock);
    // The anchor lies ahead, as far as the point goes in the time rules.ahead.
    const Vector<T> entry =
        select(fresh, none, at_most(speed + velocity, T(rules.fastest_in) * in.length, locks, out.cut));
    const Vector<T> anchor = out.target + T(rules.ahead) * entry;

    s.mark = select(locks, anchor, select(acts & (releases | !was_locked), x, mark));
    s.offset = select(locks, out.target - anchor, select(releases, out.target - x, offset));
    s.velocity = select(locks, entry, velocity);
    s.left = select(locks, T(rules.given.stop_time), left);
    s.fresh = no_lanes<T>();
    s.locked = (was_locked & !releases) | locks;
    s.armed = armed & !locks;
    s.waiting = (waiting & !locks) | releases;
    out.too_far = releases & in.label;
    out.step.locks = locks;
    out.step.releases = releases;
    return out;
}

// Contact from a point's own motion, for points without labels. A slow and low point is in contact; to stay in contact
// it may be faster and higher than to come into it.
template <class T>
struct MotionState {
    Vector<T> place;  // in the support's frame, of the last step
    Mask<T> contact;
};
// height: of the point, over the body's root. fresh: of the plant's state; the speed is then unknown.
template <class T>
SWIVEL_INLINE constexpr Mask<T> contact_by_motion(MotionState<T>& s, const Mask<T>& fresh, const PlantInput<T>& in,
                                                  const T& height, const PlantRules& rules)
{
    const Mask<T> moves = (in.time > T(0)) & !fresh, was_in_contact = s.contact & !fresh;
    const auto bar = [&](const float(&bounds)[2]) SWIVEL_INLINE_LAMBDA {
        return select(was_in_contact, T(bounds[1]), T(bounds[0])) * in.length;
    };
    const T way = bar(rules.given.speed) * in.time;
    const Mask<T> is_at_rest = (len2(in.point - s.place) <= way * way) & (height <= bar(rules.given.height));
    s.contact = (moves & is_at_rest) | (was_in_contact & !moves);
    s.place = select(moves | fresh, in.point, s.place);
    return s.contact;
}

}  // namespace swivel::inline SWIVEL_ISA

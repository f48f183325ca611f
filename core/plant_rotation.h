// SPDX-License-Identifier: MIT
//
// A rotation that is planted together with a point (plant.h). Its offset is the half-tangent vector g = axis
// tan(angle / 2), which stands for the rotation (g, 1) made unit. The same cubic brings it to zero in the same time.
#pragma once

#include "core/plant.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct TurnState {
    Rotor<T> mark;               // the anchor's rotation, or the animated one of the last step
    Vector<T> offset, velocity;  // half-tangent vectors
};

// At most tan(75 degrees) long. q: of unit length.
template <class T>
SWIVEL_INLINE constexpr Vector<T> half_tangent(const Rotor<T>& q)
{
    const T w = q.template at<kScalar>(), per = flip_sign(T(1) / hi(abs(w), T(1e-6)), w);
    Mask<T> longer = no_lanes<T>();
    return at_most(per * vector_part(q), T(3.7320508075688772), all_lanes<T>(), longer);
}
template <class T>
SWIVEL_INLINE constexpr Rotor<T> from_half_tangent(const Vector<T>& g)
{
    return normalise(rotor(g, T(1)));
}

// The rotation that goes with plant()'s target. animated: in the support's frame, of unit length. locked: after the
// step.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> plant_rotation(TurnState<T>& s, const PlantStep<T>& step, const Mask<T>& locked,
                                                const Rotor<T>& animated, const PlantRules& rules)
{
    const Vector<T> none = vector(T(0), T(0), T(0));
    const Mask<T> was_locked = (locked & !step.locks) | step.releases;
    const Rotor<T> mark = select(step.fresh, animated, s.mark);
    Vector<T> offset = select(step.fresh, none, s.offset), velocity = select(step.fresh, none, s.velocity);
    Mask<T> cut = no_lanes<T>();
    const Vector<T> speed = select(was_locked, none, step.per_time * half_tangent(animated * ~mark));
    velocity = select(step.fades, at_most(velocity - speed, T(rules.turn_out), step.fades, cut), velocity);
    fade(offset, velocity, step);
    const Rotor<T> target = unit_rotation(from_half_tangent(offset) * select(was_locked, mark, animated));
    // The anchor lies ahead, as plant()'s does.
    const Vector<T> entry = select(step.fresh, none, at_most(speed + velocity, T(rules.turn_in), step.locks, cut));
    const Vector<T> ahead = T(rules.ahead) * entry;
    s.mark = select(step.locks, unit_rotation(from_half_tangent(ahead) * target),
                    select((step.moves | step.fresh) & (step.releases | !was_locked), animated, mark));
    s.offset = select(step.locks, -ahead, select(step.releases, half_tangent(target * ~animated), offset));
    s.velocity = select(step.locks, entry, velocity);
    return target;
}

}  // namespace swivel::inline SWIVEL_ISA

// SPDX-License-Identifier: MIT
//
// A prop in two hands: where it lies between them, and the least move that lets both arms reach it. Our own formulas.
#pragma once

#include "core/joint_frame.h"

namespace swivel::inline SWIVEL_ISA {

// Where a hand or a held thing is. rotation: of unit length.
template <class T>
struct HeldFrame {
    Rotor<T> rotation;
    Vector<T> place;
};
// The grip's frame outside of `outer`. scale: of places in `outer`.
template <class T>
SWIVEL_INLINE constexpr HeldFrame<T> gripped(const HeldFrame<T>& outer, const HeldFrame<T>& grip, const T& scale)
{
    return {unit_rotation(outer.rotation * grip.rotation), outer.place + turned(outer.rotation, scale * grip.place)};
}
// The frame of the thing that this hand holds at this grip.
template <class T>
SWIVEL_INLINE constexpr HeldFrame<T> held_by(const HeldFrame<T>& hand, const HeldFrame<T>& grip)
{
    const Rotor<T> rotation = unit_rotation(hand.rotation * ~grip.rotation);
    return {rotation, hand.place - turned(rotation, grip.place)};
}
// The frame between two, by a share of 0 to 1: places on their line, rotations by a normalised blend the short way
// round. Shares 0 and 1 give a and b, to the bit.
template <class T>
SWIVEL_INLINE constexpr HeldFrame<T> between(const HeldFrame<T>& a, const HeldFrame<T>& b, const T& share)
{
    const Mask<T> is_a = share == T(0), is_b = share == T(1);
    if (all(is_a)) return a;
    const T rest = T(1) - share, other = flip_sign(share, scalar_product(~a.rotation, b.rotation));
    const HeldFrame<T> mixed{normalise(rest * a.rotation + other * b.rotation), rest * a.place + share * b.place};
    return {select(is_a, a.rotation, select(is_b, b.rotation, mixed.rotation)),
            select(is_a, a.place, select(is_b, b.place, mixed.place))};
}

// The moves of a prop that bring its grip within an arm's reach: those within `reach` of `middle`, plus a slack of
// several times rounding, so that rounding loses no move.
inline constexpr double kReachSlack = 5e-7;
template <class T>
struct ReachingMoves {
    Vector<T> middle;
    T reach;

    SWIVEL_INLINE constexpr Mask<T> has(const Vector<T>& move) const
    {
        const T far = reach + T(kReachSlack) * (reach + sqrt(len2(middle)));
        return len2(move - middle) <= far * far;
    }
    // The shortest of them.
    SWIVEL_INLINE constexpr Vector<T> shortest() const
    {
        const T length2 = len2(middle);
        const Mask<T> is_far = length2 > reach * reach;
        const T way = select(is_far, T(1) - reach / sqrt(select(is_far, length2, T(1))), T(0));
        return way * middle;
    }
};
// The shortest move that both arms can reach. If there is none, the move from which the worse arm misses least.
//
// If one arm's shortest move is also a move of the other's, it is that. Else it is the point nearest to 0 on the circle
// where their spheres meet. Concentric spheres never get there, because of the slack.
template <class T>
SWIVEL_INLINE constexpr Vector<T> min_move(const ReachingMoves<T>& a, const ReachingMoves<T>& b)
{
    const Vector<T> min_a = a.shortest(), min_b = b.shortest();
    const Vector<T> between = b.middle - a.middle;
    const T both = a.reach + b.reach;
    const Mask<T> is_a = b.has(min_a), is_b = a.has(min_b), meets = !(is_a | is_b);
    const Vector<T> one = select(is_a, min_a, min_b);
    if (!any(meets)) return one;
    const T distance = sqrt(hi(len2(between), T(kTiny2)));
    const Vector<T> line = (T(1) / distance) * between;
    const T apart = hi(distance - a.reach - b.reach, T(0));
    const T along =
        select(apart > T(0), a.reach + T(0.5) * apart, T(0.5) * (distance + (a.reach - b.reach) * (both / distance)));
    const Vector<T> centre = a.middle + along * line;
    const T radius = sqrt(hi(a.reach * a.reach - along * along, T(0)));
    const Vector<T> to_origin = -centre + scalar_product(line, centre) * line;
    const T length2 = len2(to_origin);
    const Mask<T> is_known = length2 > T(1e-12) * len2(centre);
    const Vector<T> way =
        select(is_known, (T(1) / sqrt(select(is_known, length2, T(1)))) * to_origin, any_across(line));
    return select(meets, centre + radius * way, one);
}

}  // namespace swivel::inline SWIVEL_ISA

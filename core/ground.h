// SPDX-License-Identifier: MIT
//
// A foot on ground that is not flat. Heights are along the body's axis up, distances from the ground along its normal.
// A foot turns about its toe, so no length changes. Our own formulas.
#pragma once

#include "core/clavicle.h"
#include "core/joint_frame.h"
#include "core/plant.h"

namespace swivel::inline SWIVEL_ISA {

// The cosine of the steepest slope that feet stand on: 87 degrees.
inline constexpr double kSteepest = 0.05;
// A normal whose squared distance from up is less than this counts as up: 1e-6 radians.
inline constexpr double kUpright2 = 1e-12;

// The plane of the ground below a foot, relative to the root's place.
template <class T>
struct GroundPlane {
    Vector<T> place, normal;  // the normal is of unit length
    T rise;                   // its component along up
    Mask<T> exists;           // whether there is ground to stand on

    // The normal that a foot turns to; up without ground.
    SWIVEL_INLINE constexpr Vector<T> slope(const Vector<T>& up) const { return select(exists, normal, up); }
    SWIVEL_INLINE constexpr T distance(const Vector<T>& point) const { return scalar_product(normal, point - place); }
    // How far a point must move up to reach this clearance from the plane; 0 without ground.
    SWIVEL_INLINE constexpr T way_up(const Vector<T>& point, const T& clearance) const
    {
        return select(exists, (clearance - distance(point)) / select(exists, rise, T(1)), T(0));
    }
};
// place: NaN where no ground is known. up: unit.
template <class T>
SWIVEL_INLINE constexpr GroundPlane<T> ground_plane(const Vector<T>& place, const Vector<T>& normal,
                                                    const Vector<T>& up)
{
    const Vector<T> unit = normalise(normal);
    const T rise = scalar_product(unit, up);
    const Mask<T> exists = (len2(place) <= T(kHuge2)) & (rise > T(kSteepest));
    return {place, unit, rise, exists};
}

// Raises the anchors of points that lock in this step by `way`, to their clearance over the ground. Their targets stay,
// because their offsets fall by as much. up: in the support's frame.
template <class T>
SWIVEL_INLINE constexpr void lock_on_ground(PlantState<T>& state, const Mask<T>& locks, const Vector<T>& up,
                                            const T& way)
{
    const Vector<T> lift = select(locks, way, T(0)) * up;
    state.mark = select(locks, state.mark + lift, state.mark);
    state.offset = select(locks, state.offset - lift, state.offset);
}

template <class T>
struct Foot {
    Vector<T> toe;
    Rotor<T> rotation;  // of unit length
};
// The turn, limited to a max angle about its own axis. turn: of unit length, by at most half a circle. cos_half,
// sin_half: of half the max angle.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> no_further(const Rotor<T>& turn, const T& cos_half, const T& sin_half)
{
    // By the sine: cosines do not tell small angles apart.
    const Vector<T> v = vector_part(turn);
    const T length2 = len2(v);
    const Mask<T> is_further = length2 > sin_half * sin_half;
    if (!any(is_further)) return turn;
    const Vector<T> axis = (sin_half / sqrt(select(is_further, length2, T(1)))) * v;
    return select(is_further, rotor(axis, cos_half), turn);
}

// The turn that lifts one end of a foot to the wanted height along the normal. The end moves up a circle about the
// foot's other end, in the plane of foot and normal, at most to the top. An end that is high enough stays. end: from
// the other end.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> lifting_turn(const Mask<T>& counts, const Vector<T>& normal, const Vector<T>& end,
                                              const T& wanted)
{
    const T length2 = len2(end), height = scalar_product(normal, end);
    const Mask<T> lifts = counts & (height < wanted);
    if (!any(lifts)) return one<T>();
    const Vector<T> flat = end - height * normal;
    const T flat2 = len2(flat), across = sqrt(hi(length2 - wanted * wanted, T(0)) / hi(flat2, T(kTiny2)));
    return select(lifts, clavicle_rotation(end, wanted * normal + across * flat, T(1)), one<T>());
}

// Turns the foot with the ground by a share of 0 to 1, and keeps toe and heel at their clearances or higher.
// slope: the plane that the foot turns with and its heel stays above: the ground, or for a foot in the air a plane
// through the same point with another normal.
// heel_from_toe: in the foot's frame, in the world's unit. Clearances are in the same unit.
template <class T>
SWIVEL_INLINE constexpr Foot<T> foot_on_ground(const GroundPlane<T>& ground, const GroundPlane<T>& slope,
                                               const Vector<T>& up, const Foot<T>& foot, const Vector<T>& heel_from_toe,
                                               const T& scale, const T& share, const GroundRules& rules)
{
    const Vector<T> toe = foot.toe + hi(ground.way_up(foot.toe, T(rules.given.toe_clearance) * scale), T(0)) * up;
    const Rotor<T> with_ground =
        no_further(clavicle_rotation(up, slope.normal, share), T(rules.cos_half_max), T(rules.sin_half_max)) *
        foot.rotation;
    const Rotor<T> on_slope = unit_rotation(with_ground);

    const T wanted = T(rules.given.heel_clearance) * scale - slope.distance(toe);
    const Rotor<T> lift = lifting_turn(ground.exists, slope.normal, turned(on_slope, heel_from_toe), wanted);
    // Beyond the ground's end, a foot's turn fades until its slope is up again.
    const Mask<T> turns = ground.exists | (len2(slope.normal - up) > T(kUpright2));
    return {toe, select(turns, unit_rotation(lift * on_slope), foot.rotation)};
}

}  // namespace swivel::inline SWIVEL_ISA

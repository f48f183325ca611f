// SPDX-License-Identifier: MIT
//
// Chooses the swivel plane: the plane through shoulder and wrist that the elbow lies in, the arm's one freedom for a
// fixed wrist. Here from a pole. Where the pole does not say (along the target's line within sin 1e-3, or of no length)
// the plane's normal is the rest hinge e1, or e2 when e1 lies along the line.
#pragma once

#include "core/arm.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct SwivelPlane {
    Vector<T> side;    // of unit length, in the plane, orthogonal to the line, on the elbow's side: normal x line
    Vector<T> normal;  // of unit length and orthogonal to the line
    Mask<T> undefined;
};

// u: unit vector from shoulder to wrist. aim: along u, and pole: both of any length in 3e-8..1e6, aim2 and pole2 its
// square. The aim is taken instead of u so that this root and this division need not wait for u's.
template <class T>
SWIVEL_INLINE constexpr SwivelPlane<T> swivel_plane(const Vector<T>& u, const Vector<T>& aim, const T& aim2,
                                                    const Vector<T>& pole, const T& pole2)
{
    const Vector<T> across = cross(aim, pole);
    const T across2 = len2(across);
    // 1e-6 = (sin 1e-3)^2: closer to the line, the pole's digits are noise.
    const Mask<T> defined = across2 > T(1e-6) * aim2 * pole2;

    Vector<T> chosen = across;
    T chosen2 = across2;
    if (!all(defined)) {
        // The parts of e1 and e2 orthogonal to u.
        const auto hinge = cross(u, cross(unit<T, kE1>(), u)), other = cross(u, cross(unit<T, kE2>(), u));
        const T hinge2 = hinge.template at<kE1>();  // its squared length is its part along e1
        const Mask<T> across_e1 = hinge2 > T(1e-6);
        chosen = select(defined, across, select(across_e1, hinge, other));
        chosen2 = select(defined, across2, select(across_e1, hinge2, other.template at<kE2>()));
    }
    const Vector<T> normal = (T(1) / sqrt(chosen2)) * chosen;
    // Once more orthogonal: a pole 1e-3 off the line leaves 1e-5 of the line in the normal. The side needs no such
    // care.
    return {cross(normal, u), normal - scalar_product(normal, u) * u, !defined};
}

}  // namespace swivel::inline SWIVEL_ISA

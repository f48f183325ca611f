// SPDX-License-Identifier: MIT
//
// The rotor that lays a frame along a line. It takes steps 3 to 5 of the lecture (pipeline.h), the middle line and the
// twist about it. The forms here cannot cancel, and take lines and normals of any length. Source: D. Hildenbrand,
// Inverse Kinematics of a Virtual Character (TU Darmstadt, 2019).
#pragma once

#include "core/conformal.h"

namespace swivel::inline SWIVEL_ISA {

// A line along -e3 has no middle line to e3. So the frame starts from e3 or -e3, whichever is nearer to the line.
// Before it starts from -e3, it is turned by pi about e1.
template <class T>
struct FrameStart {
    T side;    // the start is e3 with the sign of this
    T length;  // of the line
    T height;  // length + |z|: how far line + length * start goes along the start

    // Half the squared length of the middle line between the two.
    SWIVEL_INLINE constexpr T middle_half2() const { return length * height; }
};
template <class T>
SWIVEL_INLINE constexpr FrameStart<T> frame_start(const Vector<T>& line, const T& length)
{
    const T side = line.template at<kE3>();
    return {side, length, length + abs(side)};
}

template <class T>
struct FrameRotor {
    Rotor<T> from_start;  // carries the start to the line and e1 to the normal; of any length
    T twist_len2;         // the squared length of its twist
};

// per_length2: about 1 / length^2 of the line; it keeps the numbers in range, and cancels with the rotor's length.
// normal: orthogonal to the line up to rounding, of length normal_length, not zero.
template <class T>
SWIVEL_INLINE constexpr FrameRotor<T> frame_from_start(const Vector<T>& line, const FrameStart<T>& from,
                                                       const T& per_length2, const Vector<T>& normal,
                                                       const T& normal_length)
{
    // Steps 3 and 4: the middle line between the start and the line, here of squared length 2 length height.
    const T start = from.side, height = from.height;
    const Vector<T> middle = part<blades(kE1, kE2)>(line) + copysign(height, start) * unit<T, kE3>();

    // Step 5: before the turn by pi about the middle line, the normal is n' = 2 (n.m) m / |m|^2 - n. It lies in the
    // plane of e1 and e2: n' ~ c e1 + s e2. Here everything is multiplied by height per_length2.
    const Vector<T> n = per_length2 * normal;
    const T along = flip_sign(n.template at<kE3>(), start);  // n.m / length, as n is orthogonal to the line
    const T c = along * line.template at<kE1>() - height * n.template at<kE1>();
    const T s = along * line.template at<kE2>() - height * n.template at<kE2>();
    const T spread = (per_length2 * normal_length) * height;  // sqrt(c^2 + s^2), at hand before they are

    // Half the turn from e1 to n', along spread + c and s k, or for obtuse turns along s and (spread - c) k.
    const T large = spread + abs(c);
    const Mask<T> obtuse = c < T(0);
    const auto twist = select(obtuse, s, large) * unit<T, kScalar>() + select(obtuse, large, s) * unit<T, kK>();

    return {central_line(middle) * twist, large * large + s * s};
}

// A rotor from the start, as a rotor from e3.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> from_e3(const FrameStart<T>& start, const Rotor<T>& from_start)
{
    return select(copysign(T(1), start.side) < T(0), times_blade<kI>(from_start), from_start);
}

// For a line and a normal of unit length: the rotor that carries e3 to the line and e1 to the normal. It is 1.4 to 9
// long.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> frame_along(const Vector<T>& line, const Vector<T>& normal)
{
    const FrameStart<T> start = frame_start(line, T(1));
    return from_e3(start, frame_from_start(line, start, T(1), normal, T(1)).from_start);
}

// Steps 3 to 5 for an arm: the unit rotor that carries e3 to the upper arm and e1 to the hinge. lift: the arm's pose in
// the line's frame.
template <class T, class Lift>
SWIVEL_INLINE constexpr Rotor<T> lifted(const Vector<T>& line, const Vector<T>& normal, const Lift& lift)
{
    return normalise(frame_along(line, normal) * lift);
}

// The rotor of unit length that carries e3 to the line and e1 to a normal orthogonal to it, both of any length. length:
// of the line. per_length2: about 1 / length^2.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> unit_frame(const Vector<T>& line, const T& length, const T& per_length2,
                                            const Vector<T>& normal)
{
    const FrameStart<T> start = frame_start(line, length);
    const FrameRotor<T> frame = frame_from_start(line, start, per_length2, normal, sqrt(len2(normal)));
    const T half2 = start.middle_half2() * frame.twist_len2;
    return from_e3(start, (T(1) / sqrt(half2 + half2)) * frame.from_start);
}
template <class T>
SWIVEL_INLINE constexpr Rotor<T> frame_rotor(const Vector<T>& line, const Vector<T>& normal)
{
    const T length2 = len2(line);
    return unit_frame(line, sqrt(length2), per_power_of_two(length2), normal);
}

}  // namespace swivel::inline SWIVEL_ISA

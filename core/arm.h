// SPDX-License-Identifier: MIT
//
// The inputs and results of an arm, in the arm frame. The shoulder is at the origin. At rest both bones lie along +e3
// and the hinge along e1. Flexion carries the forearm towards +e2.
#pragma once

#include "core/conformal.h"
#include "include/swivel/swivel.h"

namespace swivel {

inline namespace SWIVEL_ISA {

// Vectors are no longer than kHuge; a shorter one than kTiny counts as zero.
inline constexpr double kTiny = 1e-15, kTiny2 = 1e-30, kHuge = 1e15, kHuge2 = 1e30;
// For plain arms, poles, squared wrists and twice the shorter bones lie between kPlainMin and kPlainMax. The longer
// bones lie below kPlainMax. Then half2 in solve_arm.h, the product of all squared lengths, stays a normal float. With
// wrists w, poles p and distances d, half2 is a quarter to one times (d/L2)^2 w^2 (p sin)^2. It is at least 0.25 1e-13
// (1e-9 1e-3)^2, because kMinLift bounds (d/L2)^2 w^2. It is at most 5e15 kPlainMax^3, because the digits of bones
// allow d/L2 up to 3.4e7. docs/mathematics.md proves that no operation of a plain arm overflows.
inline constexpr double kPlainMin = 1e-9, kPlainMax = 3.5e7, kMinLift = 1e-13;
// The least sine of a pole's angle to the target's line. A closer pole does not say where the elbow goes, because its
// digits are noise.
inline constexpr double kPoleOff = 1e-3;
// In arm lengths.
// - kSwallowed: a shorter bone is lost in the digits of the other.
// - kNearest: no wrist comes nearer to the shoulder.
inline constexpr double kSwallowed = 1e-7, kNearest = 1e-9;

template <class T>
struct ArmGoal {
    Vector<T> wrist;  // target, relative to the shoulder
    Vector<T> pole;   // the elbow's side of the axis; only its direction counts
    T upper, fore;    // bone lengths
};

template <class T>
struct ArmPose {
    Rotor<T> shoulder;     // carries e3 to the upper arm and e1 to the swivel plane's normal
    T cos_half, sin_half;  // of the flexion; both >= 0
    Word<T> flags;
    Mask<T> valid;  // false: bad input, the arm is at rest
};

// The elbow's rotor: flexion turns the forearm about -e1.
template <class T>
SWIVEL_INLINE constexpr Mv<T, blades(kScalar, kI)> elbow_rotor(const ArmPose<T>& pose)
{
    return pose.cos_half * unit<T, kScalar>() - pose.sin_half * unit<T, kI>();
}

template <class T>
SWIVEL_INLINE constexpr Mask<T> is_length(const T& x)
{
    return ((x >= T(kTiny)) & (x <= T(kHuge))) | (x == T(0));
}

template <class T>
SWIVEL_INLINE constexpr Mask<T> is_within(const T& x, double min, double max)
{
    return (x >= T(min)) & (x <= T(max));
}
// A rotor may have any length in 1e-9..1e9. Its square times a scale is then a normal float.
template <class T>
SWIVEL_INLINE constexpr Mask<T> is_orientation(const Rotor<T>& q)
{
    return is_within(len2(q), 1e-18, 1e18);
}

// Forward kinematics, for rotors of unit length: wrist = q_s (L1 e3 + q_e L2 e3 ~q_e) ~q_s.
template <class T>
SWIVEL_INLINE constexpr Vector<T> wrist_of(const ArmPose<T>& pose, const T& upper, const T& fore)
{
    const auto q_e = elbow_rotor(pose);
    const auto forearm = part<blades(kE2, kE3)>(q_e * (fore * unit<T, kE3>()) * ~q_e);
    return sandwich(pose.shoulder, vector(T(0), forearm.template at<kE2>(), upper + forearm.template at<kE3>()));
}

}  // namespace SWIVEL_ISA
}  // namespace swivel

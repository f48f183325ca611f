// SPDX-License-Identifier: MIT
//
// A solve as a correction of the incoming pose. The arm's formulas give each bone a frame: e3 along the bone, e1 the
// swivel plane's normal. The incoming bones get such frames, too. A joint turns by the rotation from the incoming frame
// to the solved one. So the bones go where the solver puts them, and a joint keeps what the solver ignores: a forearm's
// roll, an elbow that is no pure hinge. An untouched goal gives back the incoming pose.
//
// All inputs are in one space. Bones may have any length. A bone without a length lies along the other one, as in the
// solver.
#pragma once

#include "core/frame_rotor.h"
#include "core/wish.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct BoneLines {
    Vector<T> upper, fore;  // unit: from shoulder to elbow and from there to the wrist
    T upper_length, fore_length;
};
template <class T>
SWIVEL_INLINE constexpr BoneLines<T> bone_lines(const Vector<T>& upper, const Vector<T>& fore)
{
    const T upper2 = len2(upper), fore2 = len2(fore);
    const Mask<T> no_upper = upper2 < T(kTiny2), no_fore = fore2 < T(kTiny2);
    const T upper_length = sqrt(upper2), fore_length = sqrt(fore2);
    const Vector<T> e3 = vector(T(0), T(0), T(1));
    const Vector<T> upper_line = select(no_upper, e3, (T(1) / select(no_upper, T(1), upper_length)) * upper),
                    fore_line = select(no_fore, upper_line, (T(1) / select(no_fore, T(1), fore_length)) * fore);
    return {select(no_upper, fore_line, upper_line), fore_line, upper_length, fore_length};
}

// Normals of the plane that the bones lie in.
template <class T>
struct BendNormals {
    // The bones' own; for straight bones the hinge. It flips when the bend changes sides. So use it only where the
    // elbow stays as it comes, with the same normal before and after.
    Vector<T> own;
    // Small changes of the bones turn this one little. It is the hinge while the bend is noise, beyond that the bones'
    // own normal on the hinge's side, with a smooth blend between. It has any length. A bend against the hinge is
    // treated as a bend with it.
    Vector<T> steady;
    T sine;  // of the bend
};
// The sines of the bend below which it is noise, and above which the bones tell their plane: about 3 and 10 degrees.
// Knees and elbows that clips hold straight bend by up to some 3 degrees, to any side.
inline constexpr double kBendUnknown = 0.05, kBendKnown = 0.17;
// hinge: of the elbow, unit and along neither bone. Turning about its opposite bends the limb.
template <class T>
SWIVEL_INLINE constexpr BendNormals<T> bend_normals(const BoneLines<T>& bones, const Vector<T>& hinge)
{
    const Vector<T> normal = cross(bones.fore, bones.upper);
    const T sine2 = len2(normal);
    const Mask<T> straight = sine2 < T(kTiny2);
    const T per_sine = T(1) / sqrt(select(straight, T(1), sine2)), sine = per_sine * sine2;
    const Vector<T> own = select(straight, hinge, per_sine * normal);
    const T share = lo(hi((sine - T(kBendUnknown)) * T(1 / (kBendKnown - kBendUnknown)), T(0)), T(1));
    const T weight = share * share * (T(3) - T(2) * share);
    const T side = copysign(T(1), scalar_product(own, hinge));
    return {own, hinge + weight * (side * own - hinge), sine};
}

// The frames of both bones.
template <class T>
struct BoneFrames {
    Rotor<T> upper, fore;
};
template <class T>
SWIVEL_INLINE constexpr Rotor<T> bone_frame(const Vector<T>& line, const Vector<T>& normal)
{
    return unit_frame(line, T(1), T(1), across(across(normal, line), line));
}
// The same for a normal of unit length that is orthogonal to the line but for rounding.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> own_frame(const Vector<T>& line, const Vector<T>& normal)
{
    return normalise(frame_along(line, across(normal, line)));
}
template <class T>
SWIVEL_INLINE constexpr BoneFrames<T> bone_frames(const BoneLines<T>& bones, const Vector<T>& normal)
{
    return {bone_frame(bones.upper, normal), bone_frame(bones.fore, normal)};
}
// The elbow's hinge between the bones' own frames, from the cosine and sine of the bend.
template <class T>
SWIVEL_INLINE constexpr Hinge<T> own_hinge(const BoneLines<T>& bones, const T& sine)
{
    const T cosine = scalar_product(bones.upper, bones.fore), root = sqrt(T(2) * (T(1) + abs(cosine)));
    const T large = T(0.5) * root, small = sine / root;
    const Mask<T> obtuse = cosine < T(0);
    return hinge(select(obtuse, small, large), -select(obtuse, large, small));
}

}  // namespace swivel::inline SWIVEL_ISA

// SPDX-License-Identifier: MIT
//
// A solve as a correction of the incoming pose. The arm's own formulas give each bone a frame: e3 along the bone, e1
// the swivel plane's normal. Such a frame is laid into the incoming bones, too. A joint turns by what carries the
// incoming frame to the solved one. So the bones go where the solver puts them, and a joint keeps whatever the solver
// does not know: the roll of a forearm, an elbow that is no pure hinge. An untouched goal gives back the incoming pose.
//
// All of it is in one space, whichever the caller takes. Bones may have any length. A bone without a length lies along
// the other one, as the solver has it.
#pragma once

#include "core/frame_rotor.h"
#include "core/wish.h"

namespace swivel::inline SWIVEL_ISA {

template <class T>
struct IncomingBones {
    Vector<T> upper, fore;  // from shoulder to elbow and from there to the wrist
    Vector<T> hinge;        // of the elbow, unit and along neither bone: a turn about its opposite bends the limb
};

// The sines of the bend below which it is noise, and above which the bones tell their plane: about 3 and 10 degrees.
// Knees and elbows that clips hold straight bend by up to some 3 degrees, to any side.
inline constexpr double kBendUnknown = 0.05, kBendKnown = 0.17;

// The normal of the plane that the bones lie in; of straight bones the hinge. It flips with a bend that changes
// sides, so use it only where the same normal serves before and after: where the elbow stays as it comes.
template <class T>
SWIVEL_INLINE constexpr Vector<T> own_normal(const IncomingBones<T>& bones)
{
    const Vector<T> normal = cross(scaled(bones.fore), scaled(bones.upper));
    const T normal2 = len2(normal);
    const Mask<T> straight = normal2 < T(kTiny2);
    return select(straight, bones.hinge, (T(1) / sqrt(select(straight, T(1), normal2))) * normal);
}
// A normal that no small change of the bones turns far: the hinge while the bend is noise, then the bones' own normal
// on the hinge's side, and between both a smooth blend. It has any length. A bend against the hinge comes out as one
// with it.
template <class T>
SWIVEL_INLINE constexpr Vector<T> steady_normal(const IncomingBones<T>& bones)
{
    const Vector<T> upper = scaled(bones.upper), fore = scaled(bones.fore), normal = cross(fore, upper);
    const T size2 = len2(upper) * len2(fore), normal2 = len2(normal);
    const Mask<T> unknown = normal2 <= T(kBendUnknown * kBendUnknown) * size2;
    const T per_length = T(1) / sqrt(select(unknown, T(1), normal2));
    const T sine = per_length * normal2 / sqrt(select(unknown, T(1), size2));
    const T share = lo((sine - T(kBendUnknown)) * T(1 / (kBendKnown - kBendUnknown)), T(1));
    const T weight = share * share * (T(3) - T(2) * share);
    const Vector<T> own = flip_sign(per_length, scalar_product(normal, bones.hinge)) * normal;
    return select(unknown, bones.hinge, bones.hinge + weight * (own - bones.hinge));
}

// The frames of both bones.
template <class T>
struct BoneFrames {
    Rotor<T> upper, fore;
};
template <class T>
SWIVEL_INLINE constexpr Rotor<T> bone_frame(const Vector<T>& bone, const Vector<T>& normal)
{
    const Vector<T> line = normalise(bone);
    return frame_rotor(line, across(across(normal, line), line));
}
template <class T>
SWIVEL_INLINE constexpr BoneFrames<T> bone_frames(const IncomingBones<T>& bones, const Vector<T>& normal)
{
    const Mask<T> no_upper = len2(bones.upper) < T(kTiny2), no_fore = len2(bones.fore) < T(kTiny2);
    const Vector<T> upper = select(no_upper & no_fore, vector(T(0), T(0), T(1)), bones.upper);
    return {bone_frame(select(no_upper & !no_fore, bones.fore, upper), normal),
            bone_frame(select(no_fore, upper, bones.fore), normal)};
}

// What an incoming rotation becomes.
template <class T>
SWIVEL_INLINE constexpr Rotor<T> corrected(const Rotor<T>& solved, const Rotor<T>& was, const Rotor<T>& incoming)
{
    return normalise(solved * ~was * incoming);
}

}  // namespace swivel::inline SWIVEL_ISA

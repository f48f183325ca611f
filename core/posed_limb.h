// SPDX-License-Identifier: MIT
//
// A limb of a body's pose, prepared for the arm's formulas: its bones, and the rotations between the formulas' bone
// frames and its joints. These replace a binding's constants, so that a solved arm goes back to the joints as a
// correction of the incoming pose (correction.h).
#pragma once

#include "core/correction.h"
#include "core/joint_frame.h"

namespace swivel::inline SWIVEL_ISA {

// The normal in a limb's incoming frames. chosen: its own or the steady one, lane by lane.
enum class BendNormal { own, chosen };

// The part of a limb's joints that its bones need, in one space.
template <class T>
struct PosedLimb {
    Rotor<T> parent, shoulder;
    Vector<T> shoulder_place, elbow_place, wrist_place;
};

template <class T>
struct SeenLimb {
    Rotor<T> arm;          // the arm frame, in the space of the joints
    Turn<T> back;          // into the arm frame
    BoneLines<T> bones;    // in the arm frame
    BoneFrames<T> model;   // the same
    BoneFrames<T> frames;  // in the space of the joints
};

// The hinge, or another axis where that lies along the bone.
template <class T>
SWIVEL_INLINE constexpr Vector<T> hinge_across(const Vector<T>& hinge, const Vector<T>& bone)
{
    const Mask<T> off = len2(across(hinge, bone)) > T(kPoleOff * kPoleOff);
    const Mask<T> is_e1 = abs(hinge.template at<kE1>()) > T(0.8);
    return select(off, hinge, select(is_e1, vector(T(0), T(1), T(0)), vector(T(1), T(0), T(0))));
}

// parent_from_arm: as in a binding. hinge: in the shoulder joint's frame. stays: for BendNormal::chosen, the lanes that
// take the own normal.
template <BendNormal which, class T>
SWIVEL_INLINE constexpr SeenLimb<T> seen_limb(const PosedLimb<T>& posed, const Rotor<T>& parent_from_arm,
                                              const Vector<T>& hinge, const Mask<T>& stays)
{
    const Rotor<T> arm = posed.parent * parent_from_arm;
    const Turn<T> back = turn_by(~arm);
    const BoneLines<T> bones =
        bone_lines(back(posed.elbow_place - posed.shoulder_place), back(posed.wrist_place - posed.elbow_place));
    const BendNormals<T> normals = bend_normals(bones, hinge_across(back(turned(posed.shoulder, hinge)), bones.upper));
    if constexpr (which == BendNormal::own) {
        const Rotor<T> upper = own_frame(bones.upper, normals.own), frame = arm * upper;
        const Hinge<T> elbow = own_hinge(bones, normals.sine);
        return {arm, back, bones, {upper, upper * elbow}, {frame, frame * elbow}};
    } else {
        const BoneFrames<T> model = bone_frames(bones, select(stays, normals.own, normals.steady));
        return {arm, back, bones, model, {arm * model.upper, arm * model.fore}};
    }
}

}  // namespace swivel::inline SWIVEL_ISA

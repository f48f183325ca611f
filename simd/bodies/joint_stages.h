// SPDX-License-Identifier: MIT
//
// Stages write a body's joints: local rotations in place of the incoming ones, and the axes of matrices.
#pragma once

#include "core/joint_frame.h"
#include "simd/limbs/goal_stages.h"

namespace swivel::inline SWIVEL_ISA {

// How much of a body's corrections counts: a share, in lanes that are good.
template <class S>
SWIVEL_INLINE typename S::T body_weight(const S& s)
{
    using T = typename S::T;
    return s.strip.run.strip.pose->weight.data ? s.body.get(kWeightRow) : T(1);
}

// Turns the axes of a joint's matrix; those of lanes that are not valid from the axes of no rotation.
template <class S>
SWIVEL_INLINE void turn_axes(const S& s, std::uint32_t joint, const Rotor<typename S::T>& turn,
                             const Mask<typename S::T>& valid, const Mask<typename S::T>& kept)
{
    using T = typename S::T;
    const bool by_rows = s.strip.run.strip.pose->form == SWIVEL_MATRIX_ROWS;
    const std::uint32_t first = joint + kAxesRow;
    for (std::uint32_t n = 0; n < 3; ++n) {
        const auto row = [&](std::uint32_t c)
                             SWIVEL_INLINE_LAMBDA { return first + (by_rows ? 3 * c + n : 3 * n + c); };
        const Vector<T> incoming = vector(s.body.get(row(0)), s.body.get(row(1)), s.body.get(row(2)));
        const Vector<T> none = vector(T(n == 0), T(n == 1), T(n == 2));
        const Vector<T> axis = select(kept, incoming, turned(turn, select(valid, incoming, none)));
        s.body.set(row(0), axis.template at<kE1>());
        s.body.set(row(1), axis.template at<kE2>());
        s.body.set(row(2), axis.template at<kE3>());
    }
}
// Gives a joint its local rotation: what was solved, or a rest rotation in lanes that are not valid. In kept lanes the
// incoming one stays.
template <class S>
SWIVEL_INLINE void set_local(const S& s, std::uint32_t joint, const Rotor<typename S::T>& solved,
                             const Rotor<typename S::T>& rest, const Mask<typename S::T>& valid,
                             const Mask<typename S::T>& kept)
{
    using T = typename S::T;
    const swivel_pose& pose = *s.strip.run.strip.pose;
    const Rotor<T> incoming = s.body.rotor(joint + kLocalRow), q = select(valid, solved, rest);
    const T side = select(valid, scalar_product(~incoming, q), T(1));
    if (pose.form != SWIVEL_ROTATIONS && pose.space == SWIVEL_LOCAL)
        turn_axes(s, joint, unit_rotation(select(valid, q * ~incoming, q)), valid, kept);
    s.body.set(joint + kLocalRow, select(kept, incoming, flip_sign(q, side)));
}

}  // namespace swivel::inline SWIVEL_ISA

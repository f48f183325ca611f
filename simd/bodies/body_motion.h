// SPDX-License-Identifier: MIT
//
// How what was solved moves the joints of bodies: those that a limb turns, and all below them. Only body_kernels.cpp
// includes this.
#pragma once

#include "core/limb_goal.h"
#include "simd/bodies/body_values.h"

namespace swivel::inline SWIVEL_ISA {

namespace {

// How a joint moves, in the body's space: it turns about the root's place, and is shifted.
struct Motion {
    Rotor<T> turn;
    Vector<T> shift;

    // row: that of the joint that moves it, or 0.
    SWIVEL_INLINE static Motion at(const BodyBlock& block, std::uint32_t row, std::uint32_t lane)
    {
        if (row == 0) return {one<T>(), vector(T(0), T(0), T(0))};
        const RowView<T> rows = rows_of(block, row, lane);
        return {rows.rotor(kMotionRow), rows.vector(kShiftRow)};
    }
    // The motion of a joint of the skeleton, from where it comes.
    SWIVEL_INLINE static Motion at(const BodyBlock& block, const MovedJoint& joint, std::uint32_t lane)
    {
        const Motion motion = at(block, joint.mover, lane);
        if (joint.look == 0) return motion;
        const Motion look = at(block, joint.look, lane);
        return {motion.turn * look.turn, motion(look.shift)};
    }
    SWIVEL_INLINE Vector<T> operator()(const Vector<T>& place) const { return turned(turn, place) + shift; }
    // Where nothing moves, so the incoming bits stay.
    SWIVEL_INLINE Mask<T> is_none() const { return (len2(vector_part(turn)) == T(0)) & (len2(shift) == T(0)); }
};

// From the world to the body's space.
struct IntoBody {
    Rotor<T> back;
    T shrink;

    SWIVEL_INLINE IntoBody(const BodyBlock& block, std::uint32_t lane)
        : back(~rows_of(block, kRootJoint, lane).rotor(kTurnRow)),
          shrink(T(1) / rows_of(block, kRootJoint, lane).get(kScaleRow))
    {
    }
    SWIVEL_INLINE Rotor<T> rotation(const RowView<T>& joint) const { return back * joint.rotor(kTurnRow); }
    SWIVEL_INLINE Vector<T> offset(const Vector<T>& v) const { return turned(back, shrink * v); }
    SWIVEL_INLINE Vector<T> place(const RowView<T>& joint) const { return offset(joint.vector(kPlaceRow)); }
};

SWIVEL_FLATTEN void move(const BodyBlock& block, const GroupJoints& joints)
{
    const Motion none = Motion::at(block, 0, 0);
    for_each_slice(block, [&](std::uint32_t lane) SWIVEL_INLINE_LAMBDA {
        const IntoBody body(block, lane);
        const Mask<T> kept = rows_of(block, 0, lane).get(kKeptRow) > T(0.5);
        for (std::uint32_t n = 0; n < joints.turned_count; ++n) {
            const TurnedJoint& joint = joints.turned[n];
            const Motion above = Motion::at(block, joint.above, lane);
            const RowView<T> at = rows_of(block, joint.row, lane);
            const Rotor<T> parent = body.rotation(rows_of(block, joint.parent, lane)), incoming = body.rotation(at);
            const Vector<T> place = body.place(at);
            const Rotor<T> solved = unit_rotation(above.turn * parent * at.rotor(kLocalRow));
            const Rotor<T> turn = select(kept, none.turn, hemisphere(unit_rotation(solved * ~incoming)));
            at.set(kMotionRow, turn);
            at.set(kShiftRow, select(kept, none.shift, above(place) - turned(turn, place)));
        }
    });
}

// These take one joint of a pose in the body's space to where it moves.
SWIVEL_FLATTEN [[gnu::noinline]] void carry_rotation(const swivel_pose& pose, const BodyBlock& block,
                                                     const MovedJoint& joint)
{
    const Bodies rotations(block, pose.rotations);
    const std::size_t at = offset_of(pose.rotations, joint.skeleton_joint);
    for_each_slice(block, [&](std::uint32_t lane) SWIVEL_INLINE_LAMBDA {
        const Motion motion = Motion::at(block, joint, lane);
        const Rotor<T> incoming = rotor_of(load_values<T, 4>(rotations.lane + lane, at));
        rows_of(block, 0, lane)
            .set(kOutTurnRow, select(motion.is_none(), incoming, with_one_nan(motion.turn * incoming)));
    });
}
SWIVEL_FLATTEN [[gnu::noinline]] void carry_translation(const swivel_pose& pose, const BodyBlock& block,
                                                        const MovedJoint& joint)
{
    const Bodies translations(block, pose.translations);
    const std::size_t at = offset_of(pose.translations, joint.skeleton_joint);
    for_each_slice(block, [&](std::uint32_t lane) SWIVEL_INLINE_LAMBDA {
        const Motion motion = Motion::at(block, joint, lane);
        const Vector<T> incoming = vector_of(load_values<T, 3>(translations.lane + lane, at));
        rows_of(block, 0, lane).set(kOutPlaceRow, select(motion.is_none(), incoming, with_one_nan(motion(incoming))));
    });
}
template <swivel_pose_form Form>
SWIVEL_FLATTEN [[gnu::noinline]] void carry_matrix(const swivel_pose& pose, const BodyBlock& block,
                                                   const MovedJoint& joint)
{
    constexpr bool by_rows = Form == SWIVEL_MATRIX_ROWS;
    const Bodies matrices(block, pose.rotations);
    const std::size_t at = offset_of(pose.rotations, joint.skeleton_joint);
    for_each_slice(block, [&](std::uint32_t lane) SWIVEL_INLINE_LAMBDA {
        const Motion motion = Motion::at(block, joint, lane);
        const MatrixParts m = read_parts<Form>(matrices.lane + lane, at);
        const RowView<T> out = rows_of(block, 0, lane);
        for (std::uint32_t c = 0; c < 4; ++c) {
            const Vector<T> incoming = c < 3 ? axis_of<Form>(m, c) : vector_of(m.part[3]);
            const Vector<T> moved = select(motion.is_none(), incoming,
                                           with_one_nan(c < 3 ? turned(motion.turn, incoming) : motion(incoming)));
            const std::uint32_t first = by_rows ? c : 3 * c, step = by_rows ? 4 : 1;
            out.set(first, moved.template at<kE1>());
            out.set(first + step, moved.template at<kE2>());
            out.set(first + 2 * step, moved.template at<kE3>());
        }
    });
}
void carry(const BodyPlan& plan, const BodyBlock& block, const MovedJoint& joint)
{
    const swivel_pose& pose = *plan.pose;
    switch (pose.form) {
        case SWIVEL_MATRIX_ROWS:
            return carry_matrix<SWIVEL_MATRIX_ROWS>(pose, block, joint);
        case SWIVEL_MATRIX_COLUMNS:
            return carry_matrix<SWIVEL_MATRIX_COLUMNS>(pose, block, joint);
        case SWIVEL_MATRIX_COLUMNS3:
            return carry_matrix<SWIVEL_MATRIX_COLUMNS3>(pose, block, joint);
        case SWIVEL_ROTATIONS:
            carry_rotation(pose, block, joint);
            if (pose.translations.data) carry_translation(pose, block, joint);
    }
}

// Positions count from the root before its shift, as all that a solve tells does. The pose's weight counts for the
// shift as it does for turns.
SWIVEL_FLATTEN void locate(const BodyPlan& plan, const BodyBlock& block, const BodyJoint& joint)
{
    for_each_slice(block, [&](std::uint32_t lane) SWIVEL_INLINE_LAMBDA {
        const IntoBody body(block, lane);
        const Motion motion = Motion::at(block, joint.mover, lane);
        const RowView<T> at = rows_of(block, joint.row, lane), out = rows_of(block, 0, lane);
        const T given = plan.pose->weight.data ? out.get(kWeightRow) : T(1),
                weight = select(is_share(given), given, T(0));
        const Vector<T> place = motion(body.place(at)), shifted = weight * out.vector(kShiftedRow);
        out.set(kOutTurnRow, with_one_nan(hemisphere(motion.turn * body.rotation(at))));
        // Adding a shift of 0 would turn -0 to +0.
        out.set(kOutPlaceRow, with_one_nan(select(len2(shifted) == T(0), place, place + body.offset(shifted))));
    });
}

}  // namespace

}  // namespace swivel::inline SWIVEL_ISA

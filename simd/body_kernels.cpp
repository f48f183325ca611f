// SPDX-License-Identifier: MIT
//
// Forward kinematics of bodies, compiled once for each instruction set: from the caller's poses to rows of world
// frames, and how what was solved moves the joints.
#include <array>
#include <cstring>

#include "core/joint_frame.h"
#include "core/matrix_frame.h"
#include "simd/kernels.h"
#include "simd/lanes.h"
#include "simd/values.h"

namespace swivel::inline SWIVEL_ISA {

namespace {

using T = typename KernelNumber<SWIVEL_ARCH, 1>::type;

// The rows of one joint, from the lanes of a slice on.
struct JointRows {
    float* rows;

    SWIVEL_INLINE T get(std::uint32_t row) const
    {
        return load_lanes<T>([&](std::size_t n) SWIVEL_INLINE_LAMBDA { return rows + row * kLanes + n; });
    }
    SWIVEL_INLINE void set(std::uint32_t row, const T& value) const
    {
        store_lanes([&](std::size_t n) SWIVEL_INLINE_LAMBDA { return rows + row * kLanes + n; }, value);
    }
    SWIVEL_INLINE void set_vector(std::uint32_t row, const Vector<T>& v) const
    {
        set(row, v.template at<kE1>());
        set(row + 1, v.template at<kE2>());
        set(row + 2, v.template at<kE3>());
    }
    SWIVEL_INLINE void set_rotor(std::uint32_t row, const Rotor<T>& q) const
    {
        set(row, q.template at<kI>());
        set(row + 1, q.template at<kJ>());
        set(row + 2, q.template at<kK>());
        set(row + 3, q.template at<kScalar>());
    }
    SWIVEL_INLINE Vector<T> get_vector(std::uint32_t row) const { return vector(get(row), get(row + 1), get(row + 2)); }
    SWIVEL_INLINE Rotor<T> get_rotor(std::uint32_t row) const
    {
        return rotor(get(row), get(row + 1), get(row + 2), get(row + 3));
    }
    SWIVEL_INLINE JointFrame<T> frame() const { return {get_rotor(kTurnRow), get_vector(kPlaceRow), get(kScaleRow)}; }
    SWIVEL_INLINE void set_frame(const JointFrame<T>& frame) const
    {
        set_rotor(kTurnRow, frame.rotation);
        set_vector(kPlaceRow, frame.place);
        set(kScaleRow, frame.scale);
    }
};

SWIVEL_INLINE Vector<T> vector_of(const std::array<T, 3>& v) { return vector(v[0], v[1], v[2]); }
SWIVEL_INLINE Rotor<T> rotor_of(const std::array<T, 4>& q) { return rotor(q[0], q[1], q[2], q[3]); }

// Where a block's bodies have their values. Lanes of bodies that are not there take those of one that is.
struct Bodies {
    const char* lane[kLanes];

    Bodies() = default;
    Bodies(const BodyBlock& block, const void* data, std::size_t stride)
    {
        const auto any = static_cast<std::uint32_t>(__builtin_ctz(block.lanes));
        const char* each = static_cast<const char*>(data) + std::size_t{block.first} * stride;
        const char* const instead = each + any * stride;
        for (std::uint32_t n = 0; n < kLanes; ++n, each += stride) lane[n] = block.lanes >> n & 1 ? each : instead;
    }
    Bodies(const BodyBlock& block, const swivel_in& values) : Bodies(block, values.data, values.stride) {}
    Bodies(const BodyBlock& block, const swivel_joint_values& values) : Bodies(block, values.data, values.body_stride)
    {
    }
};
SWIVEL_INLINE JointRows rows_of(const BodyBlock& block, std::uint32_t row, std::uint32_t lane)
{
    return {block.rows + row * kLanes + lane};
}

// What a pose says of a joint, relative to its parent or to the root.
struct GivenJoint {
    Rotor<T> rotation;
    Vector<T> translation;
    T scale;
};

// A matrix in the order of memory: rows without the translation, and that; or columns.
struct MatrixParts {
    std::array<T, 3> part[4];
};
template <swivel_pose_form Form>
SWIVEL_INLINE MatrixParts read_parts(LaneValues lane, std::size_t at)
{
    MatrixParts m;
    if constexpr (Form == SWIVEL_MATRIX_ROWS) {
        for (std::size_t r = 0; r < 3; ++r) {
            const std::array<T, 4> row = load_values<T, 4>(lane, at + entry_offset(Form, r, 0));
            m.part[r] = {row[0], row[1], row[2]};
            m.part[3][r] = row[3];
        }
    } else {
        for (std::size_t c = 0; c < 4; ++c) m.part[c] = load_values<T, 3>(lane, at + entry_offset(Form, 0, c));
    }
    return m;
}
template <swivel_pose_form Form>
SWIVEL_INLINE Vector<T> axis_of(const MatrixParts& m, std::size_t n)
{
    return Form == SWIVEL_MATRIX_ROWS ? vector(m.part[0][n], m.part[1][n], m.part[2][n]) : vector_of(m.part[n]);
}

// The joints of a block. Form, Translates, Scales: what the pose has, as constants.
template <swivel_pose_form Form, bool Translates, bool Scales>
struct PoseReader {
    const Bodies rotations, translations, scales;
    const swivel_pose& pose;

    PoseReader(const BodyBlock& block, const swivel_pose& of)
        : rotations(block, of.rotations),
          translations(Translates ? Bodies(block, of.translations) : Bodies()),
          scales(Scales ? Bodies(block, of.scales) : Bodies()),
          pose(of)
    {
    }
    SWIVEL_INLINE GivenJoint read(const BodyJoint& joint, std::uint32_t lane, const JointRows& to) const
    {
        const std::size_t at = offset_of(pose.rotations, joint.skeleton_joint);
        if constexpr (Form != SWIVEL_ROTATIONS) {
            return read_matrix(rotations.lane + lane, at, joint.is_turned != 0, to);
        } else {
            const Rotor<T> rotation = rotor_of(load_values<T, 4>(rotations.lane + lane, at));
            if (joint.is_turned) to.set_rotor(kLocalRow, rotation);
            GivenJoint given{rotation,
                             vector(T(joint.translation[0]), T(joint.translation[1]), T(joint.translation[2])), T(1)};
            if constexpr (Translates)
                given.translation = vector_of(
                    load_values<T, 3>(translations.lane + lane, offset_of(pose.translations, joint.skeleton_joint)));
            if constexpr (Scales) {
                const std::array<T, 3> scale =
                    load_values<T, 3>(scales.lane + lane, offset_of(pose.scales, joint.skeleton_joint));
                given.scale = uniform_scale(scale[0], scale[1], scale[2]);
            }
            return given;
        }
    }

private:
    SWIVEL_INLINE static GivenJoint read_matrix(LaneValues lane, std::size_t at, bool keeps, const JointRows& to)
    {
        const MatrixParts m = read_parts<Form>(lane, at);
        const MatrixFrame<T> frame = matrix_frame(axis_of<Form>(m, 0), axis_of<Form>(m, 1), axis_of<Form>(m, 2));
        if (keeps) {
            to.set_rotor(kLocalRow, frame.rotation);
            for (std::uint32_t n = 0; n < 9; ++n) to.set(kAxesRow + n, m.part[n / 3][n % 3]);
        }
        return {frame.rotation, vector_of(m.part[3]), select(frame.valid, frame.scale, T(__builtin_nan("")))};
    }
};

// The root, which lies at the place that all others are from.
SWIVEL_FLATTEN [[gnu::noinline]] void read_root(const BodyPlan& plan, const BodyBlock& block)
{
    const Vector<T> none = vector(T(0), T(0), T(0));
    const swivel_pose& pose = *plan.pose;
    const auto at = [&](std::uint32_t row, std::uint32_t lane)
                        SWIVEL_INLINE_LAMBDA { return rows_of(block, row, lane); };
    for (std::uint32_t lane = 0; lane < kLanes; lane += lane_count<T>) {
        at(kRootJoint, lane).set_frame({one<T>(), none, T(1)});
        at(0, lane).set_vector(kRootRow, none);
    }
    if (pose.root_rotation.data) {
        const Bodies bodies(block, pose.root_rotation);
        for (std::uint32_t lane = 0; lane < kLanes; lane += lane_count<T>)
            at(kRootJoint, lane).set_rotor(kTurnRow, unit_rotation(rotor_of(load_values<T, 4>(bodies.lane + lane, 0))));
    }
    if (pose.root_position.data && !pose.root_is_double) {
        const Bodies bodies(block, pose.root_position);
        for (std::uint32_t lane = 0; lane < kLanes; lane += lane_count<T>)
            at(0, lane).set_vector(kRootRow, vector_of(load_values<T, 3>(bodies.lane + lane, 0)));
    }
    if (pose.root_scale.data) {
        const Bodies bodies(block, pose.root_scale);
        float* const scales = at(kRootJoint + kScaleRow, 0).rows;
        for (std::uint32_t n = 0; n < kLanes; ++n) std::memcpy(scales + n, bodies.lane[n], sizeof(float));
    }
}

// A joint of a pose in the body's space. Its place, where the pose has none, follows from the joint above. As along a
// chain, what is bad in a joint shows in all below it.
template <bool Translates>
SWIVEL_INLINE JointFrame<T> frame_in_body(const JointFrame<T>& root, const JointFrame<T>& above,
                                          const GivenJoint& given)
{
    JointFrame<T> frame = joint_frame(root, given.rotation, given.translation, given.scale);
    if constexpr (!Translates) frame.place = above.place + turned(above.rotation, above.scale * given.translation);
    const Mask<T> good = is_within(len2(above.rotation), 0.99, 1.01) & (len2(above.place) <= T(kHuge2));
    frame.scale = select(good & (above.scale == above.scale), frame.scale, T(__builtin_nan("")));
    return frame;
}

template <swivel_pose_form Form, bool Translates, bool Scales>
SWIVEL_FLATTEN [[gnu::noinline]] void read_joints(const BodyPlan& plan, const BodyBlock& block)
{
    const PoseReader<Form, Translates, Scales> reader(block, *plan.pose);
    const bool in_body = plan.pose->space == SWIVEL_IN_BODY;
    for (std::uint32_t n = 1; n < plan.joint_count; ++n) {
        const BodyJoint& joint = plan.joints[n];
        for (std::uint32_t lane = 0; lane < kLanes; lane += lane_count<T>) {
            const JointRows at = rows_of(block, joint.row, lane);
            const GivenJoint given = reader.read(joint, lane, at);
            const JointFrame<T> above = rows_of(block, joint.parent, lane).frame();
            if (!in_body) {
                at.set_frame(joint_frame(above, given.rotation, given.translation, given.scale));
                continue;
            }
            const JointFrame<T> frame =
                frame_in_body<Translates>(rows_of(block, kRootJoint, lane).frame(), above, given);
            at.set_frame(frame);
            if (joint.is_turned) at.set_rotor(kLocalRow, ~above.rotation * frame.rotation);
        }
    }
}

void forward(const BodyPlan& plan, const BodyBlock& block)
{
    read_root(plan, block);
    const swivel_pose& pose = *plan.pose;
    switch (pose.form) {
        case SWIVEL_MATRIX_ROWS:
            return read_joints<SWIVEL_MATRIX_ROWS, true, true>(plan, block);
        case SWIVEL_MATRIX_COLUMNS:
            return read_joints<SWIVEL_MATRIX_COLUMNS, true, true>(plan, block);
        case SWIVEL_MATRIX_COLUMNS3:
            return read_joints<SWIVEL_MATRIX_COLUMNS3, true, true>(plan, block);
        case SWIVEL_ROTATIONS:
            if (pose.translations.data)
                return pose.scales.data ? read_joints<SWIVEL_ROTATIONS, true, true>(plan, block)
                                        : read_joints<SWIVEL_ROTATIONS, true, false>(plan, block);
            return pose.scales.data ? read_joints<SWIVEL_ROTATIONS, false, true>(plan, block)
                                    : read_joints<SWIVEL_ROTATIONS, false, false>(plan, block);
    }
}

// How a joint moves, in the body's space: it turns about the root's place, and is shifted.
struct Motion {
    Rotor<T> turn;
    Vector<T> shift;

    // of: the row of the joint that moves it, or 0.
    SWIVEL_INLINE static Motion at(const BodyBlock& block, std::uint32_t of, std::uint32_t lane)
    {
        if (of == 0) return {one<T>(), vector(T(0), T(0), T(0))};
        const JointRows rows = rows_of(block, of, lane);
        return {rows.get_rotor(kMotionRow), rows.get_vector(kShiftRow)};
    }
    SWIVEL_INLINE Vector<T> operator()(const Vector<T>& place) const { return turned(turn, place) + shift; }
    // Where nothing moves, so the incoming bits stay.
    SWIVEL_INLINE Mask<T> is_none() const
    {
        const Vector<T> axis = vector(turn.template at<kI>(), turn.template at<kJ>(), turn.template at<kK>());
        return (len2(axis) == T(0)) & (len2(shift) == T(0));
    }
};

// From the world to the body's space.
struct IntoBody {
    Rotor<T> back;
    T shrink;

    SWIVEL_INLINE IntoBody(const BodyBlock& block, std::uint32_t lane)
        : back(~rows_of(block, kRootJoint, lane).get_rotor(kTurnRow)),
          shrink(T(1) / rows_of(block, kRootJoint, lane).get(kScaleRow))
    {
    }
    SWIVEL_INLINE Rotor<T> rotation(const JointRows& of) const { return back * of.get_rotor(kTurnRow); }
    SWIVEL_INLINE Vector<T> place(const JointRows& of) const { return turned(back, shrink * of.get_vector(kPlaceRow)); }
};

SWIVEL_FLATTEN void move(const BodyBlock& block, const BodyLimb& limb)
{
    const Motion none = Motion::at(block, 0, 0);
    for (std::uint32_t lane = 0; lane < kLanes; lane += lane_count<T>) {
        const IntoBody body(block, lane);
        const Mask<T> kept = rows_of(block, 0, lane).get(kKeptRow) > T(0.5);
        for (std::uint32_t n = 0; n < limb.turned_count; ++n) {
            const TurnedJoint& joint = limb.turned[n];
            const Motion above = Motion::at(block, joint.above, lane);
            const JointRows at = rows_of(block, joint.row, lane);
            const Rotor<T> parent = body.rotation(rows_of(block, joint.parent, lane)), was = body.rotation(at);
            const Vector<T> place = body.place(at);
            const Rotor<T> is = unit_rotation(above.turn * parent * at.get_rotor(kLocalRow));
            const Rotor<T> turn = select(kept, none.turn, hemisphere(is * ~was));
            at.set_rotor(kMotionRow, turn);
            at.set_vector(kShiftRow, select(kept, none.shift, above(place) - turned(turn, place)));
        }
    }
}

template <swivel_pose_form Form>
SWIVEL_INLINE void carry_matrix(const Motion& motion, LaneValues lane, std::size_t at, const JointRows& out)
{
    const MatrixParts m = read_parts<Form>(lane, at);
    const Mask<T> none = motion.is_none();
    for (std::uint32_t c = 0; c < 4; ++c) {
        const Vector<T> was = c < 3 ? axis_of<Form>(m, c) : vector_of(m.part[3]);
        const Vector<T> is = select(none, was, c < 3 ? turned(motion.turn, was) : motion(was));
        const std::uint32_t first = Form == SWIVEL_MATRIX_ROWS ? c : 3 * c, step = Form == SWIVEL_MATRIX_ROWS ? 4 : 1;
        out.set(first, is.template at<kE1>());
        out.set(first + step, is.template at<kE2>());
        out.set(first + 2 * step, is.template at<kE3>());
    }
}
SWIVEL_FLATTEN void carry(const BodyPlan& plan, const BodyBlock& block, const MovedJoint& joint)
{
    const swivel_pose& pose = *plan.pose;
    const Bodies rotations(block, pose.rotations);
    const std::size_t at = offset_of(pose.rotations, joint.skeleton_joint);
    const bool translates = pose.translations.data != nullptr;
    const Bodies translations = translates ? Bodies(block, pose.translations) : rotations;
    for (std::uint32_t lane = 0; lane < kLanes; lane += lane_count<T>) {
        const Motion motion = Motion::at(block, joint.mover, lane);
        const JointRows out = rows_of(block, 0, lane);
        const LaneValues from = rotations.lane + lane;
        if (pose.form == SWIVEL_MATRIX_ROWS) carry_matrix<SWIVEL_MATRIX_ROWS>(motion, from, at, out);
        if (pose.form == SWIVEL_MATRIX_COLUMNS) carry_matrix<SWIVEL_MATRIX_COLUMNS>(motion, from, at, out);
        if (pose.form == SWIVEL_MATRIX_COLUMNS3) carry_matrix<SWIVEL_MATRIX_COLUMNS3>(motion, from, at, out);
        if (pose.form != SWIVEL_ROTATIONS) continue;
        const Rotor<T> rotation = rotor_of(load_values<T, 4>(from, at));
        out.set_rotor(kOutTurnRow, select(motion.is_none(), rotation, motion.turn * rotation));
        if (!translates) continue;
        const Vector<T> place =
            vector_of(load_values<T, 3>(translations.lane + lane, offset_of(pose.translations, joint.skeleton_joint)));
        out.set_vector(kOutPlaceRow, select(motion.is_none(), place, motion(place)));
    }
}

SWIVEL_FLATTEN void place(const BodyBlock& block, const BodyJoint& joint)
{
    for (std::uint32_t lane = 0; lane < kLanes; lane += lane_count<T>) {
        const IntoBody body(block, lane);
        const Motion motion = Motion::at(block, joint.mover, lane);
        const JointRows at = rows_of(block, joint.row, lane), out = rows_of(block, 0, lane);
        out.set_rotor(kOutTurnRow, hemisphere(motion.turn * body.rotation(at)));
        out.set_vector(kOutPlaceRow, motion(body.place(at)));
    }
}

}  // namespace

extern const BodyKernels body_kernels;
const BodyKernels body_kernels{forward, move, carry, place};

}  // namespace swivel::inline SWIVEL_ISA

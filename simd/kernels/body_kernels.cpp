// SPDX-License-Identifier: MIT
//
// The kernels of bodies, compiled once for each instruction set: forward kinematics, from the caller's poses to rows of
// world frames, and how what was solved moves the joints.
#include <cstring>

#include "core/fit.h"
#include "core/matrix_frame.h"
#include "simd/bodies/body_motion.h"
#include "simd/bodies/body_values.h"

namespace swivel::inline SWIVEL_ISA {

namespace {

// The joints of a block as a pose gives them, each in its parent's frame or in the root's. Form, Translates, Scales:
// what the pose has, as constants.
template <swivel_pose_form Form, bool Translates, bool Scales>
struct PoseReader {
    const Bodies rotations, translations, scales;
    const swivel_pose& pose;

    PoseReader(const BodyBlock& block, const swivel_pose& given)
        : rotations(block, given.rotations),
          translations(Translates ? Bodies(block, given.translations) : Bodies()),
          scales(Scales ? Bodies(block, given.scales) : Bodies()),
          pose(given)
    {
    }
    SWIVEL_INLINE JointFrame<T> read(const BodyJoint& joint, std::uint32_t lane, const RowView<T>& to) const
    {
        const std::size_t at = offset_of(pose.rotations, joint.skeleton_joint);
        if constexpr (Form != SWIVEL_ROTATIONS) {
            return read_matrix(rotations.lane + lane, at, joint.is_turned != 0, to);
        } else {
            const Rotor<T> rotation = rotor_of(load_values<T, 4>(rotations.lane + lane, at));
            if (joint.is_turned) to.set(kLocalRow, rotation);
            JointFrame<T> given{
                rotation, vector(T(joint.translation[0]), T(joint.translation[1]), T(joint.translation[2])), T(1)};
            if constexpr (Translates)
                given.place = vector_of(
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
    SWIVEL_INLINE static JointFrame<T> read_matrix(LaneValues lane, std::size_t at, bool is_turned,
                                                   const RowView<T>& to)
    {
        const MatrixParts m = read_parts<Form>(lane, at);
        const MatrixFrame<T> frame = matrix_frame(axis_of<Form>(m, 0), axis_of<Form>(m, 1), axis_of<Form>(m, 2));
        if (is_turned) {
            to.set(kLocalRow, frame.rotation);
            for (std::uint32_t n = 0; n < 9; ++n) to.set(kAxesRow + n, m.part[n / 3][n % 3]);
        }
        return {frame.rotation, vector_of(m.part[3]), select(frame.valid, frame.scale, T(__builtin_nan("")))};
    }
};

// Fills a row of a block with a number of each body.
SWIVEL_INLINE void read_numbers(const BodyBlock& block, const swivel_in& values, std::uint32_t row)
{
    const Bodies bodies(block, values);
    for (std::uint32_t n = 0; n < kLanes; ++n)
        std::memcpy(block.rows + row * kLanes + n, bodies.lane[n], sizeof(float));
}

// The root, which lies at the place that all others are from.
SWIVEL_FLATTEN [[gnu::noinline]] void read_root(const BodyPlan& plan, const BodyBlock& block)
{
    const Vector<T> none = vector(T(0), T(0), T(0));
    const swivel_pose& pose = *plan.pose;
    const auto at = [&](std::uint32_t row, std::uint32_t lane)
                        SWIVEL_INLINE_LAMBDA { return rows_of(block, row, lane); };
    for_each_slice(block, [&](std::uint32_t lane) SWIVEL_INLINE_LAMBDA {
        set_frame(at(kRootJoint, lane), {one<T>(), none, T(1)});
        at(0, lane).set(kRootRow, none);
        at(0, lane).set(kShiftedRow, none);
    });
    if (pose.root_rotation.data) {
        const Bodies bodies(block, pose.root_rotation);
        for_each_slice(block, [&](std::uint32_t lane) SWIVEL_INLINE_LAMBDA {
            at(kRootJoint, lane).set(kTurnRow, unit_rotation(rotor_of(load_values<T, 4>(bodies.lane + lane, 0))));
        });
    }
    if (pose.root_position.data && !pose.root_is_double) {
        const Bodies bodies(block, pose.root_position);
        for_each_slice(block, [&](std::uint32_t lane) SWIVEL_INLINE_LAMBDA {
            at(0, lane).set(kRootRow, vector_of(load_values<T, 3>(bodies.lane + lane, 0)));
        });
    }
    if (pose.root_scale.data) read_numbers(block, pose.root_scale, kRootJoint + kScaleRow);
}

// Where the root is from the support, along the world's axes: of doubles, and of floats once the root is read.
SWIVEL_INLINE void read_root_from_support(const BodyBlock& block, const swivel_pose& pose)
{
    constexpr double origin[3] = {};
    const Bodies roots(block, pose.root_position);
    const Bodies supports(block, pose.support_position.data ? pose.support_position : swivel_in{origin, 0});
    float* const rows = block.rows + kRootFromSupportRow * kLanes;
    for (std::uint32_t n = 0; n < kLanes; ++n) {
        double root[3], support[3];
        std::memcpy(root, roots.lane[n], sizeof root);
        std::memcpy(support, supports.lane[n], sizeof support);
        for (std::uint32_t c = 0; c < 3; ++c) rows[c * kLanes + n] = static_cast<float>(root[c] - support[c]);
    }
}
SWIVEL_INLINE void take_root_from_support(const BodyBlock& block, const swivel_pose& pose)
{
    const bool has_support = pose.support_position.data != nullptr;
    const Bodies supports = has_support ? Bodies(block, pose.support_position) : Bodies();
    for_each_slice(block, [&](std::uint32_t lane) SWIVEL_INLINE_LAMBDA {
        const RowView<T> at = rows_of(block, 0, lane);
        Vector<T> from = at.vector(kRootRow);
        if (has_support) from = from - vector_of(load_values<T, 3>(supports.lane + lane, 0));
        at.set(kRootFromSupportRow, from);
    });
}

// A body's values for plants and shifts.
SWIVEL_FLATTEN [[gnu::noinline]] void read_time_and_support(const BodyPlan& plan, const BodyBlock& block)
{
    const swivel_pose& pose = *plan.pose;
    read_numbers(block, pose.time, kTimeRow);
    if (pose.root_is_double)
        read_root_from_support(block, pose);
    else
        take_root_from_support(block, pose);
    const Bodies rotations = pose.support_rotation.data ? Bodies(block, pose.support_rotation) : Bodies();
    for_each_slice(block, [&](std::uint32_t lane) SWIVEL_INLINE_LAMBDA {
        const RowView<T> at = rows_of(block, 0, lane);
        if (pose.support_rotation.data)
            at.set(kSupportRow, unit_rotation(rotor_of(load_values<T, 4>(rotations.lane + lane, 0))));
        at.set(kSpanRow, T(-kAnyShift));
        at.set(kSpanRow + 1, T(kAnyShift));
        at.set(kSpanRow + 2, T(1));
    });
}

// A joint of a pose in the body's space. Its place, where the pose has none, follows from the joint above. As along a
// chain, what is bad in a joint shows in all below it.
template <bool Translates>
SWIVEL_INLINE JointFrame<T> frame_in_body(const JointFrame<T>& root, const JointFrame<T>& above,
                                          const JointFrame<T>& given)
{
    JointFrame<T> frame = joint_frame(root, given.rotation, given.place, given.scale);
    if constexpr (!Translates) frame.place = above.place + turned(above.rotation, above.scale * given.place);
    const Mask<T> good = is_almost_unit(above.rotation) & (len2(above.place) <= T(kHuge2));
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
        for_each_slice(block, [&](std::uint32_t lane) SWIVEL_INLINE_LAMBDA {
            const RowView<T> at = rows_of(block, joint.row, lane);
            const JointFrame<T> given = reader.read(joint, lane, at);
            const JointFrame<T> above = frame_of(rows_of(block, joint.parent, lane));
            if (!in_body) return set_frame(at, joint_frame(above, given.rotation, given.place, given.scale));
            const JointFrame<T> frame =
                frame_in_body<Translates>(frame_of(rows_of(block, kRootJoint, lane)), above, given);
            set_frame(at, frame);
            if (joint.is_turned) at.set(kLocalRow, ~above.rotation * frame.rotation);
        });
    }
}

void forward(const BodyPlan& plan, const BodyBlock& block)
{
    read_root(plan, block);
    if (plan.pose->time.data) read_time_and_support(plan, block);
    if (plan.pose->weight.data) read_numbers(block, plan.pose->weight, kWeightRow);
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

}  // namespace

extern const BodyKernels body_kernels;
const BodyKernels body_kernels{forward, move, carry, locate};

}  // namespace swivel::inline SWIVEL_ISA

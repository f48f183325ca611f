// SPDX-License-Identifier: MIT
//
// Forward kinematics of bodies, compiled once for each instruction set: from the caller's poses to rows of world
// frames.
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
    SWIVEL_INLINE JointFrame<T> frame() const
    {
        return {rotor(get(kTurnRow), get(kTurnRow + 1), get(kTurnRow + 2), get(kTurnRow + 3)),
                vector(get(kPlaceRow), get(kPlaceRow + 1), get(kPlaceRow + 2)), get(kScaleRow)};
    }
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
// The offset of a joint's value in its body.
SWIVEL_INLINE std::size_t offset_of(const swivel_joint_values& values, std::uint32_t joint)
{
    return values.offsets ? values.offsets[joint] : joint * values.joint_stride;
}

// What a pose says of a joint.
struct LocalJoint {
    Rotor<T> rotation;
    Vector<T> translation;
    T scale;
};

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
    SWIVEL_INLINE LocalJoint read(const BodyJoint& joint, std::uint32_t lane,
                                  [[maybe_unused]] const JointRows& to) const
    {
        const std::size_t at = offset_of(pose.rotations, joint.skeleton_joint);
        if constexpr (Form != SWIVEL_ROTATIONS) {
            return read_matrix(rotations.lane + lane, at, joint.is_turned != 0, to);
        } else {
            const Rotor<T> rotation = rotor_of(load_values<T, 4>(rotations.lane + lane, at));
            if (joint.is_turned) to.set_rotor(kLocalRow, rotation);
            LocalJoint local{rotation,
                             vector(T(joint.translation[0]), T(joint.translation[1]), T(joint.translation[2])), T(1)};
            if constexpr (Translates)
                local.translation = vector_of(
                    load_values<T, 3>(translations.lane + lane, offset_of(pose.translations, joint.skeleton_joint)));
            if constexpr (Scales) {
                const std::array<T, 3> scale =
                    load_values<T, 3>(scales.lane + lane, offset_of(pose.scales, joint.skeleton_joint));
                local.scale = uniform_scale(scale[0], scale[1], scale[2]);
            }
            return local;
        }
    }

private:
    SWIVEL_INLINE static LocalJoint read_matrix(LaneValues lane, std::size_t at, bool keeps, const JointRows& to)
    {
        std::array<T, 3> part[4];  // rows without the translation, and that; or columns
        if constexpr (Form == SWIVEL_MATRIX_ROWS) {
            for (std::size_t r = 0; r < 3; ++r) {
                const std::array<T, 4> row = load_values<T, 4>(lane, at + r * 4 * sizeof(float));
                part[r] = {row[0], row[1], row[2]};
                part[3][r] = row[3];
            }
        } else {
            constexpr std::size_t step = (Form == SWIVEL_MATRIX_COLUMNS ? 4 : 3) * sizeof(float);
            for (std::size_t c = 0; c < 4; ++c) part[c] = load_values<T, 3>(lane, at + c * step);
        }
        const auto axis = [&](std::size_t n) SWIVEL_INLINE_LAMBDA {
            return Form == SWIVEL_MATRIX_ROWS ? vector(part[0][n], part[1][n], part[2][n]) : vector_of(part[n]);
        };
        const MatrixFrame<T> frame = matrix_frame(axis(0), axis(1), axis(2));
        if (keeps) {
            to.set_rotor(kLocalRow, frame.rotation);
            for (std::uint32_t n = 0; n < 9; ++n) to.set(kAxesRow + n, part[n / 3][n % 3]);
        }
        return {frame.rotation, vector_of(part[3]), select(frame.valid, frame.scale, T(__builtin_nan("")))};
    }
};

// The root, which lies at the place that all others are from.
SWIVEL_FLATTEN [[gnu::noinline]] void read_root(const BodyPlan& plan, const BodyBlock& block)
{
    const Vector<T> none = vector(T(0), T(0), T(0));
    const swivel_pose& pose = *plan.pose;
    const auto rows_of = [&](std::uint32_t row, std::uint32_t lane)
                             SWIVEL_INLINE_LAMBDA { return JointRows{block.rows + row * kLanes + lane}; };
    for (std::uint32_t lane = 0; lane < kLanes; lane += lane_count<T>) {
        rows_of(joint_row(0), lane).set_frame({rotor(T(0), T(0), T(0), T(1)), none, T(1)});
        rows_of(0, lane).set_vector(kRootRow, none);
    }
    if (pose.root_rotation.data) {
        const Bodies bodies(block, pose.root_rotation);
        for (std::uint32_t lane = 0; lane < kLanes; lane += lane_count<T>)
            rows_of(joint_row(0), lane)
                .set_rotor(kTurnRow, unit_rotation(rotor_of(load_values<T, 4>(bodies.lane + lane, 0))));
    }
    if (pose.root_position.data && !pose.root_is_double) {
        const Bodies bodies(block, pose.root_position);
        for (std::uint32_t lane = 0; lane < kLanes; lane += lane_count<T>)
            rows_of(0, lane).set_vector(kRootRow, vector_of(load_values<T, 3>(bodies.lane + lane, 0)));
    }
    if (pose.root_scale.data) {
        const Bodies bodies(block, pose.root_scale);
        float* const scales = rows_of(joint_row(0) + kScaleRow, 0).rows;
        for (std::uint32_t n = 0; n < kLanes; ++n) std::memcpy(scales + n, bodies.lane[n], sizeof(float));
    }
}

template <swivel_pose_form Form, bool Translates, bool Scales>
SWIVEL_FLATTEN [[gnu::noinline]] void read_joints(const BodyPlan& plan, const BodyBlock& block)
{
    const PoseReader<Form, Translates, Scales> reader(block, *plan.pose);
    for (std::uint32_t n = 1; n < plan.joint_count; ++n) {
        const BodyJoint& joint = plan.joints[n];
        for (std::uint32_t lane = 0; lane < kLanes; lane += lane_count<T>) {
            const auto rows_of = [&](std::uint32_t of) SWIVEL_INLINE_LAMBDA {
                return JointRows{block.rows + joint_row(of) * kLanes + lane};
            };
            const JointRows at = rows_of(n);
            const LocalJoint local = reader.read(joint, lane, at);
            at.set_frame(joint_frame(rows_of(joint.parent).frame(), local.rotation, local.translation, local.scale));
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

}  // namespace

extern const BodyKernels body_kernels;
const BodyKernels body_kernels{forward};

}  // namespace swivel::inline SWIVEL_ISA

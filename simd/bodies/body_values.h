// SPDX-License-Identifier: MIT
//
// The kernels of bodies read and write rows of a block's joints, and the caller's values of its bodies. Only
// body_kernels.cpp includes this.
#pragma once

#include <array>

#include "core/joint_frame.h"
#include "simd/component_rows.h"
#include "simd/kernels.h"
#include "simd/lanes.h"
#include "simd/values.h"

namespace swivel::inline SWIVEL_ISA {

namespace {

using T = typename KernelNumber<SWIVEL_ARCH, 1>::type;

// The frame of a joint, in its rows.
SWIVEL_ALWAYS_INLINE JointFrame<T> frame_of(const RowView<T>& joint)
{
    return {joint.rotor(kTurnRow), joint.vector(kPlaceRow), joint.get(kScaleRow)};
}
SWIVEL_ALWAYS_INLINE void set_frame(const RowView<T>& joint, const JointFrame<T>& frame)
{
    joint.set(kTurnRow, frame.rotation);
    joint.set(kPlaceRow, frame.place);
    joint.set(kScaleRow, frame.scale);
}

SWIVEL_ALWAYS_INLINE Vector<T> vector_of(const std::array<T, 3>& v) { return vector(v[0], v[1], v[2]); }
SWIVEL_ALWAYS_INLINE Rotor<T> rotor_of(const std::array<T, 4>& q) { return rotor(q[0], q[1], q[2], q[3]); }

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
SWIVEL_ALWAYS_INLINE RowView<T> rows_of(const BodyBlock& block, std::uint32_t row, std::uint32_t lane)
{
    return {block.rows + row * kLanes + lane};
}

// Calls take(its first lane) for each slice of a block that has chosen bodies.
template <class Take>
SWIVEL_INLINE void for_each_slice(const BodyBlock& block, const Take& take)
{
    constexpr std::uint32_t lanes = lane_count<T>, every = (1u << lanes) - 1;
    for (std::uint32_t lane = 0; lane < kLanes; lane += lanes)
        if (lanes == kLanes || (block.lanes >> lane & every) != 0) take(lane);
}

// A matrix in the order of memory: rows without the translation, and that; or columns.
struct MatrixParts {
    std::array<T, 3> part[4];
};
template <swivel_pose_form Form>
SWIVEL_ALWAYS_INLINE MatrixParts read_parts(LaneValues lane, std::size_t at)
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
SWIVEL_ALWAYS_INLINE Vector<T> axis_of(const MatrixParts& m, std::size_t n)
{
    return Form == SWIVEL_MATRIX_ROWS ? vector(m.part[0][n], m.part[1][n], m.part[2][n]) : vector_of(m.part[n]);
}

}  // namespace

}  // namespace swivel::inline SWIVEL_ISA

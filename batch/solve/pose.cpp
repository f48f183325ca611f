// SPDX-License-Identifier: MIT
//
// The way of solved joints back into the bodies' poses.
#include "batch/solve/solve.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "simd/transpose.h"

namespace swivel {

namespace {

// Rows of C floats of some bodies of a block to their values. Whole blocks go four bodies at a time.
template <std::size_t C>
void from_rows(const float* rows, LaneMask lanes, char* values, std::size_t stride)
{
    if (lanes == kAllLanes)
        for (std::size_t n = 0; n < kLanes; n += 4) four_values_from_rows<C>(rows + n, values + n * stride, stride);
    else
        for (; lanes != 0; lanes &= lanes - 1) {
            const auto n = static_cast<std::size_t>(std::countr_zero(lanes));
            value_from_rows<C>(rows + n, values + n * stride);
        }
}

// The value of a joint of one body.
char* value_of(const swivel_joint_values& values, std::uint32_t joint, std::uint32_t body)
{
    return static_cast<char*>(values.data) + std::size_t{body} * values.body_stride + offset_of(values, joint);
}

// A block's bodies, and where joints go.
struct PoseWriter {
    const swivel_pose& pose;
    const BodyBlock& block;
    const swivel_joint_values& results = pose.results.data ? pose.results : pose.rotations;

    // C numbers of a joint's value, from a row and a byte on.
    template <std::size_t C>
    void write(const swivel_joint_values& to, std::uint32_t joint, std::uint32_t row, std::size_t byte = 0) const
    {
        from_rows<C>(block.rows + row * kLanes, block.lanes, value_of(to, joint, block.first) + byte, to.body_stride);
    }
    void write_local(const TurnedJoint& joint) const
    {
        if (pose.form == SWIVEL_ROTATIONS) return write<4>(results, joint.skeleton_joint, joint.row + kLocalRow);
        for (std::uint32_t part = 0; part < 3; ++part)
            write<3>(results, joint.skeleton_joint, joint.row + kAxesRow + 3 * part, part_offset(part));
        copy_translations(joint.skeleton_joint);
    }
    // From the rows of kernels.bodies.carry().
    void write_carried(std::uint32_t joint) const
    {
        if (pose.form == SWIVEL_ROTATIONS) {
            write<4>(results, joint, kOutTurnRow);
            const bool apart = pose.translation_results.data != nullptr;
            if (pose.translations.data)
                write<3>(apart ? pose.translation_results : pose.translations, joint, kOutPlaceRow);
        } else if (pose.form == SWIVEL_MATRIX_ROWS) {
            for (std::uint32_t part = 0; part < 3; ++part) write<4>(results, joint, 4 * part, part_offset(part));
        } else {
            for (std::uint32_t part = 0; part < 4; ++part) write<3>(results, joint, 3 * part, part_offset(part));
        }
    }

private:
    // A row or a column of a matrix.
    std::size_t part_offset(std::uint32_t part) const
    {
        return pose.form == SWIVEL_MATRIX_ROWS ? entry_offset(pose.form, part, 0) : entry_offset(pose.form, 0, part);
    }
    // A solve does not change them.
    void copy_translations(std::uint32_t joint) const
    {
        if (value_of(results, joint, 0) == value_of(pose.rotations, joint, 0) &&
            results.body_stride == pose.rotations.body_stride)
            return;
        for (LaneMask lanes = block.lanes; lanes != 0; lanes &= lanes - 1) {
            const std::uint32_t body = block.first + static_cast<std::uint32_t>(std::countr_zero(lanes));
            for (std::size_t row = 0; row < 3; ++row)
                std::memcpy(value_of(results, joint, body) + entry_offset(pose.form, row, 3),
                            value_of(pose.rotations, joint, body) + entry_offset(pose.form, row, 3), sizeof(float));
        }
    }
};

}  // namespace

void pose_out(const BodyKernels& kernels, const BodyPlan& plan, const Group& group, const BodyBlock& block)
{
    const GroupJoints& joints = group.plan.joints;
    const swivel_pose& pose = *plan.pose;
    const PoseWriter writer{pose, block};
    const bool in_body = pose.space == SWIVEL_IN_BODY;
    if (!in_body)
        for (std::uint32_t n = 0; n < joints.turned_count; ++n) writer.write_local(joints.turned[n]);
    if (!(group.features & kLook) && (in_body || gives_joints(pose))) kernels.move(block, joints);
    if (in_body) carry_out(kernels, plan, group, block);
}

void carry_out(const BodyKernels& kernels, const BodyPlan& plan, const Group& group, const BodyBlock& block)
{
    const GroupJoints& joints = group.plan.joints;
    const PoseWriter writer{*plan.pose, block};
    for (std::uint32_t n = 0; n < joints.moved_count; ++n) {
        kernels.carry(plan, block, joints.moved[n]);
        writer.write_carried(joints.moved[n].skeleton_joint);
    }
}

void joints_out(const BodyKernels& kernels, const BodyPlan& plan, const BodyBlock& block)
{
    const swivel_pose& pose = *plan.pose;
    const PoseWriter writer{pose, block};
    for (std::uint32_t n = 1; n < plan.joint_count; ++n) {
        kernels.locate(plan, block, plan.joints[n]);
        const std::uint32_t joint = plan.joints[n].skeleton_joint;
        if (pose.joint_rotations.data) writer.write<4>(pose.joint_rotations, joint, kOutTurnRow);
        if (pose.joint_positions.data) writer.write<3>(pose.joint_positions, joint, kOutPlaceRow);
    }
}

void stay(const Group& group, const BodyBlock& block)
{
    const GroupJoints& joints = group.plan.joints;
    constexpr std::size_t kNumbers = 7;  // a rotor and a vector
    for (std::uint32_t n = 0; n < joints.turned_count; ++n) {
        float* const motion = block.rows + (joints.turned[n].row + kMotionRow) * kLanes;
        if (group.features & kLook && joints.above != 0)
            std::copy_n(block.rows + (joints.above + kMotionRow) * kLanes, kNumbers * kLanes, motion);
        else
            for (std::size_t c = 0; c < kNumbers; ++c)
                std::fill_n(motion + c * kLanes, std::size_t{kLanes}, c == 3 ? 1.0f : 0.0f);
    }
}

}  // namespace swivel

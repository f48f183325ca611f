// SPDX-License-Identifier: MIT
#include "tests/pose_buffer.h"

#include <cstring>

namespace swivel::test {

PoseBuffer::PoseBuffer(const PoseLayout& of, std::size_t joints, std::size_t bodies)
    : layout(of),
      joint_count(joints),
      body_stride(joints * (rotation_bytes() + (of.translates ? 12 : 0) + (of.scales ? 12 : 0)) + (of.roots ? 32 : 0) +
                  of.gap),
      bytes(bodies * body_stride, kPattern)
{
}

PoseBuffer::PoseBuffer(const PoseLayout& of, const std::vector<Body>& bodies)
    : PoseBuffer(of, bodies[0].rotations.size(), bodies.size())
{
    for (std::size_t n = 0; n < bodies.size(); ++n) write(n, bodies[n]);
}

std::size_t PoseBuffer::rotation_bytes() const
{
    return layout.form == SWIVEL_ROTATIONS ? 16 : layout.form == SWIVEL_MATRIX_COLUMNS ? 64 : 48;
}
std::size_t PoseBuffer::rotation_at(std::size_t n, std::size_t joint) const
{
    return n * body_stride + joint * rotation_bytes();
}
std::size_t PoseBuffer::translation_at(std::size_t n, std::size_t joint) const
{
    return rotation_at(n, joint_count) + joint * 12;
}
std::size_t PoseBuffer::scale_at(std::size_t n, std::size_t joint) const
{
    return translation_at(n, layout.translates ? joint_count : 0) + joint * 12;
}
std::size_t PoseBuffer::root_at(std::size_t n) const { return scale_at(n, layout.scales ? joint_count : 0); }
std::size_t PoseBuffer::element(int row, int column) const
{
    const int index = layout.form == SWIVEL_MATRIX_ROWS      ? 4 * row + column
                      : layout.form == SWIVEL_MATRIX_COLUMNS ? 4 * column + row
                                                             : 3 * column + row;
    return static_cast<std::size_t>(index) * sizeof(float);
}

void PoseBuffer::write(std::size_t n, const Body& local)
{
    const Body body = layout.in_body ? in_body_space(*layout.in_body, local) : local;
    const auto put = [&](std::size_t at, const auto& value) { std::memcpy(&bytes[at], &value, sizeof value); };
    for (std::size_t joint = 0; joint < joint_count; ++joint) {
        if (layout.form == SWIVEL_ROTATIONS) {
            put(rotation_at(n, joint), body.rotations[joint]);
            if (layout.translates) put(translation_at(n, joint), body.translations[joint]);
            if (layout.scales) put(scale_at(n, joint), body.scales[joint]);
            continue;
        }
        const Eigen::Matrix3d turn = quat(body.rotations[joint]).normalized().toRotationMatrix();
        for (int row = 0; row < 3; ++row) {
            const auto r = static_cast<std::size_t>(row);
            for (int column = 0; column < 3; ++column)
                put(rotation_at(n, joint) + element(row, column),
                    static_cast<float>(turn(row, column) * body.scales[joint][static_cast<std::size_t>(column)]));
            put(rotation_at(n, joint) + element(row, 3), body.translations[joint][r]);
        }
    }
    if (!layout.roots) return;
    put(root_at(n), body.root_position);
    put(root_at(n) + 12, body.root_rotation);
    put(root_at(n) + 28, body.root_scale);
}

Body PoseBuffer::read(std::size_t n, const Body& otherwise) const
{
    Body body = layout.in_body ? in_body_space(*layout.in_body, otherwise) : otherwise;
    for (std::size_t joint = 0; joint < joint_count; ++joint) {
        const unsigned char* const at = &bytes[rotation_at(n, joint)];
        if (layout.form == SWIVEL_ROTATIONS) {
            std::memcpy(&body.rotations[joint], at, sizeof(Float4));
            if (layout.translates)
                std::memcpy(&body.translations[joint], &bytes[translation_at(n, joint)], sizeof(Float3));
            continue;
        }
        const Eigen::Matrix3d turn = matrix(n, joint);
        for (int row = 0; row < 3; ++row)
            std::memcpy(&body.translations[joint][static_cast<std::size_t>(row)], at + element(row, 3), sizeof(float));
        body.rotations[joint] = floats(Quaterniond(Eigen::Matrix3d(turn / turn.col(0).norm())));
    }
    return layout.in_body ? from_body_space(*layout.in_body, body) : body;
}

Eigen::Matrix3d PoseBuffer::matrix(std::size_t n, std::size_t joint) const
{
    Eigen::Matrix3d axes;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) {
            float number;
            std::memcpy(&number, &bytes[rotation_at(n, joint) + element(row, column)], sizeof number);
            axes(row, column) = number;
        }
    return axes;
}

swivel_pose PoseBuffer::view()
{
    swivel_pose pose = swivel_default_pose();
    pose.form = layout.form;
    pose.space = layout.in_body ? SWIVEL_IN_BODY : SWIVEL_LOCAL;
    pose.rotations = {&bytes[rotation_at(0, 0)], body_stride, rotation_bytes(), nullptr};
    if (layout.form == SWIVEL_ROTATIONS && layout.translates)
        pose.translations = {&bytes[translation_at(0, 0)], body_stride, 12, nullptr};
    if (layout.form == SWIVEL_ROTATIONS && layout.scales)
        pose.scales = {&bytes[scale_at(0, 0)], body_stride, 12, nullptr};
    if (layout.roots) {
        pose.root_position = {&bytes[root_at(0)], body_stride};
        pose.root_rotation = {&bytes[root_at(0) + 12], body_stride};
        pose.root_scale = {&bytes[root_at(0) + 28], body_stride};
    }
    return pose;
}

}  // namespace swivel::test

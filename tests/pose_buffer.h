// SPDX-License-Identifier: MIT
//
// Bodies' poses in memory, in any form and at any distances, as engines keep them. Bytes between values are a pattern
// that nobody may change.
#pragma once

#include "tests/random_bodies.h"

namespace swivel::test {

struct PoseLayout {
    swivel_pose_form form = SWIVEL_ROTATIONS;
    bool translates = false, scales = false, roots = false;
    std::size_t gap = 0;                    // bytes after each body
    const BodySkeleton* in_body = nullptr;  // then all is relative to the root
};

struct PoseBuffer {
    PoseLayout layout;
    std::size_t joint_count, body_stride;
    std::vector<unsigned char> bytes;

    PoseBuffer(const PoseLayout& of, std::size_t joints, std::size_t bodies);
    PoseBuffer(const PoseLayout& of, const std::vector<Body>& bodies);

    void write(std::size_t n, const Body& body);
    // What it says of a body. What its form does not say is taken from `otherwise`.
    Body read(std::size_t n, const Body& otherwise) const;
    Eigen::Matrix3d matrix(std::size_t n, std::size_t joint) const;  // where its form has matrices
    swivel_pose view();

private:
    static constexpr std::size_t kPattern = 0xa5;
    std::size_t rotation_bytes() const;
    std::size_t rotation_at(std::size_t n, std::size_t joint) const;
    std::size_t translation_at(std::size_t n, std::size_t joint) const;
    std::size_t scale_at(std::size_t n, std::size_t joint) const;
    std::size_t root_at(std::size_t n) const;
    // The bytes from a matrix to its element.
    std::size_t element(int row, int column) const;
};

}  // namespace swivel::test

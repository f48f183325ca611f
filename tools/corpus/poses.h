// SPDX-License-Identifier: MIT
//
// A caller's arrays of a crowd's poses: the inputs and results of a solve of bodies besides the crowd's rows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/corpus/recipe.h"

namespace swivel::corpus {

// Values body after body, and within a body joint after joint. Empty arrays are not given.
struct Poses {
    std::uint32_t body_count = 0, joint_count = 0;  // 0: the crowd is of free limbs
    swivel_pose_form form = SWIVEL_ROTATIONS;
    bool is_in_body = false;
    std::vector<float> rotations, translations, scales;  // rotations: or matrices
    std::vector<float> results, translation_results;     // empty: rotations and translations
    std::vector<float> joint_rotations, joint_positions;
    std::vector<std::size_t> offsets;  // of each joint's rotation from its body's first; empty: in the joints' order
    std::vector<float> root_positions, root_rotations, root_scales;
    std::vector<double> far_roots;  // in place of root_positions
    std::array<std::vector<double>, kGroupCount> far_targets, far_poles, far_next_targets,
        far_grounds;  // of each group, in place of rows

    // For bodies that stand:
    std::uint32_t prop_group = 0, look_group = 0, group_count = 0;  // of the crowd, where it has them
    std::vector<float> times, support_positions, support_rotations;
    std::vector<double> far_supports;  // in place of support_positions
    std::vector<double> far_props;     // in place of rows
    std::array<std::vector<double>, kLookCount> far_look_targets;
    std::vector<std::uint32_t> mask;  // of bodies that are solved; empty: all

    std::uint32_t rotation_floats() const;
    // The arrays that a solve writes, with the numbers in them that it leaves as they are.
    std::array<const std::vector<float>*, 4> solved() const;
};

// Those of a frame, without goals.
Poses make_poses(const Recipe& recipe, std::uint32_t body_count, std::uint32_t frame);

}  // namespace swivel::corpus

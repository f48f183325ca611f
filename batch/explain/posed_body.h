// SPDX-License-Identifier: MIT
//
// One body of a pose in double: where a solve has its joints, or where a common mistake in reading the pose would put
// them. Knows no limbs and no goals.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "core/joint_frame.h"

namespace swivel {

// How a pose's numbers are read.
struct Reading {
    swivel_pose_form form;
    swivel_pose_space space;
    bool joints_w_first = false, root_w_first = false;  // quaternions are stored as w, x, y, z
    bool joints_inverse = false, root_inverse = false;  // rotations are those of the parent to the joint
    bool at_rest = false;                               // translations are the skeleton's
    bool unscaled = false;                              // joints have no scales of their own
    bool root_in_other_numbers = false;                 // floats for doubles, or doubles for floats
    int root_place = 1, root_turn = 1, root_scale = 1;  // how many times each counts: 0, 1 or 2

    // As a solve reads them.
    explicit Reading(const swivel_pose& pose) : form(pose.form), space(pose.space) {}
};

// Joint numbers are places in the crowd's list of needed joints. 0 is the root, and parents come before joints.
struct PosedBody {
    const swivel_crowd& crowd;
    const swivel_pose& pose;  // valid and of full size
    const std::uint32_t body;

    // In the world; NaN if it depends on a bad number.
    Vector<double> place(std::uint32_t joint, const Reading& how) const;
    // In the world, of unit length.
    Rotor<double> rotation(std::uint32_t joint, const Reading& how) const;
    // The length of a quaternion as it is stored; 1 for matrices.
    double rotation_length(std::uint32_t joint) const;
    // Whether joints have translations of their own, and not the skeleton's.
    bool has_translations(const Reading& how) const;
    // Whether the root's place may be read as doubles: an array of floats may end earlier at the last body.
    bool may_have_double_root() const;
    Vector<double> root_place(const Reading& how) const;
    Vector<double> root_place() const { return root_place(Reading(pose)); }
    double time() const;  // 0 without

    std::uint32_t parent(std::uint32_t joint) const { return joint_at(crowd, crowd.joints[joint].parent); }
    std::uint32_t skeleton_joint(std::uint32_t joint) const { return crowd.joints[joint].skeleton_joint; }
    // The number of steps from a joint up to one above it; 0 if that is not above.
    std::uint32_t steps_up(std::uint32_t joint, std::uint32_t above) const;
    // Whether a joint of a form of 12 floats may have 16 that are a matrix by columns. Then the 12 are no matrix of the
    // form, or one without a translation.
    bool may_be_columns(std::uint32_t joint) const;

private:
    struct Given {
        Rotor<double> rotation;
        Vector<double> translation;
        double scale;
    };
    Given given(std::uint32_t joint, const Reading& how) const;
    Given given_matrix(std::uint32_t joint, const Reading& how) const;
    Vector<double> rest(std::uint32_t joint) const;
    // From the root, in its frame.
    Vector<double> place_along(std::uint32_t joint, const Reading& how) const;
    Vector<double> place_in_body(std::uint32_t joint, const Reading& how) const;
    const char* value_of(const swivel_joint_values& values, std::uint32_t joint) const;
};

}  // namespace swivel

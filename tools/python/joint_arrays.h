// SPDX-License-Identifier: MIT
//
// NumPy arrays of values of joints as swivel sees them: memory, and strides from body to body and from joint to joint.
// Knows no crowd.
#pragma once

#include <pybind11/numpy.h>

#include <cstddef>
#include <string>

#include "swivel/swivel.h"
#include "tools/python/arrays.h"

namespace swivel::python {

// What an array must hold: a value for each joint of each body. Its shape is (bodies, joints) and that of a value.
struct JointValues {
    std::string name;  // in messages
    std::size_t body_count, joint_count;
    Shape value;  // (3,), (4,), (3, 4) or (4, 4)
};

// What swivel takes, how the numbers of a value lie, and what keeps the memory. Rows of numbers are SWIVEL_ROTATIONS.
struct JointArray {
    swivel_joint_values values;
    swivel_pose_form form;
    pybind11::array owner;
};
// object: as for input(). An array without the first axis is all bodies'.
JointArray joint_input(const JointValues& wanted, pybind11::handle object, const Memory& apart);
// object: an array of float32 of this shape that may be written, else ValueError or TypeError. It is never copied, so
// each value's numbers must lie side by side.
JointArray joint_output(const JointValues& wanted, pybind11::handle object, const Memory& apart);

}  // namespace swivel::python

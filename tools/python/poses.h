// SPDX-License-Identifier: MIT
//
// Poses of bodies, and streams of a solve, as Python gives them.
#pragma once

#include <vector>

#include "tools/python/arrays.h"
#include "tools/python/crowd.h"

namespace swivel::python {

// A pose, and the arrays behind it.
struct PoseArrays {
    swivel_pose view;
    std::vector<pybind11::array> owners;
};

// A swivel.Pose of a crowd of bodies, else TypeError; ValueError or TypeError for arrays that do not go with the crowd.
PoseArrays pose_of(const HeldCrowd& held, const pybind11::object& given);

// The streams of a call, and the arrays behind them.
struct StreamArrays {
    std::vector<Streams> streams;
    std::vector<Input> inputs;
    std::vector<Output> outputs;
};

// A dict for each of these groups, or one dict if it is one group; in the crowd's order. ValueError or TypeError for
// what is none. far: positions are doubles, also without an origin.
StreamArrays streams_of(const HeldCrowd& held, const pybind11::object& given, const std::vector<std::uint32_t>& groups,
                        bool far);

}  // namespace swivel::python

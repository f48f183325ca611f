// SPDX-License-Identifier: MIT
//
// Frames of a solve as Python gives them.
#pragma once

#include <vector>

#include "tools/python/arrays.h"
#include "tools/python/crowd.h"

namespace swivel::python {

// The frames of a call, and the arrays behind them.
struct Frames {
    std::vector<swivel_frame> frames;
    std::vector<Input> inputs;
    std::vector<Output> outputs;
};

// A dict for each group, or one dict if there is one group. ValueError or TypeError for what is none.
Frames frames_of(const HeldCrowd& held, const pybind11::object& given);

}  // namespace swivel::python

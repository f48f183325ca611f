// SPDX-License-Identifier: MIT
//
// Which of a file's animations, and how densely.
#pragma once

#include <string>

namespace swivel::tools {

struct MotionChoice {
    std::string clip;  // name or index of an animation; empty: the first
    double rate = 0;   // frames a second; 0: as the file has them
};

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
//
// A frame for ozz-animation's IKTwoBoneJob: the matrices of a pose from which its corrections start. That pose is the
// rest pose with the elbows bent by 30 degrees.
#pragma once

#include <vector>

#include "bench/rivals/frames.h"

namespace bench {

class OzzFrame {
public:
    explicit OzzFrame(const FrameView& frame);
    OzzView view() const { return {models_.data(), before_.data(), {{0, 1, 0, 0}, {0, -1, 0, 0}}}; }

private:
    std::vector<CharacterModel> models_;
    std::vector<CharacterPose> before_;
};

}  // namespace bench

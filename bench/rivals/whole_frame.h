// SPDX-License-Identifier: MIT
//
// The frame of a crowd of characters, made up, and swivel on it.
#pragma once

#include <array>
#include <vector>

#include "bench/rivals/framed_crowd.h"
#include "bench/rivals/frames.h"

namespace bench {

class WholeFrame {
public:
    explicit WholeFrame(std::size_t character_count);
    WholeFrame(const WholeFrame&) = delete;
    WholeFrame& operator=(const WholeFrame&) = delete;

    std::size_t arm_count() const { return kArms * world_.size(); }
    FrameView view() { return {world_.data(), goals_.data(), local_.data(), rigs_.data(), world_.size()}; }
    FramedCrowd& framed() { return framed_; }

    // By forward kinematics from the pose buffer: the worst error of the wrists well within reach, in arm lengths;
    // infinite for a NaN.
    double worst_error() const;
    // Writes rotations that are wrong.
    void spoil();

private:
    std::vector<CharacterPose> world_, local_;
    std::vector<CharacterGoal> goals_;
    std::array<Rig, kArms> rigs_;
    FramedCrowd framed_;
};

}  // namespace bench

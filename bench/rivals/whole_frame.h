// SPDX-License-Identifier: MIT
//
// A crowd's frame, made up, and swivel on it: in three steps (inputs into rows, solve, results out of rows) or in one.
#pragma once

#include <array>
#include <vector>

#include "bench/rivals/frames.h"
#include "swivel/swivel.hpp"

namespace bench {

class WholeFrame {
public:
    explicit WholeFrame(std::size_t character_count);
    WholeFrame(const WholeFrame&) = delete;
    WholeFrame& operator=(const WholeFrame&) = delete;

    std::size_t arm_count() const { return kArms * world_.size(); }
    FrameView view() { return {world_.data(), goals_.data(), local_.data(), rigs_.data(), world_.size()}; }
    swivel::Crowd& crowd() { return crowd_; }
    const std::array<swivel_frame, kArms>& frames() const { return frames_; }

    // On this thread:
    void write();  // positions of wrists and poles, parents' frames; lengths are in the rows since the beginning
    void solve()
    {
        crowd_.solve({.blocks = swivel_blocks{0, swivel_block_count(crowd_.get())}, .on_this_thread = true});
    }
    void read();  // rotations of shoulders and elbows
    void solve_in_one()
    {
        crowd_.solve(
            {.blocks = swivel_blocks{0, swivel_block_count(crowd_.get())}, .frames = frames_, .on_this_thread = true});
    }

    // By forward kinematics from the pose buffer: the worst error of the wrists well within reach, in arm lengths;
    // infinite for a NaN.
    double worst_error() const;
    // Writes rotations that are wrong.
    void spoil();

private:
    std::vector<CharacterPose> world_, local_;
    std::vector<CharacterGoal> goals_;
    std::array<Rig, kArms> rigs_;
    std::array<std::array<swivel_frame_field, 7>, kArms> fields_;
    std::array<swivel_frame, kArms> frames_;
    swivel::Crowd crowd_;
};

}  // namespace bench

// SPDX-License-Identifier: MIT
//
// A crowd whose limbs are asked for what the formula of goals gives, frame by frame. Knows the solver's terms; no clip,
// no file format.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "tools/crowd/limb_crowds.h"

namespace swivel::tools {

// A limb of a character.
struct GivenPlace {
    std::size_t limb;
    std::uint32_t character;
};

class GoalCrowd {
public:
    // sources: of each limb, one for each frame of the clip; they must outlive the crowd, and so must limbs.
    // budget_blocks: blocks of 16 limbs that a frame solves; 0: all. Throws as LimbCrowds does, naming file.
    GoalCrowd(std::span<const LimbSetup> limbs, std::vector<std::span<const goal_source>> sources,
              std::vector<goal_character> characters, std::uint32_t budget_blocks, const std::filesystem::path& file);

    std::uint32_t character_count() const { return static_cast<std::uint32_t>(characters_.size()); }
    std::span<const goal_character> characters() const { return characters_; }
    std::span<const LimbSetup> limbs() const { return limbs_; }
    std::span<const goal_source> sources(std::size_t limb) const { return sources_[limb]; }
    // The frame of the clip that a character shows, since the last set_frame().
    std::uint32_t clip_frame(std::uint32_t character) const;

    // Fills the inputs of a frame by the formula. A limb's swivel is forgotten where the clip starts again: from its
    // end to its start is no motion.
    void set_frame(std::uint32_t frame);
    // What a limb is asked for in this frame: it may be changed until write_inputs().
    goal_input& input(std::size_t limb, std::uint32_t character) { return inputs_[limb][character]; }
    const goal_input& input(std::size_t limb, std::uint32_t character) const { return inputs_[limb][character]; }
    // Hands the inputs to the solver.
    void write_inputs();

    LimbCrowds& crowds() { return crowds_; }
    const LimbCrowds& crowds() const { return crowds_; }

private:
    void write_effectors(std::size_t limb);

    std::span<const LimbSetup> limbs_;
    std::vector<std::span<const goal_source>> sources_;
    std::vector<goal_character> characters_;
    std::vector<std::vector<goal_input>> inputs_;  // [limb][character]
    std::uint32_t frame_ = 0;
    LimbCrowds crowds_;
};

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
//
// A crowd of bodies whose limbs get the goals of the formula (goals.h), frame by frame. Knows the solver's terms; no
// clip, no file format.
#pragma once

#include <span>
#include <vector>

#include "swivel/swivel.hpp"
#include "tools/crowd/ground.h"
#include "tools/crowd/limb_setup.h"

namespace swivel::tools {

// A limb of a character.
struct GivenPlace {
    std::size_t limb;
    std::uint32_t character;
};

class GoalCrowd {
public:
    // limbs: 1 to GOAL_MAX_LIMBS; the last one may be a look. sources: of each limb, one for each frame of all clips.
    // Both must outlive the crowd. budget_blocks: blocks of 16 characters that a frame solves; 0: all. ground: what
    // legs stand on; null: nothing. It must outlive the crowd, too. frame_seconds: from frame to frame.
    GoalCrowd(std::span<const LimbSetup> limbs, const std::vector<std::span<const goal_source>>& sources,
              std::vector<goal_character> characters, std::uint32_t budget_blocks, const Ground* ground,
              double frame_seconds);

    std::uint32_t character_count() const { return static_cast<std::uint32_t>(characters_.size()); }
    std::span<const goal_character> characters() const { return characters_; }
    std::span<const LimbSetup> limbs() const { return limbs_; }
    // The frame of the sources that a character shows, since the last set_frame().
    std::uint32_t clip_frame(std::uint32_t character) const
    {
        return swivel_goal_frame(&characters_[character], frame_);
    }

    // Fills the inputs of a frame by the formula. Resets a limb's swivel where the clip starts again, because there is
    // no motion from its end to its start.
    void set_frame(std::uint32_t frame);
    // The origin of all places of a character.
    const goal_root& root(std::uint32_t character) const { return roots_[character]; }
    // Whether legs stand on ground, so that bodies are raised and shifted.
    bool has_ground() const { return ground_ != nullptr; }
    // How far ground and shift raise a character's joints above its place and the clip.
    float rise(std::uint32_t character) const;
    // A limb's goal in this frame, which may be changed until solve().
    goal_input& input(std::size_t limb, std::uint32_t character) { return inputs_[character * limbs_.size() + limb]; }
    const goal_input& input(std::size_t limb, std::uint32_t character) const
    {
        return inputs_[character * limbs_.size() + limb];
    }

    // Solves all characters; with a budget all in the first call, and blocks of 16 in turns after that.
    void solve();
    // Whether the last solve() solved a character.
    bool solved(std::uint32_t character) const
    {
        return active_.empty() || (active_[character / 32] >> character % 32 & 1u) != 0;
    }

    // The local rotation of one of a limb's joints, by its place among GOAL_JOINTS: x, y, z, w in the joint's own axes.
    std::array<float, 4> rotation(std::size_t limb, std::uint32_t character, std::size_t joint) const;
    // Whether the limb has a field; and what it is in rows, of some characters, as swivel_read() has it. The body's
    // shift is each limb's.
    bool has(std::size_t limb, swivel_field field) const;
    void read(std::size_t limb, swivel_field field, std::uint32_t first, std::uint32_t count, swivel_out to) const;
    // The residuals of some characters, by swivel_residuals().
    void residuals(std::size_t limb, std::uint32_t first, std::uint32_t count, swivel_out distance) const;
    // Restores a carried field, as bits, from which the next solve starts.
    void restore(std::size_t limb, swivel_field field, std::span<const std::uint32_t> numbers);
    // The digest of all results: see swivel_goals_digest().
    std::uint64_t digest() const { return swivel_goals_digest(crowd_.get(), poses_.data()); }

private:
    std::uint32_t group_of(std::size_t limb, swivel_field field) const
    {
        return static_cast<std::uint32_t>(field == SWIVEL_SHIFT ? limbs_.size() : limb);
    }
    const goal_ground* grid() const { return ground_ ? &ground_->grid : nullptr; }
    const float* heights() const { return ground_ ? ground_->heights.data() : nullptr; }

    std::span<const LimbSetup> limbs_;
    std::vector<goal_plan> plans_;
    std::vector<const goal_source*> sources_;  // by limb
    std::vector<goal_character> characters_;
    Crowd crowd_;
    std::vector<goal_root> roots_;
    std::vector<goal_input> inputs_;       // [character][limb]
    std::vector<float> poses_;             // as swivel_goals_solve() has them
    std::vector<std::size_t> pose_place_;  // by limb, within a character's
    std::size_t pose_size_;
    std::uint32_t frame_ = 0, budget_blocks_;
    const Ground* ground_;
    float frame_seconds_;
    std::vector<float> urgency_;         // of blocks
    std::vector<std::uint32_t> active_;  // bits of characters that were solved; empty: all
    bool began_ = false;
};

}  // namespace swivel::tools

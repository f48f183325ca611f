// SPDX-License-Identifier: MIT
#include "tools/crowd/goal_crowd.h"

#include "tools/crowd/parallel.h"

namespace swivel::tools {

GoalCrowd::GoalCrowd(std::span<const LimbSetup> limbs, std::vector<std::span<const goal_source>> sources,
                     std::vector<goal_character> characters, std::uint32_t budget_blocks,
                     const std::filesystem::path& file)
    : limbs_(limbs),
      sources_(std::move(sources)),
      characters_(std::move(characters)),
      inputs_(limbs.size(), std::vector<goal_input>(characters_.size())),
      crowds_(limbs, character_count(), budget_blocks, file)
{
    for (std::size_t limb = 0; limb < limbs.size(); ++limb)
        if (crowds_.has(limb, SWIVEL_EFFECTOR)) write_effectors(limb);
}

// They go with a character's size and stay the same.
void GoalCrowd::write_effectors(std::size_t limb)
{
    std::vector<std::array<float, 3>> values(characters_.size());
    for (std::size_t n = 0; n < characters_.size(); ++n)
        for (std::size_t axis = 0; axis < 3; ++axis)
            values[n][axis] = static_cast<float>(characters_[n].size * limbs_[limb].goals.effector[axis]);
    crowds_.write(limb, SWIVEL_EFFECTOR, values[0].data(), sizeof values[0]);
}

std::uint32_t GoalCrowd::clip_frame(std::uint32_t character) const
{
    return static_cast<std::uint32_t>((std::uint64_t{frame_} + characters_[character].start) % sources_[0].size());
}

void GoalCrowd::set_frame(std::uint32_t frame)
{
    frame_ = frame;
    for (std::size_t limb = 0; limb < limbs_.size(); ++limb) {
        for_ranges(character_count(), [&](std::uint32_t begin, std::uint32_t end) {
            swivel_goals(&limbs_[limb].goals, sources_[limb].data(), static_cast<std::uint32_t>(sources_[limb].size()),
                         frame, &characters_[begin], end - begin, &inputs_[limb][begin]);
        });
        if (!crowds_.has(limb, SWIVEL_NORMAL)) continue;
        for (std::uint32_t n = 0; n < character_count(); ++n)
            if (clip_frame(n) == 0) crowds_.reset(limb, n);
    }
}

void GoalCrowd::write_inputs()
{
    for (std::size_t limb = 0; limb < limbs_.size(); ++limb) crowds_.write_goals(limb, inputs_[limb]);
}

}  // namespace swivel::tools

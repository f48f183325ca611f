// SPDX-License-Identifier: MIT
#include "tools/cache/column.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "tools/cache/digest.h"

namespace swivel::tools {

namespace {

constexpr std::uint32_t kNoNumber = 0x7fc00000;  // a float that is NaN

// The first joint whose local rotation a field of the results is, among GOAL_JOINTS; 0: it is none.
std::size_t joint_of(swivel_field field)
{
    return field == SWIVEL_SHOULDER      ? 1
           : field == SWIVEL_ELBOW       ? 2
           : field == SWIVEL_WRIST       ? 3
           : field == SWIVEL_TWIST_BONES ? GOAL_JOINTS
                                         : 0;
}

}  // namespace

Column::Column(const CachedCrowd& crowd, std::uint32_t index, std::vector<goal_character> characters)
    : cached_(crowd),
      index_(index),
      fields_(result_fields(crowd)),
      setups_(setups_of(crowd)),
      crowd_(setups_, sources_of(crowd), std::move(characters), 0, ground_of(crowd), crowd.frame_seconds)
{
}

bool Column::has(std::size_t limb, swivel_field field) const
{
    const std::size_t joint = joint_of(field);
    const std::optional<swivel_look_def>& look = setups_[limb].look;
    return look && joint > 0 ? joint <= look->joint_count : crowd_.has(limb, field);
}

void Column::read_frame(std::uint32_t frame, Results& results) const
{
    for (std::size_t n = 0; n < fields_.size(); ++n)
        for (std::size_t limb = 0; limb < setups_.size(); ++limb) {
            const swivel_field field = fields_[n].field;
            const std::size_t count = fields_[n].count(), joint = joint_of(field);
            if (!has(limb, field)) continue;
            std::uint32_t* to = &results[n][cached_.place(frame, limb, 0) * count];
            if (joint == 0) {
                crowd_.read(limb, field, 0, crowd_.character_count(), {to, count * sizeof *to});
                if (field != SWIVEL_SHIFT) continue;
                for (std::uint32_t who = 0; who < crowd_.character_count(); ++who)
                    to[who * count + 3] = std::bit_cast<std::uint32_t>(crowd_.rise(who));
                continue;
            }
            const std::size_t joints = field == SWIVEL_TWIST_BONES ? setups_[limb].twist_bone_count : 1;
            for (std::uint32_t who = 0; who < crowd_.character_count(); ++who, to += count)
                for (std::size_t part = 0; part < joints; ++part)
                    std::ranges::transform(crowd_.rotation(limb, who, joint + part), to + 4 * part,
                                           [](float number) { return std::bit_cast<std::uint32_t>(number); });
        }
}

void Column::restore(const Results& state)
{
    for (std::size_t n = 0; n < fields_.size(); ++n)
        for (std::size_t limb = 0; limb < setups_.size(); ++limb) {
            const swivel_field field = fields_[n].field;
            if (describe(field).kind != SWIVEL_FIELD_CARRIED || !crowd_.has(limb, field)) continue;
            const std::size_t count = fields_[n].count(), at = cached_.place(0, limb, 0) * count;
            crowd_.restore(limb, field, std::span(state[n]).subspan(at, crowd_.character_count() * count));
        }
}

std::uint64_t Column::solve(std::uint32_t time, const ChunkGoals& goals, Results& results)
{
    std::vector<std::uint64_t> words;
    for (std::uint32_t frame = 0; frame < cached_.frames_in(time); ++frame) {
        crowd_.set_frame(time * cached_.chunk.frames + frame);
        put_given(cached_, goals, frame, 0, crowd_);
        crowd_.solve();
        read_frame(frame, results);
        words.push_back(crowd_.digest());
    }
    return digest_of(words);
}

void put_given(const CachedCrowd& cached, const ChunkGoals& goals, std::uint32_t frame, std::uint32_t first,
               GoalCrowd& crowd, std::vector<GivenPlace>* places)
{
    if (goals.target.empty()) return;
    const std::size_t limb_count = cached.limbs.size();
    const std::uint32_t count = std::min(cached.chunk.characters, crowd.character_count() - first);
    for (std::size_t limb = 0; limb < limb_count; ++limb)
        for (std::uint32_t n = 0; n < count; ++n) {
            const std::size_t at = cached.place(frame, limb, n);
            if (std::isnan(goals.target[3 * at])) continue;
            goal_input& input = crowd.input(limb, first + n);
            std::copy_n(&goals.target[3 * at], 3, input.target);
            std::copy_n(&goals.hand[4 * at], 4, input.hand);
            std::copy_n(cached.limbs[limb].setup.goals.weights, 2, input.weights);
            if (!std::isnan(goals.pole[3 * at])) {
                std::copy_n(&goals.pole[3 * at], 3, input.pole);
                input.weights[2] = cached.limbs[limb].setup.goals.weights[2];
            }
            if (places) places->push_back({limb, first + n});
        }
}

Results empty_results(const CachedCrowd& crowd)
{
    Results results;
    const std::size_t limbs = std::size_t{crowd.chunk.frames} * crowd.limb_count() * crowd.chunk.characters;
    for (const ResultField& field : result_fields(crowd))
        results.emplace_back(limbs * field.count(), field.field == SWIVEL_FLAGS ? 0 : kNoNumber);
    return results;
}

}  // namespace swivel::tools

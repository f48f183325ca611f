// SPDX-License-Identifier: MIT
#include "tools/cache/column.h"

#include <algorithm>
#include <cmath>

#include "tools/cache/digest.h"

namespace swivel::tools {

namespace {

constexpr std::uint32_t kNoNumber = 0x7fc00000;  // a float that is NaN

}  // namespace

Column::Column(const CachedCrowd& crowd, std::uint32_t index, std::vector<goal_character> characters,
               const std::filesystem::path& folder)
    : cached_(crowd),
      index_(index),
      fields_(result_fields(crowd)),
      setups_(setups_of(crowd)),
      crowd_(setups_, sources_of(crowd), std::move(characters), 0, folder)
{
}

void Column::solve_frame(const ChunkGoals& goals, std::uint32_t frame)
{
    put_given(cached_, goals, frame, 0, crowd_);
    crowd_.write_inputs();
    crowd_.crowds().solve();
}

void Column::read_frame(std::uint32_t frame, Results& results) const
{
    for (std::size_t n = 0; n < fields_.size(); ++n)
        for (std::size_t limb = 0; limb < cached_.limbs.size(); ++limb) {
            if (!crowd_.crowds().has(limb, fields_[n].field)) continue;
            const std::size_t count = fields_[n].count();
            const std::size_t at = cached_.place(frame, limb, 0) * count;
            crowd_.crowds().read(limb, fields_[n].field, 0, crowd_.character_count(),
                                 {&results[n][at], count * sizeof(std::uint32_t)});
        }
}

void Column::restore(const Results& state)
{
    for (std::size_t n = 0; n < fields_.size(); ++n)
        for (std::size_t limb = 0; limb < cached_.limbs.size(); ++limb) {
            if (fields_[n].field != SWIVEL_NORMAL || !crowd_.crowds().has(limb, SWIVEL_NORMAL)) continue;
            const std::size_t count = fields_[n].count(), at = cached_.place(0, limb, 0) * count;
            crowd_.crowds().restore_normals(limb, std::span(state[n]).subspan(at, crowd_.character_count() * count));
        }
}

std::uint64_t Column::solve(std::uint32_t time, const ChunkGoals& goals, Results& results)
{
    std::vector<std::uint64_t> words;
    for (std::uint32_t frame = 0; frame < cached_.frames_in(time); ++frame) {
        crowd_.set_frame(time * cached_.chunk.frames + frame);
        solve_frame(goals, frame);
        read_frame(frame, results);
        const std::vector<std::uint64_t> of_frame = crowd_.crowds().digests();
        words.insert(words.end(), of_frame.begin(), of_frame.end());
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
            std::copy_n(&goals.pole[3 * at], 3, input.pole);
            std::copy_n(&goals.hand[4 * at], 4, input.hand);
            if (places) places->push_back({limb, first + n});
        }
}

std::vector<LimbSetup> setups_of(const CachedCrowd& crowd)
{
    std::vector<LimbSetup> setups;
    for (const CachedLimb& limb : crowd.limbs) setups.push_back(limb.setup);
    return setups;
}

std::vector<std::span<const goal_source>> sources_of(const CachedCrowd& crowd)
{
    std::vector<std::span<const goal_source>> sources;
    for (const CachedLimb& limb : crowd.limbs) sources.push_back(limb.sources);
    return sources;
}

Results empty_results(const CachedCrowd& crowd)
{
    Results results;
    const std::size_t limbs = std::size_t{crowd.chunk.frames} * crowd.limbs.size() * crowd.chunk.characters;
    for (const ResultField& field : result_fields(crowd))
        results.emplace_back(limbs * field.count(), field.field == SWIVEL_FLAGS ? 0 : kNoNumber);
    return results;
}

}  // namespace swivel::tools

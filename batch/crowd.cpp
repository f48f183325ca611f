// SPDX-License-Identifier: MIT
#include "batch/crowd.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <new>

#include "batch/sized.h"
#include "batch/solve.h"
#include "batch/streams.h"
#include "simd/dispatch.h"
#include "simd/float_env.h"
#include "simd/rows.h"

namespace swivel {

namespace {

constexpr std::size_t kAlignment = 64;

constexpr std::uint64_t aligned(std::uint64_t bytes) { return (bytes + kAlignment - 1) / kAlignment * kAlignment; }

RestFrames rest_frames(const swivel_binding& binding)
{
    RestFrames frames;
    const auto copy = [](const float(&from)[4], float(&to)[4]) { std::copy_n(from, 4, to); };
    copy(binding.parent_from_arm, frames.parent_from_arm);
    copy(binding.upper_from_arm, frames.upper_from_arm);
    copy(binding.elbow_parent_from_arm, frames.elbow_parent_from_arm);
    copy(binding.fore_from_arm, frames.fore_from_arm);
    copy(binding.wrist_parent_from_arm, frames.wrist_parent_from_arm);
    copy(binding.shoulder_rest, frames.shoulder_rest);
    copy(binding.elbow_rest, frames.elbow_rest);
    copy(binding.wrist_rest, frames.wrist_rest);
    for (std::size_t n = 0; n < kMostTwistBones; ++n) {
        copy(binding.twist_parent_from_arm[n], frames.twist_parent_from_arm[n]);
        copy(binding.twist_from_arm[n], frames.twist_from_arm[n]);
    }
    return frames;
}

std::uint32_t blocks_of(const swivel_group_def& group) { return (group.limb_count - 1) / SWIVEL_LANES + 1; }

struct Layout {
    std::uint32_t block_count;
    std::uint64_t groups, chosen, urgency, done, input, results,
        end;  // byte offsets in the arena, also of one too large

    explicit Layout(const swivel_crowd_def& def) : block_count(0)
    {
        for (std::uint32_t g = 0; g < def.group_count; ++g) block_count += blocks_of(group_at(def, g));
        const std::uint64_t blocks = block_count, words = mask_word_count(block_count);
        groups = aligned(sizeof(swivel_crowd));
        chosen = groups + aligned(std::uint64_t{def.group_count} * sizeof(Group));
        urgency = chosen + aligned(words * sizeof(std::uint32_t));
        done = urgency + (def.features & feature::budget ? aligned(blocks * sizeof(float)) : 0);
        input = done + aligned(blocks);
        results = input + blocks * kInputRowBytes * input_row_count(def.features);
        end = results + aligned(blocks * result_row_bytes(def.features) * result_row_count(def.features));
    }
};

void fill_field(const swivel_crowd& crowd, Field field, std::initializer_list<float> values)
{
    const std::uint32_t first = field_first_row(crowd.features, field);
    if (field_row_count(crowd.features, field) == 0) return;
    for (std::uint32_t block = 0; block < crowd.block_count; ++block) {
        float* row = crowd.input + row_offset(std::size_t{block} * SWIVEL_LANES, crowd.input_row_count, first);
        for (const float value : values) row = std::fill_n(row, std::size_t{SWIVEL_LANES}, value);
    }
}

// Fills every lane, also of the padding, with an ordinary arm and with inputs that change nothing.
void fill_inputs(const swivel_crowd& crowd)
{
    fill_field(crowd, Field::target, {0, 0, 2});
    fill_field(crowd, Field::pole, {0, -1, 0});
    fill_field(crowd, Field::lengths, {1, 1});
    fill_field(crowd, Field::parent_rotation, {0, 0, 0, 1});
    fill_field(crowd, Field::parent_scale, {1});
    fill_field(crowd, Field::hand, {0, 0, 0, 1});

    // No turn, all of the goal, no limit. A range: its middle 0, half its width pi.
    fill_field(crowd, Field::angle, {1, 0});
    for (const Field q : {Field::incoming_shoulder, Field::incoming_elbow, Field::incoming_wrist})
        fill_field(crowd, q, {0, 0, 0, 1});
    fill_field(crowd, Field::weights, {1, 1, 1});
    fill_field(crowd, Field::reach, {0, 0, 1, 0});
    fill_field(crowd, Field::most_swivel, {-1, 0});
    fill_field(crowd, Field::flexion_limit, {1, 0});
    for (const Field cone : {Field::shoulder_cone, Field::hand_cone}) fill_field(crowd, cone, {0, 0, 1, -1});
    for (const Field twist : {Field::humeral_twist, Field::forearm_twist}) fill_field(crowd, twist, {1, 0, -1, 0});
    fill_field(crowd, Field::hand_twist, {0, 0, 1, 1, 0, -1, 0});
    for (const Field box : {Field::shoulder_box, Field::wrist_box})
        fill_field(crowd, box, {1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1, 0});
    fill_field(crowd, Field::aim, {0, 0, 1, 1, 0});
}

// Gives a group's limbs NaN for inputs without a sensible default. So they are bad input until the caller gives them.
void unknown_inputs(const swivel_crowd& crowd, const Group& group)
{
    constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
    constexpr float unknown[] = {kUnknown, kUnknown, kUnknown};
    const auto start = [&](Field field, const float* value) {
        copy_in(rows_of(crowd, group, field), 0, group.limb_count, {value, 0});
    };
    start(Field::target, unknown);
    start(Field::lengths, crowd.features & feature::joints ? group.binding.lengths : unknown);
    if (crowd.features & feature::world) start(Field::shoulder_position, unknown);
}

// Copies the first lane of each row of the first block to all lanes of this row, in all blocks of the run.
template <class Word>
void spread(Word* rows, std::uint32_t row_count, std::uint32_t block_count)
{
    for (std::uint32_t block = block_count; block-- > 0;)
        for (std::uint32_t row = 0; row < row_count; ++row)
            std::fill_n(rows + (std::size_t{block} * row_count + row) * SWIVEL_LANES, std::size_t{SWIVEL_LANES},
                        rows[std::size_t{row} * SWIVEL_LANES]);
}

// Puts a group's limbs into their rest pose. The kernel does so, because their inputs are bad. Limbs that were never
// solved have no flag.
void rest(const swivel_crowd& crowd, const Group& group)
{
    const FloatEnv env;
    solve_group(crowd, find_isa("scalar")->kernels, group, group.first_block, 1);
    const std::size_t first = row_offset(std::size_t{group.first_block} * SWIVEL_LANES, crowd.result_row_count, 0);
    const std::size_t flags = std::size_t{field_first_row(crowd.features, Field::flags)} * SWIVEL_LANES;
    if (crowd.words) {
        crowd.words[first + flags] = crowd.words[first + flags + SWIVEL_LANES] = 0;
        spread(crowd.words + first, crowd.result_row_count, group.block_count);
    } else {
        crowd.results[first + flags] = 0;
        spread(crowd.results + first, crowd.result_row_count, group.block_count);
    }
}

}  // namespace

swivel_group_def group_at(const swivel_crowd_def& def, std::uint32_t g)
{
    return element(def.groups, g, swivel_default_group_def(0));
}

std::uint64_t crowd_bytes(const swivel_crowd_def& def) { return Layout(def).end; }

swivel_crowd* place_crowd(const swivel_crowd_def& def, void* arena)
{
    const Layout layout(def);
    char* const base = static_cast<char*>(arena);
    std::memset(base, 0, static_cast<std::size_t>(layout.end));
    Group* const groups = reinterpret_cast<Group*>(base + layout.groups);
    std::uint32_t first_block = 0;
    for (std::uint32_t g = 0; g < def.group_count; ++g) {
        const swivel_group_def from = group_at(def, g);
        const std::uint32_t block_count = blocks_of(from);
        new (groups + g) Group{first_block, block_count, from.limb_count, from.binding, rest_frames(from.binding)};
        first_block += block_count;
    }

    const bool compact = def.features & feature::compact, budget = def.features & feature::budget;
    char* const results = base + layout.results;
    swivel_crowd* const crowd =
        new (base) swivel_crowd{def.features,
                                def.group_count,
                                layout.block_count,
                                input_row_count(def.features),
                                result_row_count(def.features),
                                {},
                                def.shoulder_order,
                                def.wrist_order,
                                groups,
                                reinterpret_cast<float*>(base + layout.input),
                                compact ? nullptr : reinterpret_cast<float*>(results),
                                compact ? reinterpret_cast<std::uint16_t*>(results) : nullptr,
                                arena,
                                static_cast<std::size_t>(layout.end),
                                nullptr,
                                nullptr,
                                {},
                                reinterpret_cast<std::uint32_t*>(base + layout.chosen),
                                budget ? reinterpret_cast<float*>(base + layout.urgency) : nullptr,
                                reinterpret_cast<std::uint8_t*>(base + layout.done)};

    for (std::size_t f = 0; f < kFieldCount; ++f)
        crowd->first_row[f] =
            static_cast<std::uint16_t>(field_first_row(def.features & ~feature::compact, static_cast<Field>(f)));

    fill_inputs(*crowd);
    for (std::uint32_t g = 0; g < def.group_count; ++g) {
        unknown_inputs(*crowd, groups[g]);
        rest(*crowd, groups[g]);
    }
    return crowd;
}

}  // namespace swivel

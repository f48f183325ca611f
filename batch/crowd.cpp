// SPDX-License-Identifier: MIT
#include "batch/crowd.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <new>

#include "simd/rows.h"

namespace swivel {

namespace {

constexpr std::size_t kAlignment = 64;

constexpr std::size_t aligned(std::size_t bytes) { return (bytes + kAlignment - 1) / kAlignment * kAlignment; }

std::uint32_t blocks_of(const swivel_group_def& group) { return (group.limb_count - 1) / SWIVEL_LANES + 1; }

struct Layout {
    std::uint32_t block_count;
    std::size_t groups, chosen, urgency, input, results, end;  // byte offsets in the arena

    explicit Layout(const swivel_crowd_def& def) : block_count(0)
    {
        for (std::uint32_t g = 0; g < def.group_count; ++g) block_count += blocks_of(def.groups[g]);
        groups = aligned(sizeof(swivel_crowd));
        chosen = groups + aligned(def.group_count * sizeof(Group));
        urgency = chosen + aligned(mask_word_count(block_count) * sizeof(std::uint32_t));
        input = urgency + (def.features & SWIVEL_BUDGET ? aligned(block_count * sizeof(float)) : 0);
        results = input + block_count * kInputRowBytes * input_row_count(def.features);
        end = results + aligned(block_count * result_row_bytes(def.features) * result_row_count(def.features));
    }
};

void fill_field(const swivel_crowd& crowd, swivel_field field, std::initializer_list<float> values)
{
    const std::uint32_t first = field_first_row(crowd.features, field);
    if (field_row_count(crowd.features, field) == 0) return;
    for (std::uint32_t block = 0; block < crowd.block_count; ++block) {
        float* row = crowd.input + row_offset(std::size_t{block} * SWIVEL_LANES, crowd.input_row_count, first);
        for (const float value : values) row = std::fill_n(row, std::size_t{SWIVEL_LANES}, value);
    }
}

}  // namespace

std::size_t crowd_bytes(const swivel_crowd_def& def) { return Layout(def).end; }

swivel_crowd* place_crowd(const swivel_crowd_def& def, void* arena)
{
    const Layout layout(def);
    char* const base = static_cast<char*>(arena);
    std::memset(base, 0, layout.end);
    Group* const groups = reinterpret_cast<Group*>(base + layout.groups);
    std::uint32_t first_block = 0;
    for (std::uint32_t g = 0; g < def.group_count; ++g) {
        const std::uint32_t block_count = blocks_of(def.groups[g]);
        new (groups + g) Group{first_block, block_count, def.groups[g].limb_count, def.groups[g].binding};
        first_block += block_count;
    }

    const bool compact = def.features & SWIVEL_COMPACT, budget = def.features & SWIVEL_BUDGET;
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
                                layout.end,
                                nullptr,
                                nullptr,
                                {},
                                reinterpret_cast<std::uint32_t*>(base + layout.chosen),
                                budget ? reinterpret_cast<float*>(base + layout.urgency) : nullptr};

    for (int f = 0; f < SWIVEL_FIELD_COUNT; ++f)
        crowd->first_row[f] = static_cast<std::uint16_t>(
            field_first_row(def.features & ~std::uint32_t{SWIVEL_COMPACT}, static_cast<swivel_field>(f)));

    fill_field(*crowd, SWIVEL_TARGET, {0, 0, 2});
    fill_field(*crowd, SWIVEL_POLE, {0, -1, 0});
    fill_field(*crowd, SWIVEL_LENGTHS, {1, 1});
    fill_field(*crowd, SWIVEL_PARENT_ROTATION, {0, 0, 0, 1});
    fill_field(*crowd, SWIVEL_PARENT_SCALE, {1});
    fill_field(*crowd, SWIVEL_HAND, {0, 0, 0, 1});

    // What changes nothing: no turn, all of the goal, no limit. A range: its middle 0, half its width pi.
    fill_field(*crowd, SWIVEL_ANGLE, {1, 0});
    for (const swivel_field q : {SWIVEL_INCOMING_SHOULDER, SWIVEL_INCOMING_ELBOW, SWIVEL_INCOMING_WRIST})
        fill_field(*crowd, q, {0, 0, 0, 1});
    fill_field(*crowd, SWIVEL_WEIGHTS, {1, 1, 1});
    fill_field(*crowd, SWIVEL_REACH, {0, 0, 1, 0});
    fill_field(*crowd, SWIVEL_MOST_SWIVEL, {-1, 0});
    fill_field(*crowd, SWIVEL_FLEXION_LIMIT, {1, 0});
    for (const swivel_field cone : {SWIVEL_SHOULDER_CONE, SWIVEL_HAND_CONE}) fill_field(*crowd, cone, {0, 0, 1, -1});
    for (const swivel_field twist : {SWIVEL_HUMERAL_TWIST, SWIVEL_FOREARM_TWIST})
        fill_field(*crowd, twist, {1, 0, -1, 0});
    fill_field(*crowd, SWIVEL_HAND_TWIST, {0, 0, 1, 1, 0, -1, 0});
    for (const swivel_field box : {SWIVEL_SHOULDER_BOX, SWIVEL_WRIST_BOX})
        fill_field(*crowd, box, {1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1, 0});
    fill_field(*crowd, SWIVEL_AIM, {0, 0, 1, 1, 0});
    return crowd;
}

}  // namespace swivel

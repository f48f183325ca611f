// SPDX-License-Identifier: MIT
#include "batch/solve/group_copies.h"

#include <algorithm>
#include <bit>

#include "core/num.h"
#include "simd/rows.h"

namespace swivel {

namespace {

// The fields of a limb often share cache lines. Values that are a multiple of half a kilobyte apart fall on few places
// of a cache. The lines of a whole run then do not stay there, so two blocks of all fields are copied at a time. That
// took 0.8 of the time there, and 1.06 where it is not needed.
constexpr std::size_t kCrowdedStride = 512;
constexpr std::uint32_t kCrowdedBlocks = 2;

// Calls copy(first, limb_count) for the limbs of lanes(block) in some blocks of a group, counted within the group.
template <class Lanes, class Copy>
void for_some_limbs(GroupBlocks blocks, const Lanes& lanes_in, const Copy& copy)
{
    std::size_t first = std::size_t{blocks.first} * SWIVEL_LANES;
    std::size_t begin = first, end = first;  // limbs that lie side by side, not yet copied
    for (std::uint32_t block = blocks.first; block < blocks.first + blocks.count; ++block, first += SWIVEL_LANES) {
        LaneMask lanes = lanes_in(block);
        for (std::size_t limb = first; lanes != 0;) {
            const int skipped = std::countr_zero(lanes), taken = std::countr_one(lanes >> skipped);
            limb += static_cast<std::size_t>(skipped);
            if (limb > end) {
                if (begin < end) copy(begin, end - begin);
                begin = limb;
            }
            limb += static_cast<std::size_t>(taken);
            end = limb;
            lanes >>= skipped + taken;
        }
    }
    if (begin < end) copy(begin, end - begin);
}

// The lanes of a group's block whose limbs have bad input.
LaneMask bad_lanes(const Group& group, std::uint32_t block)
{
    const float* const flags = group.results + row_offset(std::size_t{block} * SWIVEL_LANES, group.result_row_count,
                                                          group.first_row[index_of(SWIVEL_FLAGS)]);
    LaneMask lanes = 0;
    for (std::uint32_t lane = 0; lane < SWIVEL_LANES; ++lane)
        lanes |= (bit_cast<std::uint32_t>(flags[lane]) & SWIVEL_BAD_INPUT ? 1u : 0u) << lane;
    return lanes;
}

Stream* add_input(const Group& group, const swivel_streams& given, const swivel_stream& each, Stream* next)
{
    const FieldRows rows = rows_of(group, each.field);
    const swivel_in values{each.data, each.stride};
    if (!given.origin.data || !is_position(each.field)) return streams_in(rows, 0, values, next);
    const swivel_in origin = has_origin(group, each.field) ? given.origin : swivel_in{};
    return streams_of_doubles(rows, 0, values, origin, next);
}
void copy_chosen(const Group& group, const Stream* from, const Stream* end, const std::uint32_t* mask, GroupBlocks some)
{
    if (mask) {
        for_some_limbs(
            some, [&](std::uint32_t block) { return chosen_limbs(group, block, mask); },
            [&](std::size_t limb, std::size_t limb_count) { copy(from, end, limb, limb_count); });
    } else {
        const std::size_t limb = std::size_t{some.first} * SWIVEL_LANES, room = std::size_t{some.count} * SWIVEL_LANES;
        copy(from, end, limb, std::min(room, group.limb_count - limb));
    }
}

// Calls copy(part) for a few of some blocks at a time.
template <class Copy>
void in_parts(const GroupCopies& copies, GroupBlocks some, const Copy& copy)
{
    for (std::uint32_t done = 0; done < some.count; done += copies.copied_blocks)
        copy(GroupBlocks{some.first + done, std::min(copies.copied_blocks, some.count - done)});
}

}  // namespace

std::uint32_t stream_count_of(const Group& group, const swivel_streams& given)
{
    std::uint32_t count = 0;
    for (const swivel_stream& each : fields_of(given))
        if (each.data) count += stream_count(field_row_count(group.features, each.field));
    return count;
}

Stream* GroupCopies::set(const GroupStreams& from, std::uint32_t max_blocks, Stream* first)
{
    group = from.group;
    blocks = from.blocks;
    streams = first;
    Stream* next = first;
    for (const swivel_stream& each : fields_of(from.given))
        if (each.data && is_input(each.field)) next = add_input(*group, from.given, each, next);
    in_end = next;
    for (const bool is_flags : {false, true}) {
        for (const swivel_stream& each : fields_of(from.given))
            if (each.data && !is_input(each.field) && (each.field == SWIVEL_FLAGS) == is_flags)
                next = streams_out(rows_of(*group, each.field), 0, {each.data, each.stride}, next);
        (is_flags ? out_end : kept_end) = next;
    }
    const bool is_crowded = std::any_of(streams, out_end, [](const Stream& stream) {
        return stream.stride > 0 && stream.stride % kCrowdedStride == 0;
    });
    copied_blocks = is_crowded ? kCrowdedBlocks : max_blocks;
    return out_end;
}

void GroupCopies::copy_in(const std::uint32_t* mask, GroupBlocks some) const
{
    in_parts(*this, some, [&](GroupBlocks part) { copy_chosen(*group, streams, in_end, mask, part); });
}

void GroupCopies::copy_out(const std::uint32_t* mask, GroupBlocks some) const
{
    const auto good = [&](std::uint32_t block) {
        return chosen_limbs(*group, block, mask) & ~bad_lanes(*group, block);
    };
    in_parts(*this, some, [&](GroupBlocks part) {
        if (!group->keeps_pose) return copy_chosen(*group, in_end, out_end, mask, part);
        for_some_limbs(part, good,
                       [&](std::size_t limb, std::size_t limb_count) { copy(in_end, kept_end, limb, limb_count); });
        copy_chosen(*group, kept_end, out_end, mask, part);
    });
}

}  // namespace swivel

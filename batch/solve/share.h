// SPDX-License-Identifier: MIT
//
// A group's frame on its way into its rows and back: the copies of a run of blocks. If limbs are chosen, only these are
// copied.
#pragma once

#include "batch/crowd/streams.h"
#include "batch/solve/frame.h"
#include "batch/solve/solve.h"

namespace swivel {

// Streams of a frame that has every field, or of four ordinary ones.
constexpr std::uint32_t kMaxStreams = [] {
    std::uint32_t count = 0;
    for (const FieldRow& row : kFields) count += stream_count(field_row_count(kEveryFeature, row.field));
    return count;
}();

// A group's blocks among those of the job, and its frame.
struct GroupFrame {
    const Group* group;
    GroupBlocks blocks;
    swivel_frame frame;
};

std::uint32_t stream_count_of(const Group& group, const swivel_frame& frame);

// One group's share of a round: its blocks, and the copies of its frame. Inputs come first; then results, of which
// limbs that keep their pose get only the last, the flags.
struct Share {
    const Group* group;
    GroupBlocks blocks;
    std::uint32_t copied_blocks;  // at a time
    Stream *streams, *in_end, *kept_end, *out_end;

    // Stores the streams from `to` on, and returns their end. run: the most blocks that are copied at a time.
    Stream* set(const GroupFrame& group_frame, std::uint32_t run, Stream* to);
    // Some blocks of the group, the limbs of a mask or all.
    void copy_in(const std::uint32_t* mask, GroupBlocks some) const;
    void copy_out(const std::uint32_t* mask, GroupBlocks some) const;
};

}  // namespace swivel

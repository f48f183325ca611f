// SPDX-License-Identifier: MIT
//
// A group's streams on their way into its rows and back: the copies of a run of blocks. If limbs are chosen, only these
// are copied.
#pragma once

#include "batch/crowd/streams.h"
#include "batch/solve/solve.h"
#include "batch/solve/streams_of.h"

namespace swivel {

// Streams of a group that lists every field, or of four ordinary ones.
constexpr std::uint32_t kMaxStreams = [] {
    std::uint32_t count = 0;
    for (const FieldRow& row : kFields) count += stream_count(field_row_count(kEveryFeature, row.field));
    return count;
}();

// A group's blocks among those of the job, and its streams.
struct GroupStreams {
    const Group* group;
    GroupBlocks blocks;
    swivel_streams given;
};

std::uint32_t stream_count_of(const Group& group, const swivel_streams& given);

// One group's share of a round: its blocks, and the copies of its streams. Inputs come first; then results, of which
// limbs that keep their pose get only the last, the flags.
struct Share {
    const Group* group;
    GroupBlocks blocks;
    std::uint32_t copied_blocks;  // at a time
    Stream *streams, *in_end, *kept_end, *out_end;

    // Stores the streams from `to` on, and returns their end. run: the most blocks that are copied at a time.
    Stream* set(const GroupStreams& from, std::uint32_t run, Stream* to);
    // Some blocks of the group, the limbs of a mask or all.
    void copy_in(const std::uint32_t* mask, GroupBlocks some) const;
    void copy_out(const std::uint32_t* mask, GroupBlocks some) const;
};

}  // namespace swivel

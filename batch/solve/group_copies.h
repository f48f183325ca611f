// SPDX-License-Identifier: MIT
//
// Copies a group's streams into its rows, and results back. If limbs are chosen, only these are copied.
#pragma once

#include "batch/crowd/streams.h"
#include "batch/solve/work.h"

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

// A group's blocks, and the copies of its streams. Inputs come first; then results. Limbs that keep their pose give
// only the last result, the flags.
struct GroupCopies {
    const Group* group;
    GroupBlocks blocks;
    std::uint32_t copied_blocks;  // at a time
    Stream *streams, *in_end, *kept_end, *out_end;

    // Stores the streams from `first` on, and returns their end. At most max_blocks blocks are copied at a time.
    Stream* set(const GroupStreams& from, std::uint32_t max_blocks, Stream* first);
    // These copy some blocks of the group, the limbs of a mask or all.
    void copy_in(const std::uint32_t* mask, GroupBlocks some) const;
    void copy_out(const std::uint32_t* mask, GroupBlocks some) const;
};

}  // namespace swivel

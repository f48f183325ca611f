// SPDX-License-Identifier: MIT
//
// The whole frame. A few blocks at a time are copied in, solved and copied out, while their rows are in the nearest
// cache. If limbs are chosen, only these are.
#include "batch/frame.h"

#include <algorithm>
#include <bit>

#include "batch/lane_mask.h"
#include "batch/solve.h"
#include "batch/streams.h"
#include "simd/rows.h"

namespace swivel {

namespace {

// The rows of a run stay in a level 1 cache of 32 KiB. A run is so long that loading the kernels' constants does not
// count. 4 to 16 blocks took the same time within 3 %.
constexpr std::uint32_t kRunBlocks = 8;
// With chosen limbs, a run is longer, so that single limbs of several blocks are solved together.
constexpr std::uint32_t kChosenRunBlocks = 64;
// Copies field after field, for two blocks at a time. The fields of a limb often share cache lines. If values are a
// kilobyte apart, they fall on so few places of a cache that the lines of 8 blocks do not stay. There this took 0.8 of
// the time, and 1.03 where values lie close.
constexpr std::size_t kCopyLimbs = 2 * SWIVEL_LANES;

// Values from limb first on.
swivel_in from(const swivel_in& values, std::size_t first)
{
    if (!values.data) return values;
    return {static_cast<const char*>(values.data) + first * values.stride, values.stride};
}

// The copies of one group's frame, its null members left out.
struct Copies {
    struct In {
        FieldRows rows;
        swivel_in values, origin;
        bool doubles;
    } in[kInputCount];
    struct Out {
        FieldRows rows;
        swivel_out values;
    } out[kFieldCount - kInputCount];
    std::size_t in_count = 0, out_count = 0;

    Copies(const swivel_crowd& crowd, const Group& group, const swivel_frame& frame)
    {
        for (const FrameInput& input : kFrameInputs)
            if (const swivel_in& values = frame.*input.member; values.data)
                in[in_count++] = {rows_of(crowd, group, input.field), values,
                                  has_origin(crowd.features, input.field) ? frame.origin : swivel_in{},
                                  frame.origin.data && is_position(input.field)};
        for (const FrameOutput& output : kFrameOutputs)
            if (const swivel_out& values = frame.*output.member; values.data)
                out[out_count++] = {rows_of(crowd, group, output.field), values};
    }

    void read(std::size_t first, std::size_t limb_count) const
    {
        for (std::size_t n = 0; n < in_count; ++n) {
            const swivel_in values = from(in[n].values, first);
            if (in[n].doubles)
                copy_doubles_in(in[n].rows, first, limb_count, values, from(in[n].origin, first));
            else
                copy_in(in[n].rows, first, limb_count, values);
        }
    }
    void write(std::size_t first, std::size_t limb_count) const
    {
        for (std::size_t n = 0; n < out_count; ++n) {
            const auto& [data, stride] = out[n].values;
            copy_out(out[n].rows, first, limb_count, {static_cast<char*>(data) + first * stride, stride});
        }
    }
};

// Calls copy(first, limb_count) for a group's limbs in a run of blocks, counted within the group: all of them, or those
// of the mask.
template <class Copy>
void for_each_limbs(const Group& group, const std::uint32_t* mask, std::uint32_t block, std::uint32_t block_count,
                    const Copy& copy)
{
    const std::size_t first = std::size_t{block - group.first_block} * SWIVEL_LANES;
    if (!mask) {
        const std::size_t end =
            std::min(first + std::size_t{block_count} * SWIVEL_LANES, std::size_t{group.limb_count});
        for (std::size_t n = first; n < end; n += kCopyLimbs) copy(n, std::min(kCopyLimbs, end - n));
        return;
    }
    for (std::uint32_t k = 0; k < block_count; ++k) {
        LaneMask lanes = lanes_of(mask, block + k) & lanes_of_limbs(group, block + k);
        for (std::size_t lane = first + std::size_t{k} * SWIVEL_LANES; lanes != 0;) {
            const int skipped = std::countr_zero(lanes), taken = std::countr_one(lanes >> skipped);
            copy(lane + static_cast<std::size_t>(skipped), static_cast<std::size_t>(taken));
            lane += static_cast<std::size_t>(skipped + taken);
            lanes >>= skipped + taken;
        }
    }
}

}  // namespace

void solve_frame_group(const swivel_crowd& crowd, const Kernels& kernels, const Group& group, const swivel_frame& frame,
                       const std::uint32_t* mask, std::uint32_t first_block, std::uint32_t block_count)
{
    const Copies copies(crowd, group, frame);
    const std::uint32_t most = mask ? kChosenRunBlocks : kRunBlocks;
    for (std::uint32_t done = 0; done < block_count; done += most) {
        const std::uint32_t block = first_block + done, run = std::min(most, block_count - done);
        for_each_limbs(group, mask, block, run, [&](std::size_t n, std::size_t count) { copies.read(n, count); });
        if (mask)
            solve_chosen_group(crowd, kernels, group, mask, block, run);
        else
            solve_group(crowd, kernels, group, block, run);
        for_each_limbs(group, mask, block, run, [&](std::size_t n, std::size_t count) { copies.write(n, count); });
    }
}

}  // namespace swivel

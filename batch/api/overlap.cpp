// SPDX-License-Identifier: MIT
//
// Finds results in streams that overlap inputs of other limbs, for builds with SWIVEL_CHECK_USE. It knows strides that
// are equal, and values that all limbs share.
#include <cstdint>

#include "batch/api/job_check.h"
#include "batch/refusal/status.h"
#include "batch/solve/pose.h"
#include "batch/solve/solve.h"
#include "batch/solve/streams_of.h"
#include "simd/rows.h"

namespace swivel {

namespace {

// A field's values in the caller's array: the first one's address, bytes between them, bytes of one.
struct FrameValue {
    std::int64_t at, stride, bytes, limb_count;
    std::uint32_t group;
    const char* name;
};

// Whether a value of `out` overlaps a value of `in` that is another limb's.
bool overlaps(const FrameValue& out, const FrameValue& in)
{
    if (in.stride != 0 && in.stride != out.stride) return false;
    const std::int64_t apart = in.at - out.at, step = out.stride;
    const std::int64_t min = 1 - out.limb_count, max = in.stride == 0 ? 0 : in.limb_count - 1;
    // Limb i + k of `in` overlaps limb i of `out` if -in.bytes < apart + k step < out.bytes.
    std::int64_t k = (-in.bytes - apart) / step - 1;
    while (apart + k * step <= -in.bytes) ++k;
    for (; apart + k * step < out.bytes; ++k) {
        const bool is_own = k == 0 && in.group == out.group && (in.stride != 0 || in.limb_count == 1);
        if (k >= min && k <= max && !is_own) return true;
    }
    return false;
}

// Calls take(value, is_input) for all values of a job's streams.
template <class Take>
void for_each_value(const swivel_crowd& crowd, const swivel_job& job, swivel_blocks blocks, const Take& take)
{
    for_each_group(crowd, job.groups, blocks, [&](const Group& group, GroupBlocks, std::uint32_t n) {
        swivel_streams streams = streams_at(job.streams, n);
        if (job.pose) streams.origin = origin_of(full_pose(job.pose));
        const auto value = [&](const void* data, std::size_t stride, std::size_t bytes, const char* name) {
            return FrameValue{static_cast<std::int64_t>(reinterpret_cast<std::uintptr_t>(data)),
                              // The stride of one value alone may be anything.
                              static_cast<std::int64_t>(stride == 0 || group.limb_count > 1 ? stride : bytes),
                              static_cast<std::int64_t>(bytes), group.limb_count,
                              static_cast<std::uint32_t>(&group - crowd.groups), name};
        };
        if (streams.origin.data)
            take(value(streams.origin.data, streams.origin.stride, 3 * sizeof(double), "origin"), true);
        for (const swivel_stream& each : fields_of(streams)) {
            const bool is_double = streams.origin.data && is_position(each.field);
            const std::size_t bytes =
                field_row_count(group.features, each.field) * (is_double ? sizeof(double) : sizeof(float));
            if (each.data) take(value(each.data, each.stride, bytes, name_of(each.field)), is_input(each.field));
        }
    });
}

}  // namespace

swivel_status check_overlap(const swivel_crowd& crowd, const swivel_job& job, swivel_blocks blocks)
{
    swivel_status status = SWIVEL_OK;
    for_each_value(crowd, job, blocks, [&](const FrameValue& out, bool is_input) {
        if (is_input) return;
        for_each_value(crowd, job, blocks, [&](const FrameValue& in, bool is_also_input) {
            if (is_also_input && status == SWIVEL_OK && overlaps(out, in))
                status = fail(SWIVEL_INVALID_ARGUMENT,
                              "streams: group %u's %s overlaps another limb's input, group %u's %s; give it a place of "
                              "its own",
                              out.group, out.name, in.group, in.name);
        });
    });
    return status;
}

}  // namespace swivel

// SPDX-License-Identifier: MIT
//
// Finds results of a job, in streams or in its pose, that overlap each other or inputs that are not their own, for
// builds with SWIVEL_CHECK_USE. It knows strides of which one is a multiple of the other, and values that all limbs
// share.
#include <algorithm>
#include <cstdint>
#include <cstdio>

#include "batch/api/check.h"
#include "batch/api/pose_arrays.h"
#include "batch/refusal/status.h"
#include "batch/solve/work.h"
#include "simd/rows.h"

namespace swivel {

namespace {

constexpr std::uint32_t kOfPose = UINT32_MAX, kNoJoint = UINT32_MAX;

// Values in the caller's array, one for each limb or body: a field's, or those of the pose or of one of its joints.
struct LimbValues {
    std::int64_t at, stride, bytes, count;  // at: the first one's address; count: 1 where all limbs share it
    bool is_result, is_shared;
    std::uint32_t group, joint;  // group: or kOfPose
    std::uint32_t array;         // a field's place in the table, or a PoseKind
    const char* name;

    std::int64_t end() const { return at + (count - 1) * stride + bytes; }
    bool is_same_array(const LimbValues& other) const
    {
        return group == other.group && joint == other.joint && array == other.array;
    }
    // Whether a solve reads a limb's value here before it writes the limb's result. It reads all inputs of a group's
    // limb first, and of a pose the value of the same joint: other joints that only move along are read late.
    bool is_input_of(const LimbValues& result) const
    {
        if (is_result || is_shared || group != result.group) return false;
        return group != kOfPose || is_same_array(result);
    }
    void print(char (&text)[96]) const
    {
        if (group != kOfPose)
            std::snprintf(text, sizeof text, "group %u's %s", group, name);
        else if (joint != kNoJoint)
            std::snprintf(text, sizeof text, "joint %u of the pose's %s", joint, name);
        else
            std::snprintf(text, sizeof text, "the pose's %s", name);
    }
};

// Whether a value of one array overlaps one of the other, which has `per` values in each stride of the first. is_own:
// the two values of one limb may overlap.
bool overlaps(const LimbValues& sparse, const LimbValues& dense, std::int64_t per, bool is_own)
{
    const std::int64_t apart = dense.at - sparse.at, step = dense.stride;
    // Value per * i + k of `dense` overlaps value i of `sparse` if -dense.bytes < apart + k step < sparse.bytes.
    std::int64_t k = (-dense.bytes - apart) / step - 1;
    while (apart + k * step <= -dense.bytes) ++k;
    for (; apart + k * step < sparse.bytes; ++k) {
        const std::int64_t first = k < 0 ? (per - 1 - k) / per : 0,
                           last = std::min(sparse.count, (dense.count - 1 - k) / per + 1) - 1;
        if (k >= dense.count || first > last) continue;
        const bool is_one_limb = per == 1 ? k == 0 : first == last && per * first + k == first;
        if (!is_own || !is_one_limb) return true;
    }
    return false;
}
// Whether a result overlaps another value.
bool overlaps(LimbValues result, LimbValues other)
{
    if (result.is_same_array(other) && other.is_result) return false;
    if (result.end() <= other.at || other.end() <= result.at) return false;
    // The stride of one value alone may be anything.
    if (result.count == 1) result.stride = other.count == 1 ? result.bytes : other.stride;
    if (other.count == 1) other.stride = result.stride;
    const bool is_own = other.is_input_of(result);
    if (result.stride % other.stride == 0) return overlaps(result, other, result.stride / other.stride, is_own);
    if (other.stride % result.stride == 0) return overlaps(other, result, other.stride / result.stride, is_own);
    return false;
}

LimbValues values_of(const void* data, std::size_t stride, std::size_t bytes, std::uint32_t limb_count,
                     const char* name)
{
    const bool is_one = stride == 0 || limb_count == 1;
    return {static_cast<std::int64_t>(reinterpret_cast<std::uintptr_t>(data)),
            static_cast<std::int64_t>(is_one ? bytes : stride),
            static_cast<std::int64_t>(bytes),
            is_one ? 1 : limb_count,
            false,
            stride == 0 && limb_count > 1,
            kOfPose,
            kNoJoint,
            0,
            name};
}

// Calls take(values) for all values of a job's streams.
template <class Take>
void for_each_streamed(const swivel_crowd& crowd, const swivel_job& job, swivel_blocks blocks, const Take& take)
{
    if (!job.streams) return;
    for_each_group(crowd, job.groups, blocks, [&](const Group& group, GroupBlocks, std::uint32_t n) {
        swivel_streams streams = streams_at(job.streams, n);
        if (job.pose) streams.origin = origin_of(full_pose(job.pose));
        const auto take_values = [&](const void* data, std::size_t stride, std::size_t bytes, std::size_t array,
                                     const char* name, bool is_result) {
            LimbValues values = values_of(data, stride, bytes, group.limb_count, name);
            values.group = static_cast<std::uint32_t>(&group - crowd.groups);
            values.array = static_cast<std::uint32_t>(array);
            values.is_result = is_result;
            take(values);
        };
        if (streams.origin.data)
            take_values(streams.origin.data, streams.origin.stride, 3 * sizeof(double), kFieldCount, "origin", false);
        for (const swivel_stream& each : fields_of(streams)) {
            const bool is_double = streams.origin.data && is_position(each.field);
            const std::size_t bytes =
                field_row_count(group.features, each.field) * (is_double ? sizeof(double) : sizeof(float));
            if (each.data)
                take_values(each.data, each.stride, bytes, index_of(each.field), name_of(each.field),
                            !is_input(each.field));
        }
    });
}
// Calls take(values) for all values of a job's pose that a solve may touch.
template <class Take>
void for_each_posed(const swivel_crowd& crowd, const swivel_job& job, const Take& take)
{
    if (!job.pose) return;
    const swivel_pose pose = full_pose(job.pose);
    const std::uint32_t body_count = crowd.groups[0].limb_count;
    for_each_array(pose, [&](const PoseArray& array) {
        for_each_joint(crowd, job.groups, pose, array.use, [&](std::uint32_t joint) {
            LimbValues values = values_of(static_cast<const char*>(array.values.data) + offset_of(array.values, joint),
                                          array.values.body_stride, array.bytes, body_count, array.name);
            values.is_result = array.use != PoseUse::read;
            values.joint = joint;
            values.array = static_cast<std::uint32_t>(array.kind);
            take(values);
        });
    });
    for (const BodyValues& each : values_of_bodies(pose))
        if (each.values.data) take(values_of(each.values.data, each.values.stride, each.bytes, body_count, each.name));
}
template <class Take>
void for_each_value(const swivel_crowd& crowd, const swivel_job& job, swivel_blocks blocks, const Take& take)
{
    for_each_streamed(crowd, job, blocks, take);
    for_each_posed(crowd, job, take);
}

}  // namespace

swivel_status check_overlap(const swivel_crowd& crowd, const swivel_job& job, swivel_blocks blocks)
{
    swivel_status status = SWIVEL_OK;
    for_each_value(crowd, job, blocks, [&](const LimbValues& result) {
        if (!result.is_result) return;
        for_each_value(crowd, job, blocks, [&](const LimbValues& other) {
            if (status != SWIVEL_OK || !overlaps(result, other)) return;
            char names[2][96];
            result.print(names[0]);
            other.print(names[1]);
            status = refuse("%s overlaps %s, %s; give it a place of its own", names[0],
                            other.is_result ? "another result" : "an input that is not its own", names[1]);
        });
    });
    return status;
}

}  // namespace swivel

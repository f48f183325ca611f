// SPDX-License-Identifier: MIT
//
// The frames of a job.
#pragma once

#include <span>

#include "batch/refusal/sized.h"
#include "include/swivel/swivel.h"

namespace swivel {

// Frame n of an array, and its fields.
inline swivel_frame frame_at(const swivel_frame* frames, std::size_t n)
{
    return element(frames, n, swivel_default_frame());
}
inline std::span<const swivel_frame_field> fields_of(const swivel_frame& frame)
{
    return {frame.fields, frame.field_count};
}

}  // namespace swivel

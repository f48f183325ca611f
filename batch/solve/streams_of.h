// SPDX-License-Identifier: MIT
//
// The streams of a job.
#pragma once

#include <span>

#include "batch/refusal/sized.h"
#include "include/swivel/swivel_bodies.h"

namespace swivel {

// The nth streams of an array, and their fields.
inline swivel_streams streams_at(const swivel_streams* streams, std::size_t n)
{
    return element(streams, n, swivel_default_streams());
}
inline std::span<const swivel_stream> fields_of(const swivel_streams& streams)
{
    return {streams.fields, streams.field_count};
}

}  // namespace swivel

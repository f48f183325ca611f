// SPDX-License-Identifier: MIT
//
// A failing C entry point returns a status for the program and leaves one line for people.
#pragma once

#include "include/swivel/swivel_bodies.h"

namespace swivel {

// Formats the line that swivel_last_error() gives on this thread, and returns SWIVEL_INVALID_ARGUMENT. Longer lines are
// cut at 255 characters.
[[gnu::format(printf, 1, 2)]] swivel_status refuse(const char* format, ...);
// The same with another status.
[[gnu::format(printf, 2, 3)]] swivel_status fail(swivel_status status, const char* format, ...);

// The line; empty before the first failure.
const char* last_error();

}  // namespace swivel

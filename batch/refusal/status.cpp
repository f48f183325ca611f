// SPDX-License-Identifier: MIT
#include "batch/refusal/status.h"

#include <cstdarg>
#include <cstdio>

namespace swivel {

namespace {

thread_local char message[256] = "";

}  // namespace

swivel_status refuse(const char* format, ...)
{
    std::va_list values;
    va_start(values, format);
    std::vsnprintf(message, sizeof message, format, values);
    va_end(values);
    return SWIVEL_INVALID_ARGUMENT;
}

swivel_status fail(swivel_status status, const char* format, ...)
{
    std::va_list values;
    va_start(values, format);
    std::vsnprintf(message, sizeof message, format, values);
    va_end(values);
    return status;
}

const char* last_error() { return message; }

}  // namespace swivel

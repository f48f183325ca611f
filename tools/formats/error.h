#pragma once
// SPDX-License-Identifier: MIT
// The one exception of the readers and writers: something about the user's file is wrong. Its text is a single
// line "FILE:LINE: cause; what to do" (the last where the cause does not say it), to be printed as it is. Faults of the
// calling code are not this error: those throw std::invalid_argument.

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace swivel::formats {

struct InputError : std::runtime_error {
    // `line` counts from 1; 0 means the error belongs to no line, and none is printed.
    // Both become printable(), so that the message is one line. What `cause` quotes of a file is kMaxQuoted characters
    // long at most: its author cuts it.
    InputError(const std::filesystem::path& path, std::size_t line, std::string_view cause);
    InputError(const std::filesystem::path& path, std::string_view cause) : InputError(path, 0, cause) {}
};

}  // namespace swivel::formats

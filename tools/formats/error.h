#pragma once
// SPDX-License-Identifier: MIT
// The one exception of the readers and writers: the user's file is wrong. Its text is a single line "FILE:LINE: cause;
// what to do", to be printed as it is. The advice is left out where the cause implies it. Faults of the calling code
// throw std::invalid_argument instead.

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace swivel::formats {

struct InputError : std::runtime_error {
    // `line` counts from 1; 0 means the error belongs to no line, and none is printed.
    // Path and cause become printable(), so that the message is one line. The caller cuts quotes of a file to
    // kMaxQuoted characters.
    InputError(const std::filesystem::path& path, std::size_t line, std::string_view cause);
    InputError(const std::filesystem::path& path, std::string_view cause) : InputError(path, 0, cause) {}
};

}  // namespace swivel::formats

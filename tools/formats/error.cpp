// SPDX-License-Identifier: MIT
#include "tools/formats/error.h"

#include <fmt/format.h>

#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

std::string message(const std::filesystem::path& path, std::size_t line, std::string_view cause)
{
    const std::string name = is_standard_stream(path) ? "standard input" : printable(path.string(), std::string::npos);
    const std::string what = printable(cause, std::string::npos);
    return line == 0 ? fmt::format("{}: {}", name, what) : fmt::format("{}:{}: {}", name, line, what);
}

}  // namespace

InputError::InputError(const std::filesystem::path& path, std::size_t line, std::string_view cause)
    : std::runtime_error(message(path, line, cause))
{
}

}  // namespace swivel::formats

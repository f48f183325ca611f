// SPDX-License-Identifier: MIT
//
// Writing to the standard streams. Standard output is for what was asked for: the run fails where that cannot be
// written in full, which is_output_whole() tells at its end. Standard error is for messages: one that nobody can be
// told is lost, and changes nothing.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string_view>
#include <utility>

#include "tools/formats/printable.h"

namespace swivel::tools {

// Gives the numbers of closed standard streams to /dev/null, so that no file opened later gets them, and the stream's
// text. They still cannot be read or written; messages get lost. False: that failed.
bool open_closed_streams();

// Writes text to stdout or stderr, as it is.
void say_text(std::FILE* to, std::string_view text) noexcept;

// Writes lines, which may quote anything: as printable_lines() lets them reach a terminal.
template <class... Values>
void say(std::FILE* to, fmt::format_string<Values...> text, Values&&... values)
{
    say_text(to, formats::printable_lines(fmt::format(text, std::forward<Values>(values)...)));
}

// Whether all that was said on standard output since the last call has been written.
bool is_output_whole();

}  // namespace swivel::tools

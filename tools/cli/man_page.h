// SPDX-License-Identifier: MIT
//
// The command's manual page, for man: roff with the macros of man(7).
#pragma once

#include <string>

#include "tools/cli/command_outline.h"

namespace swivel::tools {

std::string man_page(const Outline& outline);

}  // namespace swivel::tools

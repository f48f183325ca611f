// SPDX-License-Identifier: MIT
//
// What bash, zsh and fish must know to complete the command's words: a script for each.
#pragma once

#include <string>

#include "tools/cli/command_outline.h"

namespace swivel::tools {

std::string bash_completion(const Outline& outline);
std::string zsh_completion(const Outline& outline);
std::string fish_completion(const Outline& outline);

}  // namespace swivel::tools

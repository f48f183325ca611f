// SPDX-License-Identifier: MIT
//
// The command line of caches: store, fill, check, replay.
#pragma once

#include <CLI/CLI.hpp>

namespace swivel::tools {

void add_cache_commands(CLI::App& app);

}  // namespace swivel::tools

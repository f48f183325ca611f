// SPDX-License-Identifier: MIT
#include "tools/swivel/command_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace swivel::tools {

int fail(int code, std::string line)
{
    std::replace(line.begin(), line.end(), '\n', ' ');
    fmt::print(stderr, "swivel: {}\n", line);
    return code;
}

}  // namespace swivel::tools

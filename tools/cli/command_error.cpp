// SPDX-License-Identifier: MIT
#include "tools/cli/command_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace swivel::tools {

int fail(int code, std::string line)
{
    std::replace(line.begin(), line.end(), '\n', ' ');
    std::fputs(fmt::format("swivel: {}\n", line).c_str(), stderr);  // fmt::print() throws where nobody can be told
    return code;
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
#include "tools/cli/process.h"
#include "tools/swivel/command_line.h"

int main(int argc, char** argv)
{
    return swivel::tools::run_process([&] { return swivel::tools::run_swivel(argc, argv); });
}

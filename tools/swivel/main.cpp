// SPDX-License-Identifier: MIT
#include "tools/swivel/command_line.h"

int main(int argc, char** argv) { return swivel::tools::run_swivel(argc, argv); }

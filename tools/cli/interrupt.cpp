// SPDX-License-Identifier: MIT
#include "tools/cli/interrupt.h"

#include <csignal>

#include "tools/cli/command_error.h"

namespace swivel::tools {

namespace {

volatile std::sig_atomic_t interrupted = 0;

}  // namespace

void note_interrupts()
{
    interrupted = 0;  // of an earlier run in this process
    for (const int signal : {SIGINT, SIGTERM})
        std::signal(signal, [](int number) {
            interrupted = 1;
            std::signal(number, SIG_DFL);
        });
}

void check_interrupt()
{
    if (interrupted) throw CommandError(1, "interrupted; no output was written");
}

}  // namespace swivel::tools

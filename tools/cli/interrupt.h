// SPDX-License-Identifier: MIT
//
// Ctrl-C and termination as an ordinary failure, so that half-written files are removed on the way out.
#pragma once

namespace swivel::tools {

// From now on SIGINT and SIGTERM only leave a note; a second one ends the process at once.
void note_interrupts();

// Throws CommandError if one came. Called between frames.
void check_interrupt();

}  // namespace swivel::tools

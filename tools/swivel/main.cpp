// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <unistd.h>

#include "tools/swivel/command_line.h"

namespace {

// A file opened later would get the number of a standard stream that is closed, and the stream's text. /dev/null takes
// that number first. For input and output it is opened the wrong way round, so that these still cannot be read or
// written. Messages get lost.
bool open_closed_streams()
{
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
        const bool is_closed = ::fcntl(stream, F_GETFD) < 0;
        if (is_closed && ::open("/dev/null", stream == STDOUT_FILENO ? O_RDONLY : O_WRONLY) != stream) return false;
    }
    return true;
}

}  // namespace

int main(int argc, char** argv) { return open_closed_streams() ? swivel::tools::run_swivel(argc, argv) : 1; }

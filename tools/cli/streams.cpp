// SPDX-License-Identifier: MIT
#include "tools/cli/streams.h"

#include <fcntl.h>
#include <unistd.h>

namespace swivel::tools {

bool open_closed_streams()
{
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
        const bool is_closed = ::fcntl(stream, F_GETFD) < 0;
        // The wrong way round for input and output, so that these still cannot be used.
        if (is_closed && ::open("/dev/null", stream == STDOUT_FILENO ? O_RDONLY : O_WRONLY) != stream) return false;
    }
    return true;
}

// fmt::print() throws where it cannot write.
void say_text(std::FILE* to, std::string_view text) noexcept { std::fwrite(text.data(), 1, text.size(), to); }

bool is_output_whole()
{
    const bool is_whole = std::fflush(stdout) == 0 && !std::ferror(stdout);
    std::clearerr(stdout);
    return is_whole;
}

}  // namespace swivel::tools

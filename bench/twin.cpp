// SPDX-License-Identifier: MIT
#include "bench/twin.h"

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

namespace bench {

namespace {

bool send(int line)
{
    const char word = 0;
    return ::send(line, &word, 1, MSG_NOSIGNAL) == 1;
}
bool receive(int line)
{
    char word;
    return read(line, &word, 1) == 1;
}

void require(bool is_there)
{
    if (!is_there) throw std::runtime_error("the second process ended before its work");
}

// The other process, until the first one closes the line.
[[noreturn]] void serve(int line, const std::function<Work()>& prepare)
{
    try {
        const Work work = prepare();
        while (send(line) && receive(line)) work();
    } catch (...) {
        _exit(1);
    }
    _exit(0);
}

}  // namespace

Twin::Twin(const std::function<Work()>& prepare)
{
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0 || (process_ = fork()) < 0)
        throw std::runtime_error("no second process starts; nothing is measured beside it");
    if (process_ == 0) {
        close(ends[0]);
        serve(ends[1], prepare);
    }
    close(ends[1]);
    line_ = ends[0];
    try {
        work_ = prepare();
        require(receive(line_));
    } catch (...) {
        end();
        throw;
    }
}

Twin::~Twin() { end(); }

void Twin::run()
{
    require(send(line_));
    work_();
    require(receive(line_));
}

void Twin::end() const
{
    close(line_);
    waitpid(process_, nullptr, 0);
}

}  // namespace bench

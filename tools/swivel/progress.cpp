// SPDX-License-Identifier: MIT
#include "tools/swivel/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace swivel::tools {

namespace {

using Clock = std::chrono::steady_clock;

bool is_watched()
{
    const char* terminal = std::getenv("TERM");
    return isatty(STDERR_FILENO) && terminal && std::strcmp(terminal, "dumb") != 0;
}

}  // namespace

Progress::Progress(std::string what, std::uint64_t total)
    : what_(std::move(what)), total_(total), visible_(is_watched() && total > 1), start_(Clock::now()), drawn_(start_)
{
}

Progress::~Progress()
{
    if (visible_) fmt::print(stderr, "\r\x1b[K");
}

void Progress::show(std::uint64_t done)
{
    const Clock::time_point now = Clock::now();
    if (!visible_ || now - drawn_ < std::chrono::milliseconds(100)) return;
    drawn_ = now;
    constexpr std::uint64_t width = 30;
    const std::uint64_t filled = width * done / total_;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const double left = done > 0 ? seconds * static_cast<double>(total_ - done) / static_cast<double>(done) : 0;
    fmt::print(stderr, "\r[{:#<{}}{:<{}}] {:3} %  {} of {} {}, {:.0f} s left\x1b[K", "", filled, "", width - filled,
               100 * done / total_, done, total_, what_, left);
    std::fflush(stderr);
}

}  // namespace swivel::tools

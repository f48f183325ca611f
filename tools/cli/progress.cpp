// SPDX-License-Identifier: MIT
#include "tools/cli/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "tools/cli/streams.h"

namespace swivel::tools {

namespace {

using Clock = std::chrono::steady_clock;

bool is_watched()
{
    const char* terminal = std::getenv("TERM");
    return isatty(STDERR_FILENO) && terminal && std::strcmp(terminal, "dumb") != 0;
}

// Of the terminal; 80, as terminals are by custom, where it does not say.
std::size_t column_count()
{
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

std::string progress_line(std::uint64_t done, std::uint64_t total, std::string_view what, double seconds,
                          std::size_t columns)
{
    constexpr std::size_t min_bar = 5, max_bar = 30;
    const double left = done > 0 ? seconds * static_cast<double>(total - done) / static_cast<double>(done) : 0;
    const std::string percent = fmt::format("{:3} %", 100 * done / total);
    const std::string figures = fmt::format("{}  {} of {} {}, {:.0f} s left", percent, done, total, what, left);
    const std::size_t room = columns > 0 ? columns - 1 : 0;  // the last column makes some terminals wrap
    if (const std::size_t taken = figures.size() + 3; taken + min_bar <= room) {
        const std::size_t width = std::min(max_bar, room - taken), filled = width * done / total;
        return fmt::format("[{:#<{}}{:<{}}] {}", "", filled, "", width - filled, figures);
    }
    return figures.size() <= room ? figures : percent.size() <= room ? percent : "";
}

Progress::Progress(std::string what, std::uint64_t total, bool quiet)
    : what_(std::move(what)),
      total_(total),
      visible_(!quiet && is_watched() && total > 1),
      start_(Clock::now()),
      drawn_(start_)
{
}

Progress::~Progress()
{
    if (visible_) say_text(stderr, "\r\x1b[K");
}

void Progress::show(std::uint64_t done)
{
    const Clock::time_point now = Clock::now();
    if (!visible_ || now - drawn_ < std::chrono::milliseconds(100)) return;
    drawn_ = now;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    say_text(stderr, fmt::format("\r{}\x1b[K", progress_line(done, total_, what_, seconds, column_count())));
}

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
#include "tests/run_command.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <catch2/catch.hpp>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <string_view>

extern char** environ;

namespace swivel::test {
namespace {

// Two ends of a channel; closed when they go out of scope.
struct Channel {
    int reading = -1, writing = -1;

    Channel() = default;
    Channel(const Channel&) = delete;
    Channel& operator=(const Channel&) = delete;
    ~Channel()
    {
        close_end(reading);
        close_end(writing);
    }
    static void close_end(int& end)
    {
        if (end >= 0) ::close(end);
        end = -1;
    }
};

void open_channel(Channel& channel, bool terminal)
{
    if (!terminal) {
        std::array<int, 2> ends{};
        REQUIRE(::pipe2(ends.data(), O_CLOEXEC) == 0);
        channel.reading = ends[0];
        channel.writing = ends[1];
        return;
    }
    channel.reading = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE(channel.reading >= 0);
    REQUIRE(::grantpt(channel.reading) == 0);
    REQUIRE(::unlockpt(channel.reading) == 0);
    channel.writing = ::open(::ptsname(channel.reading), O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE(channel.writing >= 0);
}

Words merged_environment(const Words& changes)
{
    const auto name_of = [](std::string_view entry) { return entry.substr(0, entry.find('=')); };
    Words merged;
    for (char** entry = environ; *entry; ++entry) {
        bool is_changed = false;
        for (const std::string& change : changes) is_changed = is_changed || name_of(change) == name_of(*entry);
        if (!is_changed) merged.emplace_back(*entry);
    }
    for (const std::string& change : changes) {
        if (change.find('=') != std::string::npos) merged.push_back(change);
    }
    return merged;
}

std::vector<char*> pointers(Words& words)
{
    std::vector<char*> all;
    for (std::string& word : words) all.push_back(word.data());
    all.push_back(nullptr);
    return all;
}

// Takes what there is; closes the end when the other side has gone (a terminal says so with an error).
void take(int& reading, std::string& into)
{
    std::array<char, 1 << 16> buffer;
    const ssize_t count = ::read(reading, buffer.data(), buffer.size());
    if (count > 0)
        into.append(buffer.data(), static_cast<std::size_t>(count));
    else if (count == 0 || errno != EINTR)
        Channel::close_end(reading);
}

// The peak so far. wait4() will not do: what it tells begins with the memory of the process that forked. Neither does
// the child before it has become the program.
void look_up_peak(pid_t child, const std::string& program, Outcome& outcome)
{
    const std::filesystem::path process = "/proc/" + std::to_string(child);
    std::error_code gone;
    if (!std::filesystem::equivalent(process / "exe", program, gone)) return;
    std::ifstream status(process / "status");
    for (std::string word; status >> word;)
        if (word == "VmHWM:") status >> outcome.peak_kib;
}

void listen(pid_t child, const std::string& program, const Surroundings& surroundings, Channel& out, Channel& err,
            Outcome& outcome)
{
    while (out.reading >= 0 || err.reading >= 0) {
        std::array<pollfd, 2> ends = {{{out.reading, POLLIN, 0}, {err.reading, POLLIN, 0}}};  // -1 is passed over
        look_up_peak(child, program, outcome);
        if (surroundings.meanwhile) surroundings.meanwhile(child);
        if (::poll(ends.data(), ends.size(), 10) <= 0) continue;
        if (ends[0].revents) take(out.reading, outcome.out);
        if (ends[1].revents) take(err.reading, outcome.err);
    }
}

}  // namespace

Outcome run_program(const std::filesystem::path& folder, Words words, const Surroundings& surroundings)
{
    Channel out, err;
    open_channel(out, false);
    open_channel(err, surroundings.terminal);
    const winsize size{24, surroundings.columns, 0, 0};
    if (surroundings.terminal) REQUIRE(::ioctl(err.writing, TIOCSWINSZ, &size) == 0);
    Words environment = merged_environment(surroundings.environment);
    const std::vector<char*> argv = pointers(words), envp = pointers(environment);

    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {  // only calls that are safe between fork and exec
        ::alarm(surroundings.max_seconds);
        if (::chdir(folder.c_str()) == 0 && ::dup2(out.writing, STDOUT_FILENO) >= 0 &&
            ::dup2(err.writing, STDERR_FILENO) >= 0) {
            if (surroundings.before) surroundings.before();
            ::execve(argv[0], argv.data(), envp.data());
        }
        ::_exit(126);  // 127 is what the loader says without memory
    }
    Channel::close_end(out.writing);
    Channel::close_end(err.writing);
    Outcome outcome;
    listen(child, words[0], surroundings, out, err, outcome);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0) REQUIRE(errno == EINTR);
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    REQUIRE(outcome.exit_code != 126);
    return outcome;
}

}  // namespace swivel::test

// SPDX-License-Identifier: MIT
//
// The promise: whatever ends the command's process, no unfinished file stays, one line says why, and the exit status is
// the cause's own. What is lost on a standard stream is told, and never lands in a file.
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <functional>
#include <sstream>

#include "tests/pipe_stage.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

// ---- what a process may find itself in, for Surroundings::before

void limit(int resource, std::uint64_t most)
{
    const rlimit limits = {most, most};
    ::setrlimit(static_cast<__rlimit_resource>(resource), &limits);
}

constexpr bool is_sanitized()
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return true;
#else
    return false;
#endif
}

// A folder with a clip of some seconds of work, and a run of it that something happens to while it writes o.csv.
struct LongRun {
    TempFolder folder;

    explicit LongRun(int frames = 20'000)
    {
        const std::size_t motion = kTwoArms.find("Frames: ");
        std::string clip = kTwoArms.substr(0, motion) + "Frames: " + std::to_string(frames) + "\nFrame Time: .01\n";
        std::istringstream lines(kTwoArms.substr(motion));
        std::string line;
        for (int n = 0; n < 3; ++n) std::getline(lines, line);
        for (int n = 0; n < frames; ++n) clip += line + "\n";
        spill(folder / "clip.bvh", clip);
    }
    // When: a partial file is there.
    Outcome run(Surroundings surroundings, int characters, std::function<void(pid_t)> then) const
    {
        bool is_done = false;
        surroundings.meanwhile = [&](pid_t process) {
            if (is_done || folder.file_count() == 1) return;
            is_done = true;
            then(process);
        };
        const Outcome outcome = spawn_command(
            folder.path, {"solve", "clip.bvh", "--characters", std::to_string(characters), "--out", "o.csv", "--quiet"},
            surroundings);
        CHECK(is_done);
        return outcome;
    }
};

}  // namespace

TEST_CASE("process: a signal leaves no partial file, says so, and is what the run ends by")
{
    const LongRun stage;
    Surroundings plain;
    plain.before = [] { limit(RLIMIT_CORE, 0); };
    for (const int signal :
         {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU, SIGPIPE, SIGXFSZ, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
        const bool is_fault =
            signal == SIGSEGV || signal == SIGBUS || signal == SIGFPE || signal == SIGILL || signal == SIGABRT;
        if (is_fault && is_sanitized()) continue;  // they report faults themselves
        INFO(::strsignal(signal));
        const Outcome outcome = stage.run(plain, 100, [&](pid_t process) { ::kill(process, signal); });
        CHECK(outcome.exit_code == -signal);
        CHECK(outcome.err ==
              (signal == SIGPIPE ? ""  // as other tools end
                                 : "swivel: " + std::string(::strsignal(signal)) + "; unfinished files are removed\n"));
        CHECK(stage.folder.file_count() == 1);
    }
}

TEST_CASE("process: a hangup that nohup has ignored stays ignored")
{
    const LongRun stage(500);
    Surroundings nohup;
    nohup.before = [] { ::signal(SIGHUP, SIG_IGN); };
    const Outcome outcome = stage.run(nohup, 50, [](pid_t process) { ::kill(process, SIGHUP); });
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    CHECK(fs::exists(stage.folder / "o.csv"));
    CHECK(stage.folder.file_count() == 2);
}

TEST_CASE("process: a pipe that nobody reads and a limit on the size of files end a run, and leave no file")
{
    const PipeStage stage;
    Surroundings unread;
    unread.before = [] {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) == 0) ::dup2(ends[1], STDOUT_FILENO);
        ::close(ends[0]);
    };
    for (const Words& words :
         std::vector<Words>{{"help"}, {"solve", "clip.bvh", "--out", "-", "--export-targets", "t2.csv", "--quiet"}}) {
        const Outcome outcome = spawn_command(stage.folder.path, words, unread);
        CHECK(outcome.exit_code == -SIGPIPE);
        CHECK(outcome.err.empty());
    }
    Surroundings small;
    small.before = [] { limit(RLIMIT_FSIZE, 100), limit(RLIMIT_CORE, 0); };
    const Outcome outcome = spawn_command(stage.folder.path, {"solve", "clip.bvh", "--out", "o.csv"}, small);
    CHECK(outcome.exit_code == -SIGXFSZ);
    CHECK(outcome.err == "swivel: File size limit exceeded; unfinished files are removed\n");
    CHECK(stage.folder.file_count() == 3);
}

TEST_CASE("process: a standard output that is full is one line and exit code 1, whatever goes there")
{
    const PipeStage stage;
    Surroundings full;
    full.stdout_file = "/dev/full";
    for (const Words& words : std::vector<Words>{{"--help"},
                                                 {"--version"},
                                                 {"solve", "--help"},
                                                 {"help", "solve"},
                                                 {"info", "--json"},
                                                 {"rig", "clip.bvh"},
                                                 {"solve", "clip.bvh", "--json"},
                                                 {"demo", "--characters", "2", "--frames", "2"}}) {
        const Outcome outcome = spawn_command(stage.folder.path, words, full);
        INFO(words.front());
        CHECK(outcome.exit_code == 1);
        CHECK(outcome.err == "swivel: standard output could not be written in full\n");
    }
    const Outcome poses = spawn_command(stage.folder.path, {"solve", "clip.bvh", "--out", "-", "--quiet"}, full);
    CHECK(poses.exit_code == 1);
    CHECK_THAT(poses.err, StartsWith("swivel: standard output: cannot be written: "));
}

TEST_CASE("process: closed standard streams lose their text, and no other file gets it")
{
    const PipeStage stage;
    const std::string csv = stage.written({"clip.bvh", "--out", "a.csv"}),
                      table = stage.written({"clip.bvh", "--export-targets", "t2.csv"});
    const auto spawn = [&](Words words, const std::vector<int>& closed) {
        Surroundings without;
        without.before = [&closed] {
            for (const int descriptor : closed) ::close(descriptor);
        };
        words.insert(words.begin(), "solve");
        return spawn_command(stage.folder.path, words, without);
    };
    for (const std::vector<int>& closed : std::vector<std::vector<int>>{{0}, {1}, {2}, {0, 1, 2}}) {
        INFO(closed.size() << " closed, " << closed[0] << " first");
        const Outcome outcome = spawn({"clip.bvh", "--out", "b.csv", "--export-targets", "t3.csv"}, closed);
        CHECK(slurp(stage.folder / "b.csv") == csv);
        CHECK(slurp(stage.folder / "t3.csv") == table);
        CHECK(outcome.exit_code == std::ranges::count(closed, 1));  // the report is lost with standard output
    }
    CHECK(spawn({"clip.bvh", "--clip", "x"}, {2}).exit_code == 2);  // what cannot be said is no crash
    CHECK_THAT(spawn({"-"}, {0}).err, StartsWith("swivel: standard input: "));
    CHECK_THAT(spawn({"clip.bvh", "--out", "-", "--quiet"}, {1}).err,
               StartsWith("swivel: standard output: cannot be written: "));
}

TEST_CASE("process: a message that nobody can be told changes no exit code")
{
    const TempFolder folder;
    Surroundings mute;
    mute.before = [] { ::dup2(::open("/dev/full", O_WRONLY | O_CLOEXEC), STDERR_FILENO); };
    CHECK(spawn_command(folder.path, {"slove"}, mute).exit_code == 2);
}

TEST_CASE("process: lack of memory is one line that blames no file, wherever it shows")
{
    if (is_sanitized()) return;  // they reserve more than any limit
    const LongRun stage(500);
    const auto run = [&](const Words& words, std::uint64_t kib) {
        Surroundings poor;
        poor.before = [kib] { limit(RLIMIT_CORE, 0), limit(RLIMIT_AS, 1024 * kib); };
        return spawn_command(stage.folder.path, words, poor);
    };
    std::uint64_t least = 8192;  // before main() begins nothing is promised
    while (run({"--version"}, least).exit_code != 0) least += least / 16;
    for (const Words& words :
         std::vector<Words>{{"rig", "clip.bvh"},
                            {"solve", "clip.bvh", "--out", "o.csv", "--threads", "2", "--characters", "3"},
                            {"solve", "clip.bvh", "--out", "o.bvh"},
                            {"demo", "--characters", "20000", "--frames", "1", "--threads", "2"}}) {
        int failed = 0, done = 0;
        for (std::uint64_t kib = least; done < 3 && kib < 1 << 20; kib += kib / 16) {
            const Outcome outcome = run(words, kib);
            INFO(words.front() << " " << kib << " KiB: " << outcome.err);
            if (outcome.exit_code == 0) {
                for (const char* out : {"o.csv", "o.bvh"}) fs::remove(stage.folder / out);
                ++done;
                continue;
            }
            ++failed;
            CHECK(outcome.exit_code == 1);
            CHECK_THAT(outcome.err, StartsWith("swivel: not enough memory") && Contains("try a shorter clip"));
            CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
            CHECK(stage.folder.file_count() == 1);
        }
        CHECK(done == 3);
        CHECK(failed > 0);
    }
}

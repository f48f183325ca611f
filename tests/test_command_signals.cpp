// SPDX-License-Identifier: MIT
//
// The command as a process: signals, streams that are full or closed, pipes that nobody reads, and little memory.
#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <csignal>
#include <functional>
#include <sstream>
#include <tuple>

#include "tests/pipe_stage.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

using Words = std::vector<std::string>;

// ---- what a process may find itself in, for Surroundings::before

void direct(int stream, const char* file) { ::dup2(::open(file, O_WRONLY | O_CLOEXEC), stream); }

// A pipe that nobody reads.
void cut(int stream)
{
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) == 0) ::dup2(ends[1], stream);
    ::close(ends[0]);
}

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

// A named pipe that is left unread until it is full, and whose writer then gets a signal. Afterwards all is read.
struct FullPipe {
    fs::path path;
    int signal;
    int reading = -1;
    bool is_sent = false;

    FullPipe(const fs::path& name, int sent) : path(name), signal(sent)
    {
        REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
        reading = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
        REQUIRE(reading >= 0);
        ::fcntl(reading, F_SETPIPE_SZ, 4096);  // the least, so that short files fill it, too
    }
    FullPipe(const FullPipe&) = delete;
    FullPipe& operator=(const FullPipe&) = delete;
    ~FullPipe() { ::close(reading); }

    // For Surroundings::meanwhile.
    void operator()(pid_t process)
    {
        if (is_sent) {
            std::array<char, 1 << 16> bytes;
            while (::read(reading, bytes.data(), bytes.size()) > 0) {
            }
            return;
        }
        int held = 0;
        ::ioctl(reading, FIONREAD, &held);
        is_sent = held >= ::fcntl(reading, F_GETPIPE_SZ);
        if (is_sent) ::kill(process, signal);
    }
};

}  // namespace

TEST_CASE("process: a standard output that is full or closed is a failure")
{
    const PipeStage stage;
    Surroundings full;
    full.stdout_file = "/dev/full";
    const Outcome outcome = spawn_command(stage.folder.path, {"solve", "clip.bvh", "--out", "-", "--quiet"}, full);
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.err, StartsWith("swivel: standard output: cannot be written: "));

    const std::string csv = stage.written({"clip.bvh", "--out", "a.csv"}),
                      table = stage.written({"clip.bvh", "--export-targets", "t2.csv"});
    const auto spawn = [&](Words words, std::vector<int> closed) {
        Surroundings without;
        without.closed = std::move(closed);
        words.insert(words.begin(), {"solve", "clip.bvh"});
        return spawn_command(stage.folder.path, words, without);
    };
    for (const auto& [data, other, whole] :
         {std::tuple("--out", "--export-targets", table), {"--export-targets", "--out", csv}}) {
        const Outcome closed = spawn({data, "-", other, "b.csv", "--quiet"}, {1});
        CHECK(closed.exit_code == 1);
        CHECK_THAT(closed.err, StartsWith("swivel: standard output: cannot be written: "));
        // Nothing else may be in the other file, where it is there.
        CHECK((!fs::exists(stage.folder / "b.csv") || slurp(stage.folder / "b.csv") == whole));
        fs::remove(stage.folder / "b.csv");
    }
    for (const std::vector<int>& descriptors : std::vector<std::vector<int>>{{0}, {1}, {2}, {0, 1, 2}}) {
        const Outcome closed = spawn({"--out", "b.csv", "--export-targets", "t3.csv", "--strict"}, descriptors);
        INFO(descriptors.size() << " closed, " << descriptors[0] << " first");
        CHECK(slurp(stage.folder / "b.csv") == csv);
        CHECK(slurp(stage.folder / "t3.csv") == table);
        const bool says_all = descriptors == std::vector{0} || descriptors == std::vector{2};
        CHECK(closed.exit_code == (says_all ? 0 : 1));  // the report is lost with standard output
        fs::remove(stage.folder / "b.csv");
        fs::remove(stage.folder / "t3.csv");
    }
    CHECK(spawn({"--clip", "x"}, {2}).exit_code == 2);  // what cannot be said is no crash
    Surroundings without;
    without.closed = {0};
    const Outcome unread = spawn_command(stage.folder.path, {"solve", "-"}, without);
    CHECK(unread.exit_code == 1);
    CHECK_THAT(unread.err, StartsWith("swivel: standard input: "));
}

TEST_CASE("process: a standard output that is full is one line and exit code 1, whatever goes there")
{
    const PipeStage stage;
    Surroundings full;
    full.stdout_file = "/dev/full";
    for (const Words& words : std::vector<Words>{{"--help"},
                                                 {"--version"},
                                                 {"solve", "--help"},
                                                 {"help"},
                                                 {"help", "solve"},
                                                 {"help", "--man"},
                                                 {"completion", "zsh"},
                                                 {"info"},
                                                 {"info", "--json"},
                                                 {"rig", "clip.bvh"},
                                                 {"rig", "clip.bvh", "--json"},
                                                 {"solve", "clip.bvh"},
                                                 {"demo", "--characters", "2", "--frames", "2"}}) {
        const Outcome outcome = spawn_command(stage.folder.path, words, full);
        INFO(words.front());
        CHECK(outcome.exit_code == 1);
        CHECK(outcome.err == "swivel: standard output could not be written in full\n");
    }
}

TEST_CASE("process: a message that nobody can be told ends no run and changes no exit code")
{
    const PipeStage stage;
    const std::string csv = stage.written({"clip.bvh", "--out", "a.csv"});
    for (const auto& before : std::vector<std::function<void()>>{
             [] { direct(STDERR_FILENO, "/dev/full"); }, [] { ::close(STDERR_FILENO); }, [] { cut(STDERR_FILENO); }}) {
        Surroundings mute;
        mute.before = before;
        const auto code = [&](const Words& words) { return spawn_command(stage.folder.path, words, mute).exit_code; };
        CHECK(code({"slove"}) == 2);
        CHECK(code({"rig", "no.bvh"}) == 1);
        CHECK(code({"--version"}) == 0);
        const Outcome data = spawn_command(stage.folder.path, {"solve", "clip.bvh", "--out", "-"}, mute);
        CHECK(data.exit_code == 0);  // its report goes to standard error
        CHECK(data.out == csv);
        CHECK(code({"solve", "clip.bvh", "--out", "-", "--json"}) == 0);
    }
    Surroundings gone;
    gone.environment = {"TERM=xterm"};
    gone.terminal = gone.hangs_up = true;  // while the progress bar is drawn
    const Outcome demo = spawn_command(stage.folder.path, {"demo", "--characters", "20000", "--frames", "60"}, gone);
    CHECK_THAT(demo.err, Contains("of 60 frames"));
    CHECK(demo.exit_code == 0);
    CHECK_THAT(demo.out, StartsWith("demo "));
}

TEST_CASE("process: a pipe that nobody reads ends a run as other tools end, and leaves no file")
{
    const PipeStage stage;
    Surroundings unread;
    unread.before = [] { cut(STDOUT_FILENO); };
    for (const Words& words : std::vector<Words>{{"help"},
                                                 {"info"},
                                                 {"rig", "clip.bvh"},
                                                 {"solve", "clip.bvh"},
                                                 {"solve", "clip.bvh", "--out", "-", "--export-targets", "t2.csv"}}) {
        const Outcome outcome = spawn_command(stage.folder.path, words, unread);
        CHECK(outcome.exit_code == -SIGPIPE);
        CHECK((outcome.err.empty() || outcome.err.starts_with("clip ")));  // the report
    }
    CHECK(stage.folder.file_count() == 3);
    const Outcome wrong = spawn_command(stage.folder.path, {"rig", "no.bvh"}, unread);
    CHECK(wrong.exit_code == 1);
    CHECK_THAT(wrong.err, StartsWith("swivel: no.bvh: "));
}

TEST_CASE("process: a signal that asks a run to end leaves no partial file, and is what the run ends by")
{
    const LongRun stage;
    Surroundings plain;
    plain.before = [] { limit(RLIMIT_CORE, 0); };
    for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU}) {
        const Outcome outcome = stage.run(plain, 100, [&](pid_t process) { ::kill(process, signal); });
        CHECK(outcome.exit_code == -signal);
        CHECK(outcome.err == "swivel: interrupted; unfinished files are removed\n");
        CHECK(stage.folder.file_count() == 1);
    }
}

TEST_CASE("process: a fault leaves no partial file, says so, and is what the run ends by")
{
    if (is_sanitized()) return;  // they report faults themselves
    const LongRun stage;
    Surroundings plain;
    plain.before = [] { limit(RLIMIT_CORE, 0); };
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
        const Outcome outcome = stage.run(plain, 100, [&](pid_t process) { ::kill(process, signal); });
        CHECK(outcome.exit_code == -signal);
        CHECK(outcome.err ==
              "swivel: a fault in swivel or in a library ends this run; unfinished files are removed; please report "
              "it\n");
        CHECK(stage.folder.file_count() == 1);
    }
}

TEST_CASE("process: a signal after the last frame ends the run, too, and no further file is written")
{
    const LongRun stage(2'000);
    struct Case {
        std::string piped;
        Words words, left_out;
    };
    // All are written after the frames, and have less than a buffer, but more than a pipe holds.
    for (const auto& [piped, words, left_out] :
         std::vector<Case>{{"walk.bvh", {"--out", "walk.bvh"}, {}},
                           {"t.csv", {"--export-targets", "t.csv", "--out", "o.bvh"}, {"o.bvh"}},
                           {"t.csv", {"--export-targets", "t.csv", "--report", "r.html"}, {"r.html"}},
                           {"r.html", {"--report", "r.html"}, {}}}) {
        FullPipe pipe(stage.folder / piped, SIGTERM);
        Surroundings slow;
        slow.meanwhile = [&](pid_t process) { pipe(process); };
        Words all = {"solve", "clip.bvh", "--quiet"};
        all.insert(all.end(), words.begin(), words.end());
        const Outcome outcome = spawn_command(stage.folder.path, all, slow);
        INFO(piped);
        CHECK(pipe.is_sent);
        CHECK(outcome.exit_code == -SIGTERM);
        CHECK(outcome.err == "swivel: interrupted; unfinished files are removed\n");
        for (const std::string& file : left_out) CHECK_FALSE(fs::exists(stage.folder / file));
        fs::remove(stage.folder / piped);
        CHECK(stage.folder.file_count() == 1);
    }
}

TEST_CASE("process: a signal during the work of a report leaves no partial file")
{
    const LongRun stage(20);
    for (const Words& words :
         std::vector<Words>{{"solve", "clip.bvh", "--characters", "200000", "--report", "r.html", "--quiet"},
                            {"verify", "--arms", "100000000", "--report", "r.html", "--quiet"},
                            {"bench", "--seconds", "100", "--report", "r.html", "--quiet"}}) {
        INFO(words.front());
        int looks = 0;
        bool is_sent = false;
        Surroundings stopped;
        stopped.meanwhile = [&](pid_t process) {
            if (is_sent || (stage.folder.file_count() == 1 && ++looks < 50)) return;  // half a second, or a file
            is_sent = ::kill(process, SIGINT) == 0;
        };
        const Outcome outcome = spawn_command(stage.folder.path, words, stopped);
        CHECK(is_sent);
        CHECK(outcome.exit_code == -SIGINT);
        CHECK(stage.folder.file_count() == 1);
    }
}

TEST_CASE("process: help and manual page name the exit codes of signals")
{
    const PipeStage stage;
    for (const Words& words : std::vector<Words>{{"--help"}, {"help", "--man"}})
        CHECK_THAT(run_command(stage.folder.path, words).out, Contains("above 128: ended by a signal"));
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

TEST_CASE("process: a limit on the size of files is a write error")
{
    const PipeStage stage;
    Surroundings small;
    small.before = [] { limit(RLIMIT_FSIZE, 100); };
    const Outcome outcome = spawn_command(stage.folder.path, {"solve", "clip.bvh", "--out", "o.csv"}, small);
    CHECK(outcome.exit_code == 1);
    CHECK(outcome.err ==
          "swivel: o.csv: cannot be written: File too large; raise the limit on the size of files, ulimit -f\n");
    CHECK(stage.folder.file_count() == 3);
}

TEST_CASE("process: lack of memory is one line that blames no file, wherever it shows")
{
    if (is_sanitized()) return;  // they reserve more than any limit
    const LongRun stage(500);
    for (const Words& words :
         std::vector<Words>{{"info"},
                            {"rig", "clip.bvh"},
                            {"solve", "clip.bvh", "--out", "o.csv", "--threads", "2", "--characters", "3"},
                            {"solve", "clip.bvh", "--out", "o.bvh"},
                            {"demo", "--characters", "20000", "--frames", "1", "--threads", "2"}}) {
        // Fine steps show what happens before main(), and these take little time for one command alone.
        const std::uint64_t steps = words.front() == "info" ? 64 : 16;
        int failed = 0, done = 0;
        for (std::uint64_t kib = 8192; done < 3 && kib < 1 << 20; kib += kib / steps) {
            Surroundings poor;
            poor.before = [kib] {
                limit(RLIMIT_CORE, 0);
                limit(RLIMIT_AS, 1024 * kib);
            };
            const Outcome outcome = spawn_command(stage.folder.path, words, poor);
            INFO(words.front() << " " << kib << " KiB: " << outcome.err);
            if (outcome.exit_code == 127) continue;  // the loader's: nothing of ours has run
            if (outcome.exit_code == 0) {
                for (const char* out : {"o.csv", "o.bvh"}) fs::remove(stage.folder / out);
                ++done;
                continue;
            }
            ++failed;
            CHECK(outcome.exit_code == 1);
            CHECK_THAT(outcome.err, StartsWith("swivel: not enough memory"));
            CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
            CHECK(stage.folder.file_count() == 1);
            if (words.front() == "demo" && kib > 12'000) CHECK_THAT(outcome.err, Contains("fewer --characters"));
        }
        CHECK(done == 3);
        CHECK(failed > 0);
    }
}

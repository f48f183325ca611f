// SPDX-License-Identifier: MIT
//
// The promise: whatever ends the command's process, no unfinished file stays, one line says why, and the exit status is
// the cause's own. Memory does not grow with a crowd's clip. A bar shows how far a run is, on a terminal alone, within
// its width, and is wiped. Full disks and closed streams are in tests/transcripts/input.txt.
#include <rapidcheck/catch.h>
#include <sys/resource.h>
#include <unistd.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <functional>

#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tests/test_data.h"
#include "tools/cli/progress.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
using swivel::tools::progress_line;

namespace {

void limit(int resource, std::uint64_t max)
{
    const rlimit limits = {max, max};
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

    explicit LongRun(std::size_t frames = 20'000)
    {
        spill(folder / "clip.bvh", cut(plain_motion(kTwoArms), 0, 1, frames / 2));
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

const Surroundings kTerminal{{"TERM=xterm"}, true};
// Long enough for bars, 0.1 s apart, on a machine ten times faster than today's.
const Words kLongRun = {"demo", "--characters", "20000", "--frames", "100"};

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

TEST_CASE("process: a pipe that nobody reads ends a run without a word")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    Surroundings unread;
    unread.before = [] {
        int ends[2];
        if (::pipe(ends) == 0) ::dup2(ends[1], STDOUT_FILENO);
        ::close(ends[0]);
        ::close(ends[1]);
    };
    for (const Words& words :
         std::vector<Words>{{"help"}, {"solve", "clip.bvh", "--out", "-", "--export-targets", "t.csv", "--quiet"}}) {
        const Outcome outcome = spawn_command(folder.path, words, unread);
        CHECK(outcome.exit_code == -SIGPIPE);
        CHECK(outcome.err.empty());
        CHECK(folder.file_count() == 1);
    }
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
    std::uint64_t min = 8192;  // before main() begins nothing is promised
    while (run({"--version"}, min).exit_code != 0) min += min / 16;
    for (const Words& words :
         std::vector<Words>{{"rig", "clip.bvh"},
                            {"solve", "clip.bvh", "--out", "o.csv", "--threads", "2", "--characters", "3"},
                            {"solve", "clip.bvh", "--out", "o.bvh"},
                            {"demo", "--characters", "20000", "--frames", "1", "--threads", "2"}}) {
        int failed = 0, done = 0;
        for (std::uint64_t kib = min; done < 3 && kib < 1 << 20; kib += kib / 16) {
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

TEST_CASE("process: memory is bounded by clip and crowd, not by their product")
{
    // Per frame the command keeps its line of text (under 1.5 kB), 32 bytes for each of 31 joints, and the places of
    // two arms. These take 488 bytes, and three times that while a vector grows. The sum is under 4 kB; 8 kB leaves
    // room for the allocator. One frame of poses of 500 characters is 52 kB in memory and 150 kB as text.
    constexpr long kFrameKib = 8, kPosesKib = 500 * 2 * 52 / 1024;
    const TempFolder folder;
    const PlainMotion jump = plain_motion_of(must_find_jump());
    fs::create_symlink("/dev/null", folder / "poses.csv");
    const auto peak = [&](std::size_t repeats) {
        spill(folder / "clip.bvh", cut(jump, 0, 8, repeats));
        // A sanitizer keeps freed memory for a while; here that would hide what is measured.
        const Surroundings lean{{"ASAN_OPTIONS=quarantine_size_mb=1:thread_local_quarantine_size_kb=64"}};
        const Outcome outcome =
            done(spawn_command(folder.path, {"solve", "clip.bvh", "--characters", "500", "--out", "poses.csv"}, lean));
        return outcome.peak_kib;
    };
    const long frames = static_cast<long>(jump.lines.size() + 7) / 8;
    const long once = peak(1), often = peak(4);
    INFO("peak " << once << " KiB for " << frames << " frames, " << often << " KiB for " << 4 * frames);
    REQUIRE(once > 1000);  // the command was seen at work
    const long grown = often - once;
    CHECK(grown < 3 * frames * kFrameKib);
    CHECK(3 * frames * kFrameKib < 3 * frames * kPosesKib / 4);  // else the bound would prove nothing
}

TEST_CASE("progress: the bar is for terminals alone, and wiped")
{
    const TempFolder folder;
    const Outcome piped = spawn_command(folder.path, kLongRun, {{"TERM=xterm"}});
    CHECK(piped.exit_code == 0);
    CHECK(piped.err.empty());
    Surroundings dumb = kTerminal;
    dumb.environment = {"TERM=dumb"};
    CHECK(spawn_command(folder.path, kLongRun, dumb).err.empty());
    const Outcome watched = spawn_command(folder.path, kLongRun, kTerminal);
    CHECK(watched.exit_code == 0);
    CHECK_THAT(watched.err, StartsWith("\r[") && Contains(" of 100 frames") && EndsWith("\r\x1b[K"));
    CHECK_THAT(watched.err, !Contains("\n"));
    CHECK_THAT(watched.out, Contains("million arms/s") && !Contains("\x1b"));
    Words quiet = kLongRun;
    quiet.push_back("--quiet");
    const Outcome silent = spawn_command(folder.path, quiet, kTerminal);
    CHECK(silent.err.empty());
    CHECK_THAT(silent.out, Contains("million arms/s"));
}

TEST_CASE("progress: the bar is narrower than the terminal, as wide as that says it is")
{
    const TempFolder folder;
    const Outcome outcome = spawn_command(folder.path, kLongRun, {{"TERM=xterm"}, true, 24});
    CHECK_THAT(outcome.err, Contains(" %"));
    for (std::size_t at = 0; at < outcome.err.size();) {
        const std::size_t end = outcome.err.find("\x1b[K", at);
        REQUIRE(end != std::string::npos);
        CHECK(outcome.err[at] == '\r');
        CHECK(end - at - 1 < 24);
        at = end + 3;
    }
}

TEST_CASE("progress: a line fits, and says as much as fits")
{
    rc::prop("narrower than the terminal, with all figures where there is room", [] {
        const auto total = *rc::gen::inRange<std::uint64_t>(2, 1'000'000'000'000);
        const auto done = *rc::gen::inRange<std::uint64_t>(0, total + 1);
        const auto columns = *rc::gen::inRange<std::size_t>(0, 200);
        const double seconds = *rc::gen::inRange(0, 1'000'000);
        const std::string line = progress_line(done, total, "frames", seconds, columns);
        RC_ASSERT(line.size() < std::max<std::size_t>(columns, 1));
        RC_ASSERT(line.find_first_of("\r\n") == std::string::npos);
        if (columns > 5) RC_ASSERT(line.find(std::to_string(100 * done / total) + " %") != std::string::npos);
        const std::string wide = progress_line(done, total, "frames", seconds, 200);
        RC_ASSERT(wide.find(std::to_string(done) + " of " + std::to_string(total) + " frames, ") != std::string::npos);
        RC_ASSERT(std::count(wide.begin(), wide.end(), '#') == static_cast<long>(30 * done / total));
        if (wide.size() < columns) RC_ASSERT(line == wide);
    });
}

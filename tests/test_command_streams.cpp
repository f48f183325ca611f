// SPDX-License-Identifier: MIT
//
// The command as a process: in a pipe, with streams that cannot be written, signals and little memory. Clips, tables
// and crowd files come from standard input, poses go to standard output with nothing between them. Runs may say
// nothing, and exit codes say whether a solve went wrong.
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <functional>
#include <random>
#include <sstream>
#include <tuple>

#include "tests/plain_motion.h"
#include "tests/random_figure.h"
#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

using Words = std::vector<std::string>;

const std::string kPipeTable =
    "frame,character,limb,x,y,z,pole_x,pole_y,pole_z\n"
    "0,0,left_arm,6,8,3,4,8,9\n";

// A folder with clip.bvh, t.csv and c.toml.
struct PipeStage {
    TempFolder folder;

    PipeStage()
    {
        spill(folder / "clip.bvh", kTwoArms);
        spill(folder / "t.csv", kPipeTable);
        spill(folder / "c.toml", "[limb.arms]\nhand = false\n");
    }
    Outcome run(Words words, const std::string& input = {}) const
    {
        words.insert(words.begin(), "solve");
        return run_command(folder.path, words, input);
    }
    // What a run that must succeed writes to the file at the end of its words.
    std::string written(const Words& words) const
    {
        const Outcome outcome = run(words);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return slurp(folder / words.back());
    }
    void require_refused(const Words& words, int code, const std::string& said, const std::string& input = {}) const
    {
        const Outcome outcome = run(words, input);
        INFO(outcome.err);
        CHECK(outcome.exit_code == code);
        CHECK(outcome.out.empty());
        CHECK_THAT(outcome.err, StartsWith("swivel: ") && Contains(said));
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    }
};

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

}  // namespace

TEST_CASE("streams: a BVH clip, a table and a crowd file may come from standard input")
{
    const PipeStage stage;
    const std::string plain = stage.written({"clip.bvh", "--out", "a.csv"}),
                      table = stage.written({"clip.bvh", "--targets", "t.csv", "--out", "b.csv"}),
                      crowd = stage.written({"clip.bvh", "--crowd", "c.toml", "--out", "c.csv"});
    CHECK(plain != table);
    CHECK(stage.run({"-", "--out", "x.csv"}, kTwoArms).exit_code == 0);
    CHECK(slurp(stage.folder / "x.csv") == plain);
    CHECK(stage.run({"-", "--out", "x.csv"}, "\xEF\xBB\xBF\n" + kTwoArms).exit_code == 0);
    CHECK(slurp(stage.folder / "x.csv") == plain);
    CHECK(stage.run({"clip.bvh", "--targets", "-", "--out", "x.csv"}, kPipeTable).exit_code == 0);
    CHECK(slurp(stage.folder / "x.csv") == table);
    CHECK(stage.run({"clip.bvh", "--crowd", "-", "--out", "x.csv"}, "[limb.arms]\nhand = false\n").exit_code == 0);
    CHECK(slurp(stage.folder / "x.csv") == crowd);
    spill(stage.folder / "in.toml", "[crowd]\ntargets = \"-\"\n");
    CHECK(stage.run({"clip.bvh", "--crowd", "in.toml", "--out", "x.csv"}, kPipeTable).exit_code == 0);
    CHECK(slurp(stage.folder / "x.csv") == table);
    CHECK_THAT(run_command(stage.folder.path, {"rig", "-"}, kTwoArms).out, Contains("LeftForeArm"));
}

TEST_CASE("streams: a glTF clip is told by its first bytes, and each format goes out as it goes to a file")
{
    const PipeStage stage;
    std::mt19937 random(7);
    const Figure figure = random_figure(random, {}, figure_names()[0]);
    figure.rig.write(stage.folder / "f.glb");
    const std::string glb = slurp(stage.folder / "f.glb");
    for (const std::string format : {"glb", "gltf", "csv"}) {
        const std::string file = stage.written({"f.glb", "--out", "own." + format});
        const Outcome piped = stage.run({"-", "-o", "-", "--format", format}, glb);
        INFO(piped.err);
        CHECK(piped.exit_code == 0);
        CHECK((piped.out == file));
    }
    const std::string gltf = slurp(stage.folder / "own.gltf");
    const std::string again = stage.written({"own.gltf", "--out", "again.csv"});
    CHECK((stage.run({"-", "-o", "-"}, gltf).out == again));
    CHECK(
        (stage.run({"clip.bvh", "-o", "-", "--format", "bvh"}).out == stage.written({"clip.bvh", "--out", "own.bvh"})));
}

TEST_CASE("streams: with poses on standard output reports are on standard error, and --quiet leaves none")
{
    const PipeStage stage;
    const std::string csv = stage.written({"clip.bvh", "--out", "a.csv"});
    const Outcome text = stage.run({"clip.bvh", "--out", "-"});
    CHECK(text.out == csv);
    CHECK_THAT(text.err, StartsWith("clip ") && Contains("solved ") && Contains("written  to standard output"));
    const Outcome json = stage.run({"clip.bvh", "--out", "-", "--json"});
    CHECK(json.out == csv);
    CHECK(nlohmann::json::parse(json.err).at("out") == "-");
    const Outcome quiet = stage.run({"clip.bvh", "--out", "-", "--quiet"});
    CHECK(quiet.out == csv);
    CHECK(quiet.err.empty());
    const Outcome silent = stage.run({"clip.bvh", "--out", "b.csv", "--quiet"});
    CHECK(silent.out + silent.err == "");
    CHECK(slurp(stage.folder / "b.csv") == csv);
    CHECK(nlohmann::json::parse(stage.run({"clip.bvh", "--quiet", "--json"}).out).at("frames") == 2);
    CHECK_THAT(stage.run({"no.bvh", "--quiet"}).err, StartsWith("swivel: no.bvh: "));
    CHECK(stage.run({"clip.bvh"}).out.starts_with("clip "));  // as before
    stage.run({"clip.bvh", "--export-targets", "t2.csv"});
    const Outcome exported = stage.run({"clip.bvh", "--export-targets", "-", "--out", "b.csv"});
    CHECK(exported.out == slurp(stage.folder / "t2.csv"));
    CHECK_THAT(exported.err, Contains("written  b.csv") && Contains("written  to standard output"));
    CHECK_FALSE(fs::exists(stage.folder / "-"));
}

TEST_CASE("streams: what cannot be read or written is refused in one line")
{
    const PipeStage stage;
    for (const Words& words : std::vector<Words>{
             {"-", "--targets", "-"}, {"-", "--crowd", "-"}, {"clip.bvh", "--crowd", "-", "--targets", "-"}})
        stage.require_refused(words, 2, "more than one of FILE, --crowd and --targets", kTwoArms);
    spill(stage.folder / "in.toml", "[crowd]\ntargets = \"-\"\n");
    stage.require_refused({"-", "--crowd", "in.toml"}, 2, "more than one of FILE", kTwoArms);
    stage.require_refused({"-"}, 1, "standard input: is empty");
    stage.require_refused({"-"}, 1, "standard input: starts neither as BVH nor as glTF", "a,b,c\n");
    stage.require_refused({"-"}, 1, "standard input:", "HIERARCHY\nROOT");
    stage.require_refused({"-"}, 1, "standard input: starts neither", std::string("HIERARCHY\n\0", 11));
    stage.require_refused({"-"}, 1, "standard input:", "{}");
    stage.require_refused({"-"}, 1, "standard input:", "glTF");
    stage.require_refused({"clip.bvh", "--crowd", "clip.bvh"}, 1,
                          "clip.bvh: is a BVH file, and a TOML file is needed here; give the clip as FILE");
    stage.require_refused({"-", "--fps", "30"}, 2, "--fps samples", kTwoArms);
    stage.require_refused({"clip.bvh", "--targets", "-", "--json"}, 1, "standard input:3: column x is empty",
                          kPipeTable + "0,0,right_arm,,8,3,4,8,9\n");
    stage.require_refused({"clip.bvh", "--out", "-", "--format", "glb"}, 2, "this clip is a BVH file");
    stage.require_refused({"clip.bvh", "--out", "-", "--format", "bvh", "--characters", "2"}, 2, "one character");
    stage.require_refused({"clip.bvh", "--out", "-", "--export-targets", "-"}, 2, "is the file of --out itself");
    stage.require_refused({"clip.bvh", "--format", "csv"}, 2, "--format requires --out");
    stage.require_refused({"clip.bvh", "--out", "x", "--format", "fbx"}, 2, "there is no 'fbx'");
    stage.require_refused({"clip.bvh", "--out", "x"}, 2, "or --format");
    stage.require_refused({"clip.bvh", "--out", "x.fbx"}, 2, "no writer for this suffix");
    stage.require_refused({"clip.bvh", "--out", "x.fbx", "--format", "glb"}, 2, "this clip is a BVH file");
    CHECK(stage.run({"clip.bvh", "--out", "x.fbx", "--format", "csv"}).exit_code == 0);  // its suffix does not count
    CHECK(slurp(stage.folder / "x.fbx").starts_with("frame,"));
    CHECK(stage.run({"clip.bvh", "--out", "x", "--format", "csv"}).exit_code == 0);
    CHECK(slurp(stage.folder / "x").starts_with("frame,"));
}

TEST_CASE("streams: a standard output that is full or closed is a failure")
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

TEST_CASE("streams: a standard output that is full is one line and exit code 1, whatever goes there")
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
                                                 {"rig", "clip.bvh", "--toml"},
                                                 {"rig", "clip.bvh", "--json"},
                                                 {"solve", "clip.bvh"},
                                                 {"demo", "--characters", "2", "--frames", "2"}}) {
        const Outcome outcome = spawn_command(stage.folder.path, words, full);
        INFO(words.front());
        CHECK(outcome.exit_code == 1);
        CHECK(outcome.err == "swivel: standard output could not be written in full\n");
    }
}

TEST_CASE("streams: a message that nobody can be told ends no run and changes no exit code")
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

TEST_CASE("streams: a pipe that nobody reads ends a run as other tools end, and leaves no file")
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

TEST_CASE("streams: a signal that asks a run to end leaves no partial file, and is what the run ends by")
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

TEST_CASE("streams: a hangup that nohup has ignored stays ignored")
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

TEST_CASE("streams: a limit on the size of files is a write error")
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

TEST_CASE("streams: lack of memory is one line that blames no file, wherever it shows")
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

TEST_CASE("streams: tables from spreadsheets are read where they can be, and else told what to change")
{
    const PipeStage stage;
    const std::string csv = stage.written({"clip.bvh", "--targets", "t.csv", "--out", "a.csv"});
    spill(stage.folder / "quoted.csv",
          "\"frame\",\"character\",limb,x,y,z,\"pole_x\",pole_y,pole_z\r\n0,0,\"left_arm\",\"6\",8,3,4,8,9\r\n");
    CHECK(stage.written({"clip.bvh", "--targets", "quoted.csv", "--out", "b.csv"}) == csv);
    const auto refused = [&](const std::string& text, const std::string& said) {
        const Outcome outcome = stage.run({"clip.bvh", "--targets", "-", "--json"}, text);
        CHECK(outcome.exit_code == 1);
        CHECK_THAT(outcome.err, Contains(said));
    };
    refused("frame;character;limb;x;y;z;pole_x;pole_y;pole_z\n0;0;left_arm;6;8;3;4;8;9\n",
            "standard input:1: its columns are separated by semicolons or tabs; write commas");
    refused("frame\tcharacter\tlimb\tx\n", "separated by semicolons or tabs");
    refused(kPipeTable + "1,0,\"left_arm,6,8,3,4,8,9\n", "standard input:3: a quote is opened and not closed");
    refused("\"frame,character\n", "standard input:1: a quote is opened and not closed");
}

TEST_CASE("streams: --strict is exit code 1 where most limbs are out of reach, after writing")
{
    const PipeStage stage;
    const auto far = [](int count) {
        std::string text = "frame,character,limb,x,y,z,pole_x,pole_y,pole_z\n";
        for (int n = 0; n < count; ++n)
            text += std::to_string(n / 2) + ",0," + (n % 2 ? "right_arm" : "left_arm") + ",1000,0,0,0,9,0\n";
        return text;
    };
    for (const int count : {1, 2, 3, 4}) {  // of four
        const bool goes_wrong = count > 2;
        const Outcome lax = stage.run({"clip.bvh", "--targets", "-", "--out", "lax.csv"}, far(count));
        CHECK(lax.exit_code == 0);
        CHECK(lax.err.empty());
        CHECK((lax.out.find("\nnote     most arms are not where they should be") != std::string::npos) == goes_wrong);
        const Outcome strict = stage.run({"clip.bvh", "--targets", "-", "--out", "s.csv", "--strict"}, far(count));
        CHECK(strict.exit_code == (goes_wrong ? 1 : 0));
        if (goes_wrong)
            CHECK(strict.err == "swivel: --strict: of 4 arms, " + std::to_string(count) +
                                    " are out of reach; are the targets in the right place and unit?\n");
        CHECK(slurp(stage.folder / "s.csv") == slurp(stage.folder / "lax.csv"));
        const auto json = nlohmann::json::parse(stage.run({"clip.bvh", "--targets", "-", "--json"}, far(count)).out);
        CHECK(json.at("went_wrong") == goes_wrong);
    }
}

TEST_CASE("streams: straight arms that are where they should be are not out of reach, though rounding clamps some")
{
    const PipeStage stage;
    std::string clip = kTwoArms.substr(0, kTwoArms.find("Frames: ")) + "Frames: 10\nFrame Time: .01\n";
    for (const auto& [from, to] : {std::pair("OFFSET 5 0 0", "OFFSET 4.7 0 0"),
                                   {"OFFSET -5 0 0", "OFFSET -4.7 0 0"},
                                   {"OFFSET 3 0 0", "OFFSET 3.1 0 0"},
                                   {"OFFSET -3 0 0", "OFFSET -3.1 0 0"}})
        clip.replace(clip.find(from), std::string(from).size(), to);
    for (int frame = 0; frame < 10; ++frame) {
        clip += "1.1 2.3 4.7 0 " + std::to_string(7 * frame) + " 0";
        for (int n = 0; n < 18; ++n) clip += " 0";
        clip += "\n";
    }
    const Outcome strict = stage.run({"-", "--strict"}, clip);
    CHECK(strict.exit_code == 0);
    CHECK(strict.err.empty());
    CHECK_THAT(strict.out, !Contains("\nnote "));
    const auto json = nlohmann::json::parse(stage.run({"-", "--json"}, clip).out);
    CHECK(json.at("flags").at("clamped far") > 10);  // of 20: the flags alone would say that most are lost
    CHECK(json.at("out_of_reach") == 0);
    CHECK(json.at("missed").at("wrist").at("worst") < 1e-6);
}

TEST_CASE("streams: aims that are too near miss, and are no errors")
{
    const PipeStage stage;
    spill(stage.folder / "aim.toml", "[limb.arms.aim]\naxis = [0, 0, 1]\nflexion_deg = 40\n");
    // The left shoulder is at (2.97, 7, 2.65) in the first frame: its ray cannot pass so near.
    const std::string near_one = "frame,character,limb,x,y,z\n0,0,left_arm,2.97,7.1,2.65\n0,0,right_arm,-4,9,30\n";
    const Outcome outcome = stage.run({"clip.bvh", "--crowd", "aim.toml", "--targets", "-", "--json"}, near_one);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const auto json = nlohmann::json::parse(outcome.out);
    const std::uint64_t count = json.at("missed").at("aim").at("count");
    CHECK(count >= 1);
    CHECK(count == json.at("flags").at("clamped near"));
    CHECK(json.at("missed").at("aim").at("worst") > 1e-3);
    CHECK(json.at("errors").at("aim").at("count") == 4 - count);
    CHECK(json.at("errors").at("aim").at("worst") < 1e-5);
}

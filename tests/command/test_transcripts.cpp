// SPDX-License-Identifier: MIT
//
// Plays tests/transcripts/*.txt: what a user types, and what they see. A line for sh stands after `$ `, and goes on
// after `> `. Below it stands what must come: the lines of standard output, those of standard error after `2> `, and
// after `+ ` each file or folder that is new or another, after `- ` each that is gone. A command that fails ends with
// its exit code in brackets, and with its one line of standard error. `...` is any text of a line, and on a line of its
// own any lines. Blank lines are not compared. Comments begin with `# `.
//
// Each transcript has a folder of its own, with clip.bvh, two arms in two frames, and jump.bvh, a whole body that lands
// and stands. SWIVEL_RENEW=1 writes what comes now into the transcripts, and keeps lines with `...` that still match.
#include <catch2/catch.hpp>

#include <cstdlib>
#include <set>
#include <span>
#include <sstream>

#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;

namespace {

using Lines = std::vector<std::string>;

const std::string kAny = "...";

Lines lines_of(const std::string& text)
{
    std::istringstream in(text);
    Lines lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

// One command of a transcript, and where what must come stands in its lines.
struct Entry {
    std::string command;
    std::size_t begin, end;
};

std::vector<Entry> entries_of(const Lines& lines)
{
    std::vector<Entry> entries;
    const auto has = [&](std::size_t n, const char* prefix) {
        return n < lines.size() && lines[n].starts_with(prefix);
    };
    for (std::size_t n = 0; n < lines.size();) {
        if (!has(n, "$ ")) {
            REQUIRE((lines[n].empty() || has(n, "# ")));  // no line that belongs to no command
            ++n;
            continue;
        }
        Entry entry{lines[n].substr(2), 0, 0};
        for (++n; has(n, "> "); ++n) entry.command += "\n" + lines[n].substr(2);
        entry.begin = n;
        while (n < lines.size() && !lines[n].empty() && !has(n, "$ ") && !has(n, "# ")) ++n;
        entry.end = n;
        entries.push_back(entry);
    }
    return entries;
}

bool matches(std::string_view pattern, std::string_view line)
{
    const std::size_t any = pattern.find(kAny);
    if (any == std::string_view::npos) return pattern == line;
    if (!line.starts_with(pattern.substr(0, any))) return false;
    const std::string_view rest = pattern.substr(any + kAny.size());
    for (std::size_t at = any; at <= line.size(); ++at)
        if (matches(rest, line.substr(at))) return true;
    return false;
}

bool all_match(std::span<const std::string> patterns, std::span<const std::string> lines)
{
    if (patterns.empty()) return lines.empty();
    if (patterns[0] == kAny && all_match(patterns.subspan(1), lines)) return true;
    if (lines.empty()) return false;
    return patterns[0] == kAny ? all_match(patterns, lines.subspan(1))
                               : matches(patterns[0], lines[0]) && all_match(patterns.subspan(1), lines.subspan(1));
}

// What a command makes a user see, in a transcript's words.
Lines played(const fs::path& folder, const std::string& command)
{
    const auto before = contents(folder);
    const std::string bin = fs::path(SWIVEL_COMMAND).parent_path();
    const Outcome outcome = run_program(
        folder, {"/bin/sh", "-c", command},
        {.environment = {"PATH=" + bin + ":" + std::getenv("PATH"), "SOURCE=" SWIVEL_SOURCE_DIR, "LC_ALL=C"}});
    const std::string code = outcome.exit_code == 0 ? "" : "[" + std::to_string(outcome.exit_code) + "]";
    Lines seen = lines_of(outcome.out), errors = lines_of(outcome.err);
    if (!code.empty() && errors.size() == 1)
        seen.push_back(code + " " + errors[0]);
    else {
        for (const std::string& line : errors) seen.push_back("2> " + line);
        if (!code.empty()) seen.push_back(code);
    }
    const auto after = contents(folder);
    std::set<std::string> changed;  // files and folders: + in which something is new or another, - which are gone
    for (const auto& [name, bytes] : after)
        if (!before.contains(name) || before.at(name) != bytes) changed.insert("+ " + name.substr(0, name.find('/')));
    for (const auto& [name, bytes] : before)
        if (!after.contains(name)) changed.insert("- " + name.substr(0, name.find('/')));
    if (command.find("swivel ") != std::string::npos)
        for (std::string name : changed) {
            std::ranges::replace_if(
                name, [](char c) { return c < ' '; }, '?');  // ends of lines, and bytes that are no ASCII
            seen.push_back(name);
        }
    std::erase(seen, "");
    return seen;
}

std::string joined(std::span<const std::string> lines)
{
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

// What comes, in those lines of before that match it.
Lines renewed(std::span<const std::string> before, Lines seen)
{
    for (std::string& line : seen)
        for (const std::string& pattern : before)
            if (pattern != kAny && matches(pattern, line)) line = pattern;
    return seen;
}

void play(const fs::path& file)
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    spill(folder / "jump.bvh", cut(plain_motion_of(must_find_jump()), 2600, 1));
    const Lines lines = lines_of(slurp(file));
    const auto part = [&](std::size_t begin, std::size_t end) { return std::span(lines).subspan(begin, end - begin); };
    std::string now;
    std::size_t done = 0;
    for (const Entry& entry : entries_of(lines)) {
        const auto expected = part(entry.begin, entry.end);
        const Lines seen = played(folder.path, entry.command);
        const bool is_same = all_match(expected, seen);
        now += joined(part(done, entry.begin)) + joined(is_same ? expected : renewed(expected, seen));
        done = entry.end;
        INFO(file.filename().string() << ":" << entry.begin << ": $ " << entry.command);
        INFO("must come:\n" << joined(expected) << "comes:\n" << joined(seen));
        CHECK(is_same);
    }
    if (std::getenv("SWIVEL_RENEW")) spill(file, now + joined(part(done, lines.size())));
}

}  // namespace

TEST_CASE("transcripts: what users type, and what they see")
{
    std::set<fs::path> files;
    for (const auto& file : fs::directory_iterator(fs::path(SWIVEL_SOURCE_DIR) / "tests/transcripts"))
        files.insert(file);
    REQUIRE_FALSE(files.empty());
    for (const fs::path& file : files) DYNAMIC_SECTION(file.filename().string())
        {
            play(file);
        }
}

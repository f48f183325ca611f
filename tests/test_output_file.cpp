// SPDX-License-Identifier: MIT
// OutputFile's promise: whole or not at all, and one clear line when it cannot be.

#include <fcntl.h>
#include <unistd.h>
#include <catch2/catch.hpp>

#include <stdexcept>

#include "tests/test_data.h"
#include "tools/formats/error.h"
#include "tools/formats/output_file.h"

using namespace swivel::formats;
using namespace swivel::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

void write_all(const fs::path& path, std::string_view text)
{
    OutputFile out(path);
    out.write(text);
    out.commit();
}

// What InputError says when `path` is opened, written and committed; empty if nothing fails.
std::string complaint_about_output(const fs::path& path, std::string_view text = "x")
{
    try {
        write_all(path, text);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

// As a user without root's rights, so that permissions mean something.
struct AsNobody {
    bool was_root = ::geteuid() == 0;
    AsNobody()
    {
        if (was_root) REQUIRE(::seteuid(65534) == 0);
    }
    ~AsNobody()
    {
        if (was_root && ::seteuid(0) != 0) std::abort();
    }
};

}  // namespace

TEST_CASE("a committed file holds what was written, and nothing else is left")
{
    const TempFolder folder;
    std::string text;
    OutputFile out(folder / "a.txt");
    for (int i = 0; i < 300000; ++i) {  // several buffers full
        const std::string line = std::to_string(i) + "\n";
        out.write(line);
        text += line;
    }
    const std::string large(3 << 20, 'x');  // larger than the buffer
    out.write(large);
    out.write("end");
    CHECK_FALSE(fs::exists(folder / "a.txt"));
    out.commit();
    CHECK(slurp(folder / "a.txt") == text + large + "end");
    CHECK(folder.file_count() == 1);
}

TEST_CASE("an uncommitted file leaves the old one and no rest")
{
    const TempFolder folder;
    spill(folder / "a.txt", "old");
    {
        OutputFile out(folder / "a.txt");
        out.write("new");
        CHECK(fs::exists(folder / ("a.txt.partial-" + std::to_string(::getpid()))));
        CHECK(slurp(folder / "a.txt") == "old");
    }
    CHECK(slurp(folder / "a.txt") == "old");
    CHECK(folder.file_count() == 1);
    write_all(folder / "a.txt", "new");
    CHECK(slurp(folder / "a.txt") == "new");
}

TEST_CASE("an empty file can be written")
{
    const TempFolder folder;
    write_all(folder / "a.txt", "");
    CHECK(fs::exists(folder / "a.txt"));
}

TEST_CASE("a symbolic link stays a link")
{
    const TempFolder folder;
    fs::create_directory(folder / "inner");
    fs::create_symlink("inner/real.txt", folder / "link.txt");
    fs::create_symlink("link.txt", folder / "link2.txt");
    write_all(folder / "link2.txt", "dangling");
    CHECK(slurp(folder / "inner/real.txt") == "dangling");
    write_all(folder / "link2.txt", "present");
    CHECK(slurp(folder / "inner/real.txt") == "present");
    CHECK(fs::is_symlink(folder / "link.txt"));
    CHECK(fs::is_symlink(folder / "link2.txt"));
    fs::create_symlink("loop.txt", folder / "loop.txt");
    CHECK_THAT(complaint_about_output(folder / "loop.txt"), Contains("chain of links"));
}

TEST_CASE("targets that cannot be opened are refused by name and cause")
{
    const TempFolder folder;
    spill(folder / "file", "x");
    CHECK_THAT(complaint_about_output(folder / "none/a.txt"),
               StartsWith((folder / "none/a.txt").string() + ": ") && Contains("No such file or directory"));
    CHECK_THAT(complaint_about_output(folder.path), Contains("is a directory"));
    CHECK_THAT(complaint_about_output(folder / "file/a.txt"), Contains("Not a directory"));
    CHECK_THAT(complaint_about_output(""), Contains("needs a name"));
    CHECK_THAT(complaint_about_output(folder / std::string(250, 'n')), Contains("too long"));
    spill(folder / ("b.txt.partial-" + std::to_string(::getpid())), "rest");
    CHECK_THAT(complaint_about_output(folder / "b.txt"), Contains("File exists; remove it"));
    CHECK_THAT(complaint_about_output(folder / "line\nbreak/a"), Contains("line\\x0abreak"));
}

TEST_CASE("permissions are respected")
{
    const TempFolder folder;
    fs::create_directory(folder / "closed");
    fs::create_directory(folder / "open");
    spill(folder / "open/kept.txt", "kept");
    fs::permissions(folder.path, fs::perms(0755));
    fs::permissions(folder / "closed", fs::perms(0555));
    fs::permissions(folder / "open", fs::perms(0777));
    fs::permissions(folder / "open/kept.txt", fs::perms(0444));
    const AsNobody nobody;
    CHECK_THAT(complaint_about_output(folder / "closed/a.txt"), Contains("Permission denied; check the folder"));
    CHECK_THAT(complaint_about_output(folder / "open/kept.txt"), Contains("cannot be replaced: Permission denied"));
    CHECK(complaint_about_output(folder / "open/new.txt").empty());
}

TEST_CASE("a full disk is told, at write or at commit")
{
    CHECK_THAT(complaint_about_output("/dev/full"),
               StartsWith("/dev/full: cannot be written: No space left on device; free some"));
    CHECK_THAT(complaint_about_output("/dev/full", std::string(5 << 20, 'x')), Contains("No space left"));
    CHECK(fs::exists("/dev/full"));
}

TEST_CASE("devices, pipes and open descriptors are written straight")
{
    const TempFolder folder;
    CHECK(complaint_about_output("/dev/null").empty());
    CHECK(fs::is_character_file("/dev/null"));

    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    write_all("/dev/fd/" + std::to_string(ends[1]), "through a pipe");
    char got[64] = {};
    CHECK(::read(ends[0], got, sizeof got) == 14);
    CHECK(std::string(got) == "through a pipe");
    ::close(ends[0]);
    ::close(ends[1]);

    spill(folder / "log.txt", "before ");  // as the shell's ">>" gives it to /dev/stdout
    const int log = ::open((folder / "log.txt").c_str(), O_WRONLY | O_APPEND);
    write_all("/proc/self/fd/" + std::to_string(log), "after");
    ::close(log);
    CHECK(slurp(folder / "log.txt") == "before after");
    CHECK(folder.file_count() == 1);
}

TEST_CASE("calls out of order are the caller's mistake")
{
    const TempFolder folder;
    OutputFile out(folder / "a.txt");
    out.commit();
    CHECK_THROWS_AS(out.write("x"), std::invalid_argument);
    CHECK_THROWS_AS(out.commit(), std::invalid_argument);
}

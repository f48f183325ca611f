// SPDX-License-Identifier: MIT
// OutputFile's promise: whole or not at all, and one clear line when it cannot be.

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <catch2/catch.hpp>

#include <iterator>
#include <tuple>

#include "tests/test_data.h"
#include "tools/formats/error.h"
#include "tools/formats/output_file.h"
#include "tools/formats/partial.h"

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
        CHECK(fs::exists(folder / (".swivel-" + std::to_string(::getpid()) + "-0")));
        CHECK(slurp(folder / "a.txt") == "old");
    }
    CHECK(slurp(folder / "a.txt") == "old");
    CHECK(folder.file_count() == 1);
}

TEST_CASE("two files of one folder, and the rest of a killed run, are not mixed up")
{
    const TempFolder folder;
    const fs::path rest = folder / (".swivel-" + std::to_string(::getpid()) + "-0");
    spill(rest, "rest");
    OutputFile a(folder / "a.txt"), b(folder / "b.txt");
    a.write("a");
    b.write("b");
    b.commit();
    a.commit();
    CHECK(slurp(folder / "a.txt") == "a");
    CHECK(slurp(folder / "b.txt") == "b");
    CHECK(slurp(rest) == "rest");
    CHECK(folder.file_count() == 3);
}

TEST_CASE("an unfinished folder goes with all in it, and with nothing outside")
{
    const TempFolder folder;
    fs::create_directory(folder / "outside");
    spill(folder / "outside/kept", "kept");
    {
        Partial partial;
        REQUIRE(partial.make(folder.path, [](const char* name) { return ::mkdir(name, 0777); }) == 0);
        const fs::path at = partial.name();
        CHECK(at.filename().string().starts_with(".swivel-"));
        fs::create_directories(at / "a/b/c");
        for (int n = 0; n < 1000; ++n) spill(at / ("a/b/" + std::to_string(n)), "x");  // several readings of a folder
        fs::create_directory_symlink(folder / "outside", at / "link");
    }
    CHECK(std::distance(fs::directory_iterator(folder.path), {}) == 1);
    CHECK(slurp(folder / "outside/kept") == "kept");
}

TEST_CASE("a process that cannot unwind removes all its partial files")
{
    const TempFolder folder;
    spill(folder / "b.txt", "old");
    OutputFile a(folder / "a.txt");
    {
        const OutputFile gone(folder / "c.txt");
    }
    OutputFile b(folder / "b.txt");
    CHECK(folder.file_count() == 3);
    const pid_t child = ::fork();
    if (child == 0) {
        Partial::remove_all();
        ::_exit(0);
    }
    REQUIRE(::waitpid(child, nullptr, 0) == child);
    CHECK(folder.file_count() == 1);
    CHECK(slurp(folder / "b.txt") == "old");
}

TEST_CASE("names may be as long as the file system lets them be")
{
    for (std::size_t size = 236; size <= 255; ++size) {
        const TempFolder folder;
        const std::string name(size, 'n');
        write_all(folder / name, "new");
        write_all(folder / name, "newer");
        CHECK(slurp(folder / name) == "newer");
        CHECK(folder.file_count() == 1);
    }
}

TEST_CASE("a replaced file keeps its permissions, a new one has what the umask leaves")
{
    const TempFolder folder;
    const auto mode = [&](const char* name) { return static_cast<unsigned>(fs::status(folder / name).permissions()); };
    for (const unsigned before : {0600u, 0640u, 0644u, 0664u, 0666u, 0700u, 0755u, 0777u}) {
        spill(folder / "old", "old");
        fs::permissions(folder / "old", fs::perms(before));
        fs::create_symlink("old", folder / "link");
        {
            OutputFile out(folder / "link");
            out.write("new");
            for (const auto& file : fs::directory_iterator(folder.path))  // at no moment more
                CHECK((static_cast<unsigned>(file.symlink_status().permissions()) & ~before) * !file.is_symlink() == 0);
            out.commit();
        }
        CHECK(slurp(folder / "old") == "new");
        CHECK(mode("old") == before);
        fs::remove(folder / "link");
    }
    for (const unsigned mask : {0u, 022u, 027u, 077u}) {
        const mode_t own = ::umask(mask);
        write_all(folder / "new", "new");
        ::umask(own);
        CHECK(mode("new") == (0666u & ~mask));
        fs::remove(folder / "new");
    }
}

TEST_CASE("a replaced file keeps its owner and group where the process may give them")
{
    if (::geteuid() != 0) return;  // nobody else may
    const TempFolder folder;
    fs::permissions(folder.path, fs::perms(0777));
    const fs::path file = folder / "a.txt";
    const auto rights = [&] {
        struct stat now;
        REQUIRE(::stat(file.c_str(), &now) == 0);
        return std::tuple(now.st_uid, now.st_gid, now.st_mode & 0777);
    };
    const auto make = [&](uid_t owner, gid_t group, unsigned mode) {
        spill(file, "old");
        REQUIRE(::chown(file.c_str(), owner, group) == 0);
        fs::permissions(file, fs::perms(mode));
    };
    make(65534, 65533, 0640);
    write_all(file, "new");
    CHECK(rights() == std::tuple(65534, 65533, 0640));
    const AsNobody nobody;  // whose group is still root's
    for (const gid_t group : {0u, 65533u}) {
        CHECK(::seteuid(0) == 0);
        make(1, group, 0676);
        CHECK(::seteuid(65534) == 0);
        write_all(file, "new");
        CHECK(rights() == std::tuple(65534, 0, group == 0 ? 0676 : 0666));  // the other group's right is not root's
    }
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

TEST_CASE("a name that is too long is refused before the work, not after")
{
    const TempFolder folder;
    CHECK_THROWS_WITH(OutputFile(folder / std::string(256, 'n')), Contains("cannot be created: File name too long"));
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

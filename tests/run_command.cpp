// SPDX-License-Identifier: MIT
#include "tests/run_command.h"

#include <sys/mman.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <iostream>

#include "tools/swivel/commands.h"

namespace swivel::test {

namespace {

void flush_all()
{
    std::cout.flush();
    std::cerr.flush();
    std::fflush(nullptr);
}

// While it lives, what this process writes to a file descriptor goes to memory, and what it reads from one comes from
// there.
class Capture {
public:
    Capture(int descriptor, const std::string& input) : Capture(descriptor)
    {
        REQUIRE(::pwrite(memory_, input.data(), input.size(), 0) == static_cast<ssize_t>(input.size()));
    }
    explicit Capture(int descriptor)
        : descriptor_(descriptor), before_(::dup(descriptor)), memory_(::memfd_create("capture", 0))
    {
        REQUIRE(before_ >= 0);
        REQUIRE(::dup2(memory_, descriptor_) >= 0);
    }
    Capture(const Capture&) = delete;
    Capture& operator=(const Capture&) = delete;
    ~Capture()
    {
        ::dup2(before_, descriptor_);
        ::close(before_);
        ::close(memory_);
    }
    std::string text() const
    {
        std::string all(static_cast<std::size_t>(::lseek(memory_, 0, SEEK_END)), '\0');
        all.resize(static_cast<std::size_t>(::pread(memory_, all.data(), all.size(), 0)));
        return all;
    }

private:
    int descriptor_, before_, memory_;
};

// While it lives, the working directory is another.
class InFolder {
public:
    explicit InFolder(const std::filesystem::path& folder) : before_(std::filesystem::current_path())
    {
        std::filesystem::current_path(folder);
    }
    InFolder(const InFolder&) = delete;
    InFolder& operator=(const InFolder&) = delete;
    ~InFolder() { std::filesystem::current_path(before_); }

private:
    std::filesystem::path before_;
};

}  // namespace

Outcome run_command(const std::filesystem::path& folder, const Words& arguments, const std::string& input)
{
    std::vector<const char*> argv = {"swivel"};
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    const InFolder there(folder);
    flush_all();
    const Capture in(STDIN_FILENO, input), out(STDOUT_FILENO), err(STDERR_FILENO);
    Outcome outcome;
    outcome.exit_code = tools::run_swivel(static_cast<int>(argv.size()), argv.data());
    flush_all();
    outcome.out = out.text();
    outcome.err = err.text();
    return outcome;
}

Outcome done(const Outcome& outcome)
{
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return outcome;
}

Outcome spawn_command(const std::filesystem::path& folder, const Words& arguments, const Surroundings& surroundings)
{
    Words words = {SWIVEL_COMMAND};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return run_program(folder, std::move(words), surroundings);
}

}  // namespace swivel::test

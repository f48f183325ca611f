// SPDX-License-Identifier: MIT
//
// Runs the swivel command, or another program, in a folder and keeps what it said.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace swivel::test {

using Words = std::vector<std::string>;

struct Outcome {
    int exit_code = -1;    // -N: ended by signal N; SIGALRM where it took too long
    std::string out, err;  // every byte of stdout and stderr
    long peak_kib = 0;     // largest resident memory, looked up 100 times a second; what comes later is missed
};

struct Surroundings {
    Words environment{};                     // "NAME=value" on top of this process's own; "NAME" alone removes it
    bool terminal = false;                   // stderr is a terminal
    unsigned short columns = 0;              // of that; 0: it does not say
    std::function<void()> before{};          // called in the process before it becomes the program: only calls that
                                             // are safe after fork(), such as for limits and signals
    std::function<void(pid_t)> meanwhile{};  // called some 100 times a second while it runs
    unsigned max_seconds = 300;
};

// Runs words[0], a path, as a process of its own and without a shell. `folder` is its working directory. Fails the test
// if it cannot start.
Outcome run_program(const std::filesystem::path& folder, Words words, const Surroundings& surroundings = {});

// Runs `swivel arguments...` as a function of this process, with `folder` as its working directory and `input` on its
// standard input.
Outcome run_command(const std::filesystem::path& folder, const Words& arguments, const std::string& input = {});

// An outcome that must be success: else the test fails, with what was said.
Outcome done(const Outcome& outcome);

// The same as a process. Only a process has an environment, a terminal, a peak of memory and a time.
Outcome spawn_command(const std::filesystem::path& folder, const Words& arguments,
                      const Surroundings& surroundings = {});

}  // namespace swivel::test

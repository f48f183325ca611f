// SPDX-License-Identifier: MIT
//
// A progress bar on stderr while a person looks on; nothing where stderr is not a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace swivel::tools {

class Progress {
public:
    // what: one word, such as "frames". total: how many there are to do.
    Progress(std::string what, std::uint64_t total);
    ~Progress();  // wipes the bar
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // done of total are finished. Redraws at most ten times a second.
    void show(std::uint64_t done);

private:
    std::string what_;
    std::uint64_t total_;
    bool visible_;
    std::chrono::steady_clock::time_point start_, drawn_;
};

}  // namespace swivel::tools

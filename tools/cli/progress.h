// SPDX-License-Identifier: MIT
//
// A progress bar on stderr while a person looks on; nothing where stderr is no terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace swivel::tools {

// The bar and its figures, or as much of them as fits into one line of a terminal that has that many columns.
// done: 0 to total. total: 1 or more. what: their name, such as "frames". seconds: since the start.
std::string progress_line(std::uint64_t done, std::uint64_t total, std::string_view what, double seconds,
                          std::size_t columns);

class Progress {
public:
    // what: their name, such as "frames". total: how many there are to do. quiet: shows nothing.
    Progress(std::string what, std::uint64_t total, bool quiet);
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

#pragma once
// SPDX-License-Identifier: MIT
// Files for tests: real motion where a machine keeps it, a folder of its own for what a test writes, and what
// a folder holds. Real files are looked for in $SWIVEL_TEST_DATA, in Debian's assimp-testmodels, and
// in ../shared/data beside the repository.

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace swivel::test {
namespace fs = std::filesystem;

// A real file by the name it has in ../shared/data; an empty path if this machine has none.
fs::path find_data(const std::string& name);

// The one file every machine must have: its absence fails the test.
fs::path must_find_jump();

// Every real BVH file of this machine.
std::vector<fs::path> all_bvh_files();

inline void spill(const fs::path& path, std::string_view text) { std::ofstream(path, std::ios::binary) << text; }

std::string slurp(const fs::path& path);

// A folder that lives as long as the object.
struct TempFolder {
    fs::path path;

    TempFolder();
    ~TempFolder()
    {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    fs::path operator/(std::string_view name) const { return path / name; }
    auto file_count() const { return std::distance(fs::directory_iterator(path), fs::directory_iterator()); }
};

// Everything below a folder: names within it, and for files their bytes.
std::map<std::string, std::string> contents(const fs::path& folder);

// `text` with the first `from` replaced by `to`; fails the test if there is none.
std::string edited(std::string text, std::string_view from, std::string_view to);

}  // namespace swivel::test

#pragma once
// SPDX-License-Identifier: MIT
// Files for tests: real figures and motion where a machine keeps them, a folder of its own for what a test writes, what
// a folder holds, and what readers say when they refuse a file. Real files are looked for in $SWIVEL_TEST_DATA, in
// Debian's assimp-testmodels, and in ../shared/data beside the repository.

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "tools/formats/error.h"

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

// A figure, of which all animations come back, and what tells the bend of arms and of legs.
struct SharedFigure {
    std::string name;
    int animations;  // 0: it has none
    std::size_t limbs;
    std::string arms_by, legs_by;
    std::vector<std::string> options = {};
};
inline const std::vector<SharedFigure> kSharedFigures = {
    {"RobotExpressive.glb", 14, 2, "rest pose", ""},  // its feet hang on its root
    {"m2m_human_ymca.glb", 1, 4, "clip", "toes"},
    {"m2m_human_skeleton_tpose.glb", 1, 4, "toes", "toes"},
    {"m2m_human_male.glb", 0, 4, "toes", "rest pose"},
    {"cesium_man.gltf",
     1,
     4,
     "rest pose",
     "rest pose",
     {"--arm", "left:#16,#17,#18", "--arm", "right:#13,#14,#15", "--leg", "left:#7,#8,#9", "--leg", "right:#3,#4,#5"}},
};
// Each has four limbs.
inline constexpr const char* kSharedClips[] = {"cmu_01_01_forward_jump.bvh", "cmu_02_01_walk.bvh",
                                               "cmu_05_06_dance.bvh"};

// A real file, or an empty path where this machine keeps none; a folder that was named must have it.
inline fs::path find_or_warn(const std::string& name)
{
    const fs::path path = find_data(name);
    if (!path.empty()) return path;
    INFO(name << " is in none of the folders above");
    REQUIRE(std::getenv("SWIVEL_TEST_DATA") == nullptr);
    WARN("not judged: " << name << ", which this machine has not");
    return path;
}

// What the InputError of `read` says, in one line, without the folder; empty if there is none.
template <class Read>
std::string complaint_of(const TempFolder& folder, const Read& read)
{
    try {
        read();
    } catch (const formats::InputError& error) {
        const std::string what = error.what();
        const std::string place = (folder.path / "").string();
        REQUIRE(what.starts_with(place));
        REQUIRE(what.find_first_of("\n\r") == std::string::npos);
        return what.substr(place.size());
    }
    return {};
}

}  // namespace swivel::test

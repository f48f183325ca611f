// SPDX-License-Identifier: MIT
//
// A small crowd in a cache, in a folder of its own, and the commands of caches run there.
#pragma once

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/pipe_stage.h"
#include "tools/cache/cache.h"

namespace swivel::test {

inline void require_done(const Outcome& outcome)
{
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
}

// A replay goes through the characters in another order.
inline std::multiset<std::string> sorted_lines(const fs::path& path)
{
    std::istringstream text(slurp(path));
    std::multiset<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.insert(line);
    return lines;
}

inline const std::string kLimited =
    "[limb.arms.limits]\nflexion_deg = [0, 90]\n[limb.arms.swivel]\nmost_deg_per_frame = 3\n";

// A crowd of 40 characters with limits and step limits, in a cache.
struct CacheStage {
    TempFolder folder;
    std::vector<std::string> crowd{"--crowd", "crowd.toml", "--characters", "40"};

    explicit CacheStage(const std::string& toml = kLimited)
    {
        std::string clip = kTwoArms;
        clip.replace(clip.rfind(" 0 21 0 "), 8, " 0 21 40 ");  // turns an elbow by more than its step limit
        spill(folder / "clip.bvh", clip);
        spill(folder / "crowd.toml", toml);
        require_done(run(with_crowd({"store", "clip.bvh", "cache", "--chunk", "1,16"})));
    }
    Outcome run(const std::vector<std::string>& words) const { return run_command(folder.path, words); }
    std::vector<std::string> with_crowd(std::vector<std::string> words) const
    {
        words.insert(words.end(), crowd.begin(), crowd.end());
        return words;
    }
    std::map<std::string, std::string> files() const { return contents(folder / "cache"); }
    // Turns a bit of a file over.
    void flip(const std::string& name) const
    {
        std::string bytes = slurp(folder / ("cache/" + name));
        bytes[9 % bytes.size()] ^= 1;
        spill(folder / ("cache/" + name), bytes);
    }
    void require_refused(const std::vector<std::string>& words, const std::string& what) const
    {
        const Outcome outcome = run(words);
        CHECK(outcome.exit_code == 1);
        CHECK_THAT(outcome.err, Catch::Matchers::Contains(what));
        CHECK(std::ranges::count(outcome.err, '\n') == 1);
    }
};

}  // namespace swivel::test

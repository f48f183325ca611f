// SPDX-License-Identifier: MIT
//
// A small clip, a table and a crowd file in a folder, and runs of `swivel solve` there.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tests/test_data.h"

namespace swivel::test {

inline const std::string kPipeTable =
    "frame,character,limb,x,y,z,pole_x,pole_y,pole_z\n"
    "0,0,left_arm,6,8,3,4,8,9\n";

// A folder with clip.bvh, t.csv and c.toml.
struct PipeStage {
    TempFolder folder;

    PipeStage()
    {
        spill(folder / "clip.bvh", kTwoArms);
        spill(folder / "t.csv", kPipeTable);
        spill(folder / "c.toml", "[limb.arms]\nhand = false\n");
    }
    Outcome run(Words words, const std::string& input = {}) const
    {
        words.insert(words.begin(), "solve");
        return run_command(folder.path, words, input);
    }
    // What a run that must succeed writes to the file at the end of its words.
    std::string written(const Words& words) const
    {
        const Outcome outcome = run(words);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return slurp(folder / words.back());
    }
};

}  // namespace swivel::test

// SPDX-License-Identifier: MIT
//
// What `swivel solve` says of its work before the figures: the clip, the limbs bound, the crowd.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "tools/swivel/limbs.h"
#include "tools/swivel/statistics.h"

namespace swivel::tools {

struct SolveFacts {
    std::string clip, crowd;  // files; crowd may be empty
    std::string motion;       // MotionFile::describe()
    std::string targets;      // "clip" or a file
    std::uint32_t characters = 1;
    std::uint64_t seed = 1;
    std::span<const LimbFinding> missing{};  // limbs of the kinds solved that the skeleton has no names of
    std::string doubt{};                     // why the figure's front may be wrong; empty: nothing speaks against it
};

// Lines for people, on stdout.
void print_clip(const SolveFacts& facts, const formats::Clip& clip, std::span<const Limb> limbs);
nlohmann::ordered_json json_of(const SolveFacts& facts, const formats::Clip& clip, std::span<const Limb> limbs);

// In which way a solve as a whole went wrong, in one line: limbs have bad input, or most of them are out of reach.
// Empty: it did not. A note for people, and what --strict fails for.
std::string what_went_wrong(const Statistics& statistics);

}  // namespace swivel::tools

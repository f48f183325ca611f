// SPDX-License-Identifier: MIT
//
// What `swivel solve` says of its work before the figures: the clip, the limbs bound, the crowd.
#pragma once

#include <cstdio>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "tools/crowd/characters.h"

namespace swivel::tools {

struct SolveFacts {
    std::string clip, crowd;  // files; crowd may be empty
    std::string motion;       // MotionFile::describe()
    std::string targets;      // "clip" or a file
    std::uint32_t characters = 1;
    std::uint64_t seed = 1;
    std::span<const LimbFinding> missing{};  // limbs that were asked for and do not bind
    std::vector<std::string> notes{};        // MotionFile::notes()
};

// A file's name as one line shows it.
std::string shown_file(const std::string& name);

// Lines for people, on stdout or stderr.
void print_clip(std::FILE* to, const SolveFacts& facts, const formats::Clip& clip, std::span<const Limb> limbs);
nlohmann::ordered_json json_of(const SolveFacts& facts, const formats::Clip& clip, std::span<const Limb> limbs);
// What makes them differ, in their order.
nlohmann::ordered_json json_of(std::span<const goal_character> characters);

}  // namespace swivel::tools

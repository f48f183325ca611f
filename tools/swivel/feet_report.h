// SPDX-License-Identifier: MIT
//
// What `swivel feet` says of one clip: its legs, when they are in contact, and how its feet skate before and after.
#pragma once

#include <cstdio>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/feet/judge_feet.h"
#include "tools/swivel/motion_file.h"

namespace swivel::tools {

struct FeetRun {
    std::string file, out, export_contacts;  // as the user wrote them; the last two may be empty
    const MotionFile* motion_file = nullptr;
    std::vector<Limb> legs;
    std::vector<LimbFinding> missing;
    ContactBars bars;
    std::string contacts_from;  // the table's file; empty: they are found
    std::string ground;         // the picture's file; empty: a level floor
    LegMotion motion;
    Contacts contacts;
    Floor floor;
    PlacedFeet placed;
    Skating before, after;
    std::vector<FeetDoubt> doubts;
    std::vector<std::string> clip_doubts;  // of FILE itself, as clip_doubts() tells them
};

void print_feet(const FeetRun& run, std::FILE* to);
nlohmann::ordered_json json_of(const FeetRun& run);

}  // namespace swivel::tools

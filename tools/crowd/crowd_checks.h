// SPDX-License-Identifier: MIT
//
// Checks a crowd file against the solved limbs, their skeleton and the output file. All functions throw InputError
// naming file, line and key.
#pragma once

#include <span>
#include <string>

#include "tools/formats/crowd_file.h"
#include "tools/rig/limbs.h"

namespace swivel::tools {

// "clip", or the targets' file that the crowd file names, a relative path from the crowd file's folder. It can be
// opened as a text, or is a pipe, which is not tried.
std::string checked_targets(const formats::CrowdFile& file);

// Requires that every table selects a solved limb.
void require_solved(const formats::CrowdFile& file, std::span<const Limb> limbs);

// Refuses settings of a limb
// - that another of its keys disables;
// - of a clavicle, unless there is a joint above the limb, at some distance, that would turn nothing else;
// - per second, for a clip of uneven frames;
// - that keep a leg from standing on ground;
// - of an arm's hand where characters carry boxes: it then moves with the forearm.
void require_sense(const formats::CrowdFile& file, const formats::LimbSettings& settings, const formats::Clip& clip,
                   const Limb& limb);

// The solver's field of a limit, and whether it limits the hand. limit: its place in formats::kLimitKeys.
struct LimitInfo {
    swivel_field field;
    bool is_of_hand;
};
LimitInfo limit_info(std::size_t limit);

// Requires that a holding limb names another solved limb, which has a hand and holds nothing. With boxes no hand is
// free.
void require_can_hold(const formats::CrowdFile& file, std::span<const Limb> limbs);

// Refuses stretched bones and twist bones for an output clip, BVH or glTF, which cannot store them.
void require_fits_motion(const formats::CrowdFile& file, std::span<const Limb> limbs);

}  // namespace swivel::tools

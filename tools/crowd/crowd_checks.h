// SPDX-License-Identifier: MIT
//
// Whether a crowd file makes sense: for the limbs that are solved, for their skeleton, for the file that is written.
// All throw InputError naming file, line and key.
#pragma once

#include <span>
#include <string>

#include "tools/formats/crowd_file.h"
#include "tools/rig/limbs.h"

namespace swivel::tools {

// "clip", or the targets' file that the crowd file names, a relative path from the crowd file's folder. It can be
// opened as a text, or is a pipe, which is not tried.
std::string checked_targets(const formats::CrowdFile& file);

// Every table speaks of a limb that is solved.
void require_solved(const formats::CrowdFile& file, std::span<const Limb> limbs);

// No key of a limb does nothing because of another.
void require_sense(const formats::CrowdFile& file, const formats::LimbSettings& settings);

// What the solver says of a limit. limit: its place in formats::kLimitKeys.
struct LimitInfo {
    swivel_field field;
    bool is_of_hand;
};
LimitInfo limit_info(std::size_t limit);

// Nothing is asked of a leg that keeps it from standing on ground.
void require_can_stand(const formats::CrowdFile& file, const formats::LimbSettings& settings);

// Nothing is asked of an arm's hand, which goes along with the forearm where characters carry boxes.
void require_can_carry(const formats::CrowdFile& file, const formats::LimbSettings& settings);

// A limb that holds names another one that is solved, that has a hand, and that holds nothing. Boxes leave no hand
// free.
void require_can_hold(const formats::CrowdFile& file, std::span<const Limb> limbs);

// With a clavicle: the joint above the limb is there, some way from it, and carries nothing else that it would turn
// along.
void require_own_clavicle(const formats::CrowdFile& file, const formats::LimbSettings& settings,
                          const formats::Clip& clip, const Limb& limb);

// Nothing is asked for per second of a clip whose frames are uneven.
void require_even_frames(const formats::CrowdFile& file, const formats::LimbSettings& settings,
                         const formats::Clip& clip);

// Nothing is asked for that a written clip, BVH or glTF, has no room for: stretched bones and twist bones.
void require_fits_motion(const formats::CrowdFile& file, std::span<const Limb> limbs);

}  // namespace swivel::tools

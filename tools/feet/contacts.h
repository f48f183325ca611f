// SPDX-License-Identifier: MIT
//
// When feet are in contact with the ground: found in a clip, or given as a table. Knows where legs are.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tools/crowd/ground.h"
#include "tools/crowd/stands.h"
#include "tools/feet/leg_motion.h"
#include "tools/formats/contacts_csv.h"

namespace swivel::tools {

using Contacts = std::vector<std::vector<bool>>;  // [leg][frame]

// A foot is in contact while its toe is slower and lower than these, in most frames of a twelfth of a second.
struct ContactBars {
    double speed = 0.8;  // leg lengths a second, over a thirtieth of a second
    // Leg lengths. A toe is low up to this height over its floor, which a fiftieth of its frames are not above. A foot
    // whose floor is as much over the lowest one is held up.
    double height = 0.085;
};

Contacts find_contacts(const LegMotion& motion, const ContactBars& bars);

// How feet slide while they are low, by more than half a leg in the clip.
struct Slide {
    Eigen::Vector3d velocity_w;  // of the feet, in lengths of the clip a second
    bool with_body;              // they go where the body goes; else the clip walks in place
};

// Nothing for feet that stand. They go with the body if their path beside it is less than half of that in the world.
// Else the clip walks in place, if they go more than twice as far as the room is wide in which the body stays.
std::optional<Slide> slide_of(const LegMotion& motion, const ContactBars& bars);

// The rows of a table: each leg's first frame, and each in which its contact begins or ends.
std::vector<formats::ContactRow> rows_of(const LegMotion& motion, const Contacts& contacts);

// And back. A row holds until the leg's next one; before its first, a leg is not in contact. frame_count: of the clip.
// Throws InputError, naming file and line, for a limb that is none of the legs, and for a frame beyond the last.
Contacts contacts_of_rows(std::span<const LegPath> legs, std::size_t frame_count,
                          std::span<const formats::ContactRow> rows, const std::filesystem::path& file);

struct Floor {
    Eigen::Vector3d up_w = Eigen::Vector3d::UnitY();
    double level = 0;               // how high the toes stand over the world's origin, where no hill is
    const Ground* hills = nullptr;  // not owned

    // How high the hills are there; 0 without any.
    double hill(const Eigen::Vector3d& place_w) const;
    // Across the ground there, unit, and upwards.
    Eigen::Vector3d normal_w(const Eigen::Vector3d& place_w) const;
    // A toe's height over where it would stand.
    double over(const Eigen::Vector3d& toe_w) const { return toe_w.dot(up_w) - level - hill(toe_w); }
};

// The floor of a clip without hills: the height that half of the frames of contact are not above. Some foot must be in
// contact.
double floor_level(const LegMotion& motion, const Contacts& contacts);

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
//
// The contacts of feet with the ground, found in a clip or read from a table. Knows legs' motion.
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
    // Leg lengths. A toe is low if it is no higher than this over its floor, the 2nd percentile of its heights. A foot
    // whose floor is this much over the lowest one is held up.
    double height = 0.085;
};

Contacts find_contacts(const LegMotion& motion, const ContactBars& bars);

// The slide of low feet, by more than half a leg in the clip.
struct Slide {
    // Of most frames, in lengths of the clip a second: the median, since low feet that swing go the other way.
    Eigen::Vector3d velocity_w;
    bool with_body;  // the feet slide with the body; else the clip walks in place
};

// Nothing for feet that stand. Feet slide with the body if their path relative to it is less than half of their path in
// the world. Else the clip walks in place if they go more than twice the width of the body's own motion.
std::optional<Slide> slide_of(const LegMotion& motion, const ContactBars& bars);

// The rows of a table: each leg's first frame, and each in which its contact begins or ends.
std::vector<formats::ContactRow> rows_of(const LegMotion& motion, const Contacts& contacts);

// The inverse of rows_of(). A row holds until the leg's next one; before its first, a leg is not in contact.
// frame_count: of the clip. Throws InputError, naming file and line, for a limb that is no leg here, and for a frame
// beyond the last.
Contacts contacts_of_rows(std::span<const LegPath> legs, std::size_t frame_count,
                          std::span<const formats::ContactRow> rows, const std::filesystem::path& file);

struct Floor {
    Eigen::Vector3d up_w = Eigen::Vector3d::UnitY();
    double level = 0;               // the toes' standing height over the world's origin, without hills
    const Ground* hills = nullptr;  // not owned

    // The hills' height at a place; 0 without hills.
    double hill(const Eigen::Vector3d& place_w) const;
    // The ground's unit normal at a place, upwards.
    Eigen::Vector3d normal_w(const Eigen::Vector3d& place_w) const;
    // A toe's height over its standing height.
    double over(const Eigen::Vector3d& toe_w) const { return toe_w.dot(up_w) - level - hill(toe_w); }
};

// The floor of a clip without hills: the median height of toes in contact. Some foot must be in contact.
double floor_level(const LegMotion& motion, const Contacts& contacts);

}  // namespace swivel::tools

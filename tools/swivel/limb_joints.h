// SPDX-License-Identifier: MIT
//
// Which joints of a skeleton are an arm or a leg, told from their names. Knows clips alone.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "tools/formats/clip.h"
#include "tools/formats/limb_name.h"

namespace swivel::tools {

// Shoulder, elbow and wrist, or hip, knee and ankle: joints of a clip.
using LimbJoints = std::array<int, 3>;

struct LimbByName {
    std::optional<LimbJoints> joints;
    std::string habit;    // whose names they are, for people: "Mixamo, CMU, MotionBuilder"
    std::string problem;  // without joints: why names that fit are no limb; empty if none fit
};

// The limb's joints by the habits of exporters; docs/rigs.md has the table. Case, separators, name spaces, common
// prefixes and, where nothing fits with them, numbers, jnt and joint at the end do not count. Each must be its name's
// only bearer among the bones (among all joints if no bone bears it) and lie above the next, and one at least must be a
// bone; what lies between must be a twist bone by name, a part of the upper bone by name (require_twists_between() then
// asks for its place), or at the same place as one of them. Where two habits find limbs without a joint in common there
// is none: two figures.
LimbByName limb_by_name(const formats::Clip& clip, formats::LimbName limb);

// True if each is above the next.
bool is_chain(const formats::Clip& clip, const LimbJoints& joints);

// True if a joint's name says that it shares out another's twist: "upperarm_twist_01_l", "lForearmRoll".
bool is_twist_name(std::string_view joint_name);

// The side that a joint's name speaks of, or `otherwise` where it speaks of none or of both.
formats::Side side_of(std::string_view joint_name, formats::Side otherwise);

}  // namespace swivel::tools

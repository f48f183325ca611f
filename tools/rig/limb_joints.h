// SPDX-License-Identifier: MIT
//
// Which joints of a skeleton are an arm or a leg, told from their names. Knows clips alone.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

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
// bone; what lies between must be a twist or roll bone by name, a part of that bone by name
// (require_parts_between() then asks for proof), or at the same place as one of them. Where a habit's names are borne
// by three joints beside these, too, there is none: two figures.
LimbByName limb_by_name(const formats::Clip& clip, formats::LimbName limb);

// True if each is above the next.
bool is_chain(const formats::Clip& clip, const LimbJoints& joints);

// The first joint of `a` that is in `b`, too; -1 if there is none.
int shared_joint(std::span<const int> a, std::span<const int> b);

// Two joints of one name, each above one of these two alone: the trunks of two figures. Where their names differ by
// what are_namesakes() leaves out there must be two such pairs, of two names: a copied figure has more than a spine.
std::optional<std::array<int, 2>> trunks_apart(const formats::Clip& clip, int joint_a, int joint_b);

}  // namespace swivel::tools

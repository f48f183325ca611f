// SPDX-License-Identifier: MIT
//
// The bodies of SOURCE and TARGET of `swivel retarget`: by the names of their joints, and by what options say of them.
#pragma once

#include <optional>

#include "tools/retarget/joint_pairs.h"
#include "tools/rig/limb_choice.h"
#include "tools/swivel/commands.h"

namespace swivel::tools {

// What --arm, --leg, --head, --rest and --up say of one body.
struct BodyChoice {
    LimbChoice limbs;
    std::optional<NamedJoint> head;
    RestChoice rest;
};

// Throws CommandError for an option that does not say whose it is or is given twice for one body, and for the first
// three beside --map.
BodyChoice body_choice(const RetargetOptions& options, BodySide side);

// Throws InputError as choose_joints() and body_of() do.
PartedBody parted_body(const formats::Clip& clip, const std::string& file, const BodyChoice& choice);

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
//
// Which joints of a skeleton are an arm or a leg, told from their names. Knows clips alone.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "tools/formats/clip.h"
#include "tools/formats/limb_name.h"

namespace swivel::tools {

// Shoulder, elbow and wrist, or hip, knee and ankle: joints of a clip.
using LimbJoints = std::array<int, 3>;

// True if each is the parent of the next.
bool is_chain(const formats::Clip& clip, const LimbJoints& joints);

// The limb's joints by the habits of exporters: CMU, Mixamo, MotionBuilder, Unity, VRM, Unreal, Blender's Rigify,
// Quaternius, 3ds Max Biped, Poser, DAZ, Biovision. Case, separators and name spaces do not count. Nothing where no
// habit gives three joints, each its name's only bearer and the parent of the next.
std::optional<LimbJoints> joints_by_habit(const formats::Clip& clip, formats::LimbName limb);

// The side that a joint's name speaks of, or `otherwise` where it speaks of none or of both.
formats::Side side_of(std::string_view joint_name, formats::Side otherwise);

}  // namespace swivel::tools

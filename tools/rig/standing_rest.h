// SPDX-License-Identifier: MIT
//
// A rest pose that stands. Skeletons such as LAFAN1's have all bones along one axis in the rest pose, which then says
// neither up nor forwards nor which way a limb hangs; their frames do. Knows clips alone.
#pragma once

#include <optional>
#include <string>

#include "tools/formats/clip.h"
#include "tools/rig/limb_joints.h"

namespace swivel::tools {

// What the user says of the rest pose.
struct RestChoice {
    std::optional<std::size_t> frame;     // this one is the rest pose
    std::optional<Eigen::Vector3d> up_w;  // an axis of the world: a frame that stands along it is the rest pose
};

// Where the rest pose cannot be one, because a foot is above its hip or the legs point apart, a frame takes its place:
// the most upright one, then straightened. It is turned to where files of that up face, +Z, or -Y where Z is up; its
// shoulders are square to that, and the bones of its back are upright. A frame is as upright as the least upright of
// its trunk, thighs and shins. Up is the axis of the world along which heads are above feet, in the mean of all frames.
// The joints' rest_rotation changes, and no frame does. choice overrides all. limbs: where no leg is known, a frame
// must be chosen.
//
// Returns what was done, a line for people; empty where the rest pose is the file's own. Throws CannotBind where no
// frame stands, all parts within 60 degrees of upright, or where the chosen one does not exist.
std::string stand_at_rest(formats::Clip& clip, const KnownLimbs& limbs, const RestChoice& choice);

// Some files have their bones' true lengths in keys alone. Where a limb's bone is longer or shorter by a tenth in the
// first frame than at rest, joints below the hips rest at the first frame's offsets, and all at its scales. Returns a
// line for people; empty where nothing was changed.
std::string size_at_rest(formats::Clip& clip, const KnownLimbs& limbs);

}  // namespace swivel::tools

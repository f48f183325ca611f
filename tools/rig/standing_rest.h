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

// The user's own choice of a rest pose.
struct RestChoice {
    std::optional<std::size_t> frame;     // this one is the rest pose
    std::optional<Eigen::Vector3d> up_w;  // an axis of the world: a frame that stands along it is the rest pose
};

// A frame takes the rest pose's place where the file's own cannot stand:
// - a foot is above its hip, or the legs point apart;
// - the trunk points along another axis than +Y or +Z, and than in the frames;
// - legs or feet differ by 20 degrees from each other's mirror images, as in mid-step.
// It is the most upright frame, straightened. The figure is turned to where files of that up face: +Z, or -Y where Z is
// up. Its shoulders and feet are square to that, and its back is upright from the lowest joint of the spine to the
// head. A frame is as upright as the least upright of its trunk, thighs and shins. Up is the axis of the world along
// which heads are above feet, in the mean of all frames. The joints' rest_rotation changes alone, and no frame does.
// choice overrides all. limbs: where no leg is known, a frame must be chosen.
//
// Returns what was done, a line for people; empty where the rest pose is the file's own. Where no frame stands, all
// parts within 60 degrees of upright, the first of the three throws CannotBind, and so does the user's choice. The
// others then leave the file's own, and so they do without motion, in clips of one frame.
std::string stand_at_rest(formats::Clip& clip, const KnownLimbs& limbs, const RestChoice& choice);

// Some files have their bones' true lengths in keys alone. Where the limbs' bones are longer or shorter by a tenth in
// the first frame than at rest, in the median, joints below the hips rest at the first frame's offsets, and all at its
// scales. Returns a line for people; empty where nothing was changed.
std::string size_at_rest(formats::Clip& clip, const KnownLimbs& limbs);

}  // namespace swivel::tools

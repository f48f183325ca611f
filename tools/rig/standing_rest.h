// SPDX-License-Identifier: MIT
//
// Replaces rest poses that do not stand. Skeletons such as LAFAN1's rest with all bones along one axis, so that only
// their frames show up, forwards and how limbs hang. Knows clips alone.
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
// Returns a line for people on the change; empty if the file's rest pose stays. A frame stands if all parts are within
// 60 degrees of upright. If none does, the first of the three reasons, and the user's choice, throw CannotBind; the
// other reasons then leave the file's rest pose, as they do in clips of one frame.
std::string stand_at_rest(formats::Clip& clip, const KnownLimbs& limbs, const RestChoice& choice);

// Some files have their bones' true lengths only in keys. If the median bone of the limbs differs by a tenth between
// the first frame and rest, joints below the hips rest at the first frame's offsets, and all at its scales. Returns a
// line for people; empty without a change.
std::string size_at_rest(formats::Clip& clip, const KnownLimbs& limbs);

}  // namespace swivel::tools

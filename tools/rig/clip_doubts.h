// SPDX-License-Identifier: MIT
//
// The faults that a stranger would point at in a clip: of its body, and a joint that jumps in one frame, a limb that
// never moves, feet below the ground. Knows clips and the parts of bodies.
#pragma once

#include <string>
#include <vector>

#include "tools/rig/body_parts.h"

namespace swivel::tools {

// A line each for people; empty for a clip that looks right. First those of body_doubts(). If its up is wrong, that
// stands alone. The other rules are how people move.
// - A bone changes its length by a tenth.
// - An upper arm points backwards; an elbow is inside the trunk.
// - A joint turns there and back within three frames, far more than it does beside that. The worst one is told.
// - The first frame is a pose of its own, such as a T-pose. The body jumps. A limb never moves while the other does.
// - The feet are below height 0.
// parts: as body_parts() finds them; what is not known is not judged. Time: some passes over all frames.
std::vector<std::string> clip_doubts(const formats::Clip& clip, const std::vector<BodyPart>& parts);

}  // namespace swivel::tools

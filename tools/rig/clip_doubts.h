// SPDX-License-Identifier: MIT
//
// Finds visible faults in a clip: those of its body, a joint that jumps in one frame, a limb that never moves, feet
// below the ground. Knows clips and the parts of bodies.
#pragma once

#include <string>
#include <vector>

#include "tools/rig/body_doubts.h"

namespace swivel::tools {

// A line each for people; empty for a clip that looks right. First those of body_doubts(). If its up is wrong, that
// stands alone. The other rules are how people move.
// - A bone changes its length by a tenth.
// - An upper arm points backwards. Garbage: an elbow is inside the trunk.
// - A joint turns there and back within three frames, far more than it does beside that. The worst one is told.
// - The first frame is a pose of its own, such as a T-pose. The body jumps. A limb never moves while the other does.
// - The feet are below height 0.
// parts: of body_parts(), also of `body`. Unknown parts are not judged. Time: some passes over all frames.
BodyDoubts clip_doubts(const BodyFrames& body, const std::vector<BodyPart>& parts);
// The texts of these.
std::vector<std::string> clip_doubts(const formats::Clip& clip, const std::vector<BodyPart>& parts);

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
//
// The faults that a stranger would point at in a clip: left and right exchanged, a knee that bends the wrong way, a
// joint that jumps in one frame. Knows clips and the parts of bodies.
#pragma once

#include <string>
#include <vector>

#include "tools/rig/body_parts.h"

namespace swivel::tools {

// A line each for people; empty for a clip that looks right. The rules are how people are built and move.
// - Bones of one side are a tenth longer than the other's, or change their length by that.
// - The left leg is on the right of where the toes point, or the left arm on the side of the right leg; one foot points
//   backwards.
// - A knee bends forwards, or an elbow backwards; an upper arm points backwards; an elbow is inside the trunk.
// - A joint turns there and back within three frames, far more than it does beside that. The worst one is told.
// - The first frame is a pose of its own, such as a T-pose. The body jumps. A limb never moves while the other does.
// - The feet are below height 0.
// - The frames stand along another axis than the rest pose. This stands alone, since all else would follow from it.
// parts: as body_parts() finds them; what is not known is not judged. Time: some passes over all frames.
std::vector<std::string> clip_doubts(const formats::Clip& clip, const std::vector<BodyPart>& parts);

// Those of them that tell of the body, whatever it does: its up, lengths beside the other side's, left and right
// exchanged, knees and elbows that bend the wrong way.
std::vector<std::string> body_doubts(const formats::Clip& clip, const std::vector<BodyPart>& parts);

}  // namespace swivel::tools

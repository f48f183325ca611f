// SPDX-License-Identifier: MIT
//
// What is wrong in a clip with its body, whatever that does: left and right exchanged, a knee that bends the wrong way.
// Knows clips and the parts of bodies.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/rig/body_frames.h"

namespace swivel::tools {

// A line each for people. The rules are how people are built.
// - Bones of one side are a tenth longer than the other's.
// - The left leg is on the right of where the toes point, or the left arm on the side of the right leg; one foot points
//   backwards.
// - A knee bends forwards, or an elbow backwards.
// - The frames stand along another axis than the rest pose. This stands alone, since all else would follow from it.
// parts: as body_parts() finds them; what is not known is not judged.
struct BodyDoubts {
    std::vector<std::string> lines;
    bool is_up_wrong = false;  // the line is that of the axes
};
BodyDoubts body_doubts(const BodyFrames& body);
std::vector<std::string> body_doubts(const formats::Clip& clip, const std::vector<BodyPart>& parts);

// "thigh"; bone: 0 for a limb's upper one, 1 for its lower one
std::string_view bone_name(std::size_t limb, std::size_t bone);

// Whether one length is a tenth longer than the other. A bone of no length tells nothing.
bool is_other_length(double a, double b);

}  // namespace swivel::tools

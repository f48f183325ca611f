// SPDX-License-Identifier: MIT
//
// Gives a clip's figure longer or shorter legs, arms and spine, and adapts its motion. Knows clips alone.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/formats/clip.h"
#include "tools/rig/body_parts.h"

namespace swivel::tools {

// Factors of the bones' lengths. Legs are thighs and shins, arms upper arms and forearms; the spine leads from the hips
// to all joints that hang on the chest. Other joints on these bones move along them. Speed is the number of the clip's
// frames that the figure performs in one.
struct Proportions {
    double legs = 1, arms = 1, spine = 1, speed = 1;

    bool operator==(const Proportions&) const = default;
};

// The missing parts that these factors need, in VRM's words; empty: none.
std::string unknown_part(const std::vector<BodyPart>& body, const Proportions& asked);

// All frames of the clip by a figure of each build, one after the other. Joints turn as they did. The root goes as far
// as the legs are long, and the hips are as high as these need. For that the middle of both hips is scaled, about where
// it starts at the height of an ankle that stands. All parts must be known, and Y is up.
formats::Clip proportioned(const formats::Clip& clip, const std::vector<BodyPart>& body,
                           std::span<const Proportions> builds);

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
//
// Where a clip is worse than before its feet were placed, as a stranger would see it. Knows where legs are.
#pragma once

#include "tools/feet/place_feet.h"
#include "tools/feet/skating.h"

namespace swivel::tools {

struct FeetDoubt {
    enum Kind { off_ground, knee, toe_jump, body_jump } kind;
    std::size_t leg;          // none for the body
    std::size_t first, last;  // frames
    double value, before;     // in the units of Skating; before: the clip's largest, of a toe off the ground 0
    Eigen::Vector3d place_w;  // of the toe or the body
};

// A line for each contact whose toe is off its ground by more than 0.012 leg lengths, a man's centimetre. And one for
// each leg's knee and toe, and for the body, that turns or jumps more than twice as much as the clip's largest. A jump
// below 60 leg lengths/s^2 of a toe, or 30 of the body, or a knee slower than 720 degrees/s, is never reported.
// skating: of the clip before.
std::vector<FeetDoubt> feet_doubts(const LegMotion& after, const LegMotion& before, const Skating& skating,
                                   const Contacts& contacts, const ContactBars& bars, const Floor& floor);

}  // namespace swivel::tools

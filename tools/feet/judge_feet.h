// SPDX-License-Identifier: MIT
//
// What a stranger would point at in a clip whose feet were placed: where it is worse than before. Knows where legs are.
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
// each leg's knee and toe, and for the body, that turns or jumps more than twice as much as the clip's largest. Below
// 720 degrees, 60 and 30 leg lengths a second, a second, nobody sees that.
std::vector<FeetDoubt> doubts_of(const LegMotion& after, const LegMotion& before, const Contacts& contacts,
                                 const ContactBars& bars, const Floor& floor);

}  // namespace swivel::tools

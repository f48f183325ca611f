// SPDX-License-Identifier: MIT
//
// How far feet skate, and where a clip is worse than before its feet were placed, as a stranger would see it. Knows
// where legs are.
#pragma once

#include "tools/feet/contacts.h"
#include "tools/feet/place_feet.h"

namespace swivel::tools {

// What skates, and what keeps feet from it costs. Lengths are in leg lengths.
struct Skating {
    double mean_speed = 0, max_speed = 0;  // of toes in contact over the ground, a second
    double step = 0;   // the way of a toe in contact over the ground, a step; a step's contact begins within the clip
    double drift = 0;  // the most that a toe is from where its contact began, over the ground
    double off_ground = 0;  // the most that a toe in contact is over or under where it would stand
    double tip_depth = 0;   // the most that the tip of toes is under where it would be if they stood
    double knee_deg = 0;    // the largest change of a knee's angle, a frame
    double jump = 0;        // the largest change of a toe's velocity, a frame
    double body_jump = 0;   // and of the body's
};

// How far the knee is bent, in degrees.
double bend_deg(const LegPath& leg, std::size_t frame);

Skating skating_of(const LegMotion& motion, const Contacts& contacts, const Floor& floor);

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

// SPDX-License-Identifier: MIT
//
// How far feet skate, and what keeps them from it costs. Lengths are in leg lengths. Knows where legs are.
#pragma once

#include "tools/feet/floor.h"

namespace swivel::tools {

struct Skating {
    double mean_speed = 0, most_speed = 0;  // of toes in contact over the ground, a second
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

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
//
// Measures how far feet skate, and finds where placing them made a clip worse, as a viewer would see it. Knows legs'
// motion.
#pragma once

#include "tools/feet/contacts.h"
#include "tools/feet/place_feet.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

// How much feet skate, and the cost of preventing it. Lengths are in leg lengths.
struct Skating {
    double mean_speed = 0, max_speed = 0;  // of toes in contact over the ground, a second
    double step = 0;        // the mean path of a toe over the ground in a contact that begins within the clip; in any
                            // contact if none does
    double drift = 0;       // the max distance of a toe over the ground from its contact's start
    double off_ground = 0;  // the max distance of a toe in contact from its standing height
    double tip_depth = 0;   // the max depth of toes' tips below their standing height
    double knee_deg = 0;    // the largest change of a knee's angle, a frame
    double jump = 0;        // the largest change of a toe's velocity, a frame
    double body_jump = 0;   // the same for the body
    std::size_t drift_frame = 0, off_ground_frame = 0;
};

// How far the knee is bent, in degrees.
double bend_deg(const LegPath& leg, std::size_t frame);
// How far the knee turns from the frame before, in degrees.
double knee_turn_deg(const LegPath& leg, std::size_t frame);

Skating skating_of(const LegMotion& motion, const Contacts& contacts, const Floor& floor);

struct FeetDoubt {
    enum Kind { off_ground, knee, toe_jump, body_jump } kind;
    std::size_t leg;          // none for the body
    std::size_t first, last;  // frames
    double value, before;     // in the units of Skating; before: the clip's largest; 0 for a toe off the ground
    Eigen::Vector3d place_w;  // of the toe or the body
};

// A line for each contact whose toe is off its ground by more than 0.012 leg lengths, a man's centimetre, and for each
// knee, toe and body that turns or jumps more than twice as much as the clip's largest. A jump below 60 leg lengths/s^2
// of a toe, or 30 of the body, or a knee slower than 720 degrees/s, is never reported. skating: of the clip before.
std::vector<FeetDoubt> feet_doubts(const LegMotion& after, const LegMotion& before, const Skating& skating,
                                   const Contacts& contacts, const ContactBars& bars, const Floor& floor);

}  // namespace swivel::tools

// SPDX-License-Identifier: MIT
//
// Places body and feet of a whole clip so that feet in contact stand. All frames are solved at once, by least squares.
// Eigen solves them, so the results are not the same bits on every CPU.
//
// The unknowns are the changes of the body and of each toe in each frame, against the clip on its ground. A contact is
// one unknown, its place, so its toe does not move at all.
//
// These are made small:
// - The second differences of each change. So nothing starts or stops at once.
// - A toe's change against the body's, and the body's own. So the clip stays as it is where nothing is asked.
// - How much longer or shorter a leg gets than it is in the clip. So knees bend as they do there.
//
// These must hold, by large weights where they do not hold anyway:
// - No leg is longer than 0.995 of its bones. A knee that goes straight snaps.
// - Velocities of toes and of the body jump no more from frame to frame than they do in the clip.
// - Feet in contact are on the ground, on one side of an edge that is steeper than 45 degrees.
//
// Lengths of legs and heights are not linear, so the squares are solved several times, each time from the last result.
#pragma once

#include "tools/feet/contacts.h"

namespace swivel::tools {

// A leg's placed foot, frame by frame.
struct PlacedLeg {
    std::vector<Eigen::Vector3d> toe_w, ankle_w;
    std::vector<Eigen::Quaterniond> turn_w;  // the foot's turn from the clip, with the slope of the ground
};
struct PlacedFeet {
    std::vector<Eigen::Vector3d> shift_w;  // of the body: its carrier's move
    std::vector<PlacedLeg> legs;
};

// The height of a contact over its ground: 0, except on stairs of the clip's own.
double stand_height(const LegMotion& motion, const LegPath& path, const Contact& contact, const ContactBars& bars,
                    const Floor& floor);

// bars: a contact whose toe is farther from the floor than their height, in the mean, keeps that height over the
// ground: it stands on a stair. Time and memory grow with the frames: some 5 s and 100 MB for 10,000. Throws
// InputError, naming `file`, where numbers overflow: with a frame time or with lengths that no body has.
PlacedFeet place_feet(const LegMotion& motion, const Contacts& contacts, const ContactBars& bars, const Floor& floor,
                      const std::filesystem::path& file);

}  // namespace swivel::tools

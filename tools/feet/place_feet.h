// SPDX-License-Identifier: MIT
//
// Where body and feet of a whole clip go, so that feet in contact stand. The clip is known whole, so all frames are
// solved at once, by least squares. Eigen solves them, so the results are not the same bits on every CPU.
//
// Unknown are the change of the body and of each toe in each frame, against the clip on its ground. A contact is one
// unknown, its place, so its toe does not move at all.
//
// What is to be small:
// - The second differences of each change. So nothing starts or stops at once.
// - A toe's change against the body's, and the body's own. So the clip comes back where nothing is asked.
// - How much longer or shorter a leg gets than it is in the clip. So knees bend as they do there.
//
// What is to hold, by large weights where it does not hold by itself:
// - No leg is longer than 0.995 of its bones. A knee that goes straight snaps.
// - Velocities of toes and of the body jump no more from frame to frame than they do in the clip.
// - Feet in contact are on the ground, on one side of an edge that is steeper than 45 degrees.
//
// Lengths of legs and heights are not linear, so it is solved some times, each time from where the last one ended.
#pragma once

#include "tools/feet/contacts.h"

namespace swivel::tools {

// Of each frame.
struct PlacedLeg {
    std::vector<Eigen::Vector3d> toe_w, ankle_w;
    std::vector<Eigen::Quaterniond> turn_w;  // of the foot, from how the clip has it: with the slope of the ground
};
struct PlacedFeet {
    std::vector<Eigen::Vector3d> shift_w;  // of the body: what its carrier moves by
    std::vector<PlacedLeg> legs;
};

// How high over its ground a contact of the clip stands: 0, but for those on stairs of the clip's own.
double stand_height(const LegMotion& motion, const LegPath& path, const Contact& contact, const ContactBars& bars,
                    const Floor& floor);

// bars: a contact whose toe is farther from the floor than their height, in the mean, keeps that height over the
// ground: it stands on a stair. Time and memory grow with the frames: some 5 s and 100 MB for 10,000. Throws
// InputError, naming `file`, where numbers overflow: with a frame time or with lengths that no body has.
PlacedFeet place_feet(const LegMotion& motion, const Contacts& contacts, const ContactBars& bars, const Floor& floor,
                      const std::filesystem::path& file);

}  // namespace swivel::tools

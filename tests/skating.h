// SPDX-License-Identifier: MIT
//
// How feet skate: recorded motion with other legs or another way, how far its toes slide while they are in contact, and
// what the library makes of it. What is measured comes from Eigen, in double. Metres, 60 frames a second.
#pragma once

#include <array>

#include "tests/random_bodies.h"
#include "tools/formats/clip.h"

namespace swivel::test {

inline constexpr double kFrameTime = 1.0 / 60;

// How a clip is carried to another body.
struct Retarget {
    double legs = 1;  // the length of thighs and shins, times this; the root's way stays
    double way = 1;   // the root's way over the ground, times this
};

// The skeleton's two limbs are the left leg and the right one.
struct LegMotion {
    BodySkeleton skeleton;
    std::array<std::uint32_t, 2> toes;  // joints right below the ankles
    std::vector<Body> frames;
    std::vector<double> shifts;  // of the root, along y, in each frame; not in the frames

    double leg_length(std::size_t leg) const;  // at rest
};
// A clip of the CMU library, in its unit and at 120 frames a second: every second frame.
LegMotion leg_motion(const formats::Clip& clip, const Retarget& retarget = {});

// Where the toes and knees of a motion are in each frame.
struct LegPlaces {
    std::array<std::vector<Vector3d>, 2> toes;
    std::array<std::vector<double>, 2> bends;  // of the knees, in degrees
};
LegPlaces leg_places(const LegMotion& motion);

// The frames in which each toe is in contact: slower than 0.5 m/s, and within 6 cm of its floor; for most of five
// frames. The floor is what a fiftieth of the frames are not above. Speed is over two frames.
using Contacts = std::array<std::vector<bool>, 2>;
Contacts contacts_of(const LegMotion& source);

// Between two frames of contact, over the ground: a toe's mean and greatest speed, m/s; and its way in a step, mm. A
// step is a contact that begins within the clip. And the greatest change a frame of a knee, in degrees, and of the
// root's shift, mm.
struct Skating {
    double mean, most, way, knee, shift;
};
Skating skating_of(const LegMotion& motion, const Contacts& contacts);

// What the groups of both legs and of the shift are given.
struct Planting {
    double lock = 0.10, unlock = 0.20, again = 0.05;  // m, m, m/s
    double stop = 0.10, blend = 0.20;                 // s
    double margin = 0.008, zone = 0.002;              // of the cap, m
    double straightest = 1.62;                        // of the knees, degrees
    double drop = 0.03, rise = 0.03, half = 0.1;      // of the shift: m, m, s
};
struct PlantedMotion {
    LegMotion motion;
    std::array<std::vector<std::uint32_t>, 2> flags;  // of the legs, in each frame
};
PlantedMotion planted(const LegMotion& motion, const Contacts& contacts, const Planting& planting = {});

}  // namespace swivel::test

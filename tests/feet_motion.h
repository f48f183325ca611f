// SPDX-License-Identifier: MIT
//
// What `swivel feet` is judged by: where legs of a motion are, when a plain detector says that they stand, and how they
// skate. From tests' own readers of files, in double; nothing of tools/feet is in it.
#pragma once

#include <array>
#include <functional>
#include <span>

#include "tests/plain_motion.h"

namespace swivel::test {

struct PlainLegPath {
    std::vector<Eigen::Vector3d> hip, knee, ankle, toe;
};
struct PlainLegs {
    double frame_time;
    std::array<PlainLegPath, 2> legs;   // left, right
    std::vector<Eigen::Vector3d> body;  // the joint Hips

    std::size_t frame_count() const { return legs[0].toe.size(); }
    double leg_length(std::size_t side) const;
};

// Of a skeleton with the names of the CMU library.
PlainLegs legs_path(const PlainMotion& motion, double frame_time);

inline constexpr double kCarriedTime = 1.0 / 60;  // seconds from frame to frame of a clip that is carried

// A CMU clip of 120 frames a second, carried to another body.
struct Carried {
    double legs = 1;        // thighs and shins are so many times as long
    double way = 1;         // the root's way over the ground is so many times as far
    double minus = 0;       // this share of the root's mean velocity is taken away
    std::size_t every = 2;  // frame is kept

    double frame_time() const { return static_cast<double>(every) / 2 * kCarriedTime; }
};
std::string carried(const PlainMotion& motion, const Carried& to);

// The rule of docs/clip_feet.md.
using PlainContacts = std::array<std::vector<bool>, 2>;
PlainContacts plain_contacts(const PlainLegs& legs, double speed = 0.8, double height = 0.085);

// The rows of a table, frame by frame.
PlainContacts contacts_in_table(const std::string& csv, std::size_t frame_count);

// In lengths of the file a second, in lengths, in degrees: between two frames of contact.
struct PlainSkating {
    double mean = 0, most = 0, step = 0, knee = 0, jump = 0, body_jump = 0;
};
PlainSkating plain_skating(const PlainLegs& legs, const PlainContacts& contacts);

// Height and slopes of hills at a place, by the recursion of de Boor and Cox for splines of degree 2. size: x, y, z.
struct Hills {
    std::size_t columns, rows;
    std::vector<std::uint16_t> samples;  // of 16 bits
    Eigen::Vector3d size;

    double height(double x, double z) const;
};
Hills random_hills(const Eigen::Vector3d& size);
// Ground whose height changes along a way from the world's origin alone. height: where one is so far along it, both in
// the clip's unit. An edge of it is three samples wide.
Hills ground_along(const Eigen::Vector3d& way, const std::function<double(double)>& height);
// bits: 8 or 16; of 8 the upper ones.
void write_png(const fs::path& path, const Hills& hills, int bits);

}  // namespace swivel::test

// SPDX-License-Identifier: MIT
//
// `swivel feet` is judged by this: where legs of a motion are, when a plain detector says that they stand, and how they
// skate. From tests' own readers of files, in double; nothing of tools/feet is in it.
#pragma once

#include <array>
#include <functional>
#include <span>

#include "tests/plain_gltf.h"
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
    // A frame. place(joint, side): of a hip, a knee, an ankle and a toe.
    template <class Place>
    void add(const Eigen::Vector3d& hips, const Place& place)
    {
        body.push_back(hips);
        for (std::size_t side = 0; side < 2; ++side) {
            legs[side].hip.push_back(place(0, side)), legs[side].knee.push_back(place(1, side));
            legs[side].ankle.push_back(place(2, side)), legs[side].toe.push_back(place(3, side));
        }
    }
};

// The legs of a skeleton with the names of the CMU library.
PlainLegs legs_path(const PlainMotion& motion, double frame_time);
// Those of a glTF's first animation, at even times. names: hips, thigh, shin, foot and toe; * is the side, left first.
PlainLegs legs_path(const PlainGltf& gltf, const std::array<std::string, 5>& names,
                    const std::array<std::string, 2>& sides, const std::vector<double>& times);

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

// Those of the prototype that the figures of kSkatingClips come from: slower than 0.5 m/s and lower than 6 cm.
PlainContacts prototypes_contacts(const PlainLegs& source);

// The rows of a table, frame by frame.
PlainContacts contacts_in_table(const std::string& csv, std::size_t frame_count);

// In lengths of the file a second, in lengths, in degrees: between two frames of contact.
struct PlainSkating {
    double mean = 0, max = 0, step = 0, knee = 0, jump = 0, body_jump = 0;
    double begun_step = 0;  // as step, of contacts that begin after frame 0 alone
    double sink = 0;        // the most that a toe in contact goes up or down in a frame
};
PlainSkating plain_skating(const PlainLegs& legs, const PlainContacts& contacts);

inline constexpr double kMetre = 0.0254 / 0.45;  // a unit of the CMU library's skeletons

// m/s, mean and most; mm a step; the most that a knee turns in a frame, degrees.
struct Skates {
    double mean, max, step, knee;
};
// Recorded clips that skate because legs or way are another's.
struct SkatingClip {
    const char *words, *file;
    Carried to;
};
inline constexpr SkatingClip kSkatingClips[] = {
    {"walk, legs x 0.8", "cmu_02_01_walk.bvh", {.legs = 0.8}},
    {"dance, legs x 0.8", "cmu_05_06_dance.bvh", {.legs = 0.8}},
    {"jump, legs x 0.8", "cmu_01_01_forward_jump.bvh", {.legs = 0.8}},
    {"walk, root x 1.25", "cmu_02_01_walk.bvh", {.way = 1.25}},
};
inline Skates in_metres(const PlainSkating& is)
{
    return {kMetre * is.mean, kMetre * is.max, 1e3 * kMetre * is.step, is.knee};
}

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

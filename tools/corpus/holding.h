// SPDX-License-Identifier: MIT
//
// Further inputs of bodies that stand on uneven ground, hold something or look at something: the ground below each
// foot, grips, props, and targets of looks, which swing to and fro on any side. Now and then ground is steep, a prop is
// far away, one of them is missing, or a number is spoilt.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tools/corpus/bodies.h"
#include "tools/corpus/interface.h"
#include "tools/corpus/vectors.h"

namespace swivel::corpus {

// How one body looks. Places are from the root, in the unit of its scale.
struct Looker {
    Random random;  // of all frames
    double scale;
    std::array<std::array<Vector, 2>, kLookCount> places;
};

class Looking {
public:
    // bodies: in their first poses.
    Looking(const Recipe& recipe, const std::vector<Body>& bodies, Poses& poses);
    // Brings one body's looks to a frame. root: the body's place. swing: 0 to 1.
    void move_body(std::uint32_t body, const Vector& root, double swing, Poses& poses);
    // Those rows of the crowd that they are in.
    void write(Crowd& crowd) const;

private:
    void spoil_body(std::uint32_t body, Poses& poses);

    struct Rows {
        std::vector<float> targets, weights;  // body by body; targets that are far away are the poses'
    };
    const std::uint32_t group_;  // the first look's
    std::vector<Looker> lookers_;
    std::array<Rows, kLookCount> rows_;
};

// How one body stands and holds. Places are from the root, in the unit of its scale.
struct Holder {
    Random random;  // of all frames
    double scale;
    std::array<Vector, kGroupCount> grounds, normals;  // normals are of any length
    Vector ground_way;
    std::array<std::array<float, 7>, kGroupCount> grips;
    std::array<Vector, 2> prop_positions;
    std::array<std::array<float, 4>, 2> prop_rotations;
};

class Holding {
public:
    // bodies: in their first poses.
    Holding(const Recipe& recipe, const std::vector<Body>& bodies, Poses& poses);
    // root: where the body's is now. swing: 0 to 1.
    void move_body(std::uint32_t body, const Vector& root, double swing, Poses& poses);
    void write(Crowd& crowd) const;

private:
    void set_ground(std::uint32_t body, std::uint32_t group, const Vector& root, double swing, Poses& poses);
    void set_prop(std::uint32_t body, const Vector& root, double swing, Poses& poses);
    void spoil_body(std::uint32_t body, Poses& poses);

    const Recipe& recipe_;
    std::vector<Holder> holders_;
    std::array<std::vector<float>, kGroupCount> grounds_, normals_, grips_;
    struct {
        std::vector<float> positions, rotations, blends;  // body by body; positions likewise
    } props_;
};

}  // namespace swivel::corpus

// SPDX-License-Identifier: MIT
//
// What bodies look at: targets that go to and fro on any side. Now and then there is none, it is far
// away, or a number is spoilt.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tools/corpus/bodies.h"
#include "tools/corpus/interface.h"
#include "tools/corpus/vectors.h"

namespace swivel::corpus {

// Of one body. Places are from the root, in the unit of its scale.
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

    std::vector<Looker> lookers_;
    std::array<LookRows, kLookCount> rows_;
};

}  // namespace swivel::corpus

// SPDX-License-Identifier: MIT
//
// Standing bodies: poses that swing to and fro between two, and rest at both, over many frames. Roots and supports move
// independently. Times vary, some are 0 or long, and now and then a number is spoilt.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "tools/corpus/arms.h"
#include "tools/corpus/bodies.h"
#include "tools/corpus/holding.h"
#include "tools/corpus/interface.h"
#include "tools/corpus/vectors.h"

namespace swivel::corpus {

// How one body moves.
struct Mover {
    Random random;    // of all frames
    Body from, to;    // its poses; rotations of the second are the nearer ones of their two signs
    Vector root_way;  // of the root, from where the first pose has it
    std::array<std::array<Vector, kGroupCount>, 2> goals;  // of limbs, from the root, at both poses
    std::array<Vector, 2> supports, support_ways;          // of the two that it stands on in turns: from the root
    std::array<std::array<std::array<float, 4>, 2>, 2> support_rotations;
    std::uint32_t starts[3], speeds[3];  // of the pose, the root and the supports
    std::uint32_t stands_on = 0;
};

class Standing {
public:
    Standing(const Recipe& recipe, std::uint32_t body_count);
    // Brings a crowd and the poses to a frame. Frames come in order, from 0 on.
    void go_to(std::uint32_t frame, Crowd& crowd);
    Poses& poses() { return poses_; }
    // The changes that go_to() made to the state that the crowd carries, in order: a limb's reset, or other supports of
    // a body.
    struct Carried {
        std::uint32_t group, body;
        std::optional<std::array<Support, 2>> supports;
    };
    const std::vector<Carried>& carried() const { return carried_; }

private:
    struct Changes {  // of the crowd's rows in a frame, limb by limb of each group
        std::array<std::vector<float>, kGroupCount> contacts, next_targets, targets, next_times;
        std::vector<float> shift_wishes;
    };

    void move_body(std::uint32_t frame, std::uint32_t body);
    void set_joints(std::uint32_t body, double swing);
    void set_root(std::uint32_t body, double swing);
    void set_goals(std::uint32_t body, double swing, bool rests);
    Vector root_now(std::uint32_t body) const;
    Support support_of(std::uint32_t body, std::uint32_t n, double swing) const;
    void set_support(std::uint32_t body, const Support& support);
    void spoil_body(std::uint32_t body);
    void change_carried(std::uint32_t frame, std::uint32_t body, Crowd& crowd);
    void choose(std::uint32_t frame);

    const Recipe& recipe_;
    const Skeleton skeleton_;
    std::vector<Mover> movers_;
    Poses poses_;
    Changes rows_;
    std::vector<Carried> carried_;    // of the last frame
    std::optional<Holding> holding_;  // where feet are on ground or something is held
    std::optional<Looking> looking_;
};

}  // namespace swivel::corpus

// SPDX-License-Identifier: MIT
//
// Bodies in which all that holds comes together: two hands on a prop, a hand on one of these, a hand on a free limb's,
// a hand on a prop of a joint, and a leg that shifts the body.
#pragma once

#include "tests/linked_bodies.h"

namespace swivel::test {

struct HoldingBodies : LinkedBodies {
    enum Group : std::uint32_t { prop, left, right, third, free, follower, leg, fit, handle, on_handle };

    HoldingBodies(Random& random, std::size_t body_count, const PoseLayout& of,
                  swivel_on_bad_input on_bad_input = SWIVEL_KEEP_POSE)
        : LinkedBodies(random, {3, 7, 1, false}, body_count, of)
    {
        constexpr swivel_features kHand = SWIVEL_WITH_HAND | SWIVEL_WITH_RECORD, kLinked = kHand | SWIVEL_WITH_LINK;
        add(swivel_default_prop_group_def());
        add_limb(0, kLinked | SWIVEL_POLE_INCOMING, prop);
        add_limb(1, kLinked | SWIVEL_WITH_EFFECTOR | SWIVEL_POLE_INCOMING, prop);
        add_limb(2, kLinked | SWIVEL_HAND_YIELDS | SWIVEL_WITH_EFFECTOR, left);
        add_limb(3, kHand | SWIVEL_WITH_REACH);
        add_limb(4, kLinked | SWIVEL_WITH_CAP | SWIVEL_POLE_INCOMING, free);
        add_limb(5, kHand | SWIVEL_WITH_FIT | SWIVEL_POLE_INCOMING);
        add(swivel_default_fit_group_def());
        add(swivel_default_prop_group_def());
        groups.back().prop.joint = 1;
        add_limb(6, kLinked | SWIVEL_WITH_WEIGHTS | SWIVEL_POLE_INCOMING, handle);
        for (swivel_group_def& group : groups) group.on_bad_input = on_bad_input;
        for (const std::uint32_t g : {free, leg}) {
            give(g, SWIVEL_TARGET, [&](std::size_t n) { return goal(random, g, n).target; });
            give(g, SWIVEL_HAND, [&](std::size_t n) { return goal(random, g, n).hand; });
        }
        for (const std::uint32_t g : {free, third})
            give(g, SWIVEL_POLE, [&](std::size_t n) { return goal(random, g, n).pole; });
        give(left, SWIVEL_TARGET, [&](std::size_t n) { return n % 3 == 0 ? goal(random, left, n).target : kNoPlace; });
        for (const std::uint32_t g : {right, third})
            give(g, SWIVEL_EFFECTOR, [&](std::size_t) { return floats(Vector3d(0.05 * random.direction())); });
        for (const std::uint32_t g : {left, right, third, follower, on_handle})
            give(g, SWIVEL_GRIP, [&](std::size_t) { return floats(Held{random.rotation(), random.vector(0, 0.3)}); });
        give(on_handle, SWIVEL_WEIGHTS, [&](std::size_t n) { return Float3{n % 2 ? 1.0f : 0.5f, 1, 0.5f}; });
        give(prop, SWIVEL_PROP_SHARE, [&](std::size_t n) { return Float1{static_cast<float>(n % 4) / 3}; });
        give(prop, SWIVEL_PROP_PLACE, [&](std::size_t n) { return n % 5 ? kNoPlace : goal(random, right, n).target; });
        give(prop, SWIVEL_PROP_TURN, [&](std::size_t n) { return n % 7 ? kNoTurn : goal(random, right, n).hand; });
    }

private:
    BodyGoal goal(Random& random, std::uint32_t g, std::size_t n) const
    {
        return random_goal(random, skeleton, bodies[n], limb_of[g]);
    }
};

// Every bit that a solve left of a body: its results, and its pose.
inline std::vector<std::uint32_t> bits_of_body(const LinkedBodies& of, const Crowd& crowd, const PoseBuffer& poses,
                                               std::size_t n)
{
    std::vector<std::uint32_t> bits;
    swivel_field_info info;
    for (std::uint32_t g = 0; g < of.groups.size(); ++g)
        for (std::uint32_t i = 0; swivel_describe_field(i, &info); ++i) {
            const std::uint32_t count = swivel_field_row_count(crowd.get(), g, info.field);
            if (info.kind == SWIVEL_FIELD_INPUT || count == 0) continue;
            bits.resize(bits.size() + count);
            check(swivel_read(crowd.get(), info.field, g, static_cast<std::uint32_t>(n), 1,
                              {&bits[bits.size() - count], count * sizeof bits[0]}));
        }
    const unsigned char* const first = &poses.bytes[n * poses.body_stride];
    bits.insert(bits.end(), first, first + poses.body_stride);
    return bits;
}

}  // namespace swivel::test

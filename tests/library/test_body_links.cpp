// SPDX-License-Identifier: MIT
//
// The promise: a hand that is linked to another limb's is at its grip on that, where it is after its own clamps, caps,
// limits and weights. Hands may hold hands that hold hands. All is checked by forward kinematics of Eigen's, in double.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/linked_bodies.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// `tools/test --full bodies` makes a million: RC_PARAMS=max_success=6000.
constexpr std::size_t kLinkedBodies = 200;

// Limbs that lie beside each other, each linked to an earlier one or to none.
struct RandomLinks : LinkedBodies {
    explicit RandomLinks(Random& random)
        : LinkedBodies(random,
                       {random.below(8), 2 + random.below(3), random.below(3), random.below(4) == 0,
                        random.below(3) == 0 ? 1 + random.below(2) : 0},
                       kLinkedBodies, random_layout(random))
    {
        if (layout.translates && layout.scales && random.below(4) == 0) layout.in_body = &skeleton;
        for (std::uint32_t limb = 0; limb < skeleton.limbs.size(); ++limb) {
            const bool is_linked = limb > 0 && random.below(4) > 0;
            add_limb(limb, (is_linked ? SWIVEL_WITH_LINK : 0) | random_features(random, limb, is_linked),
                     limb > 0 ? random.below(limb) : 0);
        }
        for (std::uint32_t g = 0; g < groups.size(); ++g) give_inputs(random, g);
    }

    RandomLinks(const RandomLinks&) = delete;

private:
    static PoseLayout random_layout(Random& random)
    {
        PoseLayout layout;
        layout.form = static_cast<swivel_pose_form>(random.below(SWIVEL_MATRIX_COLUMNS3 + 1));
        layout.translates = layout.form != SWIVEL_ROTATIONS || random.below(2);
        layout.scales = layout.form != SWIVEL_ROTATIONS || random.below(2);
        layout.roots = random.below(2);
        return layout;
    }
    // A joint above the shoulder that no other limb hangs below.
    bool has_clavicle(std::uint32_t limb) const
    {
        const std::int32_t parent = skeleton.parents[skeleton.limbs[limb].shoulder];
        for (std::uint32_t other = 0; other < skeleton.limbs.size(); ++other)
            if (other != limb && parent >= 0 &&
                skeleton.is_above(static_cast<std::uint32_t>(parent), skeleton.limbs[other].shoulder))
                return false;
        return parent >= 0;
    }
    swivel_features random_features(Random& random, std::uint32_t limb, bool is_linked) const
    {
        const auto maybe = [&](swivel_features feature) { return random.below(3) == 0 ? feature : 0; };
        constexpr swivel_features poles[] = {0, SWIVEL_POLE_DIRECTION, SWIVEL_POLE_NORMAL, SWIVEL_POLE_INCOMING};
        swivel_features features = SWIVEL_WITH_HAND | poles[random.below(4)];
        if (!is_linked && random.below(6) == 0) return features | SWIVEL_WITH_AIM;
        features |= maybe(SWIVEL_WITH_EFFECTOR) | maybe(SWIVEL_WITH_FLEXION_LIMIT) | maybe(SWIVEL_WITH_ANGLE) |
                    maybe(SWIVEL_WITH_MOST_SWIVEL) | maybe(SWIVEL_WITH_SHOULDER_CONE) | maybe(SWIVEL_WITH_HAND_CONE) |
                    maybe(SWIVEL_WITH_RECORD) | maybe(random.below(2) ? SWIVEL_WITH_REACH : SWIVEL_WITH_CAP);
        if (features & SWIVEL_WITH_EFFECTOR) features |= maybe(SWIVEL_HAND_YIELDS);
        if (!is_linked) features |= maybe(SWIVEL_WITH_WEIGHTS);
        if (has_clavicle(limb)) features |= maybe(SWIVEL_WITH_CLAVICLE);
        return features;
    }
    void give_inputs(Random& random, std::uint32_t g)
    {
        const auto number = [&](double a, double b) { return static_cast<float>(random.between(a, b)); };
        const auto give_if = [&](swivel_features feature, swivel_field field, const auto& make) {
            if (has(g, feature)) give(g, field, make);
        };
        std::vector<BodyGoal> goals;
        for (const Body& body : bodies) goals.push_back(random_goal(random, skeleton, body, limb_of[g]));
        if (!has(g, SWIVEL_WITH_LINK)) {
            give(g, SWIVEL_TARGET, [&](std::size_t n) {
                const Vector3d root = vec(bodies[n].root_position);
                const double further = random.below(4) ? 1 : random.between(0.2, 2.5);
                return floats(Vector3d(root + further * (vec(goals[n].target) - root)));
            });
            give(g, SWIVEL_HAND, [&](std::size_t n) { return goals[n].hand; });
        }
        if (!has(g, SWIVEL_POLE_INCOMING)) give(g, SWIVEL_POLE, [&](std::size_t n) { return goals[n].pole; });
        give_if(SWIVEL_WITH_EFFECTOR, SWIVEL_EFFECTOR, [&](std::size_t) { return floats(random.vector(0, 0.1)); });
        give_if(SWIVEL_WITH_AIM, SWIVEL_AIM, [&](std::size_t) {
            const Vector3d axis = random.direction();
            return aim({axis.x(), axis.y(), axis.z()}, random.between(0.2, 2));
        });
        give_if(SWIVEL_WITH_FLEXION_LIMIT, SWIVEL_FLEXION_LIMIT,
                [&](std::size_t) { return flexion(random.between(0, 0.5), random.between(1.5, 3)); });
        give_if(SWIVEL_WITH_ANGLE, SWIVEL_ANGLE, [&](std::size_t) { return turn(random.between(-3, 3)); });
        give_if(SWIVEL_WITH_MOST_SWIVEL, SWIVEL_MOST_SWIVEL, [&](std::size_t) { return turn(random.between(0.1, 3)); });
        const auto random_cone = [&](std::size_t) {
            const Vector3d axis = random.direction();
            return cone({axis.x(), axis.y(), axis.z()}, random.between(0.3, 2));
        };
        give_if(SWIVEL_WITH_SHOULDER_CONE, SWIVEL_SHOULDER_CONE, random_cone);
        give_if(SWIVEL_WITH_HAND_CONE, SWIVEL_HAND_CONE, random_cone);
        give_if(SWIVEL_WITH_REACH, SWIVEL_REACH, [&](std::size_t) {
            return Float4{number(0, 0.1), number(0, 0.05), number(1, 1.3), number(0, 0.1)};
        });
        give_if(SWIVEL_WITH_CAP, SWIVEL_CAP, [&](std::size_t) {
            return Float3{number(0, 0.1), number(0.5, 1), number(0, 0.05)};
        });
        give_if(SWIVEL_WITH_WEIGHTS, SWIVEL_WEIGHTS, [&](std::size_t) {
            return random.below(4) ? Float3{number(0, 1), number(0, 1), number(0, 1)} : Float3{};
        });
        give_if(SWIVEL_WITH_CLAVICLE, SWIVEL_CLAVICLE, [&](std::size_t) { return Float1{number(0, 1)}; });
        give_if(SWIVEL_WITH_LINK, SWIVEL_GRIP, [&](std::size_t n) { return random_grip(random, g, n, goals[n]); });
    }
    // As this limb reaches it, if the other one gets where it is sent. Of any length.
    Float7 random_grip(Random& random, std::uint32_t g, std::size_t n, const BodyGoal& goal) const
    {
        const std::vector<JointAt> at = joints_at(skeleton, bodies[n]);
        const std::uint32_t link = groups[g].link;
        const JointAt& wrist = at[skeleton.limbs[limb_of[link]].wrist];
        const Float3 target =
            value(link, SWIVEL_TARGET, n, floats(Vector3d(vec(bodies[n].root_position) + wrist.place)));
        const Float4 hand = value(link, SWIVEL_HAND, n, floats(wrist.rotation));
        const std::int32_t parent = skeleton.parents[skeleton.limbs[limb_of[link]].shoulder];
        const double scale = parent < 0 ? double{bodies[n].root_scale} : at[static_cast<std::size_t>(parent)].scale;
        const Held leader{quat(hand).normalized(), vec(target)},
            follower{quat(goal.hand).normalized(), vec(goal.target)};
        Held grip = leader.inverse() * follower;
        grip.place /= scale;
        Float7 of = floats(grip);
        const auto length = static_cast<float>(random.spread(0.1, 10));
        for (std::size_t c = 3; c < 7; ++c) of[c] *= length;
        return of;
    }
};

bool is_leader(const LinkedBodies& of, std::uint32_t group)
{
    for (std::uint32_t g = 0; g < of.groups.size(); ++g)
        if (of.has(g, SWIVEL_WITH_LINK) && of.groups[g].link == group) return true;
    return false;
}

}  // namespace

TEST_CASE("a linked hand is at its grip on the hand that the other limb reached")
{
    int linked_count = 0, reached_count = 0, seeds = 0;
    const bool held_all = rc::check("by forward kinematics", [&](std::uint64_t seed) {
        Random random{seed};
        const RandomLinks bodies(random);
        const SolvedLinks solved(bodies);
        ++seeds;
        for (std::size_t n = 0; n < kLinkedBodies; ++n) {
            const LinkedBody body(solved, n);
            const double root = 2e-7 * vec(body.was_body.root_position).norm();  // of floats in the world
            for (std::uint32_t g = 0; g < bodies.groups.size(); ++g) {
                RC_ASSERT(!(solved.flags(g, n) & SWIVEL_BAD_INPUT));
                const Held hand = body.hand(g);
                if (is_leader(bodies, g)) {
                    const Held told = solved.from_root(SWIVEL_HAND_FRAME, g, n);
                    RC_ASSERT((told.place - hand.place).norm() <= body.bound(g) + root);
                    RC_ASSERT(told.rotation.angularDistance(hand.rotation) <= 4e-6);
                }
                if (!bodies.has(g, SWIVEL_WITH_LINK)) continue;
                ++linked_count;
                if (!(solved.flags(g, n) & SWIVEL_REACHED)) continue;
                ++reached_count;
                const std::uint32_t link = bodies.groups[g].link;
                const Held wanted = body.wanted(g, body.hand(link)), point = body.point(g);
                RC_ASSERT((point.place - wanted.place).norm() <= body.bound(g) + body.rounding(link));
                if (!bodies.has(g, SWIVEL_HAND_YIELDS))
                    RC_ASSERT(point.rotation.angularDistance(wanted.rotation) <= 4e-6);
            }
        }
    });
    CHECK(held_all);
    if (seeds > 50) CHECK(reached_count > 0.3 * linked_count);
}

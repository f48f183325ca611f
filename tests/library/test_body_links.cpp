// SPDX-License-Identifier: MIT
//
// The promise: a hand that is linked to another limb's is at its grip on that, where it is after its own clamps, caps,
// limits and weights. Hands may hold hands that hold hands. Hands hold their grips on a prop, too. It lies where the
// caller, a joint or the hands say, and moves no further than it must for both to reach, by no bit if it need not. A
// hand that says alone where it is keeps its pose. All is checked by forward kinematics of Eigen's, and by a search for
// the nearest move, in double.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/prop_bodies.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// `tools/test --full bodies` makes a million: RC_PARAMS=max_success=6000.
constexpr std::size_t kLinkedBodies = 200, kPropBodies = 200;

// Limbs that lie beside each other, each linked to an earlier one or to none.
struct RandomLinks : PosedBodies {
    explicit RandomLinks(Random& random)
        : PosedBodies(random,
                      {random.below(8), 2 + random.below(3), random.below(3), random.below(4) == 0,
                       random.below(3) == 0 ? 1 + random.below(2) : 0},
                      kLinkedBodies, random_layout(random))
    {
        if (layout.scales && random.below(4) == 0) is_in_body = true;
        for (std::uint32_t limb = 0; limb < skeleton.limbs.size(); ++limb) {
            const bool is_linked = limb > 0 && random.below(4) > 0;
            add_limb(limb, (is_linked ? SWIVEL_WITH_LINK : 0) | random_features(random, limb, is_linked),
                     limb > 0 ? random.below(limb) : 0);
        }
        for (std::uint32_t g = 0; g < groups.size(); ++g) give_inputs(random, g);
    }

    RandomLinks(const RandomLinks&) = delete;

private:
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
        features |= maybe(SWIVEL_WITH_EFFECTOR) | maybe(SWIVEL_WITH_RECORD) |
                    maybe(random.below(2) ? SWIVEL_WITH_REACH : SWIVEL_WITH_CAP);
        for (const char* const function : {"swivel_cos_sin()", "swivel_flexion()", "swivel_cone()"})
            for (const swivel_field field : every_field())
                if (is_made_by(function, field)) features |= maybe(describe(field).needs);
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
        give_if(SWIVEL_WITH_AIM, SWIVEL_AIM, [&](std::size_t) {
            const Vector3d axis = random.direction();
            return aim({axis.x(), axis.y(), axis.z()}, random.between(0.2, 2));
        });
        give_limits(random, g);
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
        const std::uint32_t link = limb_def(g).link;
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

bool is_leader(const PosedBodies& of, std::uint32_t group)
{
    for (std::uint32_t g = 0; g < of.groups.size(); ++g)
        if (of.has(g, SWIVEL_WITH_LINK) && of.limb_def(g).link == group) return true;
    return false;
}

struct PropCounts {
    int bodies = 0, kept = 0, moved = 0, missed = 0, said = 0, near = 0;
    int free_targets = 0, free_hands = 0;  // a target was written alone, or with a hand
};

// A crowd with a prop, the same with one that never moves, and one whose limbs hold nothing.
struct PropStage {
    const PropBodies& of;
    PropBodies fixed_of;
    PosedBodies free_of;
    SolvedBodies solved, fixed, free;
    PoseBuffer before;

    explicit PropStage(const PropBodies& bodies)
        : of(bodies),
          fixed_of(fixed_at(bodies)),
          free_of(bodies.free()),
          solved(of),
          fixed(fixed_of),
          free(free_of),
          before(bodies.incoming())
    {
    }
    static PropBodies fixed_at(PropBodies bodies)
    {
        bodies.prop_def().max_move = 0;
        return bodies;
    }
    static bool same_bytes(const PoseBuffer& a, const PoseBuffer& b, const BodyLimbJoints& limb, std::size_t n)
    {
        for (const std::uint32_t joint : {limb.shoulder, limb.elbow, limb.wrist})
            if (a.joint_bytes(n, joint) != b.joint_bytes(n, joint)) return false;
        return true;
    }
    // Judges the prop of one body.
    void check_prop(std::size_t n, PropCounts& counts)
    {
        const SolvedBody body(solved, n);
        const Vector3d root = of.root(n, solved);
        const UnmovedProp wanted = of.unmoved(body, root);
        std::uint32_t flags = solved.flags(of.prop, n);
        RC_ASSERT((flags == SWIVEL_REACHED || flags == SWIVEL_CLAMPED_FAR || flags == SWIVEL_CLAMPED_NEAR));
        Held is = held(solved.result<Float7>(SWIVEL_PROP_TRANSFORM, of.prop, n));
        is.place -= root;
        RC_ASSERT(is.rotation.angularDistance(wanted.frame.rotation) <= 8e-6);
        const Vector3d move = is.place - wanted.frame.place;
        const bool stays = solved.result<std::array<std::uint32_t, 7>>(SWIVEL_PROP_TRANSFORM, of.prop, n) ==
                           fixed.result<std::array<std::uint32_t, 7>>(SWIVEL_PROP_TRANSFORM, of.prop, n);
        check_near(wanted, move, flags, counts);
        if (flags == SWIVEL_CLAMPED_NEAR) flags = SWIVEL_REACHED;  // as far as the far ends say
        check_move(wanted, move, stays, flags, counts);
        for (std::size_t a = 0; a < of.arms.size(); ++a) {
            const std::uint32_t arm = of.arms[a];
            const bool reaches = flags == SWIVEL_REACHED && !(solved.flags(arm, n) & SWIVEL_CLAMPED_NEAR);
            const Held point = body.point(arm), on = body.wanted(arm, is);
            RC_ASSERT(point.rotation.angularDistance(on.rotation) <= 1e-5);
            if (reaches) RC_ASSERT((point.place - on.place).norm() <= wanted.off + 3e-6 * body.length(arm));
        }
        check_sayer(n, body, wanted, stays, counts);
        ++counts.bodies;
    }
    // A grip that is nearer to its shoulder than the arm gets is not reached.
    static void check_near(const UnmovedProp& wanted, const Vector3d& move, std::uint32_t flags, PropCounts& counts)
    {
        bool is_near = false, may_be = false;
        for (std::size_t a = 0; a < wanted.moves.size(); ++a) {
            const double distance = (move - wanted.moves[a].middle).norm();
            is_near |= distance < wanted.nearest[a] - 3 * wanted.off;
            may_be |= distance < wanted.nearest[a] + 3 * wanted.off;
        }
        if (is_near) RC_ASSERT(flags != SWIVEL_REACHED);
        if (flags == SWIVEL_CLAMPED_NEAR) RC_ASSERT(may_be);
        counts.near += flags == SWIVEL_CLAMPED_NEAR;
    }
    void check_move(const UnmovedProp& wanted, const Vector3d& move, bool stays, std::uint32_t flags,
                    PropCounts& counts) const
    {
        const Ball &a = wanted.moves.front(), &b = wanted.moves.back();
        const auto shrunk = [&](double by) {
            return nearest_in_balls({a.middle, std::max(0.0, a.radius - by)}, {b.middle, std::max(0.0, b.radius - by)});
        };
        const double none = std::max(a.beyond(Vector3d::Zero()), b.beyond(Vector3d::Zero()));
        if (none <= -wanted.off) RC_ASSERT(stays);
        if (stays) RC_ASSERT(move.norm() <= wanted.off);
        RC_ASSERT(move.norm() <= wanted.max + wanted.off);
        const std::optional<Vector3d> surely = shrunk(wanted.off), at_most = shrunk(-wanted.off);
        if (surely && surely->norm() <= wanted.max - wanted.off) RC_ASSERT(flags == SWIVEL_REACHED);
        if (!at_most || at_most->norm() > wanted.max + wanted.off) RC_ASSERT(flags == SWIVEL_CLAMPED_FAR);
        if (surely) RC_ASSERT(move.norm() <= surely->norm() + wanted.off);
        if (flags == SWIVEL_REACHED) RC_ASSERT(std::max(a.beyond(move), b.beyond(move)) <= wanted.off);
        if (!at_most && wanted.max > 10 * wanted.off && move.norm() < wanted.max - wanted.off)  // both miss by half
            RC_ASSERT(std::fabs(a.beyond(move) - b.beyond(move)) <= wanted.off);
        counts.kept += stays, counts.moved += !stays && flags == SWIVEL_REACHED,
            counts.missed += flags != SWIVEL_REACHED;
    }
    void check_sayer(std::size_t n, const SolvedBody& body, const UnmovedProp& wanted, bool stays, PropCounts& counts)
    {
        const float share = of.value(of.prop, SWIVEL_HAND_BLEND, n, Float1{})[0];
        const std::size_t sayer = of.arms.size() == 1 || share == 0 ? 0 : 1, other = of.arms.size() - 1 - sayer;
        if (!wanted.is_of_hands || (of.arms.size() == 2 && share > 0 && share < 1)) return;
        const std::uint32_t arm = of.arms[sayer];
        const bool is_own = wanted.is_posed(sayer) && of.bounds == 0;
        // Rounding does not say of a straight arm that its own hand is out of reach.
        const bool other_reaches = of.arms.size() == 1 || wanted.moves[other].beyond(Vector3d::Zero()) <= -wanted.off;
        if (is_own && other_reaches && wanted.off <= 1.5e-5 * body.length(arm)) RC_ASSERT(stays);
        if (!stays) return;
        const BodyLimbJoints& limb = of.skeleton.limbs[of.limb_of[arm]];
        if (is_own) {  // but for what turns the elbow
            RC_ASSERT(same_bytes(solved.poses, before, limb, n) == !of.has(arm, SWIVEL_WITH_ANGLE));
            ++counts.said;
        }
        if (wanted.has_target[sayer]) {
            RC_ASSERT(same_bytes(solved.poses, free.poses, limb, n));
            ++(wanted.has_hand[sayer] ? counts.free_hands : counts.free_targets);
        }
    }
};

}  // namespace

TEST_CASE("a linked hand is at its grip on the hand that the other limb reached")
{
    int linked_count = 0, reached_count = 0, seeds = 0;
    const bool held_all = rc::check("by forward kinematics", [&](std::uint64_t seed) {
        Random random{seed};
        const RandomLinks bodies(random);
        const SolvedBodies solved(bodies);
        ++seeds;
        for (std::size_t n = 0; n < kLinkedBodies; ++n) {
            const SolvedBody body(solved, n);
            const double root = 2e-7 * vec(body.incoming.root_position).norm();  // of floats in the world
            for (std::uint32_t g = 0; g < bodies.groups.size(); ++g) {
                RC_ASSERT(!(solved.flags(g, n) & SWIVEL_BAD_INPUT));
                const Held hand = body.hand(g);
                if (is_leader(bodies, g)) {
                    const Held told = solved.from_root(SWIVEL_HAND_TRANSFORM, g, n);
                    RC_ASSERT((told.place - hand.place).norm() <= body.bound(g) + root);
                    RC_ASSERT(told.rotation.angularDistance(hand.rotation) <= 4e-6);
                }
                if (!bodies.has(g, SWIVEL_WITH_LINK)) continue;
                ++linked_count;
                if (!(solved.flags(g, n) & SWIVEL_REACHED)) continue;
                ++reached_count;
                const std::uint32_t link = bodies.limb_def(g).link;
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

TEST_CASE("hands hold a prop, which lies where it is said and moves no further than it must")
{
    PropCounts counts;
    const auto check_seed = [&](std::uint64_t seed) {
        Random random{seed};
        const PropBodies bodies(random, kPropBodies);
        PropStage stage(bodies);
        for (std::size_t n = 0; n < kPropBodies; ++n) stage.check_prop(n, counts);
    };
    // A far move, and two arms of which one is much shorter: a move that rounds must reach all the same.
    for (const std::uint64_t seed : {59707362647266829u, 62405213854u}) CHECK_NOTHROW(check_seed(seed));
    counts = {};
    const bool held_all = rc::check("by forward kinematics and a search", check_seed);
    CHECK(held_all);
    CAPTURE(counts.bodies, counts.kept, counts.moved, counts.missed, counts.said, counts.free_targets,
            counts.free_hands, counts.near);
    if (counts.bodies > 50 * static_cast<int>(kPropBodies)) {
        CHECK(counts.kept > counts.bodies / 10);
        CHECK(counts.moved > counts.bodies / 10);
        CHECK(counts.missed > counts.bodies / 20);
        CHECK(counts.said > counts.bodies / 200);
        CHECK(counts.free_targets > counts.bodies / 1000);
        CHECK(counts.free_hands > counts.bodies / 1000);
    }
}

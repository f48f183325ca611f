// SPDX-License-Identifier: MIT
//
// The promise: hands hold their grips on a prop. It lies where the caller, a joint or the hands say, and moves no
// further than it must for both to reach, by no bit if it need not. A hand that says alone where it is keeps its pose.
// All is checked by forward kinematics of Eigen's, and by a search for the nearest move, in double.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/prop_bodies.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// `tools/test --full bodies` makes a million: RC_PARAMS=max_success=6000.
constexpr std::size_t kPropBodies = 200;

struct PropCounts {
    int bodies = 0, kept = 0, moved = 0, missed = 0, said = 0, free = 0, near = 0;
};

// A crowd with a prop, the same with one that never moves, and one whose limbs hold nothing.
struct PropStage {
    const PropBodies& of;
    PropBodies fixed_of;
    LinkedBodies free_of;
    SolvedLinks solved, fixed, free;
    PoseBuffer before;

    explicit PropStage(const PropBodies& bodies)
        : of(bodies),
          fixed_of(fixed_at(bodies)),
          free_of(bodies.free()),
          solved(of),
          fixed(fixed_of),
          free(free_of),
          before(bodies.layout, bodies.bodies)
    {
    }
    static PropBodies fixed_at(PropBodies bodies)
    {
        bodies.groups[bodies.prop].prop.most_move = 0;
        return bodies;
    }
    static bool same_bytes(PoseBuffer& a, PoseBuffer& b, const BodyLimbJoints& limb, std::size_t n)
    {
        for (const std::uint32_t joint : {limb.shoulder, limb.elbow, limb.wrist})
            if (joint_bytes(a, n, joint) != joint_bytes(b, n, joint)) return false;
        return true;
    }
    // What the prop did in one body.
    void check_prop(std::size_t n, PropCounts& counts)
    {
        const LinkedBody body(solved, n);
        const Vector3d root = of.root(n, solved);
        const UnmovedProp wanted = of.unmoved(body, root);
        std::uint32_t flags = solved.flags(of.prop, n);
        RC_ASSERT((flags == SWIVEL_REACHED || flags == SWIVEL_CLAMPED_FAR || flags == SWIVEL_CLAMPED_NEAR));
        Held is = held(solved.result<Float7>(SWIVEL_PROP_FRAME, of.prop, n));
        is.place -= root;
        RC_ASSERT(is.rotation.angularDistance(wanted.frame.rotation) <= 8e-6);
        const Vector3d move = is.place - wanted.frame.place;
        const bool stays = solved.result<std::array<std::uint32_t, 7>>(SWIVEL_PROP_FRAME, of.prop, n) ==
                           fixed.result<std::array<std::uint32_t, 7>>(SWIVEL_PROP_FRAME, of.prop, n);
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
        RC_ASSERT(move.norm() <= wanted.most + wanted.off);
        const std::optional<Vector3d> surely = shrunk(wanted.off), at_most = shrunk(-wanted.off);
        if (surely && surely->norm() <= wanted.most - wanted.off) RC_ASSERT(flags == SWIVEL_REACHED);
        if (!at_most || at_most->norm() > wanted.most + wanted.off) RC_ASSERT(flags == SWIVEL_CLAMPED_FAR);
        if (surely) RC_ASSERT(move.norm() <= surely->norm() + wanted.off);
        if (flags == SWIVEL_REACHED) RC_ASSERT(std::max(a.beyond(move), b.beyond(move)) <= wanted.off);
        if (!at_most && wanted.most > 10 * wanted.off && move.norm() < wanted.most - wanted.off)  // both miss by half
            RC_ASSERT(std::fabs(a.beyond(move) - b.beyond(move)) <= wanted.off);
        counts.kept += stays, counts.moved += !stays && flags == SWIVEL_REACHED,
            counts.missed += flags != SWIVEL_REACHED;
    }
    void check_sayer(std::size_t n, const LinkedBody& body, const UnmovedProp& wanted, bool stays, PropCounts& counts)
    {
        const float share = of.value(of.prop, SWIVEL_PROP_SHARE, n, Float1{})[0];
        const std::size_t sayer = of.arms.size() == 1 || share == 0 ? 0 : 1, other = of.arms.size() - 1 - sayer;
        if (!wanted.is_of_hands || (of.arms.size() == 2 && share > 0 && share < 1)) return;
        const std::uint32_t arm = of.arms[sayer];
        const bool is_own = wanted.is_posed[sayer] && of.bounds == 0;
        // Of a straight arm, rounding does not say that its own hand is out of reach.
        const bool other_reaches = of.arms.size() == 1 || wanted.moves[other].beyond(Vector3d::Zero()) <= -wanted.off;
        if (is_own && other_reaches && wanted.off <= 1.5e-5 * body.length(arm)) RC_ASSERT(stays);
        if (!stays) return;
        const BodyLimbJoints& limb = of.skeleton.limbs[of.limb_of[arm]];
        if (is_own) {  // but for what turns the elbow
            RC_ASSERT(same_bytes(solved.poses, before, limb, n) == !of.has(arm, SWIVEL_WITH_ANGLE));
            ++counts.said;
        }
        if (wanted.is_written[sayer]) {
            RC_ASSERT(same_bytes(solved.poses, free.poses, limb, n));
            ++counts.free;
        }
    }
};

}  // namespace

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
    CAPTURE(counts.bodies, counts.kept, counts.moved, counts.missed, counts.said, counts.free, counts.near);
    if (counts.bodies > 50 * static_cast<int>(kPropBodies)) {
        CHECK(counts.kept > counts.bodies / 10);
        CHECK(counts.moved > counts.bodies / 10);
        CHECK(counts.missed > counts.bodies / 20);
        CHECK(counts.said > counts.bodies / 200);
        CHECK(counts.free > counts.bodies / 1000);
    }
}

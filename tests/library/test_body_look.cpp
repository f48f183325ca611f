// SPDX-License-Identifier: MIT
//
// The promise: a chain of joints turns so that its line of sight meets the target, where the last cone allows it. Each
// joint turns by its share, and no further than its cone. Limbs below are solved from where they are then. All is
// checked by forward kinematics of Eigen's, with angles.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/looking_bodies.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// `tools/test --full bodies` makes a million: RC_PARAMS=max_success=6000.
constexpr std::size_t kLookingBodies = 200;

PoseLayout random_look_layout(Random& random)
{
    PoseLayout layout;
    layout.form = static_cast<swivel_pose_form>(random.below(SWIVEL_MATRIX_COLUMNS3 + 1));
    layout.translates = layout.scales = layout.form != SWIVEL_ROTATIONS || random.below(2);
    layout.roots = random.below(2);
    return layout;
}
void put_in_body_space(LookingBodies& bodies)
{
    bodies.layout.translates = bodies.layout.scales = true;
    bodies.layout.in_body = &bodies.skeleton;
}

struct LookCounts {
    int bodies = 0, sees = 0, held = 0, faded = 0, reached = 0;
};

struct LookStage {
    const LookingBodies& of;
    SolvedLinks solved;

    explicit LookStage(const LookingBodies& bodies) : of(bodies), solved(bodies) {}

    // By how much a joint's place may be off: each rotation above it is rounded, which moves it by its distance from
    // there.
    double off(const LinkedBody& body, std::uint32_t joint) const
    {
        const Vector3d place = body.was[joint].place;
        double levers = place.norm();
        for (std::int32_t at = of.skeleton.parents[joint]; at >= 0;
             at = of.skeleton.parents[static_cast<std::size_t>(at)])
            levers += (place - body.was[static_cast<std::size_t>(at)].place).norm();
        return 2e-7 * levers + 1e-7 * vec(of.bodies[body.n].root_position).norm();
    }
    void check_look(const LinkedBody& body, std::uint32_t group, LookCounts& counts) const
    {
        const TurnedChain chain{body, of.groups[group].look};
        const std::uint32_t flags = solved.flags(group, body.n);
        const Vector3d target =
            vec(of.value(group, SWIVEL_LOOK_TARGET, body.n, kNoPlace)) - vec(of.bodies[body.n].root_position);
        const Vector3d eye = chain.eye_after(chain.last() + 1), axis = chain.axis_after(chain.last() + 1);
        const double off_place = off(body, chain.look.joints[chain.last()]), distance = (target - eye).norm(),
                     rounding = 2e-6 + off_place / distance;
        RC_ASSERT((eye - chain.eye(chain.is(chain.last()))).norm() <= 4 * off_place);
        const Float6 sight = solved.result<Float6>(SWIVEL_SIGHT, group, body.n);
        RC_ASSERT((Vector3d(sight[0], sight[1], sight[2]) - vec(of.bodies[body.n].root_position) - eye).norm() <=
                  8 * off_place);
        RC_ASSERT(angle_between({sight[3], sight[4], sight[5]}, axis) <= 3e-6);
        for (std::uint32_t n = 0; n <= chain.last(); ++n) {
            const double most = std::acos(double{chain.look.cos_most[n]});
            RC_ASSERT(angle_of(chain.own_turn(n)) <= most + 2e-6);
        }
        const double miss = angle_between(axis, target - eye);
        if (flags & SWIVEL_REACHED) RC_ASSERT(miss <= 1e-4 + rounding);
        // With the whole weight, only the last cone keeps it from the target.
        const double last_turn = angle_of(chain.own_turn(chain.last())),
                     last_most = std::acos(double{chain.look.cos_most[chain.last()]});
        const bool is_whole = !(flags & SWIVEL_FADED), last_is_free = last_turn < last_most - 1e-5;
        const Vector3d pivot = chain.is(chain.last()).place;
        const bool is_ahead = (target - pivot).norm() > (eye - pivot).norm() + 10 * off_place;
        if (is_whole && last_is_free && is_ahead) {
            RC_ASSERT(miss <= rounding);
            // The flag is of 1e-4 rad, as floats have it: for a target on the very eye they may not tell.
            if (rounding <= 5e-5) RC_ASSERT(flags & SWIVEL_REACHED);
        }
        if (is_whole) check_shares(chain, target, off_place);
        counts.sees += (flags & SWIVEL_REACHED) != 0, counts.held += (flags & SWIVEL_LIMITED_LOOK) != 0;
        counts.faded += !is_whole;
        ++counts.bodies;
    }
    // Joints before the last turn by their share of the angle that is left. The eye may pass very near the target on
    // its way, where rounding of places counts most.
    static void check_shares(const TurnedChain& chain, const Vector3d& target, double off_place)
    {
        double left = 0;
        for (std::uint32_t n = 0; n <= chain.last(); ++n) left += double{chain.look.share[n]};
        for (std::uint32_t n = 0; n < chain.last(); ++n) {
            const double share = chain.look.share[n] / left;
            left -= double{chain.look.share[n]};
            const Vector3d axis = chain.axis_after(n), to = target - chain.eye_after(n);
            const double angle = angle_between(axis, to), most = std::acos(double{chain.look.cos_most[n]}),
                         rounding = 2e-6 + off_place / to.norm();
            RC_ASSERT(std::fabs(angle_of(chain.own_turn(n)) - std::min(share * angle, most)) <= 1.1e-3 + rounding);
        }
    }
    void check_limbs(const LinkedBody& body, LookCounts& counts) const
    {
        for (std::uint32_t g = 0; g < of.groups.size(); ++g) {
            if (of.limb_of[g] == kNoLimbHere || !(solved.flags(g, body.n) & SWIVEL_REACHED)) continue;
            if (of.value(g, SWIVEL_WEIGHTS, body.n, Float3{})[0] == 0) continue;
            const Vector3d target =
                vec(of.value(g, SWIVEL_TARGET, body.n, kNoPlace)) - vec(of.bodies[body.n].root_position);
            const Held hand = body.hand(g);
            RC_ASSERT((hand.place - target).norm() <=
                      body.bound(g) + 1e-6 * (target.norm() + vec(of.bodies[body.n].root_position).norm()));
            RC_ASSERT(hand.rotation.angularDistance(quat(of.value(g, SWIVEL_HAND, body.n, Float4{})).normalized()) <=
                      1e-5);
            ++counts.reached;
        }
    }
    // All that nothing turns keeps its local rotation.
    void check_others(const LinkedBody& body) const
    {
        const Body now = solved.poses.read(body.n, body.was_body);
        std::vector<bool> turns(of.skeleton.size());
        for (std::uint32_t g = 0; g < of.groups.size(); ++g) {
            const swivel_look& look = of.groups[g].look;
            for (std::uint32_t n = 0; n < look.joint_count; ++n) turns[look.joints[n]] = true;
            if (of.limb_of[g] == kNoLimbHere || of.value(g, SWIVEL_WEIGHTS, body.n, Float3{})[0] == 0) continue;
            for (const std::uint32_t joint : {body.joints(g).shoulder, body.joints(g).elbow, body.joints(g).wrist})
                turns[joint] = true;
        }
        for (std::uint32_t joint = 0; joint < of.skeleton.size(); ++joint)
            if (!turns[joint])
                RC_ASSERT(quat(now.rotations[joint])
                              .normalized()
                              .angularDistance(quat(body.was_body.rotations[joint]).normalized()) <=
                          (of.layout.in_body ? 3e-6 : 1e-6));
    }
};

}  // namespace

TEST_CASE("a chain looks at its target, each joint by its share and within its cone")
{
    LookCounts counts;
    CHECK(rc::check("by forward kinematics", [&](std::uint64_t seed) {
        Random random{seed};
        LookingBodies bodies(random, kLookingBodies, random_look_layout(random));
        if (random.below(3) == 0) put_in_body_space(bodies);
        const LookStage stage(bodies);
        for (std::size_t n = 0; n < kLookingBodies; ++n) {
            const LinkedBody body(stage.solved, n);
            for (const std::uint32_t group : bodies.looks) stage.check_look(body, group, counts);
            stage.check_limbs(body, counts);
            stage.check_others(body);
        }
    }));
    CAPTURE(counts.bodies, counts.sees, counts.held, counts.faded, counts.reached);
    CHECK(counts.sees > counts.bodies / 10);
    CHECK(counts.held > counts.bodies / 10);
    CHECK(counts.faded > counts.bodies / 10);
    CHECK(counts.reached > counts.bodies / 10);
}

TEST_CASE("a pose in the body's space turns with a look whose limbs are not solved")
{
    CHECK(rc::check("all that is not turned keeps its local rotation", [](std::uint64_t seed) {
        Random random{seed};
        LookingBodies bodies(random, 20, random_look_layout(random));
        put_in_body_space(bodies);
        PoseBuffer poses(bodies.layout, bodies.bodies);
        Crowd crowd = bodies.crowd();
        const swivel_pose pose = bodies.view(poses);
        crowd.solve({.groups = bodies.looks, .pose = &pose});
        for (std::size_t n = 0; n < 20; ++n) {
            const Body is = poses.read(n, bodies.bodies[n]);
            for (std::uint32_t joint = 0; joint < bodies.skeleton.size(); ++joint) {
                const bool turns = std::ranges::any_of(bodies.looks, [&](std::uint32_t g) {
                    const swivel_look& look = bodies.groups[g].look;
                    return std::count(look.joints, look.joints + look.joint_count, joint) > 0;
                });
                if (!turns)
                    RC_ASSERT(quat(is.rotations[joint])
                                  .normalized()
                                  .angularDistance(quat(bodies.bodies[n].rotations[joint]).normalized()) <= 3e-6);
            }
        }
    }));
}

TEST_CASE("the joints of bodies that look are where they say")
{
    CHECK(rc::check("rotations and places", [](std::uint64_t seed) {
        Random random{seed};
        LookingBodies bodies(random, 20, random_look_layout(random));
        if (random.below(2)) put_in_body_space(bodies);
        PoseBuffer poses(bodies.layout, bodies.bodies);
        Crowd crowd = bodies.crowd();
        std::vector<Float4> rotations(20 * bodies.skeleton.size());
        std::vector<Float3> places(rotations.size());
        swivel_pose pose = bodies.view(poses);
        pose.joint_rotations = {rotations.data(), bodies.skeleton.size() * sizeof(Float4), sizeof(Float4), nullptr};
        pose.joint_places = {places.data(), bodies.skeleton.size() * sizeof(Float3), sizeof(Float3), nullptr};
        crowd.solve({.pose = &pose});
        for (std::size_t n = 0; n < 20; ++n) {
            const Body is = in_body_space(bodies.skeleton, poses.read(n, bodies.bodies[n]));
            const std::vector<JointAt> was = joints_at(bodies.skeleton, bodies.bodies[n]);
            for (std::uint32_t joint = 0; joint < bodies.skeleton.size(); ++joint) {
                const std::size_t at = n * bodies.skeleton.size() + joint;
                if (rotations[at] == Float4{}) continue;  // no group needs it
                RC_ASSERT(quat(rotations[at]).angularDistance(quat(is.rotations[joint]).normalized()) <= 5e-6);
                RC_ASSERT((vec(places[at]) - vec(is.translations[joint])).norm() <=
                          3e-6 * (1 + way_to(bodies.skeleton, was, joint) / bodies.bodies[n].root_scale));
            }
        }
    }));
}

// SPDX-License-Identifier: MIT
//
// What a body's limb turns besides its three joints: twist bones take their share of how far the hand's twist changes,
// the clavicle its share of the way to the target. Both start from the incoming pose. All is checked by Eigen, in
// double.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/body_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;
using Eigen::AngleAxisd;

// One limb below a line of joints, before and after a solve. Poses are local or in the body's space.
struct SolvedLimb {
    BodySkeleton skeleton;
    Body body;
    BodyLimbJoints limb;
    std::vector<JointAt> was, is;

    template <class GoalOf>
    SolvedLimb(Random& random, swivel_features features, std::uint32_t twist_bones, float share, const GoalOf& goal_of)
        : skeleton(random_body_skeleton(random, {2 + random.below(3), 1, random.below(3), true, twist_bones, 2})),
          body(random_body(random, skeleton, {false, false, random.below(2) == 1, 2.8})),
          limb(skeleton.limbs[0]),
          was(joints_at(skeleton, body))
    {
        Crowd crowd = body_crowd(skeleton, features | twist_bones * SWIVEL_WITH_TWIST_BONES, 1);
        write_goals(crowd, {{goal_of(*this)}});
        if (features & SWIVEL_WITH_CLAVICLE) crowd.write_all(SWIVEL_CLAVICLE, 0, std::array{share});
        PoseLayout layout;
        layout.roots = true, layout.in_body = random.below(2) ? &skeleton : nullptr;
        layout.translates = layout.in_body;
        PoseBuffer poses(layout, {body});
        solve_poses(crowd, poses.view());
        REQUIRE(!swivel_find(crowd.get(), SWIVEL_BAD_INPUT, &group, &found));
        is = joints_at(skeleton, poses.read(0, body));
    }
    Quaterniond turn(std::uint32_t joint) const { return is[joint].rotation * was[joint].rotation.conjugate(); }
    // How far it turns beyond what another does.
    Quaterniond turn(std::uint32_t joint, std::uint32_t beside) const { return turn(joint) * turn(beside).conjugate(); }
    std::uint32_t clavicle() const { return static_cast<std::uint32_t>(skeleton.parents[limb.shoulder]); }
    BodyGoal own() const { return own_goal(skeleton, body, 0); }
    Vector3d target(const BodyGoal& goal) const { return vec(goal.target) - vec(body.root_position); }

private:
    std::uint32_t group = 0, found = 0;
};

constexpr double kBound = 1e-4;  // radians and metres

// A target beside the wrist, and any hand.
BodyGoal near_goal(Random& random, const SolvedLimb& limb)
{
    BodyGoal goal = random_goal(random, limb.skeleton, limb.body, 0);
    goal.target = floats(Vector3d(vec(limb.own().target) + random.vector(0.01, 0.3)));
    return goal;
}

}  // namespace

TEST_CASE("twist bones of bodies")
{
    const swivel_features features = SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND;
    rc::prop("take their share of the change", [=](std::uint64_t seed) {
        Random random{seed};
        const std::uint32_t bones = 1 + random.below(SWIVEL_MOST_TWIST_BONES);
        const double angle = random.between(-3, 3);
        const SolvedLimb solved(random, features, bones, 0, [&](const SolvedLimb& limb) {
            BodyGoal goal = limb.own();
            const Vector3d fore = (limb.was[limb.limb.wrist].place - limb.was[limb.limb.elbow].place).normalized();
            goal.hand = floats(Quaterniond(AngleAxisd(angle, fore) * limb.was[limb.limb.wrist].rotation));
            return goal;
        });
        const auto& [joints, was] = std::tie(solved.limb, solved.was);
        const Vector3d fore = (was[joints.wrist].place - was[joints.elbow].place).normalized(),
                       upper = (was[joints.elbow].place - was[joints.shoulder].place).normalized();
        RC_PRE(fore.cross(upper).norm() > 0.1);  // floats know the roll of a straight limb only so well
        // The bone's joint and the elbow's may each be off by what rounding of a short or nearly straight limb costs.
        const double rounding = kBound + 2 * LimbAt(solved.skeleton, solved.body, was, joints).joint_bound();
        for (std::uint32_t n = 0; n < bones; ++n) {
            const Quaterniond wanted(AngleAxisd(angle * (n + 1) / (bones + 1), fore));
            const double off = solved.turn(joints.twist_bones[n], joints.elbow).angularDistance(wanted);
            RC_ASSERT(off <= (2 * (n + 1) == bones + 1 ? rounding : 0.0022 + rounding));  // a half is exact
        }
    });
    rc::prop("keep what they have beside a twist, and move with the forearm", [=](std::uint64_t seed) {
        Random random{seed};
        const SolvedLimb solved(random, SWIVEL_WITH_HAND, 2, 0, [&](const SolvedLimb& limb) {
            return random_goal(random, limb.skeleton, limb.body, 0);
        });
        const auto& [joints, was, is] = std::tie(solved.limb, solved.was, solved.is);
        for (const std::uint32_t bone : joints.twist_bones) {
            // It turns with the forearm, and then about the forearm alone.
            const Quaterniond about = solved.turn(bone, joints.elbow);
            const Vector3d fore = (is[joints.wrist].place - is[joints.elbow].place).normalized();
            RC_ASSERT(about.vec().cross(fore).norm() <= kBound);
        }
    });
}

TEST_CASE("the clavicle of bodies")
{
    const swivel_features clavicle = SWIVEL_WITH_CLAVICLE;
    rc::prop("stays where goals are untouched", [=](std::uint64_t seed) {
        Random random{seed};
        const SolvedLimb solved(random, clavicle | SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND, 2, 1,
                                [](const SolvedLimb& limb) { return limb.own(); });
        for (std::uint32_t joint = 0; joint < solved.skeleton.size(); ++joint)
            RC_ASSERT(solved.turn(joint).angularDistance(Quaterniond::Identity()) <= 2e-3);  // of a bend of 0.01
        RC_ASSERT(solved.turn(solved.clavicle()).angularDistance(Quaterniond::Identity()) <= kBound);
    });
    rc::prop("turns by its share, and the wrist is met", [=](std::uint64_t seed) {
        Random random{seed};
        const double share = random.below(4) ? random.between(0, 1) : 1;
        BodyGoal goal;
        const SolvedLimb solved(random, clavicle | SWIVEL_WITH_HAND, 2, static_cast<float>(share),
                                [&](const SolvedLimb& limb) { return goal = near_goal(random, limb); });
        const auto& [limb, was, is] = std::tie(solved.limb, solved.was, solved.is);
        const Vector3d at = was[solved.clavicle()].place, from = was[limb.wrist].place - at,
                       to = solved.target(goal) - at;
        RC_PRE(from.norm() > 0.1 && to.norm() > 0.1);
        const double angle = std::atan2(from.cross(to).norm(), from.dot(to));
        // core/clavicle.h has the curve.
        const double half = std::atan2(share * std::sin(angle), 2 * (1 - share) + share * (1 + std::cos(angle)));
        const Quaterniond wanted(AngleAxisd(2 * half, from.cross(to).normalized()));
        RC_ASSERT(solved.turn(solved.clavicle()).angularDistance(wanted) <= kBound);
        RC_ASSERT(is[limb.wrist].rotation.angularDistance(quat(goal.hand).normalized()) <= kBound);
        const double upper = (was[limb.elbow].place - was[limb.shoulder].place).norm(),
                     fore = (was[limb.wrist].place - was[limb.elbow].place).norm(),
                     far = (at + wanted * (was[limb.shoulder].place - at) - solved.target(goal)).norm();
        const bool is_in_reach = far < 0.999 * (upper + fore) && far > 1.001 * std::fabs(upper - fore);
        if (is_in_reach) RC_ASSERT((is[limb.wrist].place - solved.target(goal)).norm() <= kBound);
    });
}

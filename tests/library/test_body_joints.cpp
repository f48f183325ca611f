// SPDX-License-Identifier: MIT
//
// The promise: a solve turns what it should and says where joints are. Twist bones take their share of how far the
// hand's twist changes, the clavicle its share of the way to the target; both start from the incoming pose. Poses may
// be in the body's space: what is below a limb's joints then moves with them. All is checked by Eigen, in double. That
// goals are met in this space, too, is in test_bodies.cpp. A limb that keeps a record says of it what the pose says.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include <cstring>
#include <numeric>

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
    Crowd crowd;

    // scales: bodies have bones and scales of their own.
    template <class GoalOf>
    SolvedLimb(Random& random, swivel_features features, std::uint32_t twist_bones, float share, const GoalOf& goal_of,
               bool scales = false)
        : skeleton(random_body_skeleton(random, {2 + random.below(3), 1, random.below(3), true, twist_bones, 2})),
          body(random_body(random, skeleton, {scales, scales, random.below(2) == 1, 2.8})),
          limb(skeleton.limbs[0]),
          was(joints_at(skeleton, body)),
          crowd(body_crowd(skeleton, features | twist_bones * SWIVEL_WITH_TWIST_BONES, 1))
    {
        write_goals(crowd, {{goal_of(*this)}});
        if (features & SWIVEL_WITH_CLAVICLE) crowd.write_all(SWIVEL_CLAVICLE, 0, std::array{share});
        PoseLayout layout;
        layout.roots = true, layout.in_body = random.below(2) ? &skeleton : nullptr;
        layout.translates = scales || layout.in_body, layout.scales = scales;
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

struct SolvedPoses {
    BodySkeleton skeleton;
    PoseLayout layout;
    std::vector<Body> was, is;
    PoseBuffer poses;
    std::vector<unsigned char> before;
    std::vector<std::vector<Float4>> joint_rotations;
    std::vector<std::vector<Float3>> joint_places;

    // in_body: of the poses. bad: a body that has bad input. some: the job names some groups, in place of all.
    SolvedPoses(Random& random, bool in_body, std::size_t bad = ~std::size_t{0}, bool some = false)
        : skeleton(
              random_body_skeleton(random, {1 + random.below(20), 1 + random.below(4), random.below(3), false, 0, 3})),
          layout(random_layout(random, in_body ? &skeleton : nullptr)),
          was(random_bodies(random)),
          poses(layout, was)
    {
        Crowd crowd = body_crowd(skeleton, SWIVEL_WITH_HAND, static_cast<std::uint32_t>(was.size()));
        BodyGoals goals;
        for (std::size_t limb = 0; limb < skeleton.limbs.size(); ++limb) {
            goals.emplace_back();
            for (const Body& body : was) goals.back().push_back(random_goal(random, skeleton, body, limb));
            if (bad < was.size()) goals.back()[bad].target[1] = std::nanf("");
        }
        write_goals(crowd, goals);
        swivel_pose pose = poses.view();
        if (bad < was.size()) {  // a finger's -0, which no product gives
            constexpr float kMinusZero = -0.0f;
            std::memcpy(&poses.bytes[bad * poses.body_stride + (skeleton.size() - 1) * pose.rotations.joint_stride],
                        &kMinusZero, sizeof kMinusZero);
        }
        before = poses.bytes;
        joint_rotations.assign(was.size(), std::vector<Float4>(skeleton.size()));
        joint_places.assign(was.size(), std::vector<Float3>(skeleton.size()));
        for (std::size_t n = 0; n < was.size(); ++n) is.push_back({});
        std::vector<Float4> all_rotations(was.size() * skeleton.size());
        std::vector<Float3> all_places(all_rotations.size());
        pose.joint_rotations = {all_rotations.data(), skeleton.size() * sizeof(Float4), sizeof(Float4), nullptr};
        pose.joint_places = {all_places.data(), skeleton.size() * sizeof(Float3), sizeof(Float3), nullptr};
        std::vector<std::uint32_t> groups(skeleton.limbs.size());
        std::iota(groups.begin(), groups.end(), 0u);
        if (some) std::erase_if(groups, [&](std::uint32_t g) { return g != 0 && random.below(2); });
        crowd.solve({.groups = groups, .pose = &pose});
        for (std::size_t n = 0; n < was.size(); ++n) {
            is[n] = poses.read(n, was[n]);
            for (std::size_t joint = 0; joint < skeleton.size(); ++joint) {
                joint_rotations[n][joint] = all_rotations[n * skeleton.size() + joint];
                joint_places[n][joint] = all_places[n * skeleton.size() + joint];
            }
        }
    }

    double bound(const std::vector<JointAt>& at, std::size_t body, std::uint32_t joint) const
    {
        double length = 0;
        for (const BodyLimbJoints& limb : skeleton.limbs)
            length = std::max(length, (at[limb.elbow].place - at[limb.shoulder].place).norm() +
                                          (at[limb.wrist].place - at[limb.elbow].place).norm());
        return 2e-6 * length + 5e-7 * (way_to(skeleton, at, joint) + vec(was[body].root_position).norm());
    }

private:
    std::vector<Body> random_bodies(Random& random)
    {
        std::vector<Body> made;
        for (int n = 0; n < 20; ++n)
            made.push_back(random_body(random, skeleton, {layout.translates, layout.scales, layout.roots}));
        return made;
    }
};

bool is_limb_joint(const BodySkeleton& skeleton, std::uint32_t joint)
{
    return std::ranges::any_of(skeleton.limbs, [&](const BodyLimbJoints& limb) {
        return joint == limb.shoulder || joint == limb.elbow || joint == limb.wrist;
    });
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

TEST_CASE("poses in the body's space")
{
    rc::prop("carry along what hangs below limbs", [](std::uint64_t seed) {
        Random random{seed};
        const SolvedPoses solved(random, true);
        for (std::size_t n = 0; n < solved.was.size(); ++n) {
            const BodySkeleton& skeleton = solved.skeleton;
            const std::vector<JointAt> at = joints_at(skeleton, solved.is[n]);
            for (std::uint32_t joint = 0; joint < skeleton.size(); ++joint) {
                const Body &was = solved.was[n], &is = solved.is[n];
                const double scale = at[joint].scale / is.scales[joint][0];
                RC_ASSERT(scale * (vec(is.translations[joint]) - vec(was.translations[joint])).norm() <=
                          solved.bound(at, n, joint));
                if (!is_limb_joint(skeleton, joint))
                    RC_ASSERT(quat(is.rotations[joint])
                                  .normalized()
                                  .angularDistance(quat(was.rotations[joint]).normalized()) <= 5e-6);
            }
        }
    });
    rc::prop("keep their bits where input is bad", [](std::uint64_t seed) {
        Random random{seed};
        const SolvedPoses solved(random, true, 7);
        const auto differ = [&](std::size_t n) {
            const std::size_t stride = solved.poses.body_stride;
            return !std::equal(&solved.before[n * stride], &solved.before[n * stride] + stride,
                               &solved.poses.bytes[n * stride]);
        };
        RC_ASSERT(!differ(7));
        RC_ASSERT(differ(6));
        RC_ASSERT(differ(8));
    });
}

TEST_CASE("where joints are after a solve")
{
    rc::prop("is what forward kinematics of the poses says, also of limbs that the job does not name",
             [](std::uint64_t seed) {
                 Random random{seed};
                 const bool in_body = random.below(2), some = random.below(2);
                 const SolvedPoses solved(random, in_body, ~std::size_t{0}, some);
                 const BodySkeleton& skeleton = solved.skeleton;
                 for (std::size_t n = 0; n < solved.is.size(); ++n) {
                     Body body = solved.is[n];
                     body.root_rotation = {0, 0, 0, 1}, body.root_scale = 1;
                     const std::vector<JointAt> at = joints_at(skeleton, body);
                     for (std::uint32_t joint = 0; joint < skeleton.size(); ++joint) {
                         const bool is_needed = std::ranges::any_of(skeleton.limbs, [&](const BodyLimbJoints& limb) {
                             return skeleton.is_above(joint, limb.wrist);
                         });
                         const Float4& rotation = solved.joint_rotations[n][joint];
                         RC_ASSERT((rotation == Float4{}) != is_needed);
                         if (!is_needed) continue;
                         RC_ASSERT(rotation[3] >= 0);
                         RC_ASSERT(quat(rotation).angularDistance(at[joint].rotation) <= 5e-6);
                         RC_ASSERT((vec(solved.joint_places[n][joint]) - at[joint].place).norm() <=
                                   2e-6 + solved.bound(at, n, joint));
                     }
                 }
             });
}

TEST_CASE("matrices that go elsewhere are whole")
{
    Random random{3};
    const BodySkeleton skeleton = random_body_skeleton(random, {3, 2, 1, false});
    std::vector<Body> bodies;
    for (int n = 0; n < 20; ++n) bodies.push_back(random_body(random, skeleton, {true, true, false}));
    PoseLayout layout;
    layout.form = GENERATE(SWIVEL_MATRIX_ROWS, SWIVEL_MATRIX_COLUMNS, SWIVEL_MATRIX_COLUMNS3);
    PoseBuffer in_place(layout, bodies), untouched(layout, bodies);
    layout.gap = in_place.body_stride;  // each body's second half is for its results
    PoseBuffer apart(layout, bodies);
    swivel_pose pose = apart.view();
    std::vector<std::size_t> offsets;
    for (std::size_t joint = 0; joint < skeleton.size(); ++joint)
        offsets.push_back(in_place.body_stride + joint * pose.rotations.joint_stride);
    pose.results = pose.rotations, pose.results.offsets = offsets.data();
    Crowd crowd = body_crowd(skeleton, SWIVEL_WITH_HAND, 20);
    BodyGoals goals(2);
    for (std::size_t limb = 0; limb < 2; ++limb)
        for (const Body& body : bodies) goals[limb].push_back(random_goal(random, skeleton, body, limb));
    write_goals(crowd, goals);
    solve_poses(crowd, in_place.view());
    solve_poses(crowd, pose);
    for (std::size_t n = 0; n < bodies.size(); ++n) {
        const unsigned char *const all = &apart.bytes[n * apart.body_stride], *const solved =
                                                                                  &in_place
                                                                                       .bytes[n * in_place.body_stride];
        REQUIRE(std::equal(all, all + in_place.body_stride, &untouched.bytes[n * untouched.body_stride]));
        for (std::uint32_t joint = 0; joint < skeleton.size(); ++joint) {
            if (!is_limb_joint(skeleton, joint)) continue;
            const std::size_t first = joint * pose.rotations.joint_stride;
            const auto is_same = [&](std::size_t number) {
                return std::memcmp(solved + first + 4 * number, all + offsets[joint] + 4 * number, 4) == 0;
            };
            for (std::size_t row = 0; row < 3; ++row)
                for (std::size_t column = 0; column < 4; ++column)
                    REQUIRE(is_same(layout.form == SWIVEL_MATRIX_ROWS      ? 4 * row + column
                                    : layout.form == SWIVEL_MATRIX_COLUMNS ? 4 * column + row
                                                                           : 3 * column + row));
        }
    }
}

TEST_CASE("what a limb records of its pose")
{
    rc::prop("gives joints and residuals as the solved pose has them", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 18; ++n) {
            const swivel_features clavicle = random.below(2) ? SWIVEL_WITH_CLAVICLE : 0;
            const float beyond = random.below(4) ? 0 : 100;  // how far the target is out of reach
            BodyGoal goal;
            const auto make = [&](const SolvedLimb& limb) {
                goal = random_goal(random, limb.skeleton, limb.body, 0);
                for (float& x : goal.target) x += beyond;
                return goal;
            };
            const SolvedLimb solved(random, SWIVEL_WITH_RECORD | SWIVEL_WITH_HAND | clavicle, 0, 0.5f, make, true);
            std::array<double, 3> elbow, wrist;
            std::array<double, 4> hand;
            double residual;
            const auto out = [](auto& value) { return swivel_out{&value, sizeof value}; };
            check(swivel_forward(solved.crowd.get(), 0, 0, 1, out(elbow), out(wrist), out(hand)));
            check(swivel_residuals(solved.crowd.get(), 0, 0, 1, out(residual)));
            const auto& [limb, at] = std::tie(solved.limb, solved.is);
            const Vector3d root = vec(solved.body.root_position), place = root + at[limb.wrist].place;
            const double length = (at[limb.elbow].place - at[limb.shoulder].place).norm() +
                                  (at[limb.wrist].place - at[limb.elbow].place).norm();
            const double way = way_to(solved.skeleton, at, limb.wrist), bound = 1e-5 * (way + root.norm());
            RC_ASSERT((Vector3d(elbow.data()) - root - at[limb.elbow].place).norm() <= bound);
            RC_ASSERT((Vector3d(wrist.data()) - place).norm() <= bound);
            RC_ASSERT(Quaterniond(hand.data()).angularDistance(at[limb.wrist].rotation) <= 1e-5);
            const double missed = (place - vec(goal.target)).norm() / length;
            const double length_error = 1e-6 * length + 2e-7 * way;  // floats of the way are rounded, too
            RC_ASSERT(std::fabs(residual - missed) * length <= bound + length_error * missed);
        }
    });
}

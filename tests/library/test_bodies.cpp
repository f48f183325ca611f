// SPDX-License-Identifier: MIT
//
// The promise: a pose goes in and a pose comes out. An untouched goal gives back the incoming pose, and any goal in
// reach is met, whatever the skeleton is, joints in between and scales among it, in all forms of poses. A body's weight
// takes its share of the turn of each joint: at 1 no bit changes, at 0 the pose keeps its bits, while what is carried
// goes on, and in between bones keep their lengths. All is checked by forward kinematics of Eigen's, in double.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/looking_bodies.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// A hundred seeds make more than 50,000 bodies, though small ones come twice. `tools/test --full bodies` makes a
// million.
constexpr int kSeedBodies = 600;

// A chain of more joints has more rounding than the bound: that of floats, and in matrices that of the caller's scales.
SkeletonWish random_wish(Random& random, swivel_pose_form form)
{
    const bool is_chain = random.below(4) == 0;
    const std::uint32_t most_in_line = form == SWIVEL_ROTATIONS ? 60 : 20;
    const std::uint32_t most = random.below(4) ? 20 : is_chain ? most_in_line : 180;
    return {random.below(most), 1 + random.below(5), random.below(3), is_chain};
}
// One in four is in the body's space.
PoseLayout any_layout(Random& random, const BodySkeleton* skeleton)
{
    PoseLayout layout;
    layout.form = static_cast<swivel_pose_form>(random.below(SWIVEL_MATRIX_COLUMNS3 + 1));
    if (random.below(4) == 0) layout.in_body = skeleton;
    layout.translates = layout.in_body || layout.form != SWIVEL_ROTATIONS || random.below(2);
    layout.scales = layout.in_body || layout.form != SWIVEL_ROTATIONS || random.below(2);
    layout.roots = random.below(2);
    layout.gap = random.below(100);
    return layout;
}

// Some bodies of one skeleton, before and after a solve.
struct SolvedBodies {
    PoseLayout layout;
    BodySkeleton skeleton;
    std::vector<Body> bodies;
    PoseBuffer poses;
    BodyGoals goals;
    Crowd crowd;

    template <class GoalOf>
    SolvedBodies(Random& random, swivel_features features, const GoalOf& goal_of)
        : layout(any_layout(random, &skeleton)),
          skeleton(random_body_skeleton(random, random_wish(random, layout.form))),
          bodies(random_bodies(random)),
          poses(layout, bodies),
          crowd(body_crowd(skeleton, features, static_cast<std::uint32_t>(bodies.size())))
    {
        for (std::size_t limb = 0; limb < skeleton.limbs.size(); ++limb) {
            goals.emplace_back();
            for (const Body& body : bodies) goals.back().push_back(goal_of(skeleton, body, limb));
        }
        write_goals(crowd, goals);
        solve_poses(crowd, poses.view());
    }
    // Calls take(goal, limb's joints, the limb as it came, joints as they came, joints as they are).
    template <class Take>
    void for_each_limb(const Take& take) const
    {
        for (std::size_t n = 0; n < bodies.size(); ++n) {
            const std::vector<JointAt> was = joints_at(skeleton, bodies[n]),
                                       is = joints_at(skeleton, poses.read(n, bodies[n]));
            for (std::size_t limb = 0; limb < skeleton.limbs.size(); ++limb) {
                const BodyLimbJoints& joints = skeleton.limbs[limb];
                BodyGoal goal = goals[limb][n];
                goal.target = floats(Vector3d(vec(goal.target) - vec(bodies[n].root_position)));
                take(goal, joints, LimbAt(skeleton, bodies[n], was, joints), was, is);
            }
        }
    }

private:
    std::vector<Body> random_bodies(Random& random)
    {
        std::vector<Body> made;
        for (int n = 0; n < kSeedBodies; ++n)
            made.push_back(random_body(random, skeleton, {layout.translates, layout.scales, layout.roots}));
        return made;
    }
};

constexpr std::size_t kWeighedBodies = 40;

// Bodies that look at a rate, or limbs alone.
struct WeighedBodies : LookingBodies {
    WeighedBodies(Random& random, bool look_too) : LookingBodies(random, kWeighedBodies, random_layout(random))
    {
        if (random.below(2)) layout.translates = layout.scales = true, layout.in_body = &skeleton;
        for (const std::uint32_t group : looks) groups[group].look.rate = 3;
        if (look_too) return;
        for (const std::uint32_t group : looks)
            find(group, SWIVEL_LOOK_TARGET)->numbers.assign(3 * kWeighedBodies, kNan);
    }
};

// Two frames of a crowd with these weights. Poses come in anew in each.
struct Weighed {
    Crowd crowd;
    PoseBuffer poses;

    Weighed(const WeighedBodies& of, const std::vector<float>& weights) : crowd(of.crowd()), poses(of.layout, of.bodies)
    {
        for (int frame = 0; frame < 2; ++frame) {
            poses = PoseBuffer(of.layout, of.bodies);
            swivel_pose pose = of.view(poses);
            if (!weights.empty()) pose.weight = stream(weights);
            for (const std::uint32_t group : of.looks)
                if (frame == 1) turn_targets(of, group);
            crowd.solve({.pose = &pose});
        }
    }

private:
    // So that the look is on its way.
    void turn_targets(const WeighedBodies& of, std::uint32_t group)
    {
        std::vector<Float3> targets(kWeighedBodies);
        for (std::size_t n = 0; n < kWeighedBodies; ++n) {
            const Float3 first = of.value(group, SWIVEL_LOOK_TARGET, n, kNoPlace);
            const Vector3d root = vec(of.bodies[n].root_position), from = vec(first) - root;
            targets[n] = floats(Vector3d(root + Vector3d(from.z(), from.x(), from.y())));
        }
        crowd.write(SWIVEL_LOOK_TARGET, group, targets);
    }
};

}  // namespace

TEST_CASE("untouched goals give back the incoming pose")
{
    rc::prop("as exactly as floats know it", [](std::uint64_t seed) {
        Random random{seed};
        const SolvedBodies solved(random, SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND, own_goal);
        solved.for_each_limb([](const BodyGoal&, const BodyLimbJoints& joints, const LimbAt& limb,
                                const std::vector<JointAt>& was,
                                const std::vector<JointAt>& is) { RC_ASSERT(strayed(limb, joints, was, is) <= 1); });
    });
}

TEST_CASE("any goal in reach is met")
{
    rc::prop("by wrist and hand", [](std::uint64_t seed) {
        Random random{seed};
        const SolvedBodies solved(random, SWIVEL_WITH_HAND,
                                  [&](const BodySkeleton& skeleton, const Body& body, std::size_t limb) {
                                      return random_goal(random, skeleton, body, limb);
                                  });
        solved.for_each_limb([&](const BodyGoal& goal, const BodyLimbJoints& joints, const LimbAt& limb,
                                 const std::vector<JointAt>& was, const std::vector<JointAt>& is) {
            // In the body's space each of shoulder, elbow and wrist carries places that are floats from the root. It
            // rotates them, four roundings, and adds the shift, a difference of two places, in four more.
            const double from_root = std::max(was[joints.wrist].place.norm(), is[joints.wrist].place.norm()),
                         carried = solved.layout.in_body ? 3 * 8 * 0x1p-24 * from_root : 0;
            RC_ASSERT((is[joints.wrist].place - vec(goal.target)).norm() <= limb.wrist_bound() + carried);
            RC_ASSERT(is[joints.wrist].rotation.angularDistance(quat(goal.hand).normalized()) <= 5e-6);
        });
    });
}

TEST_CASE("with a pole, elbows that are bent against their hinge come back bent with it")
{
    Random random{8};
    const BodySkeleton skeleton = random_body_skeleton(random, {3, 1, 0, false});
    const BodyLimbJoints& limb = skeleton.limbs[0];
    std::vector<Body> bodies;
    BodyGoals goals(1);
    for (int n = 0; n < 1000; ++n) {
        bodies.push_back(random_body(random, skeleton, {false, false, true}));
        goals[0].push_back(random_goal(random, skeleton, bodies.back(), 0));
    }
    PoseBuffer poses({.roots = true}, bodies);
    Crowd crowd = body_crowd(skeleton, 0, 1000);
    write_goals(crowd, goals);
    solve_poses(crowd, poses.view());
    // How far the forearm is towards where flexion carries it.
    const auto flexed = [&](const Body& body) {
        const std::vector<JointAt> at = joints_at(skeleton, body);
        return (at[limb.wrist].place - at[limb.elbow].place).dot(at[limb.shoulder].rotation * vec(limb.bend));
    };
    int backward_count = 0;
    for (std::size_t n = 0; n < bodies.size(); ++n) {
        backward_count += flexed(bodies[n]) < 0;
        REQUIRE(flexed(poses.read(n, bodies[n])) > -1e-5);
    }
    REQUIRE(backward_count > 300);
}

TEST_CASE("matrices that are solved in place again and again stay rotations")
{
    Random random{7};
    const BodySkeleton skeleton = random_body_skeleton(random, {3, 1, 0, false});
    std::vector<Body> bodies;
    for (int n = 0; n < 40; ++n) bodies.push_back(random_body(random, skeleton, {true, false, true}));
    PoseLayout layout;
    layout.form = GENERATE(SWIVEL_MATRIX_ROWS, SWIVEL_MATRIX_COLUMNS);
    layout.roots = true;
    PoseBuffer poses(layout, bodies);
    Crowd crowd = body_crowd(skeleton, SWIVEL_WITH_HAND, 40);
    for (int frame = 0; frame < 100; ++frame) {
        BodyGoals goals(1);
        for (const Body& body : bodies) goals[0].push_back(random_goal(random, skeleton, body, 0));
        write_goals(crowd, goals);
        solve_poses(crowd, poses.view());
    }
    const BodyLimbJoints& limb = skeleton.limbs[0];
    for (std::size_t n = 0; n < bodies.size(); ++n)
        for (const std::uint32_t joint : {limb.shoulder, limb.elbow, limb.wrist}) {
            const Eigen::Matrix3d axes = poses.matrix(n, joint);
            REQUIRE((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm() <= 3e-5);
        }
}

TEST_CASE("a weight of 1 changes no bit; one of 0 keeps the pose's bits, and what is carried goes on")
{
    rc::prop("bodies with looks and limbs", [](std::uint64_t seed) {
        Random random{seed};
        const WeighedBodies of(random, true);
        const Weighed without(of, {}), all(of, std::vector<float>(kWeighedBodies, 1)),
            none(of, std::vector<float>(kWeighedBodies, 0));
        RC_ASSERT(all_words(all.crowd) == all_words(without.crowd));
        RC_ASSERT(all.poses.bytes == without.poses.bytes);
        RC_ASSERT(none.poses.bytes == PoseBuffer(of.layout, of.bodies).bytes);
        using Turns = std::array<float, 25>;
        const std::uint32_t first = of.looks.front();  // another goes on from where the first one's part has brought it
        RC_ASSERT(
            (read<Turns>(none.crowd, SWIVEL_LOOK_TURNS, first) == read<Turns>(all.crowd, SWIVEL_LOOK_TURNS, first)));
    });
}

TEST_CASE("joints turn by their share of the way in between, and bones keep their lengths")
{
    int turns = 0;
    rc::prop("looks, or limbs alone", [&](std::uint64_t seed) {
        Random random{seed};
        const bool looks = random.below(2);
        const WeighedBodies of(random, looks);
        std::vector<float> weights;
        for (std::size_t n = 0; n < kWeighedBodies; ++n) weights.push_back(static_cast<float>(random.unit()));
        const Weighed all(of, {}), some(of, weights);
        for (std::size_t n = 0; n < kWeighedBodies; ++n) {
            const Body &came = of.bodies[n], whole = all.poses.read(n, came), weighed = some.poses.read(n, came);
            for (std::size_t joint = 0; joint < of.skeleton.size(); ++joint) {
                const Float3 &bone = came.translations[joint], &same = weighed.translations[joint];
                RC_ASSERT((vec(bone) - vec(same)).norm() <= 2e-5 * (1 + vec(bone).norm()));
                const swivel_look& first = of.groups[of.looks.front()].look;
                const bool is_of_first = std::count(first.joints, first.joints + first.joint_count, joint) > 0;
                if (looks && !is_of_first) continue;  // it was solved from where the look had turned it
                const Quaterniond from = quat(came.rotations[joint]).normalized();
                const double way = from.angularDistance(quat(whole.rotations[joint]).normalized()),
                             part = from.angularDistance(quat(weighed.rotations[joint]).normalized());
                RC_ASSERT(std::fabs(part - double{weights[n]} * way) <= 1.2e-3);
                turns += way > 0.1;
            }
        }
    });
    CHECK(turns > 0);
}

TEST_CASE("a weight that is none is bad input of its body")
{
    Random random{3};
    WeighedBodies of(random, true);
    std::vector<float> weights(kWeighedBodies, 0.5f);
    weights[7] = 1.5f, weights[9] = kNan, weights[11] = -0.25f;
    const Weighed bodies(of, weights);
    for (std::uint32_t group = 0; group < of.groups.size(); ++group) {
        const std::vector<std::uint32_t> flags = read<std::uint32_t>(bodies.crowd, SWIVEL_FLAGS, group);
        for (std::size_t n = 0; n < kWeighedBodies; ++n)
            CHECK((flags[n] == SWIVEL_BAD_INPUT) == (n == 7 || n == 9 || n == 11));
    }
}

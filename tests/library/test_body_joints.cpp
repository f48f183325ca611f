// SPDX-License-Identifier: MIT
//
// The promise: a solve turns what it should and says where joints are. Twist bones take their share of how far the
// hand's twist changes, the clavicle its share of the way to the target; both start from the incoming pose. Poses may
// be in the body's space: what is below a limb's joints then moves with them. All is checked by Eigen, in double. That
// goals are met in this space, too, is in test_bodies.cpp. A limb that keeps a record says of it what the pose says.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/posed_bodies.h"

namespace {

using namespace swivel;
using namespace swivel::test;
using Eigen::AngleAxisd;

// One limb below a line of joints, whose pose is local or in the body's space.
struct OneLimb : PosedBodies {
    BodyLimbJoints limb;
    std::vector<JointAt> was;

    // scales: it has bones and scales of its own.
    OneLimb(Random& random, swivel_features features, std::uint32_t twist_bones, bool scales = false)
        : PosedBodies(random, {2 + random.below(3), 1, random.below(3), true, twist_bones, 2}, 1,
                      {.translates = scales, .scales = scales, .roots = random.below(2) == 1}, 2.8),
          limb(skeleton.limbs[0]),
          was(joints_at(skeleton, bodies[0]))
    {
        if (random.below(2)) put_in_body_space();
        add_limbs(features);
    }
    std::uint32_t clavicle() const { return static_cast<std::uint32_t>(skeleton.parents[limb.shoulder]); }
    BodyGoal own() const { return own_goal(skeleton, bodies[0], 0); }
    SolvedBody solved(const BodyGoal& goal)
    {
        give_goals(0, [&](std::size_t) { return goal; });
        const SolvedBodies all(*this);
        REQUIRE(!(all.flags(0, 0) & SWIVEL_BAD_INPUT));
        return SolvedBody(all, 0);
    }
};

constexpr double kBound = 1e-4;  // radians and metres

// Bodies of any skeleton. Half of the jobs name some groups, in place of all.
struct FewBodies : PosedBodies {
    explicit FewBodies(Random& random)
        : PosedBodies(random, {1 + random.below(20), 1 + random.below(4), random.below(3), false, 0, 3}, 20,
                      random_layout(random))
    {
        add_limbs(SWIVEL_WITH_HAND);
        give_random_goals(random);
    }
    std::vector<std::uint32_t> some_groups(Random& random) const
    {
        std::vector<std::uint32_t> some = {0};
        for (std::uint32_t g = 1; g < groups.size(); ++g)
            if (random.below(2)) some.push_back(g);
        return some;
    }
};
// How far floats may have a joint off its place.
double bound(const SolvedBody& body, const std::vector<JointAt>& at, std::uint32_t joint)
{
    double length = 0;
    for (std::uint32_t g = 0; g < body.bodies.groups.size(); ++g)
        length = std::max(length, LimbAt(body.bodies.skeleton, body.incoming, at, body.joints(g)).length());
    return 2e-6 * length + 5e-7 * (way_to(body.bodies.skeleton, at, joint) + body.root().norm());
}

constexpr double kHalfUlp = 0x1p-24;  // u: an operation of floats rounds by at most this share of its result

// How far floats may be off after some steps: in radians, or as a share of a length that holds all that they turn. An
// operation rounds evenly within half an ulp, by 0.42 u in root mean square. So a step turns a rotation by up to 1.5 u,
// because a product of two sums up 4 products a component. Or it moves a place by 2 u of its own length, which is less
// than that one. Roundings are as good as independent, so the squares of their errors add up. Not one scene in 100
// million is off by more than six times the root of their sum.
double rounding_of(int steps) { return 6 * 1.5 * kHalfUlp * std::sqrt(steps); }

bool is_limb_joint(const BodySkeleton& skeleton, std::uint32_t joint)
{
    return std::ranges::any_of(skeleton.limbs, [&](const BodyLimbJoints& limb) {
        return joint == limb.shoulder || joint == limb.elbow || joint == limb.wrist;
    });
}

}  // namespace

TEST_CASE("twist bones of bodies")
{
    rc::prop("take their share of the change", [](std::uint64_t seed) {
        Random random{seed};
        const std::uint32_t bones = 1 + random.below(SWIVEL_MAX_TWIST_BONES);
        const double angle = random.between(-3, 3);
        OneLimb one(random, SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND, bones);
        const auto& [joints, was] = std::tie(one.limb, one.was);
        const Vector3d fore = (was[joints.wrist].place - was[joints.elbow].place).normalized(),
                       upper = (was[joints.elbow].place - was[joints.shoulder].place).normalized();
        RC_PRE(fore.cross(upper).norm() > 0.1);  // floats know the roll of a straight limb only so well
        BodyGoal goal = one.own();
        goal.hand = floats(Quaterniond(AngleAxisd(angle, fore) * was[joints.wrist].rotation));
        const SolvedBody body = one.solved(goal);
        // The bone's joint and the elbow's may each be off by what rounding of a short or nearly straight limb costs.
        const double rounding = kBound + 2 * body.limb(0).joint_bound();
        for (std::uint32_t n = 0; n < bones; ++n) {
            const Quaterniond wanted(AngleAxisd(angle * (n + 1) / (bones + 1), fore)),
                is = body.turn(joints.twist_bones[n]) * body.turn(joints.elbow).conjugate();
            RC_ASSERT(is.angularDistance(wanted) <=
                      (2 * (n + 1) == bones + 1 ? rounding : 0.0022 + rounding));  // a half is exact
        }
    });
    rc::prop("keep what they have beside a twist, and move with the forearm", [](std::uint64_t seed) {
        Random random{seed};
        OneLimb one(random, SWIVEL_WITH_HAND, 2);
        const SolvedBody body = one.solved(one.goal(random, 0, 0));
        for (const std::uint32_t bone : one.limb.twist_bones) {
            // It turns with the forearm, and then about the forearm alone.
            const Quaterniond about = body.turn(bone) * body.turn(one.limb.elbow).conjugate();
            const Vector3d fore = (body.solved[one.limb.wrist].place - body.solved[one.limb.elbow].place).normalized();
            RC_ASSERT(about.vec().cross(fore).norm() <= kBound);
        }
    });
}

TEST_CASE("the clavicle of bodies")
{
    rc::prop("stays where goals are untouched", [](std::uint64_t seed) {
        Random random{seed};
        OneLimb one(random, SWIVEL_WITH_CLAVICLE | SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND, 2);
        one.give(0, SWIVEL_CLAVICLE, [](std::size_t) { return Float1{1}; });
        const SolvedBody body = one.solved(one.own());
        for (std::uint32_t joint = 0; joint < one.skeleton.size(); ++joint)
            RC_ASSERT(angle_of(body.turn(joint)) <= 2e-3);  // of a bend of 0.01
        RC_ASSERT(angle_of(body.turn(one.clavicle())) <= kBound);
    });
    rc::prop("turns by its share, and the wrist is met", [](std::uint64_t seed) {
        Random random{seed};
        const float share = random.below(4) ? static_cast<float>(random.unit()) : 1;
        OneLimb one(random, SWIVEL_WITH_CLAVICLE | SWIVEL_WITH_HAND, 2);
        one.give(0, SWIVEL_CLAVICLE, [&](std::size_t) { return Float1{share}; });
        BodyGoal goal = one.goal(random, 0, 0);
        goal.target = floats(Vector3d(vec(one.own().target) + random.vector(0.01, 0.3)));
        const SolvedBody body = one.solved(goal);
        const auto& [limb, was, is] = std::tie(one.limb, body.came, body.solved);
        const Vector3d target = vec(goal.target) - body.root(), at = was[one.clavicle()].place,
                       from = was[limb.wrist].place - at, to = target - at;
        RC_PRE(from.norm() > 0.1 && to.norm() > 0.1);
        const double angle = angle_between(from, to), s = share;
        // core/clavicle.h has the curve.
        const double half = std::atan2(s * std::sin(angle), 2 * (1 - s) + s * (1 + std::cos(angle)));
        const Quaterniond wanted(AngleAxisd(2 * half, from.cross(to).normalized()));
        RC_ASSERT(body.turn(one.clavicle()).angularDistance(wanted) <= kBound);
        RC_ASSERT(is[limb.wrist].rotation.angularDistance(quat(goal.hand).normalized()) <= kBound);
        const LimbAt bones = body.limb(0);
        const double far = (at + wanted * (was[limb.shoulder].place - at) - target).norm();
        if (far < 0.999 * bones.length() && far > 1.001 * std::fabs(bones.upper - bones.fore))
            RC_ASSERT((is[limb.wrist].place - target).norm() <= kBound);
    });
}

TEST_CASE("poses in the body's space")
{
    rc::prop("carry along what hangs below limbs", [](std::uint64_t seed) {
        Random random{seed};
        FewBodies bodies(random);
        bodies.put_in_body_space();
        const SolvedBodies solved(bodies);
        for (std::size_t n = 0; n < bodies.bodies.size(); ++n) {
            const SolvedBody body(solved, n);
            const Body &was = body.incoming, is = solved.poses.read(n, was);
            for (std::uint32_t joint = 0; joint < bodies.skeleton.size(); ++joint) {
                const double scale = body.solved[joint].scale / is.scales[joint][0];
                RC_ASSERT(scale * (vec(is.translations[joint]) - vec(was.translations[joint])).norm() <=
                          bound(body, body.solved, joint));
                if (is_limb_joint(bodies.skeleton, joint)) continue;
                const Quaterniond now = quat(is.rotations[joint]).normalized();
                RC_ASSERT(now.angularDistance(quat(was.rotations[joint]).normalized()) <= 5e-6);
            }
        }
    });
    rc::prop("keep their bits where input is bad", [](std::uint64_t seed) {
        Random random{seed};
        FewBodies bodies(random);
        bodies.put_in_body_space();
        for (std::uint32_t g = 0; g < bodies.groups.size(); ++g) bodies.find(g, SWIVEL_TARGET)->at(7)[1] = kNan;
        SolvedBodies solved(bodies);
        solved.poses = bodies.incoming();
        const swivel_pose pose = solved.poses.view();
        constexpr float kMinusZero = -0.0f;  // of a finger, which no product gives
        std::memcpy(static_cast<char*>(pose.rotations.data) + 7 * pose.rotations.body_stride +
                        (bodies.skeleton.size() - 1) * pose.rotations.joint_stride,
                    &kMinusZero, sizeof kMinusZero);
        const PoseBuffer before = solved.poses;
        solved.solve();
        const auto differ = [&](std::size_t n) {
            const unsigned char* const first = &before.bytes[n * before.body_stride];
            return !std::equal(first, first + before.body_stride, &solved.poses.bytes[n * before.body_stride]);
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
                 FewBodies bodies(random);
                 if (random.below(2)) bodies.put_in_body_space();
                 const SolvedBodies solved(bodies,
                                           random.below(2) ? std::vector<std::uint32_t>{} : bodies.some_groups(random));
                 const BodySkeleton& skeleton = bodies.skeleton;
                 for (std::size_t n = 0; n < bodies.bodies.size(); ++n) {
                     const SolvedBody solved_body(solved, n);
                     Body body = solved.poses.read(n, bodies.bodies[n]);
                     body.root_rotation = {0, 0, 0, 1}, body.root_scale = 1;
                     const std::vector<JointAt> at = joints_at(skeleton, body);
                     for (std::uint32_t joint = 0; joint < skeleton.size(); ++joint) {
                         const bool is_needed = std::ranges::any_of(skeleton.limbs, [&](const BodyLimbJoints& limb) {
                             return skeleton.is_above(joint, limb.wrist);
                         });
                         const Float4& rotation = solved.joint_rotations[n * skeleton.size() + joint];
                         RC_ASSERT((rotation == Float4{}) != is_needed);
                         if (!is_needed) continue;
                         RC_ASSERT(rotation[3] >= 0);
                         RC_ASSERT(quat(rotation).angularDistance(at[joint].rotation) <= 5e-6);
                         const Float3& place = solved.joint_positions[n * skeleton.size() + joint];
                         RC_ASSERT((vec(place) - at[joint].place).norm() <= 2e-6 + bound(solved_body, at, joint));
                     }
                 }
             });
}

TEST_CASE("matrices that go elsewhere are whole")
{
    Random random{3};
    PoseLayout layout;
    layout.form = GENERATE(SWIVEL_MATRIX_ROWS, SWIVEL_MATRIX_COLUMNS, SWIVEL_MATRIX_COLUMNS3);
    layout.translates = layout.scales = true;
    PosedBodies bodies(random, {3, 2, 1, false}, 20, layout);
    bodies.add_limbs(SWIVEL_WITH_HAND);
    bodies.give_random_goals(random);
    const SolvedBodies in_place(bodies);
    PoseBuffer came = bodies.incoming();
    layout.gap = came.body_stride;  // each body's second half is for its results
    PoseBuffer apart(layout, bodies.bodies), untouched = apart;
    swivel_pose pose = apart.view();
    pose.results = pose.rotations;
    pose.results.data = &apart.bytes[came.body_stride];
    Crowd crowd = bodies.crowd();
    solve_poses(crowd, pose);
    for (std::size_t n = 0; n < 20; ++n) {
        const unsigned char *const from = &untouched.bytes[n * apart.body_stride], *const end = from + came.body_stride;
        REQUIRE(std::equal(from, end, &apart.bytes[n * apart.body_stride]));
        PoseBuffer results = came;
        std::copy_n(&apart.bytes[n * apart.body_stride + came.body_stride], came.body_stride,
                    &results.bytes[n * came.body_stride]);
        for (std::uint32_t joint = 0; joint < bodies.skeleton.size(); ++joint) {
            if (!is_limb_joint(bodies.skeleton, joint)) continue;
            REQUIRE(results.matrix(n, joint) == in_place.poses.matrix(n, joint));
            const Body to = results.read(n, bodies.bodies[n]), wanted = in_place.poses.read(n, bodies.bodies[n]);
            REQUIRE(to.translations[joint] == wanted.translations[joint]);
        }
    }
}

TEST_CASE("what a limb records of its pose")
{
    rc::prop("gives joints and residuals as the solved pose has them", [](std::uint64_t seed) {
        Random random{seed};
        for (int n = 0; n < 18; ++n) {
            const swivel_features clavicle = random.below(2) ? SWIVEL_WITH_CLAVICLE : 0;
            OneLimb one(random, SWIVEL_WITH_RECORD | SWIVEL_WITH_HAND | clavicle, 0, true);
            if (clavicle) one.give(0, SWIVEL_CLAVICLE, [](std::size_t) { return Float1{0.5f}; });
            const float beyond = random.below(4) ? 0 : 100;  // how far the target is out of reach
            one.give_goals(0, [&](std::size_t) { return one.goal(random, 0, 0); });
            Float3 target = one.value(0, SWIVEL_TARGET, 0, kNoPlace);
            for (float& x : target) x += beyond;
            one.find(0, SWIVEL_TARGET)->write(0, target);
            const SolvedBodies solved(one);
            const SolvedBody body(solved, 0);
            std::array<double, 3> elbow, wrist;
            std::array<double, 4> hand;
            double residual;
            const auto out = [](auto& value) { return swivel_out{&value, sizeof value}; };
            check(swivel_forward(solved.crowd.get(), 0, 0, 1, out(elbow), out(wrist), out(hand)));
            check(swivel_residuals(solved.crowd.get(), 0, 0, 1, out(residual)));
            const JointAt &elbow_at = body.solved[one.limb.elbow], &wrist_at = body.solved[one.limb.wrist];
            const Vector3d place = body.root() + wrist_at.place;
            // A pose in the body's space takes the most steps: 11 products for the limb's local rotations, 7 for the
            // arm frame and the clavicle, 29 for how four joints move, 16 vectors to the world, back and on, and as
            // much as 3 for the floats in which the test reads 11 joints. Told places are floats in the world, too.
            const double way = way_to(one.skeleton, body.solved, one.limb.wrist), turn_bound = rounding_of(66),
                         bound = turn_bound * way + kHalfUlp * (way + body.root().norm());
            RC_ASSERT((Vector3d(elbow.data()) - body.root() - elbow_at.place).norm() <= bound);
            RC_ASSERT((Vector3d(wrist.data()) - place).norm() <= bound);
            RC_ASSERT(Quaterniond(hand.data()).angularDistance(wrist_at.rotation) <= turn_bound);
            // The length is that of the pose as it came. As far as its joints are from the root, it takes 6 steps: the
            // elbow's place counts twice, once for each bone, so its square 4 times. Along the limb there are 7: 2 for
            // the offsets, 2 for rotations between them, and 3 for the scale and the bones in the arm frame.
            const double length = body.limb(0).length(),
                         limb_way = way - way_to(one.skeleton, body.solved, one.limb.shoulder);
            double far = 0;
            for (const std::uint32_t joint : {one.limb.shoulder, one.limb.elbow, one.limb.wrist})
                far = std::max(far, body.came[joint].place.norm());
            const double length_bound = std::hypot(rounding_of(6) * far, rounding_of(7) * limb_way),
                         missed = (place - vec(target)).norm() / length;
            RC_ASSERT(std::fabs(residual - missed) * length <= bound + length_bound * residual);
        }
    });
}

// SPDX-License-Identifier: MIT
//
// The promise: a pose goes in and a pose comes out. An untouched goal gives back the incoming pose, and any goal in
// reach is met, whatever the skeleton is, joints in between and scales among it, in all forms of poses. A hand that
// nobody writes keeps its incoming rotation in the world. A body's weight takes its share of the turn of each joint: at
// 1 no bit changes, at 0 the pose keeps its bits, while what is carried goes on, and in between bones keep their
// lengths. All is checked by forward kinematics of Eigen's, in double.
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
    const std::uint32_t max = random.below(4) ? 20 : is_chain ? most_in_line : 180;
    return {random.below(max), 1 + random.below(5), random.below(3), is_chain};
}
PoseLayout any_layout(Random& random)
{
    PoseLayout layout = random_layout(random);
    layout.gap = random.below(100);
    if (layout.form == SWIVEL_ROTATIONS) layout.scales = random.below(2);
    return layout;
}

// Bodies of one skeleton, whose limbs have goals. One crowd in four is in the body's space.
struct AnyBodies : PosedBodies {
    template <class GoalOf>
    AnyBodies(Random& random, swivel_features features, const GoalOf& goal_of) : AnyBodies(random, any_layout(random))
    {
        if (random.below(4) == 0) put_in_body_space();
        add_limbs(features);
        for (std::uint32_t g = 0; g < groups.size(); ++g)
            give_goals(g, [&](std::size_t n) { return goal_of(skeleton, bodies[n], g); });
    }

private:
    AnyBodies(Random& random, const PoseLayout& of) : PosedBodies(random, random_wish(random, of.form), kSeedBodies, of)
    {
    }
};
// Calls take(body, group) for each limb after a solve.
template <class Take>
void for_each_limb(const PosedBodies& bodies, const Take& take)
{
    const SolvedBodies solved(bodies);
    for (std::size_t n = 0; n < bodies.bodies.size(); ++n) {
        const SolvedBody body(solved, n);
        for (std::uint32_t g = 0; g < bodies.groups.size(); ++g) take(body, g);
    }
}

// Limbs that reach for targets, fit, stand and hold, and whose hands nobody writes.
struct UnwrittenHands : PosedBodies {
    enum Group : std::uint32_t { shift, reaches, fits, stands, holds };

    explicit UnwrittenHands(Random& random)
        : PosedBodies(random, {1 + random.below(8), 4, random.below(3), false}, 20, random_layout(random))
    {
        if (random.below(4) == 0) put_in_body_space();
        constexpr swivel_features kHand = SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING;
        const auto maybe = [&](swivel_features feature) { return random.below(2) ? feature : 0; };
        swivel_shift_def def = swivel_default_shift_def();
        def.drop = def.rise = 0.5f;
        add(def);
        add_limb(0, kHand | maybe(SWIVEL_WITH_EFFECTOR) | maybe(SWIVEL_WITH_WEIGHTS));
        add_limb(1, kHand | maybe(SWIVEL_WITH_EFFECTOR) | SWIVEL_WITH_PELVIS_FIT);
        add_limb(2, kHand | maybe(SWIVEL_WITH_EFFECTOR) | maybe(SWIVEL_WITH_PLANT_ROTATION) | SWIVEL_WITH_PLANT);
        add_limb(3, kHand | SWIVEL_WITH_LINK, reaches);
        for (const std::uint32_t g : {reaches, fits})
            give(g, SWIVEL_TARGET, [&](std::size_t n) { return goal(random, g, n).target; });
        for (const std::uint32_t g : {reaches, fits, stands})
            if (has(g, SWIVEL_WITH_EFFECTOR))
                give(g, SWIVEL_EFFECTOR, [&](std::size_t) { return floats(random.vector(0, 0.1)); });
        if (has(reaches, SWIVEL_WITH_WEIGHTS))
            give(reaches, SWIVEL_WEIGHTS, [&](std::size_t) { return Float3{1, static_cast<float>(random.unit()), 1}; });
        give(stands, SWIVEL_CONTACT, [](std::size_t n) { return Float1{static_cast<float>(n % 2)}; });
        give(holds, SWIVEL_GRIP, [&](std::size_t) { return floats(Held{random.rotation(), random.vector(0, 0.1)}); });
    }
    // The same with hands that are written: the incoming ones as change(hand) leaves them.
    template <class Change>
    PosedBodies with_hands(const Change& change) const
    {
        PosedBodies made = *this;
        for (const std::uint32_t g : {reaches, fits, stands, holds})
            made.give(g, SWIVEL_HAND, [&](std::size_t n) {
                Float4 hand = floats(joints_at(skeleton, bodies[n])[skeleton.limbs[limb_of[g]].wrist].rotation);
                change(hand);
                return hand;
            });
        return made;
    }
    void check_hands(const SolvedBodies& solved, std::size_t n) const
    {
        const SolvedBody body(solved, n);
        const Vector3d up = quat(bodies[n].root_rotation).normalized() * Vector3d::UnitY(),
                       shifted = double{solved.result<Float3>(SWIVEL_SHIFT, shift, n)[0]} * up;
        for (const std::uint32_t g : {reaches, fits, stands}) {
            const JointAt& came = body.came[body.joints(g).wrist];
            const std::uint32_t flags = solved.flags(g, n);
            RC_ASSERT(!(flags & SWIVEL_BAD_INPUT));
            RC_ASSERT(body.hand(g).rotation.angularDistance(came.rotation) <= 5e-6);
            const bool fitted = g == fits && solved.flags(shift, n) == SWIVEL_REACHED && !(flags & SWIVEL_CLAMPED_NEAR);
            if (!(flags & SWIVEL_REACHED) && !fitted) continue;
            const Vector3d wanted = g == stands ? body.point(g, {came.rotation, came.place}).place
                                                : Vector3d(vec(value(g, SWIVEL_TARGET, n, kNoPlace)) - body.root());
            RC_ASSERT((body.point(g).place + shifted - wanted).norm() <=
                      1e-5 * (body.length(g) + wanted.norm() + body.root().norm()));
        }
        const Quaterniond held = body.came[body.joints(reaches).wrist].rotation * body.grip(holds).rotation;
        RC_ASSERT(body.hand(holds).rotation.angularDistance(held) <= 1e-5);
    }
};

constexpr std::size_t kWeighedBodies = 40;

// Bodies that look at a rate, or limbs alone.
struct WeighedBodies : LookingBodies {
    WeighedBodies(Random& random, bool look_too) : LookingBodies(random, kWeighedBodies, random_layout(random))
    {
        if (random.below(2)) put_in_body_space();
        for (const std::uint32_t group : looks) look_def(group).rate = 3;
        if (look_too) return;
        for (const std::uint32_t group : looks)
            find(group, SWIVEL_LOOK_TARGET)->numbers.assign(3 * kWeighedBodies, kNan);
    }
};

// Two frames of a crowd with these weights. Poses come in anew in each.
struct Weighed {
    Crowd crowd;
    PoseBuffer poses;

    Weighed(const WeighedBodies& of, const std::vector<float>& weights) : crowd(of.crowd()), poses(of.incoming())
    {
        for (int frame = 0; frame < 2; ++frame) {
            poses = of.incoming();
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
        for_each_limb(AnyBodies(random, SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND, own_goal),
                      [](const SolvedBody& body, std::uint32_t g) { RC_ASSERT(body.strayed(g) <= 1); });
    });
}

TEST_CASE("any goal in reach is met")
{
    rc::prop("by wrist and hand", [](std::uint64_t seed) {
        Random random{seed};
        const auto goal_of = [&](const auto&... of) { return random_goal(random, of...); };
        for_each_limb(AnyBodies(random, SWIVEL_WITH_HAND, goal_of), [](const SolvedBody& body, std::uint32_t g) {
            const JointAt &was = body.came[body.joints(g).wrist], &is = body.solved[body.joints(g).wrist];
            // In the body's space each of shoulder, elbow and wrist carries places that are floats from the root. It
            // rotates them, four roundings, and adds the shift, a difference of two places, in four more.
            const double from_root = std::max(was.place.norm(), is.place.norm()),
                         carried = body.bodies.is_in_body ? 3 * 8 * 0x1p-24 * from_root : 0;
            const Vector3d target = vec(body.bodies.value(g, SWIVEL_TARGET, body.n, kNoPlace)) - body.root();
            const Float4 hand = body.bodies.value(g, SWIVEL_HAND, body.n, kNoTurn);
            RC_ASSERT((is.place - target).norm() <= body.limb(g).wrist_bound() + carried);
            RC_ASSERT(is.rotation.angularDistance(quat(hand).normalized()) <= 5e-6);
        });
    });
}

TEST_CASE("a hand that nobody writes keeps its incoming rotation in the world")
{
    rc::prop("as one of NaN does to the bit, and one that is written as it came", [](std::uint64_t seed) {
        Random random{seed};
        const UnwrittenHands bodies(random);
        const auto spoil = [&](Float4& hand) { hand[random.below(4)] = kNan; };
        const auto lengthen = [](Float4& hand) {
            for (float& x : hand) x *= 3;
        };
        const PosedBodies unknown = bodies.with_hands(spoil), given = bodies.with_hands(lengthen);
        const SolvedBodies solved(bodies), same(unknown), written(given);
        for (std::size_t n = 0; n < bodies.bodies.size(); ++n) {
            RC_ASSERT(bits_of_body(solved.crowd, solved.poses, n) == bits_of_body(same.crowd, same.poses, n));
            for (const SolvedBodies* const each : {&solved, &written}) bodies.check_hands(*each, n);
        }
    });
}

TEST_CASE("with a pole, elbows that are bent against their hinge come back bent with it")
{
    Random random{8};
    PosedBodies bodies(random, {3, 1, 0, false}, 1000, {.roots = true});
    bodies.add_limbs(0);
    bodies.give_random_goals(random);
    int backward_count = 0;
    for_each_limb(bodies, [&](const SolvedBody& body, std::uint32_t g) {
        // How far the forearm is towards where flexion carries it.
        const auto flexed = [&](const std::vector<JointAt>& at) {
            const BodyLimbJoints& limb = body.joints(g);
            return (at[limb.wrist].place - at[limb.elbow].place).dot(at[limb.shoulder].rotation * vec(limb.bend));
        };
        backward_count += flexed(body.came) < 0;
        REQUIRE(flexed(body.solved) > -1e-5);
    });
    REQUIRE(backward_count > 300);
}

TEST_CASE("matrices that are solved in place again and again stay rotations")
{
    Random random{7};
    PoseLayout layout;
    layout.form = GENERATE(SWIVEL_MATRIX_ROWS, SWIVEL_MATRIX_COLUMNS);
    layout.translates = layout.roots = true;
    PosedBodies bodies(random, {3, 1, 0, false}, 40, layout);
    bodies.add_limbs(SWIVEL_WITH_HAND);
    bodies.give_random_goals(random);
    SolvedBodies solved(bodies);
    for (int frame = 1; frame < 100; ++frame) {
        bodies.inputs.clear();
        bodies.give_random_goals(random);
        bodies.write(solved.crowd);
        solved.solve();
    }
    const BodyLimbJoints& limb = bodies.skeleton.limbs[0];
    for (std::size_t n = 0; n < 40; ++n)
        for (const std::uint32_t joint : {limb.shoulder, limb.elbow, limb.wrist}) {
            const Eigen::Matrix3d axes = solved.poses.matrix(n, joint);
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
        RC_ASSERT(none.poses.bytes == of.incoming().bytes);
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
                const swivel_look_def& first = of.look_def(of.looks.front());
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

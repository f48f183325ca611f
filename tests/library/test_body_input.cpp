// SPDX-License-Identifier: MIT
//
// The promise: bad input costs its own limb of its own body, what holds it, and nothing else. A linked limb then keeps
// its goal, and the frame of a hand is whole or none. A hand on one that keeps its pose goes there. Where no weight
// asks for more, the incoming bits stay.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <numeric>

#include "tests/looking_bodies.h"
#include "tests/posed_bodies.h"
#include "tests/test_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;
using H = HoldingBodies;

constexpr swivel_pose_form kForms[] = {SWIVEL_ROTATIONS, SWIVEL_MATRIX_ROWS, SWIVEL_MATRIX_COLUMNS,
                                       SWIVEL_MATRIX_COLUMNS3};
PoseLayout whole_layout(swivel_pose_form form)
{
    PoseLayout layout;
    layout.form = form, layout.translates = layout.scales = layout.roots = true;
    return layout;
}

constexpr std::size_t kBadBody = 20;  // whose share is 2/3, or what a case makes it; without a written place

// Whether the hand of the bad body has a frame, which is whole or none.
bool has_frame(const SolvedBodies& solved, std::uint32_t group)
{
    const auto frame = solved.result<Float7>(SWIVEL_HAND_TRANSFORM, group, kBadBody);
    const auto count = std::ranges::count_if(frame, [](float x) { return std::isnan(x); });
    CHECK((count == 0 || count == 7));
    return count == 0;
}

// Bodies that hold each other and props, and the same where a part of one is bad.
struct BadBodies {
    HoldingBodies good_bodies, bodies;
    PoseBuffer came;

    explicit BadBodies(std::uint64_t seed, swivel_on_bad_input on_bad_input = SWIVEL_KEEP_POSE,
                       swivel_pose_form form = SWIVEL_ROTATIONS)
        : good_bodies(made(seed, on_bad_input, form)), bodies(made(seed, on_bad_input, form)), came(bodies.incoming())
    {
    }
    static HoldingBodies made(std::uint64_t seed, swivel_on_bad_input on_bad_input, swivel_pose_form form)
    {
        Random random{seed};
        HoldingBodies made(random, 40, whole_layout(form), on_bad_input);
        made.leave_in_hand(kBadBody);
        return made;
    }
    float* input(std::uint32_t group, swivel_field field) { return bodies.find(group, field)->at(kBadBody); }
    const BodyLimbJoints& limb(std::uint32_t group) const { return bodies.skeleton.limbs[bodies.limb_of[group]]; }
    // Changes the bad body. Numbers of the pose may be changed after that.
    template <class Spoil>
    void spoil(std::uint32_t group, const Spoil& spoil)
    {
        spoil(bodies.bodies[kBadBody], limb(group));
        came = bodies.incoming();
    }
    SolvedBodies solved() const { return SolvedBodies(bodies, came); }
    // Whether one of the two holds the other, or both hold the same.
    static bool hold(std::uint32_t a, std::uint32_t b)
    {
        constexpr std::uint32_t first[] = {H::prop, H::prop, H::prop, H::prop,   H::free,
                                           H::free, H::leg,  H::leg,  H::handle, H::handle};
        return first[a] == first[b];
    }
    // groups: that are bad in that body. Then in others, but for those that hold them, and in other bodies no bit
    // changes.
    void check_bad(const std::vector<std::uint32_t>& groups) const
    {
        const SolvedBodies before(good_bodies);
        SolvedBodies good(good_bodies), now(good_bodies);
        good.solve_next();
        bodies.write(now.crowd), now.poses = came, now.solve();
        for (std::size_t n = 0; n < 40; ++n)
            if (n != kBadBody)
                REQUIRE((bits_of_body(now.crowd, now.poses, n) == bits_of_body(good.crowd, good.poses, n)));
        for (std::uint32_t g = 0; g < bodies.groups.size(); ++g) {
            const bool is_bad = std::ranges::find(groups, g) != groups.end(),
                       is_apart = !groups.empty() &&
                                  std::ranges::none_of(groups, [&](std::uint32_t bad) { return hold(g, bad); }),
                       is_limb = bodies.limb_of[g] != kNoLimbHere;
            INFO("group " << g << ", flags " << now.flags(g, kBadBody));
            CHECK((now.flags(g, kBadBody) == SWIVEL_BAD_INPUT) == is_bad);
            CHECK(!(good.flags(g, kBadBody) & SWIVEL_BAD_INPUT));
            if (is_apart) CHECK(bits_of_group(now.crowd, g, kBadBody) == bits_of_group(good.crowd, g, kBadBody));
            if (is_apart && is_limb) check_joints(g, now.poses, good.poses);
            if (is_bad && is_limb && bodies.limb_def(g).on_bad_input == SWIVEL_KEEP_POSE) {
                check_joints(g, now.poses, came);
                if (bodies.has(g, SWIVEL_WITH_LINK)) CHECK(goal_bits(now, g) == goal_bits(before, g));
            }
            if (g == H::left || g == H::free) has_frame(now, g);
        }
    }

private:
    static std::array<std::uint32_t, 7> goal_bits(const SolvedBodies& of, std::uint32_t group)
    {
        return of.result<std::array<std::uint32_t, 7>>(SWIVEL_SOLVED_GOAL, group, kBadBody);
    }
    void check_joints(std::uint32_t group, const PoseBuffer& are, const PoseBuffer& wanted) const
    {
        for (const std::uint32_t joint : {limb(group).shoulder, limb(group).elbow, limb(group).wrist})
            CHECK(are.joint_bytes(kBadBody, joint) == wanted.joint_bytes(kBadBody, joint));
    }
};

}  // namespace

TEST_CASE("bad input of a joint is that of the limbs below it, which keep their pose, and of what hangs on them")
{
    std::vector<std::uint32_t> all(10);
    std::iota(all.begin(), all.end(), 0u);
    const auto all_but = [&](std::uint32_t group) {
        std::vector<std::uint32_t> some = all;
        std::erase(some, group);
        return some;
    };
    const std::vector<std::uint32_t> right = {H::right}, free = {H::free, H::follower};
    const struct {
        const char* name;
        std::uint32_t group;
        std::vector<std::uint32_t> groups;
        void (*spoil)(Body& body, const BodyLimbJoints& limb);
    } rows[] = {
        {"a shoulder's rotation", H::right, right, [](auto& b, auto& limb) { b.rotations[limb.shoulder][2] = kNan; }},
        {"an elbow's rotation", H::right, right, [](auto& b, auto& limb) { b.rotations[limb.elbow][1] = kNan; }},
        {"a wrist's rotation, whose hand another one holds", H::free, free,
         [](auto& b, auto& limb) { b.rotations[limb.wrist][0] = kNan; }},
        {"a wrist's translation", H::right, right, [](auto& b, auto& limb) { b.translations[limb.wrist][0] = kNan; }},
        {"a wrist's translation that is too far", H::free, free,
         [](auto& b, auto& limb) { b.translations[limb.wrist][1] = 3e20f; }},
        {"an elbow's translation", H::right, right, [](auto& b, auto& limb) { b.translations[limb.elbow][1] = kInf; }},
        {"an uneven scale", H::right, right, [](auto& b, auto& limb) { b.scales[limb.elbow][2] *= 1.01f; }},
        {"a negative scale", H::free, free, [](auto& b, auto& limb) { b.scales[limb.shoulder].fill(-1); }},
        {"a rotation above all limbs", H::right, all_but(H::shift), [](auto& b, auto&) { b.rotations[0][0] = kInf; }},
        {"the root's place", H::right, all, [](auto& b, auto&) { b.root_position[1] = kNan; }},
        {"the root's scale", H::right, all_but(H::handle), [](auto& b, auto&) { b.root_scale = 0; }},
    };
    for (const swivel_pose_form form : {SWIVEL_ROTATIONS, SWIVEL_MATRIX_COLUMNS})
        for (const auto& [name, group, groups, spoil] : rows) {
            INFO(name << ", form " << form);
            BadBodies stage(1, SWIVEL_KEEP_POSE, form);
            stage.spoil(group, spoil);
            stage.check_bad(groups);
            const bool is_bad = std::ranges::find(groups, H::free) != groups.end(),
                       has_size = stage.bodies.bodies[kBadBody].root_scale > 0;  // a body of no size has a place
            if (has_size) CHECK(has_frame(stage.solved(), H::free) == !is_bad);
        }
    INFO("a rotation of no length");
    BadBodies zero(1);
    zero.spoil(H::right, [](auto& b, auto& limb) { b.rotations[limb.elbow] = {}; });
    zero.check_bad(right);
    INFO("a slanted matrix");
    BadBodies slanted(1, SWIVEL_KEEP_POSE, SWIVEL_MATRIX_COLUMNS);
    for (const std::uint32_t joint : {slanted.limb(H::right).elbow, slanted.limb(H::right).wrist}) {
        slanted.came = slanted.bodies.incoming();
        auto* const column =
            reinterpret_cast<float*>(&slanted.came.bytes[kBadBody * slanted.came.body_stride + joint * 64]);
        for (int n = 0; n < 3; ++n) column[n] += 0.01f * column[4 + n];
        slanted.check_bad(right);
    }
}

TEST_CASE("bad input that a prop comes from is its own, and one hand takes it from afar where the other is bad")
{
    BadBodies of_prop(1), far(1);
    of_prop.bodies.bodies[kBadBody].rotations[1][2] = kNan;
    of_prop.came = of_prop.bodies.incoming();
    const SolvedBodies solved = of_prop.solved();
    CHECK(solved.flags(H::handle, kBadBody) == SWIVEL_BAD_INPUT);
    CHECK(solved.flags(H::on_handle, kBadBody) == SWIVEL_BAD_INPUT);
    for (HoldingBodies* const each : {&far.good_bodies, &far.bodies}) {
        std::get<swivel_prop_def>(each->groups[H::prop]).max_move = 1000;
        each->find(H::prop, SWIVEL_PROP_POSITION)->write(kBadBody, Float3{30, 0, 0});
    }
    far.input(H::right, SWIVEL_GRIP)[1] = kNan;
    far.check_bad({H::right});
    CHECK(far.solved().flags(H::prop, kBadBody) == SWIVEL_REACHED);
}

TEST_CASE("bad input of hands and props is that of what depends on them, and of no other body")
{
    const std::vector<std::uint32_t> none, follower = {H::follower}, right = {H::right},
                                           all = {H::prop, H::left, H::right};
    const struct {
        const char* name;
        std::uint32_t group;
        swivel_field field;
        std::size_t first, count;  // the numbers of its value that are bad
        std::vector<float> bad;
        std::vector<std::uint32_t> groups;
        float share = 0;
    } rows[] = {
        {"nothing", H::prop, SWIVEL_HAND_BLEND, 0, 1, {0, 1}, none},
        {"a grip of the hand that says where the prop is", H::left, SWIVEL_GRIP, 1, 1, {kNan, kInf, 1e16f}, all},
        {"a grip of the other hand", H::right, SWIVEL_GRIP, 1, 1, {kNan}, right},
        {"a grip of either hand, between which the prop is", H::right, SWIVEL_GRIP, 4, 1, {kInf}, all, 0.5f},
        {"a grip of no rotation", H::follower, SWIVEL_GRIP, 3, 4, {0}, follower},
        {"a share", H::prop, SWIVEL_HAND_BLEND, 0, 1, {-0.1f, 1.1f, kNan}, all},
        {"a weight", H::prop, SWIVEL_PROP_WEIGHT, 0, 1, {-0.1f, 1.1f, kNan}, all},
        {"a place of a prop", H::prop, SWIVEL_PROP_POSITION, 0, 3, {2e15f, kInf}, all},
        {"a rotation of a prop", H::prop, SWIVEL_PROP_ROTATION, 0, 4, {0, kInf}, all},
        {"a target of a hand on a prop", H::left, SWIVEL_TARGET, 0, 3, {2e15f}, all},
        {"a target", H::free, SWIVEL_TARGET, 0, 1, {kNan}, {H::free}},
        {"a hand", H::free, SWIVEL_HAND, 0, 4, {0, kInf, 1e10f}, {H::free}},
        {"a hand of NaN, which is the incoming one", H::free, SWIVEL_HAND, 3, 1, {kNan}, none},
    };
    for (const auto& [name, group, field, first, count, values, groups, share] : rows)
        for (const float bad : values) {
            INFO(name << ", " << bad);
            BadBodies stage(1);
            if (!stage.bodies.find(group, field))
                for (HoldingBodies* const each : {&stage.bodies, &stage.good_bodies})
                    each->give(group, field, [](std::size_t) { return Float1{1}; });
            if (share > 0) stage.input(H::prop, SWIVEL_HAND_BLEND)[0] = share;
            std::fill_n(stage.input(group, field) + first, count, bad);
            stage.check_bad(groups);
        }
}

TEST_CASE("a hand on a limb that keeps its pose after bad input holds it there")
{
    BadBodies stage(2);
    stage.input(H::free, SWIVEL_TARGET)[0] = kNan;
    stage.check_bad({H::free});
    const SolvedBodies solved = stage.solved();
    const SolvedBody body(solved, kBadBody);
    const JointAt& wrist = body.came[stage.limb(H::free).wrist];
    const Held told = solved.from_root(SWIVEL_HAND_TRANSFORM, H::free, kBadBody);
    const double off = 2e-7 * vec(body.incoming.root_position).norm() + body.bound(H::free);
    const Vector3d up = quat(body.incoming.root_rotation).normalized() * Vector3d::UnitY(),
                   shifted = double{solved.result<Float3>(SWIVEL_SHIFT, H::shift, kBadBody)[0]} * up;
    CHECK((told.place - shifted - wrist.place).norm() <= off);
    CHECK(told.rotation.angularDistance(wrist.rotation) <= 2e-6);
    if (solved.flags(H::follower, kBadBody) & SWIVEL_REACHED) {
        const Held wanted = body.wanted(H::follower, {wrist.rotation, wrist.place});
        CHECK((body.hand(H::follower).place - wanted.place).norm() <= body.bound(H::follower) + off);
    }
}

TEST_CASE("a hand on a limb with bad input and its rest pose has bad input")
{
    BadBodies stage(3, SWIVEL_REST_POSE);
    stage.input(H::free, SWIVEL_TARGET)[0] = kNan;
    stage.check_bad({H::free, H::follower});
    const SolvedBodies solved = stage.solved();
    CHECK(!has_frame(solved, H::free));
    const Body is = solved.poses.read(kBadBody, stage.bodies.bodies[kBadBody]);
    const swivel_binding bound =
        bind(stage.bodies.skeleton.view(), stage.bodies.joints[stage.bodies.limb_of[H::follower]]);
    CHECK(quat(is.rotations[stage.limb(H::follower).shoulder]).angularDistance(quat(bound.shoulder_rest)) <= 1e-6);
}

TEST_CASE("bad input of a look keeps its joints, and is that of no other body")
{
    const std::string spoilt = GENERATE("target", "weight", "pose");
    using Turns = std::array<float, 25>;
    Upright of;
    of.look.rate = 2;
    UprightCrowd good(of, 20), bodies(of, 20);
    std::vector<Float3> targets(20, Float3{1, 1.6f, 2});
    for (UprightCrowd* each : {&good, &bodies}) each->solve(targets, 0.1f), each->reset();
    const Vector3d sight = bodies.line(7);
    const auto carried = value_of<Turns>(bodies.crowd, SWIVEL_LOOK_TURNS, 0, 7);
    good.solve(targets, 0.1f);
    if (spoilt == "target") targets[7] = {0, 1e16f, 0};
    if (spoilt == "weight") bodies.crowd.write(SWIVEL_LOOK_WEIGHT, 0, std::vector<float>{1.5f}, 7);
    if (spoilt == "pose") bodies.rotations[7][1][0] = kNan;
    bodies.solve(targets, 0.1f);
    INFO(spoilt);
    CHECK((bodies.rotations[7][3] == Float4{0, 0, 0, 1}));
    CHECK(bodies.flags(7) == SWIVEL_BAD_INPUT);
    CHECK((bodies.line(7) == sight));
    CHECK((value_of<Turns>(bodies.crowd, SWIVEL_LOOK_TURNS, 0, 7) == carried));
    for (std::size_t n = 0; n < 20; ++n)
        if (n != 7) CHECK((bodies.rotations[n] == good.rotations[n]));
}

namespace {

// Limbs that all hang below joint 0, without goals.
struct PlainBodies : PosedBodies {
    PlainBodies(Random& random, swivel_features features, swivel_pose_form form)
        : PosedBodies(random, {2, 3, 1, true}, 20, whole_layout(form))
    {
        add_limbs(features);
    }
};

}  // namespace

TEST_CASE("without any weight the incoming bits stay, in every form")
{
    for (const swivel_pose_form form : kForms) {
        Random random{3};
        PlainBodies bodies(random, SWIVEL_WITH_HAND | SWIVEL_WITH_WEIGHTS | SWIVEL_POLE_INCOMING, form);
        bodies.give_random_goals(random);
        for (std::uint32_t g = 0; g < 3; ++g) bodies.give(g, SWIVEL_WEIGHTS, [](std::size_t) { return Float3{}; });
        for (Body& body : bodies.bodies)
            for (Float4& q : body.rotations)
                for (float& x : q) x *= 3;  // of any length, and of either sign
        const SolvedBodies solved(bodies);
        REQUIRE(solved.poses.bytes == bodies.incoming().bytes);
        for (std::size_t n = 0; n < 20; ++n) REQUIRE(solved.flags(0, n) == SWIVEL_REACHED);
    }
}

TEST_CASE("limbs with bad input are at rest where their group says so")
{
    for (const swivel_pose_form form : kForms) {
        Random random{5};
        PlainBodies bodies(random, 0, form);  // no target is written
        for (std::uint32_t g = 0; g < bodies.groups.size(); ++g) bodies.limb_def(g).on_bad_input = SWIVEL_REST_POSE;
        const SolvedBodies solved(bodies);
        for (std::size_t n = 0; n < 20; ++n) {
            const Body body = solved.poses.read(n, bodies.bodies[n]);
            for (const BodyLimbJoints& limb : bodies.skeleton.limbs)
                for (const std::uint32_t joint : {limb.shoulder, limb.elbow})
                    REQUIRE(distance(quat(body.rotations[joint]), quat(bodies.skeleton.rotations[joint]).normalized()) <
                            1e-6);
        }
    }
}

TEST_CASE("a pose of an older header is read as far as it goes")
{
    Random random{9};
    PlainBodies bodies(random, SWIVEL_WITH_HAND, SWIVEL_ROTATIONS);
    bodies.give_random_goals(random);
    PoseBuffer older = bodies.incoming();
    swivel_pose pose = older.view();
    pose.size = offsetof(swivel_pose, space);
    pose.reserved = 1;  // beyond its end
    Crowd crowd = bodies.crowd();
    solve_poses(crowd, pose);
    REQUIRE(older.bytes == SolvedBodies(bodies).poses.bytes);
}

// SPDX-License-Identifier: MIT
//
// The promise: bad input costs its own limb of its own body, what holds it, and nothing else. Where no weight asks for
// more, the incoming bits stay. A hand on one that keeps its pose goes there.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>

#include "tests/body_crowd.h"
#include "tests/linked_bodies.h"
#include "tests/looking_bodies.h"
#include "tests/test_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// A skeleton whose limbs all hang below joint 0.
BodySkeleton skeleton_of(Random& random) { return random_body_skeleton(random, {2, 3, 1, true}); }

struct PosedStage {
    BodySkeleton skeleton;
    std::vector<Body> bodies;
    BodyGoals goals;
    Crowd crowd;
    PoseLayout layout;

    PosedStage(std::uint64_t seed, swivel_features features)
        : skeleton([&] {
              Random random{seed};
              return skeleton_of(random);
          }()),
          crowd(body_crowd(skeleton, features, 20))
    {
        Random random{seed + 1};
        layout.translates = layout.scales = layout.roots = true;
        for (int n = 0; n < 20; ++n) bodies.push_back(random_body(random, skeleton, {true, true, true}));
        for (std::size_t limb = 0; limb < skeleton.limbs.size(); ++limb) {
            goals.emplace_back();
            for (const Body& body : bodies) goals.back().push_back(random_goal(random, skeleton, body, limb));
        }
        write_goals(crowd, goals);
    }
};

}  // namespace

TEST_CASE("bad input of a joint is that of the limbs below it, which keep their pose")
{
    const struct {
        const char* name;
        bool is_whole_body;
        void (*spoil)(Body& body, const BodyLimbJoints& limb);
    } rows[] = {
        {"a shoulder's rotation", false, [](auto& body, auto& limb) { body.rotations[limb.shoulder][2] = kNan; }},
        {"an elbow's rotation", false,
         [](auto& body, auto& limb) {
             body.rotations[limb.elbow] = {0, 0, 0, 0};
         }},
        {"a wrist's rotation", false, [](auto& body, auto& limb) { body.rotations[limb.wrist][0] = kNan; }},
        {"a wrist's translation", false, [](auto& body, auto& limb) { body.translations[limb.wrist][0] = kNan; }},
        {"an elbow's translation", false, [](auto& body, auto& limb) { body.translations[limb.elbow][1] = kInf; }},
        {"an uneven scale", false,
         [](auto& body, auto& limb) {
             body.scales[limb.elbow] = {1, 1, 1.01f};
         }},
        {"a negative scale", false,
         [](auto& body, auto& limb) {
             body.scales[limb.shoulder] = {-1, -1, -1};
         }},
        {"a rotation above all limbs", true,
         [](auto& body, auto&) {
             body.rotations[0] = {kInf, 0, 0, 1};
         }},
        {"the root's place", true, [](auto& body, auto&) { body.root_position[1] = kNan; }},
        {"the root's scale", true, [](auto& body, auto&) { body.root_scale = 0; }},
    };
    constexpr std::size_t bad_body = 17;
    for (const auto& [name, is_whole_body, spoil] : rows) {
        PosedStage stage(1, SWIVEL_WITH_HAND), bad(1, SWIVEL_WITH_HAND);
        PoseBuffer good(stage.layout, stage.bodies);
        solve_poses(stage.crowd, good.view());
        spoil(bad.bodies[bad_body], stage.skeleton.limbs[1]);
        PoseBuffer poses(bad.layout, bad.bodies);
        const std::vector<unsigned char> before = poses.bytes;
        solve_poses(bad.crowd, poses.view());
        for (std::uint32_t n = 0; n < 20; ++n)
            for (std::uint32_t g = 0; g < 3; ++g) {
                const bool is_bad = n == bad_body && (is_whole_body || g == 1);
                INFO(name << ", body " << n << ", group " << g);
                REQUIRE((flags_of(bad.crowd, g, n) == SWIVEL_BAD_INPUT) == is_bad);
                const BodyLimbJoints& joints = stage.skeleton.limbs[g];
                for (const std::uint32_t joint : {joints.shoulder, joints.elbow, joints.wrist}) {
                    const std::size_t at = n * poses.body_stride + joint * 16;
                    REQUIRE(std::memcmp(&poses.bytes[at], is_bad ? &before[at] : &good.bytes[at], 16) == 0);
                }
            }
    }
}

TEST_CASE("a matrix that is slanted or uneven is bad input")
{
    PosedStage stage(2, 0);
    stage.layout.form = SWIVEL_MATRIX_COLUMNS;
    PoseBuffer poses(stage.layout, stage.bodies);
    const BodyLimbJoints& limb = stage.skeleton.limbs[0];
    const std::uint32_t elbow = limb.elbow, bad = GENERATE(true, false) ? elbow : limb.wrist;
    const bool is_slanted = GENERATE(true, false);
    float* const column = reinterpret_cast<float*>(&poses.bytes[5 * poses.body_stride + bad * 64]);
    for (int n = 0; n < 3; ++n) column[n] = is_slanted ? column[n] + 0.01f * column[4 + n] : 1.01f * column[n];
    const std::vector<unsigned char> before = poses.bytes;
    solve_poses(stage.crowd, poses.view());
    for (std::uint32_t n = 0; n < 20; ++n)
        for (std::uint32_t g = 0; g < 3; ++g)
            REQUIRE((flags_of(stage.crowd, g, n) == SWIVEL_BAD_INPUT) == (n == 5 && g == 0));
    for (const std::uint32_t joint : {stage.skeleton.limbs[0].shoulder, elbow}) {
        const std::size_t at = 5 * poses.body_stride + joint * 64;
        REQUIRE(std::memcmp(&poses.bytes[at], &before[at], 64) == 0);
    }
}

TEST_CASE("without any weight the incoming bits stay, in every form")
{
    const int form = GENERATE(0, 1, 2, 3);
    PosedStage stage(3, SWIVEL_WITH_HAND | SWIVEL_WITH_WEIGHTS | SWIVEL_POLE_INCOMING);
    for (std::uint32_t g = 0; g < 3; ++g) stage.crowd.write_all(SWIVEL_WEIGHTS, g, Float3{0, 0, 0});
    stage.layout.form = static_cast<swivel_pose_form>(form);
    for (Body& body : stage.bodies)
        for (Float4& q : body.rotations)
            for (float& x : q) x *= 3;  // of any length, and of either sign
    PoseBuffer poses(stage.layout, stage.bodies);
    const std::vector<unsigned char> before = poses.bytes;
    solve_poses(stage.crowd, poses.view());
    REQUIRE(poses.bytes == before);
    for (std::uint32_t n = 0; n < 20; ++n) REQUIRE(flags_of(stage.crowd, 0, n) == SWIVEL_REACHED);
}

TEST_CASE("lengths that are written count instead of the pose's")
{
    PosedStage stage(4, 0);
    for (std::uint32_t g = 0; g < 3; ++g) stage.crowd.write_all(SWIVEL_LENGTHS, g, Float2{1e-3f, 1e-3f});
    PoseBuffer poses(stage.layout, stage.bodies);
    solve_poses(stage.crowd, poses.view());
    for (std::uint32_t n = 0; n < 20; ++n) REQUIRE(flags_of(stage.crowd, 0, n) == SWIVEL_CLAMPED_FAR);
}

TEST_CASE("limbs rest where they are told to, and a body that kept its pose keeps it")
{
    PosedStage stage(5, SWIVEL_WITH_HAND);
    const swivel_limb_joints joints = stage.skeleton.joints(0);
    swivel_group_def group = swivel_default_body_group_def(&joints);
    group.on_bad_input = SWIVEL_REST_POSE;
    const swivel_skeleton view = stage.skeleton.view();
    swivel_crowd_def def = swivel_default_crowd_def();
    def.skeleton = &view, def.body_count = 20, def.groups = &group, def.group_count = 1;
    Crowd crowd(def);  // no target is written
    const int form = GENERATE(0, 1, 2, 3);
    stage.layout.form = static_cast<swivel_pose_form>(form);
    PoseBuffer poses(stage.layout, stage.bodies);
    solve_poses(crowd, poses.view());
    for (std::size_t n = 0; n < 20; ++n) {
        const Body body = poses.read(n, stage.bodies[n]);
        for (const std::uint32_t joint : {joints.shoulder, joints.elbow})
            REQUIRE(distance(quat(body.rotations[joint]), quat(stage.skeleton.rotations[joint]).normalized()) < 1e-6);
    }
}

TEST_CASE("a pose of an older header is read as far as it goes")
{
    PosedStage stage(9, SWIVEL_WITH_HAND);
    PoseBuffer whole(stage.layout, stage.bodies), older(stage.layout, stage.bodies);
    solve_poses(stage.crowd, whole.view());
    swivel_pose pose = older.view();
    pose.size = offsetof(swivel_pose, space);
    pose.reserved = 1;  // beyond its end
    solve_poses(stage.crowd, pose);
    REQUIRE(whole.bytes == older.bytes);
}

// ---- hands and props

namespace {

constexpr std::size_t kBadBody = 20;  // whose share is 2/3, or what a case makes it; without a written place

struct BadBodies {
    HoldingBodies good_bodies, bodies;

    explicit BadBodies(std::uint64_t seed, swivel_on_bad_input on_bad_input = SWIVEL_KEEP_POSE)
        : good_bodies(made(seed, on_bad_input)), bodies(made(seed, on_bad_input))
    {
    }
    static HoldingBodies made(std::uint64_t seed, swivel_on_bad_input on_bad_input)
    {
        Random random{seed};
        PoseLayout layout;
        layout.translates = layout.scales = layout.roots = true;
        HoldingBodies made(random, 40, layout, on_bad_input);
        made.find(HoldingBodies::left, SWIVEL_TARGET)->at(kBadBody)[0] = kNan;
        for (int c = 0; c < 3; ++c) made.find(HoldingBodies::prop, SWIVEL_PROP_PLACE)->at(kBadBody)[c] = kNan;
        made.find(HoldingBodies::prop, SWIVEL_PROP_SHARE)->at(kBadBody)[0] = 0;
        return made;
    }
    float* input(std::uint32_t group, swivel_field field) { return bodies.find(group, field)->at(kBadBody); }
    Float4& rotation(std::uint32_t joint) { return bodies.bodies[kBadBody].rotations[joint]; }
    const BodyLimbJoints& limb(std::uint32_t group) const { return bodies.skeleton.limbs[bodies.limb_of[group]]; }

    // Groups that are bad in that body; in others no bit changes.
    void check_bad(const std::vector<std::uint32_t>& groups) const
    {
        const SolvedLinks good(good_bodies), solved(bodies);
        for (std::size_t n = 0; n < 40; ++n)
            if (n != kBadBody)
                REQUIRE((bits_of_body(bodies, solved.crowd, solved.poses, n) ==
                         bits_of_body(good_bodies, good.crowd, good.poses, n)));
        const PoseBuffer before(bodies.layout, bodies.bodies);
        for (std::uint32_t g = 0; g < bodies.groups.size(); ++g) {
            const bool is_bad = std::ranges::find(groups, g) != groups.end();
            INFO("group " << g << ", flags " << solved.flags(g, kBadBody));
            CHECK((solved.flags(g, kBadBody) == SWIVEL_BAD_INPUT) == is_bad);
            CHECK(!(good.flags(g, kBadBody) & SWIVEL_BAD_INPUT));
            if (!is_bad || bodies.limb_of[g] == kNoLimbHere || bodies.groups[g].on_bad_input != SWIVEL_KEEP_POSE)
                continue;
            for (const std::uint32_t joint : {limb(g).shoulder, limb(g).elbow, limb(g).wrist}) {
                const std::size_t at = kBadBody * before.body_stride + joint * 16;
                CHECK(std::memcmp(&solved.poses.bytes[at], &before.bytes[at], 16) == 0);
            }
        }
    }
};

}  // namespace

TEST_CASE("bad input of hands and props is that of what depends on them, and of no other body")
{
    using H = HoldingBodies;
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
        {"nothing", H::prop, SWIVEL_PROP_SHARE, 0, 1, {0, 1}, none},
        {"a grip of the hand that says where the prop is", H::left, SWIVEL_GRIP, 1, 1, {kNan, kInf, 1e16f}, all},
        {"a grip of the other hand", H::right, SWIVEL_GRIP, 1, 1, {kNan}, right},
        {"a grip of either hand, between which the prop is", H::right, SWIVEL_GRIP, 4, 1, {kInf}, all, 0.5f},
        {"a grip of no rotation", H::follower, SWIVEL_GRIP, 3, 4, {0}, follower},
        {"a share", H::prop, SWIVEL_PROP_SHARE, 0, 1, {-0.1f, 1.1f, kNan}, all},
        {"a weight", H::prop, SWIVEL_PROP_WEIGHT, 0, 1, {-0.1f, 1.1f, kNan}, all},
        {"a place of a prop", H::prop, SWIVEL_PROP_PLACE, 0, 3, {2e15f, kInf}, all},
        {"a rotation of a prop", H::prop, SWIVEL_PROP_TURN, 0, 4, {0, kInf}, all},
        {"a target of a hand on a prop", H::left, SWIVEL_TARGET, 0, 3, {2e15f}, all},
        {"a target", H::free, SWIVEL_TARGET, 0, 1, {kNan}, {H::free}},
    };
    for (const auto& [name, group, field, first, count, values, groups, share] : rows)
        for (const float bad : values) {
            INFO(name << ", " << bad);
            BadBodies stage(1);
            if (!stage.bodies.find(group, field))
                for (HoldingBodies* const each : {&stage.bodies, &stage.good_bodies})
                    each->give(group, field, [](std::size_t) { return Float1{1}; });
            if (share > 0) stage.input(H::prop, SWIVEL_PROP_SHARE)[0] = share;
            std::fill_n(stage.input(group, field) + first, count, bad);
            stage.check_bad(groups);
        }
}

TEST_CASE("bad input of joints is that of the hands and props that hang on them")
{
    using H = HoldingBodies;
    BadBodies elbow(1), wrist(1), far(1), of_prop(1);
    elbow.rotation(elbow.limb(H::right).elbow)[1] = kNan;
    elbow.check_bad({H::right});
    wrist.rotation(wrist.limb(H::free).wrist)[0] = kNan;  // which another one holds
    wrist.check_bad({H::free, H::follower});
    of_prop.rotation(1)[2] = kNan;
    const SolvedLinks solved(of_prop.bodies);
    CHECK(solved.flags(H::handle, kBadBody) == SWIVEL_BAD_INPUT);
    CHECK(solved.flags(H::on_handle, kBadBody) == SWIVEL_BAD_INPUT);
    // A prop that comes from far away to one hand alone.
    for (HoldingBodies* const each : {&far.good_bodies, &far.bodies}) {
        each->groups[H::prop].prop.most_move = 1000;
        each->find(H::prop, SWIVEL_PROP_PLACE)->write(kBadBody, Float3{30, 0, 0});
    }
    far.input(H::right, SWIVEL_GRIP)[1] = kNan;
    far.check_bad({H::right});
    CHECK(SolvedLinks(far.bodies).flags(H::prop, kBadBody) == SWIVEL_REACHED);
}

TEST_CASE("a hand on a limb that keeps its pose after bad input holds it there")
{
    BadBodies stage(2);
    stage.input(HoldingBodies::free, SWIVEL_TARGET)[0] = kNan;
    stage.check_bad({HoldingBodies::free});
    const SolvedLinks solved(stage.bodies);
    const LinkedBody body(solved, kBadBody);
    const JointAt& wrist = body.was[stage.limb(HoldingBodies::free).wrist];
    const Held told = solved.from_root(SWIVEL_HAND_FRAME, HoldingBodies::free, kBadBody);
    const double off = 2e-7 * vec(body.was_body.root_position).norm() + body.bound(HoldingBodies::free);
    const Vector3d up = quat(body.was_body.root_rotation).normalized() * Vector3d::UnitY(),
                   shifted = double{solved.result<Float3>(SWIVEL_SHIFT, HoldingBodies::fit, kBadBody)[0]} * up;
    CHECK((told.place - shifted - wrist.place).norm() <= off);
    CHECK(told.rotation.angularDistance(wrist.rotation) <= 2e-6);
    if (solved.flags(HoldingBodies::follower, kBadBody) & SWIVEL_REACHED) {
        const Held wanted = body.wanted(HoldingBodies::follower, {wrist.rotation, wrist.place});
        CHECK((body.hand(HoldingBodies::follower).place - wanted.place).norm() <=
              body.bound(HoldingBodies::follower) + off);
    }
}

TEST_CASE("a hand on a limb with bad input and its rest pose has bad input")
{
    BadBodies stage(3, SWIVEL_REST_POSE);
    stage.input(HoldingBodies::free, SWIVEL_TARGET)[0] = kNan;
    stage.check_bad({HoldingBodies::free, HoldingBodies::follower});
    const SolvedLinks solved(stage.bodies);
    for (const float x : solved.result<Float7>(SWIVEL_HAND_FRAME, HoldingBodies::free, kBadBody)) CHECK(std::isnan(x));
    const Body is = solved.poses.read(kBadBody, stage.bodies.bodies[kBadBody]);
    const swivel_binding bound =
        bind(stage.bodies.skeleton.view(), stage.bodies.joints[stage.bodies.limb_of[HoldingBodies::follower]]);
    CHECK(quat(is.rotations[stage.limb(HoldingBodies::follower).shoulder]).angularDistance(quat(bound.shoulder_rest)) <=
          1e-6);
}

TEST_CASE("bad input of a look keeps its joints, and is that of no other body")
{
    for (const bool keeps : {false, true})
        for (const char* const what : {"target", "weight", "pose"}) {
            INFO(what << ", " << keeps);
            const std::string spoilt = what;
            Upright of;
            of.look.look.rate = 2;
            of.look.on_bad_input = keeps ? SWIVEL_KEEP_POSE : SWIVEL_REST_POSE;
            UprightCrowd good(of, 20), bodies(of, 20);
            std::vector<Float3> targets(20, Float3{1, 1.6f, 2});
            for (UprightCrowd* each : {&good, &bodies}) each->solve(targets, 0.1f), each->reset();
            const Vector3d sight = bodies.line(7);
            std::array<float, 25> line{}, kept{};
            check(swivel_read(bodies.crowd.get(), SWIVEL_LOOK_TURNS, 0, 7, 1, {&line, sizeof line}));
            good.solve(targets, 0.1f);
            if (spoilt == "target") targets[7] = {0, 1e16f, 0};
            if (spoilt == "weight") bodies.crowd.write(SWIVEL_LOOK_WEIGHT, 0, std::vector<float>{1.5f}, 7);
            if (spoilt == "pose") bodies.rotations[7][1][0] = kNan;
            bodies.solve(targets, 0.1f);
            CHECK((bodies.rotations[7][3] == Float4{0, 0, 0, 1}));
            CHECK(bodies.flags(7) == SWIVEL_BAD_INPUT);
            CHECK((bodies.line(7) == sight));
            check(swivel_read(bodies.crowd.get(), SWIVEL_LOOK_TURNS, 0, 7, 1, {&kept, sizeof kept}));
            CHECK((kept == (keeps ? line : std::array<float, 25>{})));
            for (std::size_t n = 0; n < 20; ++n)
                if (n != 7) CHECK((bodies.rotations[n] == good.rotations[n]));
        }
}

// SPDX-License-Identifier: MIT
//
// The promise: bad input of a hand that holds costs no other body a bit, and its own body only what depends on it. A
// hand on one that keeps its pose goes there. What cannot be linked, and what cannot be solved alone, gets one line.
#include <catch2/catch.hpp>

#include "tests/holding_bodies.h"
#include "tests/test_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;

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
    void check_bad(std::initializer_list<std::uint32_t> groups) const
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

TEST_CASE("bad input of hands and props is that of what depends on them")
{
    BadBodies stage(1);
    SECTION("none") { stage.check_bad({}); }
    SECTION("a grip of the hand that says where the prop is")
    {
        for (const float bad : {kNan, kInf, 1e16f}) {
            stage.input(HoldingBodies::left, SWIVEL_GRIP)[1] = bad;
            stage.check_bad({HoldingBodies::prop, HoldingBodies::left, HoldingBodies::right});
        }
    }
    SECTION("a grip of the other hand")
    {
        stage.input(HoldingBodies::right, SWIVEL_GRIP)[1] = kNan;
        stage.check_bad({HoldingBodies::right});
    }
    SECTION("a grip of the other hand, where the prop comes from far away")
    {
        for (LinkedBodies* const of :
             {static_cast<LinkedBodies*>(&stage.good_bodies), static_cast<LinkedBodies*>(&stage.bodies)}) {
            of->groups[HoldingBodies::prop].prop.most_move = 1000;
            of->find(HoldingBodies::prop, SWIVEL_PROP_PLACE)->write(kBadBody, Float3{30, 0, 0});
        }
        stage.input(HoldingBodies::right, SWIVEL_GRIP)[1] = kNan;
        stage.check_bad({HoldingBodies::right});
        CHECK(SolvedLinks(stage.bodies).flags(HoldingBodies::prop, kBadBody) == SWIVEL_REACHED);
    }
    SECTION("a grip of no rotation")
    {
        std::fill_n(stage.input(HoldingBodies::follower, SWIVEL_GRIP) + 3, 4, 0.0f);
        stage.check_bad({HoldingBodies::follower});
    }
    SECTION("a share")
    {
        for (const float bad : {-0.1f, 1.1f, kNan}) {
            stage.input(HoldingBodies::prop, SWIVEL_PROP_SHARE)[0] = bad;
            stage.check_bad({HoldingBodies::prop, HoldingBodies::left, HoldingBodies::right});
        }
    }
    SECTION("between hands, a grip of either")
    {
        stage.input(HoldingBodies::prop, SWIVEL_PROP_SHARE)[0] = 0.5f;
        stage.input(HoldingBodies::right, SWIVEL_GRIP)[4] = kInf;
        stage.check_bad({HoldingBodies::prop, HoldingBodies::left, HoldingBodies::right});
    }
    SECTION("a place, and a rotation, of a prop")
    {
        const Float3 far = {2e15f, 0, 0};
        std::ranges::copy(far, stage.input(HoldingBodies::prop, SWIVEL_PROP_PLACE));
        stage.check_bad({HoldingBodies::prop, HoldingBodies::left, HoldingBodies::right});
        std::ranges::copy(kNoPlace, stage.input(HoldingBodies::prop, SWIVEL_PROP_PLACE));
        std::fill_n(stage.input(HoldingBodies::prop, SWIVEL_PROP_TURN), 4, 0.0f);
        stage.check_bad({HoldingBodies::prop, HoldingBodies::left, HoldingBodies::right});
    }
    SECTION("a target and a hand that are written for a hand on a prop")
    {
        const Float3 far = {2e15f, 0, 0};
        std::ranges::copy(far, stage.input(HoldingBodies::left, SWIVEL_TARGET));
        stage.check_bad({HoldingBodies::prop, HoldingBodies::left, HoldingBodies::right});
    }
    SECTION("a joint of a hand on a prop")
    {
        stage.rotation(stage.limb(HoldingBodies::right).elbow)[1] = kNan;
        stage.check_bad({HoldingBodies::right});
    }
    SECTION("a joint of a prop")
    {
        stage.rotation(1)[2] = kNan;
        const SolvedLinks solved(stage.bodies);
        CHECK(solved.flags(HoldingBodies::handle, kBadBody) == SWIVEL_BAD_INPUT);
        CHECK(solved.flags(HoldingBodies::on_handle, kBadBody) == SWIVEL_BAD_INPUT);
    }
    SECTION("a hand, as posed, that another one holds")
    {
        stage.rotation(stage.limb(HoldingBodies::free).wrist)[0] = kNan;
        stage.check_bad({HoldingBodies::free, HoldingBodies::follower});
    }
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

TEST_CASE("links and props that cannot be get one line")
{
    Random random{4};
    PoseLayout layout;
    HoldingBodies bodies(random, 3, layout);
    const swivel_skeleton skeleton = bodies.skeleton.view();
    swivel_crowd_def def = swivel_default_crowd_def();
    def.skeleton = &skeleton;
    def.body_count = 3;
    const auto refused = [&](const char* part) {
        def.groups = bodies.groups.data(), def.group_count = static_cast<std::uint32_t>(bodies.groups.size());
        swivel_crowd* crowd = nullptr;
        CHECK_REFUSED(swivel_crowd_create(&def, &crowd), SWIVEL_INVALID_ARGUMENT);
        CHECK(crowd == nullptr);
        CHECK(swivel_crowd_bytes(&def) == 0);
        INFO(swivel_last_error());
        CHECK(std::string(swivel_last_error()).find(part) != std::string::npos);
    };
    std::vector<swivel_group_def>& groups = bodies.groups;
    CHECK_NOTHROW(bodies.crowd());
    SECTION("a limb that holds itself")
    {
        groups[HoldingBodies::follower].link = HoldingBodies::follower;
        refused("group 5 is linked to group 5, which is solved later");
    }
    SECTION("limbs that hold each other")
    {
        groups[HoldingBodies::free].features |= SWIVEL_WITH_LINK;
        groups[HoldingBodies::free].link = HoldingBodies::follower;
        refused("group 4 is linked to group 5, which is solved later");
    }
    SECTION("a group that does not exist")
    {
        groups[HoldingBodies::follower].link = 10;
        refused("group 10, which does not exist; there are 10");
    }
    SECTION("a shift")
    {
        groups[HoldingBodies::follower].link = HoldingBodies::fit;
        refused("SWIVEL_FIT and has no hand");
    }
    SECTION("a limb without a hand")
    {
        groups[HoldingBodies::free].features &= ~SWIVEL_WITH_HAND;
        refused("group 5 is linked to group 4, which has no hand; add SWIVEL_WITH_HAND");
    }
    SECTION("three hands on a prop")
    {
        groups[HoldingBodies::on_handle].link = HoldingBodies::prop;
        refused("group 0 is SWIVEL_PROP, and 3 limbs are linked to it");
    }
    SECTION("no hand on a prop")
    {
        groups[HoldingBodies::on_handle].link = HoldingBodies::free;
        refused("group 8 is SWIVEL_PROP, and 0 limbs are linked to it");
    }
    SECTION("a joint that a limb turns, or that hangs below one")
    {
        for (const std::uint32_t joint : {bodies.skeleton.limbs[3].shoulder, bodies.skeleton.limbs[0].wrist}) {
            groups[HoldingBodies::handle].prop.joint = static_cast<std::int32_t>(joint);
            refused("moves; link the limbs to that group instead");
        }
    }
    SECTION("a joint that does not exist")
    {
        for (const std::int32_t joint : {-2, static_cast<std::int32_t>(bodies.skeleton.size()), 1 << 30}) {
            groups[HoldingBodies::handle].prop.joint = joint;
            refused("prop.joint is ");
        }
    }
    SECTION("a move")
    {
        for (const float bad : {-1.0f, kNan, kInf, 1001.0f}) {
            groups[HoldingBodies::prop].prop.most_move = bad;
            refused("group 0, prop.most_move is ");
        }
    }
    SECTION("features that do not go together")
    {
        for (const swivel_features bad : {SWIVEL_WITH_AIM, SWIVEL_WITH_PLANT, SWIVEL_WITH_FIT}) {
            bodies.groups[HoldingBodies::follower].features = SWIVEL_WITH_LINK | SWIVEL_WITH_HAND | bad;
            refused("group 5");
        }
        groups[HoldingBodies::follower].features = SWIVEL_WITH_LINK;
        refused("WITH_LINK");
    }
    SECTION("a prop with a limb's feature, and one with joints")
    {
        groups[HoldingBodies::prop].features |= SWIVEL_WITH_HAND;
        refused("group 0");
        groups[HoldingBodies::prop].features = SWIVEL_PROP;
        groups[HoldingBodies::prop].joints = &bodies.joints[0];
        refused("group 0 is SWIVEL_PROP, which is no limb, but names joints");
    }
    SECTION("free limbs")
    {
        for (const swivel_features bad : {SWIVEL_WITH_LINK | SWIVEL_WITH_HAND, SWIVEL_PROP, SWIVEL_WITH_HAND_FRAME}) {
            const swivel_group_def free = group(1, {}, bad);
            const swivel_crowd_def of = def_of(free);
            swivel_crowd* crowd = nullptr;
            CHECK_REFUSED(swivel_crowd_create(&of, &crowd), SWIVEL_INVALID_ARGUMENT);
        }
    }
}

TEST_CASE("a job that names a hand names what it holds, and a prop all hands on it")
{
    Random random{5};
    PoseLayout layout;
    const HoldingBodies bodies(random, 3, layout);
    Crowd crowd = bodies.crowd();
    PoseBuffer poses(layout, bodies.bodies);
    const swivel_pose pose = bodies.view(poses);
    const std::vector<unsigned char> before = poses.bytes;
    const auto solve = [&](std::initializer_list<std::uint32_t> groups) {
        std::uint32_t named = 0;
        for (const std::uint32_t g : groups) named |= 1u << g;
        swivel_job job = swivel_default_job();
        job.pose = &pose;
        job.groups = &named;
        job.group_word_count = 1;
        return swivel_solve(crowd.get(), &job);
    };
    CHECK_REFUSED(solve({HoldingBodies::follower}), SWIVEL_INVALID_ARGUMENT);
    CHECK(std::string(swivel_last_error()) == "the job names group 5, but not group 4; they are linked, name both");
    CHECK_REFUSED(solve({HoldingBodies::left, HoldingBodies::right}), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(solve({HoldingBodies::prop}), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(solve({HoldingBodies::prop, HoldingBodies::left}), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(solve({HoldingBodies::third}), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(solve({HoldingBodies::handle}), SWIVEL_INVALID_ARGUMENT);
    CHECK(poses.bytes == before);
    CHECK(solve({HoldingBodies::free}) == SWIVEL_OK);
    CHECK(solve({HoldingBodies::free, HoldingBodies::follower}) == SWIVEL_OK);
    CHECK(solve({HoldingBodies::prop, HoldingBodies::left, HoldingBodies::right}) == SWIVEL_OK);
    CHECK(solve({HoldingBodies::prop, HoldingBodies::left, HoldingBodies::right, HoldingBodies::third}) == SWIVEL_OK);
    CHECK(solve({HoldingBodies::handle, HoldingBodies::on_handle}) == SWIVEL_OK);
    CHECK(poses.bytes != before);
}

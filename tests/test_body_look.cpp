// SPDX-License-Identifier: MIT
//
// The promise: a chain of joints turns so that its line of sight meets the target, where the last cone allows it. Each
// joint turns by its share, and no further than its cone. Limbs below are solved from where they are then. All is
// checked by forward kinematics of Eigen's, with angles.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include <cstring>
#include <numbers>

#include "tests/looking_bodies.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// `tools/test --full bodies` makes a million: RC_PARAMS=max_success=6000.
constexpr std::size_t kLookingBodies = 200;

PoseLayout random_look_layout(Random& random, const BodySkeleton* in_body = nullptr)
{
    PoseLayout layout;
    layout.form = static_cast<swivel_pose_form>(random.below(SWIVEL_MATRIX_COLUMNS3 + 1));
    layout.translates = layout.scales = layout.form != SWIVEL_ROTATIONS || random.below(2);
    layout.roots = random.below(2);
    layout.in_body = in_body;
    return layout;
}

struct LookCounts {
    int bodies = 0, sees = 0, held = 0, faded = 0, kept = 0, reached = 0;
};

struct LookStage {
    const LookingBodies& of;
    SolvedLinks solved;

    explicit LookStage(const LookingBodies& bodies) : of(bodies), solved(bodies) {}

    double off(const LinkedBody& body, std::uint32_t joint) const
    {
        return 3e-7 * way_to(of.skeleton, body.was, joint) + 1e-7 * vec(of.bodies[body.n].root_position).norm();
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
            RC_ASSERT(flags & SWIVEL_REACHED);
        }
        if (is_whole) check_shares(chain, target, rounding);
        counts.sees += (flags & SWIVEL_REACHED) != 0, counts.held += (flags & SWIVEL_LIMITED_LOOK) != 0;
        counts.faded += !is_whole;
        ++counts.bodies;
    }
    // Joints before the last turn by their share of the angle that is left, about the axis of the shortest turn.
    static void check_shares(const TurnedChain& chain, const Vector3d& target, double rounding)
    {
        double left = 0;
        for (std::uint32_t n = 0; n <= chain.last(); ++n) left += double{chain.look.share[n]};
        for (std::uint32_t n = 0; n < chain.last(); ++n) {
            const double share = chain.look.share[n] / left;
            left -= double{chain.look.share[n]};
            const Vector3d axis = chain.axis_after(n), to = target - chain.eye_after(n);
            const double angle = angle_between(axis, to), most = std::acos(double{chain.look.cos_most[n]});
            const Quaterniond turn = chain.own_turn(n);
            RC_ASSERT(std::fabs(angle_of(turn) - std::min(share * angle, most)) <= 1.1e-3 + rounding);
            if (angle > 0.05 && angle < 3.1 && angle_of(turn) > 0.01)
                RC_ASSERT(angle_between(turn.w() < 0 ? Vector3d(-turn.vec()) : Vector3d(turn.vec()), axis.cross(to)) <=
                          (1e-5 + 4 * rounding) / (std::sin(angle) * angle_of(turn)));
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
        const LookingBodies bodies(random, kLookingBodies, random_look_layout(random));
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

namespace {

// A spine of two bones, a neck and a head, upright, whose eyes look along z.
struct Upright {
    BodySkeleton skeleton;
    swivel_group_def look = swivel_default_group_def(0);

    Upright()
    {
        const Float3 offsets[] = {{0, 1, 0}, {0, 0.15f, 0}, {0, 0.3f, 0.02f}, {0, 0.12f, 0.01f}};
        for (int n = 0; n < 4; ++n) {
            skeleton.parents.push_back(n - 1);
            skeleton.rotations.push_back({0, 0, 0, 1});
            skeleton.translations.push_back(offsets[n]);
            look.look.joints[n] = static_cast<std::uint32_t>(n);
        }
        look.features = SWIVEL_LOOK;
        look.look.joint_count = 4;
        const float most[] = {0.97f, 0.94f, 0.8f, 0.5f}, share[] = {1, 1, 2, 4};  // 14, 20, 37 and 60 degrees
        std::copy_n(most, 4, look.look.cos_most), std::copy_n(share, 4, look.look.share);
        look.look.eye[1] = 0.08f, look.look.eye[2] = 0.1f;
        look.look.rate = 0;
    }
    Vector3d eye() const { return {0, 1.65, 0.13}; }
};
// The bodies of a crowd of these: where they look, and their joints.
struct UprightCrowd {
    Crowd crowd;
    std::vector<std::array<Float4, 4>> rotations;

    UprightCrowd(const Upright& of, std::size_t count)
        : crowd(of.skeleton.view(), static_cast<std::uint32_t>(count), std::span(&of.look, 1)), rotations(count)
    {
        reset();
    }
    void reset()
    {
        std::ranges::fill(rotations, std::array<Float4, 4>{{{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}}});
    }
    void solve(const std::vector<Float3>& targets, float time = 0)
    {
        swivel_pose pose = swivel_default_pose();
        pose.rotations = {rotations.data(), sizeof rotations[0], sizeof(Float4), nullptr};
        pose.time = {&time, 0};
        crowd.write(SWIVEL_LOOK_TARGET, 0, std::span(targets));
        crowd.solve({.pose = &pose});
    }
    Vector3d line(std::size_t n)
    {
        Float6 sight;
        check(swivel_read(crowd.get(), SWIVEL_SIGHT, 0, static_cast<std::uint32_t>(n), 1, {&sight, sizeof sight}));
        return {sight[3], sight[4], sight[5]};
    }
    std::uint32_t flags(std::uint32_t n)
    {
        std::uint32_t flags;
        check(swivel_read(crowd.get(), SWIVEL_FLAGS, 0, n, 1, {&flags, sizeof flags}));
        return flags;
    }
};

}  // namespace

TEST_CASE("no joint turns by more than four degrees while the target circles the head by one")
{
    constexpr int kSteps = 1440;
    const Upright of;
    UprightCrowd bodies(of, kSteps);
    double most = 0;
    for (const double distance : {0.4, 0.7, 1.5, 5.0})
        for (const double height : {-0.6, -0.2, 0.0, 0.3})
            for (const bool is_upright : {false, true}) {  // the circle
                std::vector<Float3> targets;
                for (int n = 0; n < kSteps; ++n) {
                    const double angle = 2 * std::numbers::pi * n / kSteps;
                    const Vector3d around = is_upright ? Vector3d(height, std::sin(angle), std::cos(angle))
                                                       : Vector3d(std::sin(angle), height, std::cos(angle));
                    targets.push_back(floats(Vector3d(of.eye() + distance * around)));
                }
                bodies.reset();
                bodies.solve(targets);
                for (int n = 0; n < kSteps; ++n)
                    for (int joint = 0; joint < 4; ++joint)
                        most = std::max(most, quat(bodies.rotations[n][joint])
                                                  .angularDistance(quat(bodies.rotations[(n + 1) % kSteps][joint])));
            }
    INFO("degrees a degree: " << most * kSteps / (2 * std::numbers::pi));
    CHECK(most * kSteps / (2 * std::numbers::pi) <= 4);
}

TEST_CASE("a target straight behind, no weight and no target keep the incoming bits")
{
    const Upright of;
    UprightCrowd bodies(of, 48), before(of, 48);
    Random random{1};
    std::vector<Float3> targets;
    std::vector<float> weights;
    for (std::size_t n = 0; n < 48; ++n) {
        for (Float4& q : bodies.rotations[n])
            q = floats(Quaterniond(Eigen::AngleAxisd(n % 3 == 2 ? 0 : 0.3 * random.unit(), random.direction())));
        targets.push_back(n % 3 == 0
                              ? kNoPlace
                              : floats(Vector3d(of.eye() + random.spread(0.1, 9) * (n % 3 == 1 ? random.direction()
                                                                                               : Vector3d(0, 0, -1)))));
        weights.push_back(n % 3 == 1 ? 0.0f : 1.0f);
    }
    before.rotations = bodies.rotations;
    bodies.crowd.write(SWIVEL_LOOK_WEIGHT, 0, std::span(weights));
    bodies.solve(targets);
    CHECK(std::memcmp(bodies.rotations.data(), before.rotations.data(), 48 * sizeof before.rotations[0]) == 0);
    for (std::size_t n = 0; n < 48; ++n) CHECK(std::fabs(bodies.line(n).norm() - 1) <= 1e-6);
    for (std::uint32_t n = 0; n < 48; ++n)
        CHECK((bodies.flags(n) & ~(n % 3 == 1 ? SWIVEL_FADED : 0)) == (n % 3 == 2 ? SWIVEL_FADED : 0));
}

TEST_CASE("a line of sight turns at the look's rate, at any frame rate, and comes to rest on its target")
{
    Upright of;
    of.look.look.rate = 3;
    std::fill_n(of.look.look.cos_most, 4, -1.0f);
    Random random{2};
    std::vector<Float3> from, to;
    for (int n = 0; n < 64; ++n) {
        const auto ahead = [&] {
            return floats(
                Vector3d(of.eye() + random.spread(0.5, 5) * (random.direction() + Vector3d(0, 0, 1.2)).normalized()));
        };
        from.push_back(ahead()), to.push_back(n % 8 ? ahead() : kNoPlace);
    }
    for (const float frames : {15.0f, 60.0f, 600.0f, 2400.0f}) {
        UprightCrowd bodies(of, 64);
        bodies.solve(from, 1 / frames);
        for (std::uint32_t n = 0; n < 64; ++n) CHECK((bodies.flags(n) & SWIVEL_REACHED));
        std::vector<Vector3d> was;
        for (std::size_t n = 0; n < 64; ++n) was.push_back(bodies.line(n));
        const std::vector<Vector3d> first = was;
        double most = 0;
        int waits = 0;
        for (int frame = 0; frame < 2 * static_cast<int>(frames); ++frame) {
            bodies.reset();
            bodies.solve(to, 1 / frames);
            for (std::size_t n = 0; n < 64; ++n) {
                const Vector3d is = bodies.line(n);
                most = std::max(most, angle_between(was[n], is));
                was[n] = is;
                waits += (bodies.flags(static_cast<std::uint32_t>(n)) & SWIVEL_LIMITED_STEP) != 0;
            }
        }
        INFO(frames << " frames a second, " << most * frames << " rad/s");
        CHECK(most <= 2 * 3.0 / frames + 1e-5);  // of the line that is followed, and of its distance
        CHECK(most >= 0.9 * 3.0 / frames);
        CHECK(waits > 64);
        for (std::uint32_t n = 0; n < 64; ++n) {
            CHECK(bodies.flags(n) == (n % 8 ? SWIVEL_REACHED : 0));
            if (n % 8 == 0) CHECK((bodies.rotations[n][3] == Float4{0, 0, 0, 1}));
        }
    }
}

TEST_CASE("where time stands still a line of sight stays, and a reset lets it begin anew")
{
    Upright of;
    of.look.look.rate = 1;
    UprightCrowd bodies(of, 1);
    bodies.solve({{0, 1.6f, 3}}, 0.1f);
    const Vector3d was = bodies.line(0);
    bodies.reset();
    bodies.solve({{2, 1.6f, 3}}, 0);
    CHECK(angle_between(was, bodies.line(0)) <= 1e-6);
    CHECK((bodies.flags(0) & SWIVEL_LIMITED_STEP));
    bodies.crowd.reset(0);
    bodies.reset();
    bodies.solve({{2, 1.6f, 3}}, 0);
    CHECK((bodies.flags(0) & SWIVEL_REACHED));
}

TEST_CASE("a pose in the body's space turns with a look, with the limbs below it and without them")
{
    CHECK(rc::check("all that is not turned keeps its local rotation", [](std::uint64_t seed) {
        Random random{seed};
        LookingBodies bodies(random, 20, random_look_layout(random));
        bodies.layout.translates = bodies.layout.scales = true;
        bodies.layout.in_body = &bodies.skeleton;
        const LookStage stage(bodies);
        LookCounts counts;
        for (std::size_t n = 0; n < 20; ++n) {
            const LinkedBody body(stage.solved, n);
            for (const std::uint32_t group : bodies.looks) stage.check_look(body, group, counts);
            stage.check_limbs(body, counts);
            stage.check_others(body);
        }
        // The looks alone: limbs that are not solved come along as they are.
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
        if (random.below(2)) {
            bodies.layout.translates = bodies.layout.scales = true;
            bodies.layout.in_body = &bodies.skeleton;
        }
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

TEST_CASE("bad input of a look keeps its joints, and is that of no other body")
{
    const bool keeps = GENERATE(false, true);
    Upright of;
    of.look.look.rate = 2;
    of.look.on_bad_input = keeps ? SWIVEL_KEEP_POSE : SWIVEL_REST_POSE;
    UprightCrowd good(of, 20), bodies(of, 20);
    std::vector<Float3> targets(20, Float3{1, 1.6f, 2});
    for (UprightCrowd* each : {&good, &bodies}) each->solve(targets, 0.1f), each->reset();
    const Vector3d sight = bodies.line(7);
    Float4 line{}, kept{};
    check(swivel_read(bodies.crowd.get(), SWIVEL_LOOK_LINE, 0, 7, 1, {&line, sizeof line}));
    good.solve(targets, 0.1f);
    targets[7] = {0, 1e16f, 0};
    SECTION("a target")
    {
        bodies.solve(targets, 0.1f);
        CHECK((bodies.rotations[7][3] == Float4{0, 0, 0, 1}));
    }
    SECTION("a weight")
    {
        targets[7] = {1, 1.6f, 2};
        bodies.crowd.write(SWIVEL_LOOK_WEIGHT, 0, std::vector<float>{1.5f}, 7);
        bodies.solve(targets, 0.1f);
        CHECK((bodies.rotations[7][3] == Float4{0, 0, 0, 1}));
    }
    SECTION("a pose")
    {
        targets[7] = {1, 1.6f, 2};
        bodies.rotations[7][1][0] = kNan;
        bodies.solve(targets, 0.1f);
        CHECK((bodies.rotations[7][3] == Float4{0, 0, 0, 1}));
    }
    CHECK(bodies.flags(7) == SWIVEL_BAD_INPUT);
    CHECK((bodies.line(7) == sight));
    check(swivel_read(bodies.crowd.get(), SWIVEL_LOOK_LINE, 0, 7, 1, {&kept, sizeof kept}));
    CHECK((kept == (keeps ? line : Float4{})));
    for (std::size_t n = 0; n < 20; ++n)
        if (n != 7) CHECK((bodies.rotations[n] == good.rotations[n]));
}

TEST_CASE("a look that cannot be is refused in one line")
{
    Upright of;
    const auto refused = [&](const std::string& words) {
        try {
            Crowd(of.skeleton.view(), 1, std::span(&of.look, 1));
        } catch (const std::exception& e) {
            INFO(e.what());
            CHECK(std::string(e.what()).find(words) != std::string::npos);
            return;
        }
        FAIL("not refused: " << words);
    };
    swivel_look& look = of.look.look;
    const swivel_look good = look;
    const auto with = [&](const auto& change, const std::string& words) {
        look = good;
        change();
        refused(words);
    };
    with([&] { look.joint_count = 0; }, "look.joint_count is 0; it is 1 to 8");
    with([&] { look.joint_count = 9; }, "look.joint_count is 9; it is 1 to 8");
    with([&] { look.joints[2] = 4; }, "look.joints[2] is 4; the skeleton has 4 joints");
    with([&] { look.joints[1] = 0; }, "look.joints[1], joint 0, is not below the one before, joint 0");
    with([&] { look.joints[1] = 3; }, "look.joints[2], joint 2, is not below the one before, joint 3");
    with([&] { look.share[1] = -1; }, "look.share[1] is -1; it is 0 to 1000");
    with([&] { look.share[3] = 0; }, "look.share of the last joint is 0; let it be more");
    with([&] { look.cos_most[1] = kNan; }, "look.cos_most[1] is nan; it is -1 to 1");
    with([&] { look.axis[2] = 0; }, "look.axis is 0, 0, 0; give an axis");
    with([&] { look.eye[2] = 1e16f; }, "look.eye is 0, 0.08, 1e+16; give a place");
    with([&] { look.cos_none = -0.1f; },
         "look.cos_full is -0.1, look.cos_none -0.1; they are -1 to 1, and cos_full is 0.001 more");
    with([&] { look.near = -1; }, "look.near is -1; it is 0 to");
    with([&] { look.rate = -1; }, "look.rate is -1; it is 0 to 1000");
    look = good;
    const swivel_group_def twice[] = {of.look, of.look};
    CHECK_THROWS_WITH(Crowd(of.skeleton.view(), 1, twice),
                      Catch::Contains("group 0 turns joint 0, which is also joint 0 of group 1"));
    swivel_group_def lower = of.look, upper = of.look;
    lower.look.joint_count = 1, lower.look.joints[0] = 3, upper.look.joint_count = 2;
    const swivel_group_def wrong[] = {lower, upper}, right[] = {upper, lower};
    CHECK_THROWS_WITH(
        Crowd(of.skeleton.view(), 1, wrong),
        Catch::Contains(
            "group 1 turns joint 0, which is above joint 3 of group 0; let the look that is above come first"));
    CHECK_NOTHROW(Crowd(of.skeleton.view(), 1, right));
    of.look.look.rate = 1;
    Crowd crowd(of.skeleton.view(), 1, std::span(&of.look, 1));
    swivel_pose pose = swivel_default_pose();
    std::array<Float4, 4> rotations{};
    pose.rotations = {rotations.data(), sizeof rotations, sizeof(Float4), nullptr};
    CHECK_THROWS_WITH(crowd.solve({.pose = &pose}),
                      Catch::Contains("the pose has no time, which plants, shifts and looks with a rate need"));
}

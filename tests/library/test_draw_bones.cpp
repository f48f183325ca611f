// SPDX-License-Identifier: MIT
//
// The promise: swivel_draw() has solved bones where forward kinematics of Eigen's has them, also below far roots, and
// bones as they came before a solve, a clavicle or a shift moved them. Anchors are on their supports.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>

#include "tests/drawn_shapes.h"
#include "tests/looking_bodies.h"
#include "tests/planted_bodies.h"
#include "tests/prop_bodies.h"
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

namespace {

// Where a solve shifted the root.
Vector3d shift_of(const SolvedBodies& solved, std::size_t n)
{
    for (std::uint32_t g = 0; g < solved.of.groups.size(); ++g)
        if (std::holds_alternative<swivel_shift_def>(solved.of.groups[g]))
            return double{solved.result<Float3>(SWIVEL_SHIFT, g, n)[0]} *
                   (quat(solved.of.bodies[n].root_rotation).normalized() * Vector3d::UnitY());
    return Vector3d::Zero();
}

// A figure whose leg shifts it down, and whose clavicle turns. Groups: the shift, the leg and the arm.
Crowd shifted_figure(const Figure& figure)
{
    Crowd crowd = figure.crowd({swivel_default_shift_def(), body_limb(figure.leg, kFigureLimb | SWIVEL_WITH_PELVIS_FIT),
                                body_limb(figure.arm, kFigureLimb | SWIVEL_WITH_CLAVICLE)});
    crowd.write_all(SWIVEL_TARGET, 1, {0.1f, -0.1f, 0.3f});
    crowd.write_all(SWIVEL_TARGET, 2, {0.3f, 2.0f, 0.3f});
    crowd.write_all(SWIVEL_CLAVICLE, 2, std::array{0.5f});
    return crowd;
}
double shift_of(const Crowd& crowd) { return value_of<Float3>(crowd, SWIVEL_SHIFT, 0, 0)[0]; }

// Whether each line ends in a joint of the body, and each limb's elbow and wrist are ends of lines.
void check_bones(const Shapes& bones, const SolvedBody& body, const std::vector<JointAt>& at, const Vector3d& root)
{
    const auto off = [&](std::uint32_t joint) {
        return 1e-5 * (0.1 + way_to(body.bodies.skeleton, at, joint) + root.norm());
    };
    const auto is_at = [&](const swivel_shape& bone, std::uint32_t joint) {
        return (end_of(bone) - root - at[joint].place).norm() <= off(joint);
    };
    for (const swivel_shape& bone : bones) {
        bool is_joint = false;
        for (std::uint32_t joint = 0; joint < at.size(); ++joint) is_joint |= is_at(bone, joint);
        CHECK(is_joint);
    }
    for (std::uint32_t g = 0; g < body.bodies.groups.size(); ++g) {
        if (!body.bodies.is_limb(g)) continue;
        for (const std::uint32_t joint : {body.joints(g).shoulder, body.joints(g).elbow, body.joints(g).wrist})
            CHECK(std::any_of(bones.begin(), bones.end(), [&](const auto& bone) { return is_at(bone, joint); }));
    }
}

void check_bodies(const PosedBodies& bodies)
{
    SolvedBodies solved(bodies);
    const swivel_pose pose = bodies.view(solved.poses);
    // The same with results apart.
    Crowd crowd = bodies.crowd();
    PoseBuffer come = bodies.incoming(), gone = bodies.incoming();
    swivel_pose apart = bodies.view(come);
    const swivel_pose results = bodies.view(gone);
    apart.results = results.rotations;
    if (bodies.is_in_body && apart.translations.data) apart.translation_results = results.translations;
    solve_poses(crowd, apart);
    for (std::uint32_t n = 0; n < bodies.body_count(); ++n) {
        const SolvedBody body(solved, n);
        const Vector3d shifted = body.root() + shift_of(solved, n);
        const Shapes shapes = drawn_body(solved.crowd, n, pose), other = drawn_body(crowd, n, apart);
        check_bones(of_kind(shapes, SWIVEL_SHAPE_BONE), body, body.solved, shifted);
        CHECK(is_same(of_kind(other, SWIVEL_SHAPE_BONE), of_kind(shapes, SWIVEL_SHAPE_BONE)));
        check_bones(of_kind(other, SWIVEL_SHAPE_INCOMING), body, body.came, body.root());
        const KindNames always = kAxes + KindNames{"bone"};
        CHECK(names_of(shapes, SWIVEL_EVERY_GROUP) == always);
        CHECK(names_of(other, SWIVEL_EVERY_GROUP) == always + KindNames{"incoming"});
        for (std::uint32_t g = 0; g < bodies.groups.size(); ++g) {
            const Shapes one = drawn(solved.crowd, g, n, &pose);
            CHECK(names_of(one, g) == names_of(shapes, g));
            CHECK(of_kind(one, SWIVEL_SHAPE_BONE).size() == of_kind(shapes, SWIVEL_SHAPE_BONE).size());
        }
    }
}

// Solves bodies in place, and checks limbs' bones as their records have them, and bends at their elbows. Returns how
// many bones there are.
std::size_t check_recorded(const PosedBodies& bodies)
{
    SolvedBodies solved(bodies);
    const swivel_pose pose = bodies.view(solved.poses);
    std::size_t count = 0;
    for (std::uint32_t n = 0; n < bodies.body_count(); ++n) {
        const SolvedBody body(solved, n);
        const auto off = [&](std::uint32_t group) {
            return 1e-4 * (body.length(group) + way_to(bodies.skeleton, body.came, body.joints(group).wrist));
        };
        const auto is_at = [&](const Vector3d& place, std::uint32_t joint, std::uint32_t group) {
            return (place - body.root() - body.came[joint].place).norm() <= off(group);
        };
        const Shapes shapes = drawn_body(solved.crowd, n, pose);
        for (const swivel_shape& bone : of_kind(shapes, SWIVEL_SHAPE_INCOMING)) {
            const BodyLimbJoints& joints = body.joints(bone.group);
            const bool is_first = is_at(start_of(bone), joints.shoulder, bone.group);
            CHECK(is_at(end_of(bone), is_first ? joints.elbow : joints.wrist, bone.group));
            ++count;
        }
        for (const swivel_shape& bend : of_kind(shapes, SWIVEL_SHAPE_BEND))
            CHECK(is_at(start_of(bend), body.joints(bend.group).elbow, bend.group));
    }
    return count;
}

}  // namespace

TEST_CASE("bones are drawn where they are and where they were")
{
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        CAPTURE(seed);
        Random random{seed};
        PropBodies holding(random, 5);
        check_bodies(holding);
        LookingBodies looking(random, 5, random_layout(random));
        check_bodies(looking);
        looking.put_in_body_space();
        check_bodies(looking);
        PoseLayout layout;
        layout.roots = true;
        check_bodies(HoldingBodies(random, 5, layout));
    }
}

TEST_CASE("a record draws a limb's bones as they came")
{
    Random random{3};
    CHECK(check_recorded(HoldingBodies(random, 20, PoseLayout{})) == 2 * 20 * 7);

    PoseLayout layout;
    layout.roots = true;
    PosedBodies bodies(random, {3, 1, 1, true}, 20, layout);
    const std::uint32_t arm = bodies.add_limb(0, kFigureLimb | SWIVEL_WITH_CLAVICLE);
    bodies.give_random_goals(random);
    bodies.give(arm, SWIVEL_CLAVICLE, [](std::size_t) { return Float1{0.5f}; });
    CHECK(check_recorded(bodies) == 2 * 20);
}

TEST_CASE("bones as they came are before the shift, whatever the pose's weight, and a bend starts at their elbow")
{
    const float weight = GENERATE(1.0f, 0.5f);
    const bool is_apart = GENERATE(false, true);
    Figure figure;
    Crowd crowd = shifted_figure(figure);
    std::vector<Float4> results = figure.rotations;
    swivel_pose pose = figure.pose();
    pose.weight = {&weight, 0};
    if (is_apart) pose.results = {results.data(), sizeof(Float4) * results.size(), sizeof(Float4), nullptr};
    solve_poses(crowd, pose);
    CHECK(shift_of(crowd) < -0.05);
    const Shapes shapes = drawn(crowd, 2, 0, &pose), bones = of_kind(shapes, SWIVEL_SHAPE_INCOMING),
                 bends = of_kind(shapes, SWIVEL_SHAPE_BEND);
    const Vector3d shoulder(0.2, 1.5, 0), elbow(0.5, 1.5, 0), wrist(0.8, 1.5, 0.02);
    const auto has_bone = [&](const Vector3d& start, const Vector3d& end) {
        return std::any_of(bones.begin(), bones.end(), [&](const swivel_shape& bone) {
            return (start_of(bone) - start).norm() <= 1e-6 && (end_of(bone) - end).norm() <= 1e-6;
        });
    };
    CHECK(has_bone(shoulder, elbow));
    CHECK(has_bone(elbow, wrist));
    if (!is_apart) CHECK(bones.size() == 2);
    REQUIRE(bends.size() == 1);
    CHECK((start_of(bends[0]) - elbow).norm() <= 1e-6);
}

TEST_CASE("a body is drawn without its shift where the pose's weight is out of its range")
{
    Figure figure;
    Crowd crowd = shifted_figure(figure);
    swivel_pose pose = figure.pose();
    solve_poses(crowd, pose);
    CHECK(shift_of(crowd) < -0.05);
    const auto root_of = [&] { return start_of(of_kind(drawn(crowd, 0, 0, &pose), SWIVEL_SHAPE_BONE).at(0)); };
    CHECK((root_of() - Vector3d(0, shift_of(crowd), 0)).norm() <= 1e-6);
    for (const float weight : {-0.5f, 1.5f, kNan, kInf}) {
        pose.weight = {&weight, 0};
        CHECK(root_of() == Vector3d(0, 0, 0));
        CHECK(length_of(of_kind(drawn(crowd, 0, 0, &pose), SWIVEL_SHAPE_SHIFT).at(0)) == 0);
    }
}

TEST_CASE("a free limb's bones are drawn as they came")
{
    Random random{4};
    for (const swivel_features more : {swivel_features{0}, SWIVEL_WITH_CLAVICLE}) {
        const swivel_features features = kWorldJointsHand | SWIVEL_WITH_INCOMING | more;
        const BoundLimb limb = bound_limb(random);
        const Limb goal = random_limb(random, features, {limb.bound.lengths[0], limb.bound.lengths[1]});
        const LocalPose incoming{random.rotation(), random.rotation(), random.rotation()};
        Crowd crowd = crowd_of(features, 1, limb.bound);
        write_limb(crowd, 0, 0, goal);
        put(crowd, SWIVEL_INCOMING_SHOULDER, 0, floats(incoming.shoulder));
        put(crowd, SWIVEL_INCOMING_ELBOW, 0, floats(incoming.elbow));
        put(crowd, SWIVEL_INCOMING_WRIST, 0, floats(incoming.wrist));
        put(crowd, SWIVEL_CLAVICLE, 0, Float4{0.2f, 0.1f, 0, 0.7f});
        crowd.solve();
        const Parent parent = goal.parent();
        const Vector3d upper = incoming.shoulder * vec(limb.rest.translations[1]),
                       elbow = parent.position + parent.scale * (parent.rotation * upper),
                       wrist = incoming.wrist_place(limb.rest, parent);
        const double off = 1e-5 * (parent.position.norm() + 2 * parent.scale);
        const Shapes bones = of_kind(drawn(crowd, 0, 0), SWIVEL_SHAPE_INCOMING);
        REQUIRE(bones.size() == 2);
        CHECK((start_of(bones[0]) - parent.position).norm() <= off);
        CHECK((end_of(bones[0]) - elbow).norm() <= off);
        CHECK((end_of(bones[1]) - wrist).norm() <= off);
    }
}

TEST_CASE("anchors are drawn on supports, and far bodies below their roots")
{
    for (const Ground ground : {Ground::still, Ground::moving, Ground::far}) {
        PlantedBodies bodies(5, ground);
        Crowd crowd = bodies.crowd(kPlanted);
        std::size_t locked = 0;
        for (int frame = 0; frame < 30; ++frame) bodies.go_to(frame), bodies.solve(crowd);
        const swivel_pose pose = bodies.view();
        for (std::uint32_t b = 0; b < bodies.body_count; ++b) {
            const Shapes shapes = drawn_body(crowd, b, pose);
            CHECK((start_of(of_kind(shapes, SWIVEL_SHAPE_AXIS_X).front()) - bodies.roots[b]).norm() <= 1e-6);
            for (const swivel_shape_kind kind : {SWIVEL_SHAPE_BONE, SWIVEL_SHAPE_GOAL, SWIVEL_SHAPE_MISS})
                for (const swivel_shape& shape : of_kind(shapes, kind))
                    CHECK((end_of(shape) - bodies.roots[b]).norm() <= 50);
            for (const swivel_shape& shape : of_kind(shapes, SWIVEL_SHAPE_ANCHOR)) {
                if (length_of(shape) > 0) continue;  // of the circle
                const Vector3d wanted = bodies.on_support(b, mark_of(crowd, shape.group, b));
                CHECK((end_of(shape) - wanted).norm() <= 1e-5 * (1 + mark_of(crowd, shape.group, b).norm()));
                ++locked;
            }
        }
        CHECK(locked > 20);
    }
}

// SPDX-License-Identifier: MIT
//
// The promise: swivel_draw() has solved bones where forward kinematics of Eigen's has them, also below far roots, and
// bones as they came. It draws each kind of shape where its feature is on, and nowhere else. Misses are as long as
// residuals, and arcs, cones and regions are where limits have them. Shapes are finite, and always the same ones in the
// same order.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "swivel/swivel_explain.hpp"
#include "swivel/swivel_regions.hpp"
#include "tests/looking_bodies.h"
#include "tests/planted_bodies.h"
#include "tests/prop_bodies.h"

namespace {

using namespace swivel;
using namespace swivel::test;

using Shapes = std::vector<swivel_shape>;
using Names = std::set<std::string>;

Vector3d from_of(const swivel_shape& shape) { return Vector3d(shape.from[0], shape.from[1], shape.from[2]); }
Vector3d to_of(const swivel_shape& shape) { return Vector3d(shape.to[0], shape.to[1], shape.to[2]); }
double length_of(const swivel_shape& shape) { return (to_of(shape) - from_of(shape)).norm(); }

bool is_same(const swivel_shape& a, const swivel_shape& b)
{
    return from_of(a) == from_of(b) && to_of(a) == to_of(b) && a.name == b.name && a.kind == b.kind &&
           a.color == b.color && a.group == b.group;
}
bool is_same(const Shapes& a, const Shapes& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const swivel_shape& one, const swivel_shape& other) { return is_same(one, other); });
}

Shapes shapes_of(const Crowd& crowd, std::uint32_t group, std::uint32_t limb, const swivel_pose* pose,
                 std::uint32_t capacity)
{
    const swivel_shape untouched{{1, 2, 3}, {4, 5, 6}, "untouched", SWIVEL_SHAPE_END, 7, 8};
    Shapes shapes(capacity + 1, untouched);
    std::uint32_t count = 0;
    check(swivel_draw(crowd.get(), group, limb, pose, capacity > 0 ? shapes.data() : nullptr, capacity, &count));
    CHECK(is_same(shapes.back(), untouched));
    shapes.resize(std::min(count, capacity));
    shapes.resize(count, untouched);
    return shapes;
}
// All shapes. What holds of every drawing is checked.
Shapes drawn(const Crowd& crowd, std::uint32_t group, std::uint32_t limb, const swivel_pose* pose = nullptr)
{
    const auto count = static_cast<std::uint32_t>(shapes_of(crowd, group, limb, pose, 0).size());
    const Shapes shapes = shapes_of(crowd, group, limb, pose, count),
                 some = shapes_of(crowd, group, limb, pose, count / 2);
    CHECK(is_same(shapes_of(crowd, group, limb, pose, count), shapes));
    CHECK(is_same({some.begin(), some.begin() + count / 2}, {shapes.begin(), shapes.begin() + count / 2}));
    for (const swivel_shape& shape : shapes) {
        CHECK(from_of(shape).allFinite());
        CHECK(to_of(shape).allFinite());
        CHECK(shape.kind < SWIVEL_SHAPE_END);
        CHECK((shape.color & 0xff) == 0xff);
        CHECK((shape.group == SWIVEL_EVERY_GROUP || shape.group < swivel_group_count(crowd.get())));
    }
    return shapes;
}
Shapes drawn_body(const Crowd& crowd, std::uint32_t body, const swivel_pose& pose)
{
    return drawn(crowd, SWIVEL_EVERY_GROUP, body, &pose);
}
Shapes of_kind(const Shapes& shapes, swivel_shape_kind kind)
{
    Shapes found;
    for (const swivel_shape& shape : shapes)
        if (shape.kind == kind) found.push_back(shape);
    return found;
}
// The kinds of a group's shapes; SWIVEL_EVERY_GROUP: of the body itself.
Names names_of(const Shapes& shapes, std::uint32_t group)
{
    Names names;
    for (const swivel_shape& shape : shapes)
        if (shape.group == group) names.insert(shape.name);
    return names;
}
Names operator+(Names a, const Names& b)
{
    a.insert(b.begin(), b.end());
    return a;
}
const Names kAxes = {"axis_x", "axis_y", "axis_z"};

// ---- bodies of any kind

// Where a solve shifted the root.
Vector3d shift_of(const SolvedBodies& solved, std::size_t n)
{
    for (std::uint32_t g = 0; g < solved.of.groups.size(); ++g)
        if (std::holds_alternative<swivel_shift_def>(solved.of.groups[g]))
            return double{solved.result<Float3>(SWIVEL_SHIFT, g, n)[0]} *
                   (quat(solved.of.bodies[n].root_rotation).normalized() * Vector3d::UnitY());
    return Vector3d::Zero();
}

// Whether each line ends in a joint of the body, and each limb's elbow and wrist are ends of lines.
void check_bones(const Shapes& bones, const SolvedBody& body, const std::vector<JointAt>& at, const Vector3d& root)
{
    const auto off = [&](std::uint32_t joint) {
        return 1e-5 * (0.1 + way_to(body.of.skeleton, at, joint) + root.norm());
    };
    const auto is_at = [&](const swivel_shape& bone, std::uint32_t joint) {
        return (to_of(bone) - root - at[joint].place).norm() <= off(joint);
    };
    for (const swivel_shape& bone : bones) {
        bool is_joint = false;
        for (std::uint32_t joint = 0; joint < at.size(); ++joint) is_joint |= is_at(bone, joint);
        CHECK(is_joint);
    }
    for (std::uint32_t g = 0; g < body.of.groups.size(); ++g) {
        if (!body.of.is_limb(g)) continue;
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
        check_bones(of_kind(shapes, SWIVEL_SHAPE_BONE), body, body.is, shifted);
        CHECK(is_same(of_kind(other, SWIVEL_SHAPE_BONE), of_kind(shapes, SWIVEL_SHAPE_BONE)));
        check_bones(of_kind(other, SWIVEL_SHAPE_INCOMING), body, body.was, body.root());
        CHECK(names_of(shapes, SWIVEL_EVERY_GROUP) == kAxes + Names{"bone"});
        CHECK(names_of(other, SWIVEL_EVERY_GROUP) == kAxes + Names{"bone", "incoming"});
        for (std::uint32_t g = 0; g < bodies.groups.size(); ++g) {
            const Shapes one = drawn(solved.crowd, g, n, &pose);
            CHECK(names_of(one, g) == names_of(shapes, g));
            CHECK(of_kind(one, SWIVEL_SHAPE_BONE).size() == of_kind(shapes, SWIVEL_SHAPE_BONE).size());
        }
    }
}

// ---- one body with a leg, an arm and a head

struct Figure {
    static constexpr std::uint32_t kPelvis = 0, kThigh = 1, kArm = 4, kHead = 7;
    std::vector<std::int32_t> parents = {-1, 0, 1, 2, 0, 4, 5, 0};
    std::vector<Float3> translations = {{0, 1, 0},       {0.1f, 0, 0}, {0, -0.5f, 0.02f}, {0, -0.5f, -0.02f},
                                        {0.2f, 0.5f, 0}, {0.3f, 0, 0}, {0.3f, 0, 0.02f},  {0, 0.7f, 0}};
    std::vector<Float4> rotations = std::vector<Float4>(8, Float4{0, 0, 0, 1});
    swivel_limb_joints leg = limb(kThigh, -1), arm = limb(kArm, 1);
    float time = 0.02f;

    static swivel_limb_joints limb(std::uint32_t first, float forwards)
    {
        swivel_limb_joints joints = swivel_default_limb_joints(first, first + 1, first + 2);
        joints.bend[2] = forwards;
        return joints;
    }
    Crowd crowd(const std::vector<Definition>& groups) const
    {
        swivel_skeleton skeleton = swivel_default_skeleton();
        skeleton.parents = stream(parents);
        skeleton.translations = stream(translations);
        skeleton.joint_count = static_cast<std::uint32_t>(parents.size());
        return Crowd(skeleton, 1, groups);
    }
    swivel_pose pose()
    {
        swivel_pose made = swivel_default_pose();
        made.rotations = {rotations.data(), 8 * sizeof(Float4), sizeof(Float4), nullptr};
        made.time = {&time, 0};
        return made;
    }
    // The shapes after some solves.
    Shapes solved(Crowd& crowd, int frames = 1)
    {
        const swivel_pose with = pose();
        for (int n = 0; n < frames; ++n) solve_poses(crowd, with);
        return drawn_body(crowd, 0, with);
    }
};

constexpr swivel_features kLeg = SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING | SWIVEL_WITH_RECORD;
const Names kKept = {"miss", "incoming", "bend"};
const Names kSent = kKept + kAxes + Names{"goal"};
constexpr Float3 kFoot = {0.1f, 0.1f, 0.2f};

// The kinds that the leg of a figure has, which is solved as often.
Names leg_names(swivel_features features, const std::function<void(Crowd&)>& write, int frames = 1)
{
    Figure figure;
    Crowd crowd = figure.crowd({body_limb(figure.leg, features)});
    write(crowd);
    return names_of(figure.solved(crowd, frames), 0);
}
void write_foot(Crowd& crowd) { crowd.write_all(SWIVEL_TARGET, 0, kFoot); }
void write_contact(Crowd& crowd, float contact) { crowd.write_all(SWIVEL_CONTACT, 0, std::array{contact}); }

// ---- one free limb

Crowd free_limb(swivel_features features, const swivel_region* region = nullptr)
{
    swivel_limb_def def = limbs(1, features);
    def.region = region;
    Crowd crowd{Definition(def)};
    crowd.write_all(SWIVEL_TARGET, 0, {0.3f, 0.1f, 1.0f});
    crowd.write_all(SWIVEL_LENGTHS, 0, {1.0f, 0.9f});
    if (features & SWIVEL_WORLD) crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, {1.0f, 2.0f, 3.0f});
    for (const swivel_field field : {SWIVEL_INCOMING_SHOULDER, SWIVEL_INCOMING_ELBOW, SWIVEL_INCOMING_WRIST})
        if (swivel_field_row_count(crowd.get(), 0, field) > 0) crowd.write_all(field, 0, {0.0f, 0.0f, 0.0f, 1.0f});
    return crowd;
}
Names limb_names(Crowd crowd)
{
    crowd.solve();
    return names_of(drawn(crowd, 0, 0), 0);
}
template <class Value>
Names limb_names(swivel_features features, swivel_field field, const Value& value)
{
    Crowd crowd = free_limb(features);
    crowd.write_all(field, 0, value);
    return limb_names(std::move(crowd));
}
Region wide_region()
{
    Region region;
    return region.add_cones({{{0, 0, 1}, 2.0f}});
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
    const HoldingBodies bodies(random, 20, PoseLayout{});
    SolvedBodies solved(bodies);
    const swivel_pose pose = bodies.view(solved.poses);
    std::size_t count = 0;
    for (std::uint32_t n = 0; n < 20; ++n) {
        const SolvedBody body(solved, n);
        const Vector3d root = body.root() + shift_of(solved, n);
        for (const swivel_shape& bone : of_kind(drawn_body(solved.crowd, n, pose), SWIVEL_SHAPE_INCOMING)) {
            const BodyLimbJoints& joints = body.joints(bone.group);
            const double off = 1e-4 * (body.length(bone.group) + way_to(bodies.skeleton, body.was, joints.wrist));
            const bool is_first = (from_of(bone) - root - body.was[joints.shoulder].place).norm() <= off;
            const std::uint32_t end = is_first ? joints.elbow : joints.wrist;
            CHECK((to_of(bone) - root - body.was[end].place).norm() <= off);
            ++count;
        }
    }
    CHECK(count == 2 * 20 * 7);
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
            CHECK((from_of(of_kind(shapes, SWIVEL_SHAPE_AXIS_X).front()) - bodies.roots[b]).norm() <= 1e-6);
            for (const swivel_shape_kind kind : {SWIVEL_SHAPE_BONE, SWIVEL_SHAPE_GOAL, SWIVEL_SHAPE_MISS})
                for (const swivel_shape& shape : of_kind(shapes, kind))
                    CHECK((to_of(shape) - bodies.roots[b]).norm() <= 50);
            for (const swivel_shape& shape : of_kind(shapes, SWIVEL_SHAPE_ANCHOR)) {
                if (length_of(shape) > 0) continue;  // of the circle
                const Vector3d wanted = bodies.on_support(b, mark_of(crowd, shape.group, b));
                CHECK((to_of(shape) - wanted).norm() <= 1e-5 * (1 + mark_of(crowd, shape.group, b).norm()));
                ++locked;
            }
        }
        CHECK(locked > 20);
    }
}

TEST_CASE("a free limb's kinds follow from its features")
{
    const Names base = {"bone", "target", "miss", "pole"}, circle = {"wish", "allowed"};
    CHECK(limb_names(free_limb(0)) == base);
    CHECK(limb_names(free_limb(SWIVEL_WITH_HAND)) == base + kAxes);
    CHECK(limb_names(free_limb(SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR)) == base + kAxes + Names{"effector"});
    CHECK(limb_names(SWIVEL_WITH_AIM, SWIVEL_AIM, aim({0, 0, 1}, 1)) == Names{"bone", "target", "pole", "sight"});
    CHECK(limb_names(free_limb(SWIVEL_POLE_NORMAL)) == Names{"bone", "target", "miss", "normal"});
    CHECK(limb_names(free_limb(SWIVEL_WORLD | SWIVEL_POLE_DIRECTION)) == base);
    CHECK(limb_names(free_limb(SWIVEL_POLE_HALF_LINE)) == base);
    CHECK(limb_names(free_limb(SWIVEL_WITH_INCOMING)) == base + Names{"incoming", "bend"});
    CHECK(limb_names(free_limb(SWIVEL_WITH_INCOMING | SWIVEL_POLE_INCOMING)) ==
          Names{"bone", "target", "miss", "incoming", "bend"});
    CHECK(limb_names(SWIVEL_WITH_SHOULDER_CONE, SWIVEL_SHOULDER_CONE, cone({0, 0, 1}, 2)) ==
          base + circle + Names{"cone"});
    CHECK(limb_names(SWIVEL_WITH_HUMERAL_TWIST, SWIVEL_HUMERAL_TWIST, range(-3, 3)) == base + circle);
    CHECK(limb_names(SWIVEL_WITH_HAND | SWIVEL_WITH_HAND_CONE, SWIVEL_HAND_CONE, cone({0, 0, 1}, 3)) ==
          base + kAxes + circle + Names{"cone"});
    const Region region = wide_region();
    CHECK(limb_names(free_limb(SWIVEL_WITH_REGION, &region.get())) == base + circle + Names{"region"});
    CHECK(limb_names(0, SWIVEL_TARGET, kNoPlace) == Names{"bone", "pole", "bad_input"});
}

TEST_CASE("a body's kinds follow from its groups")
{
    CHECK(leg_names(kLeg, write_foot) == kKept + Names{"target"});
    CHECK(leg_names(kLeg & ~SWIVEL_WITH_RECORD, write_foot) == Names{"target"});
    CHECK(leg_names(kLeg, write_foot, 0) == Names{"target"});
    CHECK(leg_names(kLeg, [](Crowd&) {}).count("bad_input") == 1);
    const swivel_features plants = kLeg | SWIVEL_WITH_PLANT;
    CHECK(leg_names(
              plants, [](Crowd& crowd) { write_contact(crowd, 1); }, 3) == kSent + Names{"anchor"});
    CHECK(leg_names(
              plants, [](Crowd& crowd) { write_contact(crowd, 0); }, 3) == kSent);
    const swivel_features grounds = plants | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_GROUND;
    const auto write_ground = [](const Float3& place) {
        return [place](Crowd& crowd) {
            write_contact(crowd, 0);
            crowd.write_all(SWIVEL_GROUND, 0, place);
            crowd.write_all(SWIVEL_GROUND_NORMAL, 0, {0.0f, 1.0f, 0.0f});
        };
    };
    const Names on_ground = kSent + Names{"effector", "probe"};
    CHECK(leg_names(grounds, write_ground({0.1f, 0, 0})) == on_ground + Names{"ground"});
    CHECK(leg_names(grounds, write_ground(kNoPlace)) == on_ground);

    Figure figure;
    swivel_body_limb_def hand = body_limb(figure.arm, kLeg | SWIVEL_WITH_LINK);
    hand.link = 3;
    Crowd all = figure.crowd({look({Figure::kHead}), swivel_default_shift_def(),
                              body_limb(figure.leg, kLeg | SWIVEL_WITH_PELVIS_FIT), swivel_default_prop_def(), hand});
    all.write_all(SWIVEL_LOOK_TARGET, 0, {0.3f, 1.7f, 2.0f});
    all.write_all(SWIVEL_TARGET, 2, kFoot);
    all.write_all(SWIVEL_GRIP, 4, {0.0f, 0.1f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f});
    const Shapes shapes = figure.solved(all);
    CHECK(names_of(shapes, 0) == Names{"sight", "target"});
    CHECK(names_of(shapes, 1) == Names{"shift"});
    CHECK(names_of(shapes, 2) == kKept + Names{"target"});
    CHECK(names_of(shapes, 3) == kAxes + Names{"prop"});
    CHECK(names_of(shapes, 4) == kSent);
    for (const swivel_shape& bend : of_kind(shapes, SWIVEL_SHAPE_BEND)) {  // knees bend backwards, elbows forwards
        const double forwards = (to_of(bend) - from_of(bend)).normalized().z();
        CHECK((bend.group == 2 ? -forwards : forwards) > 0.99);
    }
    CHECK(swivel_reset(all.get(), 0, 0, 1) == SWIVEL_OK);
    CHECK(swivel_reset(all.get(), 1, 0, 1) == SWIVEL_OK);
    const Shapes anew = drawn_body(all, 0, figure.pose());
    CHECK(names_of(anew, 0) == Names{"target"});
    CHECK(names_of(anew, 1).empty());
}

TEST_CASE("misses are as long as residuals, and poles where they were written")
{
    Random random{8};
    for (const swivel_features features : {swivel_features{0}, SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR}) {
        for (int n = 0; n < 50; ++n) {
            Crowd crowd = free_limb(features | SWIVEL_WORLD);
            const Float3 pole = floats(random.vector(1, 5));
            crowd.write_all(SWIVEL_TARGET, 0, floats(Vector3d(Vector3d(1, 2, 3) + random.vector(0, 4))));
            crowd.write_all(SWIVEL_POLE, 0, pole);
            if (features) crowd.write_all(SWIVEL_EFFECTOR, 0, floats(random.vector(0, 0.2)));
            crowd.solve();
            std::array<double, 1> residual;
            crowd.residuals(0, residual);
            const Shapes shapes = drawn(crowd, 0, 0);
            CHECK(length_of(of_kind(shapes, SWIVEL_SHAPE_MISS).at(0)) == Approx(1.9 * residual[0]).margin(1e-6));
            CHECK(to_of(of_kind(shapes, SWIVEL_SHAPE_POLE).at(0)) == vec(pole));
        }
    }
}

TEST_CASE("elbows are on the arcs that limits allow, and limits where they are")
{
    Random random{9};
    Region region;
    region.add_cones({{{0, 0, 1}, 1.2f}, {{0, -1, 0.5f}, 0.9f}});
    region.forbid({{0, 0, 1}, 0.2f});
    std::size_t limited = 0;
    for (int n = 0; n < 400; ++n) {
        Crowd crowd =
            free_limb(SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST | SWIVEL_WITH_REGION, &region.get());
        const Vector3d axis = random.direction();
        const double angle = random.between(1, 2);
        crowd.write_all(SWIVEL_SHOULDER_CONE, 0, cone({axis.x(), axis.y(), axis.z()}, angle));
        crowd.write_all(SWIVEL_HUMERAL_TWIST, 0, range(-2, 1.5));
        crowd.write_all(SWIVEL_TARGET, 0, floats(random.vector(0.3, 1.8)));
        crowd.write_all(SWIVEL_POLE, 0, floats(random.vector(1, 2)));
        crowd.solve();
        const Shapes shapes = drawn(crowd, 0, 0);
        for (const swivel_shape& line : of_kind(shapes, SWIVEL_SHAPE_CONE))
            CHECK(to_of(line).normalized().dot(axis) == Approx(std::cos(angle)).margin(1e-5));
        for (const swivel_shape& line : of_kind(shapes, SWIVEL_SHAPE_REGION))
            CHECK(std::fabs(region.room(floats(Vector3d(to_of(line).normalized())))) <=
                  0.05f);  // else inside of the border
        const std::uint32_t flags = flags_of(crowd, 0, 0);
        const Shapes arcs = of_kind(shapes, SWIVEL_SHAPE_ALLOWED);
        if (flags & SWIVEL_INFEASIBLE || arcs.empty()) continue;
        const Vector3d elbow = to_of(of_kind(shapes, SWIVEL_SHAPE_BONE).at(0)),
                       wish = to_of(of_kind(shapes, SWIVEL_SHAPE_WISH).at(0));
        double nearest = 1e9;
        for (const swivel_shape& line : arcs) {
            const Vector3d way = to_of(line) - from_of(line);
            const double along =
                std::clamp((elbow - from_of(line)).dot(way) / std::max(way.squaredNorm(), 1e-30), 0.0, 1.0);
            nearest = std::min(nearest, (elbow - from_of(line) - along * way).norm());
        }
        CHECK(nearest <= 5e-3);  // chords of 10 degrees
        const bool is_limited =
            flags & (SWIVEL_LIMITED_SHOULDER_CONE | SWIVEL_LIMITED_HUMERAL_TWIST | SWIVEL_LIMITED_REGION);
        limited += is_limited;
        if (!is_limited) CHECK((wish - elbow).norm() <= 1e-5);
    }
    CHECK(limited > 20);
}

TEST_CASE("a kind of shape has one name and one colour")
{
    Figure figure;
    swivel_body_limb_def hand = body_limb(figure.arm, kLeg | SWIVEL_WITH_LINK);
    hand.link = 0;
    Crowd crowd = figure.crowd({swivel_default_prop_def(), hand});
    crowd.write_all(SWIVEL_GRIP, 1, {0.0f, 0.1f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f});
    std::map<std::string, std::set<std::uint32_t>> colors;
    for (const swivel_shape& shape : figure.solved(crowd)) colors[shape.name].insert(shape.color);
    for (const auto& [name, all] : colors) CHECK(all.size() == 1);
    CHECK(colors["bone"] == std::set{0xffffffffu});
    CHECK(colors["axis_x"] == std::set{0xff0000ffu});
    CHECK(colors["goal"] == std::set{0xff8c00ffu});
}

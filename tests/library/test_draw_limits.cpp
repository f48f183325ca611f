// SPDX-License-Identifier: MIT
//
// The promise: swivel_draw() has all arcs of elbows that limits allow, also of arms that aim, of elbows that turn in
// steps, and of arms that fold up. Solved elbows are on them. Cones and regions are where limits have them.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "swivel/swivel_regions.hpp"
#include "tests/drawn_shapes.h"

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr double kTwist = -0.25, kHalfRange = 1.75;  // of the upper arm: the range's middle and half of it, in radians

// A region of two cones with a hole, and a limb whose upper arm is in it, in a cone of its own and in a twist's range.
struct LimitedLimb {
    Region region;
    Vector3d axis;         // of the cone
    double angle;          // the cone's
    Vector3d line;         // to the target, which it swivels about
    Quaterniond shoulder;  // as solved
    std::uint32_t flags = 0;
    Shapes shapes;

    // Solves it for two poles, one after the other. more: SWIVEL_WITH_AIM and features of the step, or none.
    LimitedLimb(Random& random, swivel_features more) : axis(random.direction()), angle(random.between(1, 2))
    {
        region.add_cones({{{0, 0, 1}, 1.2f}, {{0, -1, 0.5f}, 0.9f}});
        region.forbid({{0, 0, 1}, 0.2f});
        Crowd crowd =
            free_limb(SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST | SWIVEL_WITH_REGION | more, &region.get());
        crowd.write_all(SWIVEL_SHOULDER_CONE, 0, cone({axis.x(), axis.y(), axis.z()}, angle));
        crowd.write_all(SWIVEL_HUMERAL_TWIST, 0, range(kTwist - kHalfRange, kTwist + kHalfRange));
        if (more & SWIVEL_WITH_MAX_SWIVEL) crowd.write_all(SWIVEL_MAX_SWIVEL, 0, cos_sin(random.between(0.1, 1)));
        const bool aims = more & SWIVEL_WITH_AIM;
        if (aims) {
            const Vector3d ray = random.direction();
            crowd.write_all(SWIVEL_AIM, 0, aim({ray.x(), ray.y(), ray.z()}, random.between(0.2, 2)));
        }
        const Float3 target = floats(aims ? random.vector(2, 8) : random.vector(0.3, 1.8));
        crowd.write_all(SWIVEL_TARGET, 0, target);
        line = vec(target).normalized();
        for (int n = 0; n < 2; ++n) {
            crowd.write_all(SWIVEL_POLE, 0, floats(random.vector(1, 2)));
            crowd.solve();
        }
        flags = flags_of(crowd, 0, 0);
        shoulder = quat(value_of<Float4>(crowd, SWIVEL_SHOULDER, 0, 0)).normalized();
        shapes = drawn(crowd, 0, 0);
    }
    bool has(std::uint32_t flag) const { return flags & flag; }
    Vector3d first(swivel_shape_kind kind) const { return end_of(of_kind(shapes, kind).at(0)); }
    // Whether the cone and the region have room for an elbow, and the upper arm's twist is then in its range.
    bool is_allowed(const Vector3d& elbow) const
    {
        const Vector3d direction = elbow.normalized();
        return direction.dot(axis) >= std::cos(angle) - 1e-5 && region.room(floats(direction)) >= -1e-5f &&
               keeps_twist(elbow);
    }
    bool keeps_twist(const Vector3d& elbow) const
    {
        // The solved arm turns about the line as one piece. The nearer an elbow is to the line, the less is its rounded
        // place sure of the turn.
        const Vector3d from = line.cross(first(SWIVEL_SHAPE_BONE)), to = line.cross(elbow);
        const double swivel = std::atan2(line.dot(from.cross(to)), from.dot(to));
        const Quaterniond upper = Quaterniond(Eigen::AngleAxisd(swivel, line)) * shoulder;
        // An upper arm that points back has no twist: z and w are 0.
        const double twist = 2 * std::atan2(upper.z(), upper.w()), z2 = upper.z() * upper.z(),
                     w2 = upper.w() * upper.w();
        return (z2 + w2) * (std::cos(twist - kTwist) - std::cos(kHalfRange)) >= -1e-5 / from.norm();
    }
};

double distance_to(const swivel_shape& line, const Vector3d& place)
{
    const Vector3d way = end_of(line) - start_of(line), from_start = place - start_of(line);
    const double along = std::clamp(from_start.dot(way) / std::max(way.squaredNorm(), 1e-30), 0.0, 1.0);
    return (from_start - along * way).norm();
}

}  // namespace

TEST_CASE("limits have their kinds of shapes")
{
    const KindNames limb = {"bone", "target", "miss", "pole", "wish", "allowed"};
    CHECK(limb_names(SWIVEL_WITH_SHOULDER_CONE, SWIVEL_SHOULDER_CONE, cone({0, 0, 1}, 2)) == limb + KindNames{"cone"});
    CHECK(limb_names(SWIVEL_WITH_HUMERAL_TWIST, SWIVEL_HUMERAL_TWIST, range(-3, 3)) == limb);
    CHECK(limb_names(SWIVEL_WITH_HAND | SWIVEL_WITH_HAND_CONE, SWIVEL_HAND_CONE, cone({0, 0, 1}, 3)) ==
          limb + kAxes + KindNames{"cone"});
    Region region;
    region.add_cones({{{0, 0, 1}, 2.0f}});
    CHECK(limb_names(free_limb(SWIVEL_WITH_REGION, &region.get())) == limb + KindNames{"region"});
}

TEST_CASE("elbows are on the arcs that limits allow, and limits where they are")
{
    for (const swivel_features more :
         {swivel_features{0}, SWIVEL_WITH_MAX_SWIVEL, SWIVEL_WITH_MAX_SWIVEL | SWIVEL_STEP_WINS, SWIVEL_WITH_AIM,
          SWIVEL_WITH_AIM | SWIVEL_WITH_MAX_SWIVEL}) {
        CAPTURE(more);
        Random random{9};
        std::size_t limited = 0;
        for (int n = 0; n < 250; ++n) {
            const LimitedLimb limb(random, more);
            for (const swivel_shape& line : of_kind(limb.shapes, SWIVEL_SHAPE_CONE))
                CHECK(end_of(line).normalized().dot(limb.axis) == Approx(std::cos(limb.angle)).margin(1e-5));
            for (const swivel_shape& line : of_kind(limb.shapes, SWIVEL_SHAPE_REGION))
                CHECK(std::fabs(limb.region.room(floats(Vector3d(end_of(line).normalized())))) <=
                      0.05f);  // else inside of the border
            const Shapes arcs = of_kind(limb.shapes, SWIVEL_SHAPE_ALLOWED);
            double nearest = 1e9;
            const Vector3d elbow = limb.first(SWIVEL_SHAPE_BONE);
            for (const swivel_shape& line : arcs) {
                CHECK(limb.is_allowed(start_of(line)));
                CHECK(limb.is_allowed(end_of(line)));
                nearest = std::min(nearest, distance_to(line, elbow));
            }
            if (limb.has(SWIVEL_INFEASIBLE) || arcs.empty()) continue;
            const bool is_stepped = limb.has(SWIVEL_LIMITED_STEP),
                       is_limited = limb.has(SWIVEL_LIMITED_SHOULDER_CONE | SWIVEL_LIMITED_HUMERAL_TWIST |
                                             SWIVEL_LIMITED_REGION);
            limited += is_limited;
            // A step that wins may leave the elbow on its way to an arc. Chords are of 10 degrees.
            if (!(is_stepped && more & SWIVEL_STEP_WINS)) CHECK(nearest <= 5e-3);
            if (!is_limited && !is_stepped) CHECK((limb.first(SWIVEL_SHAPE_WISH) - elbow).norm() <= 1e-5);
        }
        CHECK(limited > 20);
    }
}

TEST_CASE("arcs of an arm that folds up are about the arm frame's e3")
{
    Crowd crowd = free_limb(SWIVEL_WORLD | SWIVEL_WITH_HUMERAL_TWIST);
    const Float3 place = {1e8f, 2e8f, 3e8f};  // further than doubles tell the wrist from the shoulder
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, place);
    crowd.write_all(SWIVEL_TARGET, 0, place);
    crowd.write_all(SWIVEL_LENGTHS, 0, {1.0f, 1.0f});
    crowd.write_all(SWIVEL_HUMERAL_TWIST, 0, range(-3, 3));
    crowd.solve();
    const Shapes shapes = drawn(crowd, 0, 0);
    CHECK((end_of(of_kind(shapes, SWIVEL_SHAPE_WISH).at(0)) - vec(place)).norm() == Approx(1).margin(1e-6));
    const Shapes arcs = of_kind(shapes, SWIVEL_SHAPE_ALLOWED);
    CHECK(arcs.size() > 10);
    for (const swivel_shape& line : arcs) {
        const Vector3d elbow = end_of(line) - vec(place);
        CHECK(elbow.norm() == Approx(1).margin(1e-6));
        CHECK(std::fabs(elbow.z()) <= 1e-6);
    }
}

TEST_CASE("all arcs are drawn, however many limits leave")
{
    // As many cones as a region has parts, beside each other on the elbow's circle.
    const double along = (1 + 1 - 0.9 * 0.9) / 2, away = std::sqrt(1 - along * along);
    constexpr std::size_t kArcs = SWIVEL_MAX_REGION_PARTS;
    Region region;
    for (std::size_t n = 0; n < kArcs; ++n) {
        const double turn = 2 * std::numbers::pi * static_cast<double>(n) / kArcs;
        const Float3 axis = floats(Vector3d(away * std::cos(turn), away * std::sin(turn), along));
        region.add_cones({{{axis[0], axis[1], axis[2]}, 0.05f}});
    }
    Crowd crowd = free_limb(SWIVEL_WITH_REGION, &region.get());
    crowd.write_all(SWIVEL_TARGET, 0, {0.0f, 0.0f, 1.0f});
    crowd.write_all(SWIVEL_POLE, 0, {1.0f, 0.3f, 0.0f});
    crowd.solve();
    const Shapes arcs = of_kind(drawn(crowd, 0, 0), SWIVEL_SHAPE_ALLOWED);
    CHECK(arcs.size() == kArcs);  // each is shorter than a chord
    for (const swivel_shape& line : arcs) CHECK(region.room(floats(Vector3d(start_of(line).normalized()))) >= -1e-5f);
}

// SPDX-License-Identifier: MIT
//
// The promise: a region of cones in order, bridges, polygons and forbidden cones allows what its definition says. Float
// decides as double but near a boundary. The other side's region is the mirror image to the bit. test_limits.cpp has
// the swivels that a region allows.
#include "core/region.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include "tests/formula_arm.h"
#include "tests/limit_oracle.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr double kNearEdge = 1e-6;  // what rounding of the region's floats may decide otherwise

// 10,000 of a region make a million.
constexpr int kDirections = 10'000;

TEST_CASE("a region allows the directions that its definition allows, in double and in float")
{
    rc::prop("cones in order, polygons and forbidden cones", [](std::uint64_t seed) {
        Random random{seed};
        const RandomRegion r = random_region(random);
        RC_ASSERT(r.good);
        for (int n = 0; n < kDirections; ++n) {
            const Vector3d d = random.direction();
            const double wanted = r.oracle.room(d);
            const double got = room(r.region, mv<double>(d));
            const double in_float = double{room(r.region, mv<float>(d))};
            if (std::fabs(wanted) > kNearEdge) RC_ASSERT((got >= kNoRoom) == (wanted >= 0));
            if (std::fabs(got - kNoRoom) > kNearEdge) RC_ASSERT((in_float >= kNoRoom) == (got >= kNoRoom));
            RC_ASSERT(std::fabs(in_float - got) <= kNearEdge);
        }
    });
}

TEST_CASE("the mirrored region has the same room for the mirrored direction, to the bit")
{
    rc::prop("any region", [](std::uint64_t seed) {
        Random random{seed};
        const RandomRegion r = random_region(random);
        swivel_region mirrored;
        RC_ASSERT(swivel_region_mirror(&r.region, &mirrored) == SWIVEL_OK);
        for (int n = 0; n < 1000; ++n) {
            Eigen::Vector3f d = random.direction().cast<float>();
            float one = 0, other = 0;
            RC_ASSERT(swivel_region_room(&r.region, d.data(), &one) == SWIVEL_OK);
            d.x() = -d.x();
            RC_ASSERT(swivel_region_room(&mirrored, d.data(), &other) == SWIVEL_OK);
            RC_ASSERT(one == other);
        }
    });
}

TEST_CASE("a bridge has no gap from one cone's axis to the other's, and is not empty")
{
    rc::prop("two cones apart", [](std::uint64_t seed) {
        Random random{seed};
        const DirectionCone one = random_cone(random, 0.02, 0.7);
        const double other = random.between(0.02, 0.7), apart = one.angle + other + random.between(0.01, 1.5);
        const Vector3d side = random.across(one.axis);
        const DirectionCone two{(std::cos(apart) * one.axis + std::sin(apart) * side), other};
        const swivel_region_cone cones[] = {one.given(), two.given()};
        swivel_region region = swivel_default_region();
        RC_ASSERT(swivel_region_add_cones(&region, cones, 2, 0) == SWIVEL_OK);
        for (int n = 0; n <= 1000; ++n) {
            const double turn = n * apart / 1000;
            const Vector3d d = std::cos(turn) * one.axis + std::sin(turn) * side;
            RC_ASSERT(room(region, mv<double>(d)) >= kNoRoom);
        }
        const double between = one.angle + 0.5 * (apart - one.angle - other);  // in neither cone
        const Vector3d d = std::cos(between) * one.axis + std::sin(between) * side;
        swivel_region apart_cones = swivel_default_region();
        for (const swivel_region_cone& cone : cones)
            RC_ASSERT(swivel_region_add_cones(&apart_cones, &cone, 1, 0) == SWIVEL_OK);
        RC_ASSERT(room(apart_cones, mv<double>(d)) < 0);
    });
}

// A path of a few arcs, and directions about it.
TEST_CASE("cones of directions hold each with its margin, and little else")
{
    double allowed = 0, wanted = 0, one_cone = 0;
    rc::prop("directions about a bent path", [&](std::uint64_t seed) {
        Random random{seed};
        const double width = random.between(0.05, 0.3), margin = double{float(random.between(0.02, 0.15))};
        std::vector<float> flat;
        std::vector<Vector3d> given;
        Vector3d at = random.direction();
        const std::uint32_t arcs = 1 + random.below(3);
        for (std::uint32_t arc = 0; arc < arcs; ++arc) {
            const Vector3d axis = random.across(at);
            const double length = random.between(0.2, 1.0);
            for (int n = 0; n < 100; ++n) {
                const Vector3d on = Eigen::AngleAxisd(length * random.unit(), axis) * at;
                const Eigen::Vector3f d = (on + width * random.unit() * random.direction()).cast<float>();
                flat.insert(flat.end(), {d.x(), d.y(), d.z()});
                given.push_back(d.cast<double>().normalized());
            }
            at = Eigen::AngleAxisd(length, axis) * at;
        }
        swivel_region region = swivel_default_region(), single = region;
        const auto count = static_cast<std::uint32_t>(given.size());
        RC_ASSERT(swivel_region_add_directions(&region, flat.data(), count, float(margin), 6) == SWIVEL_OK);
        RC_ASSERT(swivel_region_add_directions(&single, flat.data(), count, float(margin), 1) == SWIVEL_OK);
        for (const Vector3d& d : given)
            for (int n = 0; n < 8; ++n) {
                const Vector3d near = Eigen::AngleAxisd(margin * random.unit(), random.across(d)) * d;
                RC_ASSERT(room(region, mv<double>(near)) >= kNoRoom);
            }
        for (int n = 0; n < 1000; ++n) {
            const Vector3d d = random.direction();
            allowed += room(region, mv<double>(d)) >= 0;
            one_cone += room(single, mv<double>(d)) >= 0;
            wanted += std::any_of(given.begin(), given.end(),
                                  [&](const Vector3d& g) { return g.dot(d) >= std::cos(margin); });
        }
    });
    CAPTURE(allowed / wanted, one_cone / wanted);
    CHECK(allowed < 0.8 * one_cone);
    CHECK(allowed < 2 * wanted);
}

TEST_CASE("one cone of directions is the smallest that holds them, wherever most of them are")
{
    rc::prop("two ends, and many directions near one of them", [](std::uint64_t seed) {
        Random random{seed};
        const Vector3d axis = random.direction(), side = random.across(axis);
        const double max = random.between(0.2, 1.2), slack = 0.001;
        std::vector<float> flat;
        const auto add = [&](double angle) {
            const Eigen::Vector3f d = (std::cos(angle) * axis + std::sin(angle) * side).cast<float>();
            flat.insert(flat.end(), {d.x(), d.y(), d.z()});
        };
        add(max), add(-max);
        for (int n = 0; n < 100; ++n) add(random.between(0.7, 1) * max);
        swivel_region region = swivel_default_region();
        RC_ASSERT(swivel_region_add_directions(&region, flat.data(), 102, 0.05f, 1) == SWIVEL_OK);
        for (int n = 0; n < 1000; ++n) {
            const Vector3d d = random.direction();
            const double beyond = std::acos(axis.dot(d)) - max - 0.05;
            if (std::fabs(beyond) > slack) RC_ASSERT((room(region, mv<double>(d)) >= 0) == (beyond < 0));
        }
    });
}

bool says(swivel_status status, const char* words)
{
    return status == SWIVEL_INVALID_ARGUMENT && std::string(swivel_last_error()).find(words) != std::string::npos;
}

TEST_CASE("directions that are opposite, or all around, are held or refused, never left out")
{
    int refused = 0, held = 0;
    Random random{7};
    for (int n = 0; n < 400; ++n) {
        std::vector<float> flat;
        std::vector<Vector3d> given;
        const auto add = [&](const Vector3d& d) {
            const Eigen::Vector3f f = d.cast<float>();
            flat.insert(flat.end(), {f.x(), f.y(), f.z()});
            given.push_back(f.cast<double>().normalized());
        };
        const Vector3d axis = random.direction(), side = random.across(axis);
        const std::uint32_t kind = random.below(3);
        if (kind == 0)  // two that are opposite
            add(axis), add(-axis);
        else if (kind == 1)  // a circle, and its poles or not
            for (int at = 0; at < 12; ++at) add(Eigen::AngleAxisd(kPi * at / 6, axis) * side);
        else
            for (int at = 0; at < 300; ++at) add(random.direction());
        swivel_region region = swivel_default_region();
        const swivel_region before = region;
        const swivel_status status = swivel_region_add_directions(
            &region, flat.data(), static_cast<std::uint32_t>(given.size()), 0.05f, 1 + random.below(6));
        if (status != SWIVEL_OK) {
            ++refused;
            CHECK(says(status, "found no cones that hold all these directions"));
            CHECK(std::memcmp(&before, &region, sizeof region) == 0);
            continue;
        }
        ++held;
        CHECK(std::ranges::all_of(given, [&](const Vector3d& d) { return room(region, mv<double>(d)) >= kNoRoom; }));
    }
    CHECK(refused > 20);
    CHECK(held > 20);
}

TEST_CASE("what cannot be part of a region is refused, with a line, and changes nothing")
{
    swivel_region region = swivel_default_region();
    const swivel_region_cone cone{{0, 0, 2}, 0.5f}, narrow{{0, 0, 1}, 0.001f}, none{{0, 0, 0}, 0.5f},
        opposite[] = {{{0, 0, 1}, 0.5f}, {{0, 0, -1}, 0.5f}};
    CHECK(swivel_region_add_cones(&region, &cone, 1, 0) == SWIVEL_OK);
    const swivel_region before = region;
    CHECK(says(swivel_region_add_cones(&region, &narrow, 1, 0), "the angle of cone 0"));
    CHECK(says(swivel_region_forbid(&region, &none), "the axis of cone 0, (0, 0, 0), has no direction"));
    CHECK(says(swivel_region_add_cones(&region, opposite, 2, 0), "cones 0 and 1 are opposite"));
    CHECK(says(swivel_region_add_cones(&region, opposite, 0, 0), "0 cones are not 1 to 24"));
    const float clockwise[] = {0, 0, 1, 0, 1, 1, 1, 0, 1};
    CHECK(says(swivel_region_add_polygon(&region, clockwise, 3), "convex polygon"));
    CHECK(says(swivel_region_add_polygon(&region, clockwise, 2), "2 corners are not 3 to 64"));
    const std::vector<swivel_region_cone> many(24, cone);
    CHECK(says(swivel_region_add_cones(&region, many.data(), 24, 0), "more than 64 half-spaces or 24 parts"));
    CHECK(says(swivel_region_add_cones(nullptr, &cone, 1, 0), "region is null"));
    CHECK(std::memcmp(&before, &region, sizeof region) == 0);
    region.half_space[0].axis[2] = 2;
    float room = 0;
    CHECK(says(swivel_region_room(&region, cone.axis, &room), "half-space 0 of the region needs a unit axis"));
}

}  // namespace

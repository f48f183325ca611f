// SPDX-License-Identifier: MIT
//
// Random limbs with a parent, and where an arm in its own frame puts elbow, wrist and hand, by Eigen in double.
#pragma once

#include "tests/test_arm.h"
#include "tests/test_random.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace swivel::test {

struct Parent {
    Vector3d position;
    Quaterniond rotation;  // unit
    double scale;
};

// What goes into the rows of one limb, as it was rounded to floats.
struct Limb {
    Float3 target, pole;
    Float2 lengths;
    Float3 position;
    Float4 rotation;
    Float1 scale;
    Float4 hand;

    Parent parent() const { return {vec(position), quat(rotation).normalized(), scale[0]}; }
};

// A limb in reach, bent, its pole well off the line; parent and hand quaternions of any length.
inline Limb random_limb(Random& random, swivel_features features, const Float2& lengths)
{
    Limb limb;
    limb.lengths = lengths;
    const bool world = features & SWIVEL_WORLD;
    limb.position = world ? floats(random.vector(0, 5)) : Float3{0, 0, 0};
    limb.rotation =
        world ? floats(Quaterniond(random.spread(0.01, 100) * random.rotation().coeffs())) : Float4{0, 0, 0, 1};
    limb.scale = {world ? static_cast<float>(random.spread(0.1, 10)) : 1.0f};
    limb.hand = floats(Quaterniond(random.spread(0.01, 100) * random.rotation().coeffs()));
    const Parent parent = limb.parent();
    const double far = parent.scale * (double{lengths[0]} + lengths[1]),
                 near = parent.scale * std::fabs(double{lengths[0]} - lengths[1]);
    const Vector3d line = random.direction();
    limb.target = floats(Vector3d(parent.position + (near + (far - near) * random.between(0.05, 0.95)) * line));
    const Vector3d pole = random.between(-1, 1) * line + random.between(0.3, 2) * random.across(line);
    limb.pole = floats(Vector3d(features & SWIVEL_POLE_DIRECTION ? pole : parent.position + parent.scale * pole));
    return limb;
}

inline Vector3d pole_direction(const Limb& limb, swivel_features features)
{
    return features & SWIVEL_POLE_DIRECTION ? vec(limb.pole) : vec(limb.pole) - vec(limb.position);
}

inline void write_limb(Crowd& crowd, std::uint32_t group, std::uint32_t n, const Limb& limb)
{
    const auto put = [&](swivel_field field, const auto& value) {
        if (swivel_field_row_count(crowd.get(), group, field)) crowd.write(field, group, std::span(&value, 1), n);
    };
    put(SWIVEL_TARGET, limb.target);
    put(SWIVEL_POLE, limb.pole);
    put(SWIVEL_LENGTHS, limb.lengths);
    put(SWIVEL_SHOULDER_POSITION, limb.position);
    put(SWIVEL_PARENT_ROTATION, limb.rotation);
    put(SWIVEL_PARENT_SCALE, limb.scale);
    put(SWIVEL_HAND, limb.hand);
}

struct Places {
    Vector3d elbow, wrist;
    Quaterniond hand;
};

// An arm in its own frame carried along by its parent.
inline Places places_of(const Limb& limb, const Float4& shoulder, const Float2& elbow, const Float4& wrist)
{
    const Parent parent = limb.parent();
    const Quaterniond q_s = parent.rotation * quat(shoulder).normalized();
    const Quaterniond q_e = Quaterniond(elbow[0], -double{elbow[1]}, 0, 0).normalized();
    const Vector3d elbow_w = parent.position + parent.scale * (q_s * Vector3d(0, 0, limb.lengths[0]));
    return {elbow_w, elbow_w + parent.scale * (q_s * q_e * Vector3d(0, 0, limb.lengths[1])),
            q_s * q_e * quat(wrist).normalized()};
}

// 1.5e-6 arm lengths: the wrist's own 1e-6 and the rounding of the frame's rotor.
inline constexpr double kWristError = 1.5e-6;

inline void check_places(const Limb& limb, swivel_features features, const Places& got, std::uint32_t flags)
{
    const double length = double{limb.scale[0]} * (double{limb.lengths[0]} + limb.lengths[1]);
    CHECK((got.wrist - vec(limb.target)).norm() <= kWristError * length);
    const Vector3d line = (vec(limb.target) - vec(limb.position)).normalized();
    const Vector3d pole = pole_direction(limb, features), across = (pole - pole.dot(line) * line).normalized();
    const Vector3d elbow = got.elbow - vec(limb.position);
    CHECK(elbow.dot(across) > 0);
    CHECK(std::fabs(elbow.dot(line.cross(across))) <= 3e-6 * length);  // in the plane of shoulder, target and pole
    if (features & SWIVEL_WITH_HAND) CHECK(distance(got.hand, quat(limb.hand).normalized()) <= 1e-6);
    CHECK(flags == SWIVEL_REACHED);
}

// tolerance: with skeletons the library goes by the binding's floats, the places here by the skeleton itself.
inline void check_forward(const Crowd& crowd, std::uint32_t group, const std::vector<Limb>& limbs,
                          const std::vector<Places>& places, double tolerance)
{
    const std::size_t count = limbs.size();
    std::vector<std::array<double, 3>> elbows(count), wrists(count);
    std::vector<std::array<double, 4>> hands(count);
    std::vector<double> residuals(count);
    crowd.elbows(group, elbows);
    crowd.wrists(group, wrists);
    crowd.residuals(group, residuals);
    const bool with_hand = swivel_field_row_count(crowd.get(), group, SWIVEL_HAND);
    if (with_hand) crowd.hands(group, hands);
    for (std::size_t n = 0; n < count; ++n) {
        const double length = double{limbs[n].scale[0]} * (double{limbs[n].lengths[0]} + limbs[n].lengths[1]);
        const double size = length + vec(limbs[n].position).norm();
        CHECK((Vector3d(elbows[n].data()) - places[n].elbow).norm() <= tolerance * size);
        CHECK((Vector3d(wrists[n].data()) - places[n].wrist).norm() <= tolerance * size);
        const double residual = (places[n].wrist - vec(limbs[n].target)).norm() / length;
        CHECK(std::fabs(residuals[n] - residual) <= tolerance * size / length);
        if (with_hand) CHECK(distance(Quaterniond(hands[n].data()), places[n].hand) <= tolerance);
    }
}

}  // namespace swivel::test

// SPDX-License-Identifier: MIT
//
// Judges of joint limits and of regions, in double, with Eigen and the C library's arc functions. They say how far a
// rotation is outside of a cone, a twist range or a box of Euler angles, and how much room a direction has in a region.
// A bridge is what a disc of its radius cannot cover without touching one of both cones: the closing of the pair by
// that disc. They share nothing with core/angle_limits.h, and with core/region.h no more than the definition of a cone.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "include/swivel/swivel_regions.h"
#include "tests/test_random.h"

namespace swivel::test {

inline constexpr double kPi = std::numbers::pi;

// An angle range: middle and half width, radians.
struct AngleRange {
    double middle = 0, half = kPi;

    // How far an angle is outside; negative inside.
    double outside(double angle) const { return std::fabs(std::remainder(angle - middle, 2 * kPi)) - half; }
};

// All violations are in units of a cosine, positive where the limit is broken.
inline double cone_violation(const Eigen::Vector3d& axis, double cos_opening, const Eigen::Vector3d& direction)
{
    return cos_opening - axis.dot(direction);
}

inline double twist_violation(const Eigen::Vector3d& axis, const AngleRange& range, const Eigen::Quaterniond& q)
{
    const double along = q.vec().dot(axis), angle = 2 * std::atan2(along, q.w());
    const double off = std::remainder(angle - range.middle, 2 * kPi);
    return (q.w() * q.w() + along * along) * (std::cos(range.half) - std::cos(off));
}

struct AngleBox {
    int axes[3] = {0, 1, 2};
    AngleRange range[3];
};

// By the box's own angles, both triples that give the rotation: the better one counts.
inline double box_violation(const AngleBox& box, const Eigen::Matrix3d& r)
{
    const int p = box.axes[0], q = box.axes[1], s = box.axes[2];
    const double sign = (q - p + 3) % 3 == 1 ? 1 : -1;
    const double length = std::hypot(r(s, s), r(q, s));
    const double first = std::atan2(-sign * r(q, s), r(s, s)), last = std::atan2(-sign * r(p, q), r(p, p)),
                 middle = std::atan2(sign * r(p, s), length);
    const auto sine_of = [](double outside) { return outside <= kPi / 2 ? std::sin(outside) : 1; };
    const auto violation = [&](double a, double b, double c) {
        // The sine's way out of the middle range, as long as it leads to one of its ends on the same side of the pole.
        double middle_out = -1;
        if (box.range[1].outside(b) > 0) {
            middle_out = 2;
            for (const double end : {box.range[1].middle - box.range[1].half, box.range[1].middle + box.range[1].half})
                if (std::cos(end) * std::cos(b) >= 0)
                    middle_out = std::min(middle_out, std::fabs(std::sin(end) - std::sin(b)));
        }
        return std::max(
            {middle_out, length * sine_of(box.range[0].outside(a)), length * sine_of(box.range[2].outside(c))});
    };
    return std::min(violation(first, middle, last), violation(first + kPi, kPi - middle, last + kPi));
}

// ---- regions

struct DirectionCone {
    Eigen::Vector3d axis;
    double angle;

    double room(const Eigen::Vector3d& d) const { return axis.dot(d) - std::cos(angle); }
    swivel_region_cone given() const { return {{float(axis.x()), float(axis.y()), float(axis.z())}, float(angle)}; }
};

// The cosine of the least angle from a direction to what lies in both cones, which is not empty. The nearest point is
// the direction, or that of one cone if it lies in the other, or one in which their circles meet.
inline double cos_to_both(const DirectionCone& a, const DirectionCone& b, const Eigen::Vector3d& d)
{
    if (a.room(d) >= 0 && b.room(d) >= 0) return 1;
    double max = -2;
    const auto look = [&](const DirectionCone& on, const DirectionCone& other) {
        const Eigen::Vector3d out = d - d.dot(on.axis) * on.axis;
        if (out.norm() < 1e-12) return;
        const Eigen::Vector3d nearest = std::cos(on.angle) * on.axis + std::sin(on.angle) * out.normalized();
        if (other.room(nearest) >= 0) max = std::max(max, nearest.dot(d));
    };
    look(a, b);
    look(b, a);
    const Eigen::Vector3d pole = a.axis.cross(b.axis);
    const double c = a.axis.dot(b.axis), x = std::cos(a.angle), y = std::cos(b.angle), s2 = pole.squaredNorm();
    const Eigen::Vector3d in = ((x - c * y) * a.axis + (y - c * x) * b.axis) / s2;
    if (in.squaredNorm() <= 1)
        for (const double side : {1.0, -1.0})
            max = std::max(max, d.dot(in + side * std::sqrt((1 - in.squaredNorm()) / s2) * pole));
    return max;
}

struct Chain {
    std::vector<DirectionCone> cones;
    bool closed = false;

    // A disc's centre is far enough from both cones where it is within their opposites, wider by the disc's radius.
    static double bridge_room(const DirectionCone& one, const DirectionCone& two, const Eigen::Vector3d& d)
    {
        const double radius = (kPi - one.angle - two.angle) / 2;
        if (radius <= 0 || std::acos(std::clamp(one.axis.dot(two.axis), -1.0, 1.0)) <= std::fabs(one.angle - two.angle))
            return -4;
        return std::cos(radius) -
               cos_to_both({-one.axis, kPi - one.angle - radius}, {-two.axis, kPi - two.angle - radius}, d);
    }
    double room(const Eigen::Vector3d& d) const
    {
        double max = -4;
        for (const DirectionCone& cone : cones) max = std::max(max, cone.room(d));
        const std::size_t n = cones.size(), bridges = closed && n > 2 ? n : n - 1;
        for (std::size_t i = 0; i < bridges; ++i) max = std::max(max, bridge_room(cones[i], cones[(i + 1) % n], d));
        return max;
    }
};

struct RegionOracle {
    std::vector<Chain> chains;
    std::vector<std::vector<Eigen::Vector3d>> polygons;
    std::vector<DirectionCone> forbidden;

    double room(const Eigen::Vector3d& d) const
    {
        double max = -4;
        for (const Chain& chain : chains) max = std::max(max, chain.room(d));
        for (const auto& corners : polygons) {
            double min = 2;
            for (std::size_t n = 0; n < corners.size(); ++n)
                min = std::min(min, corners[n].cross(corners[(n + 1) % corners.size()]).normalized().dot(d));
            max = std::max(max, min);
        }
        for (const DirectionCone& cone : forbidden) max = std::min(max, -cone.room(d));
        return max;
    }
};

// The room as the header of the interface says it, by the half-spaces themselves.
inline double room_by_half_spaces(const swivel_region& region, const Eigen::Vector3d& d)
{
    const auto room_of = [&](std::uint32_t n) {
        const swivel_half_space& half = region.half_space[n];
        return Eigen::Vector3f(half.axis).cast<double>().dot(d) - double{half.cosine};
    };
    double max = -4;
    for (std::uint32_t part = 0; part < region.part_count; ++part) {
        double min = 2;
        for (std::uint32_t n = region.first[part]; n < region.first[part + 1]; ++n) min = std::min(min, room_of(n));
        max = std::max(max, min);
    }
    for (std::uint32_t n = 0; n < region.cut_count; ++n) max = std::min(max, room_of(n));
    return max;
}

struct RandomRegion {
    RegionOracle oracle;
    swivel_region region = swivel_default_region();
    bool good = true;
};
// What floats make of it is what both are given.
inline DirectionCone random_cone(Random& random, double min, double max)
{
    const Eigen::Vector3d axis = random.direction().cast<float>().cast<double>();
    return {axis.normalized(), double{float(random.between(min, max))}};
}
inline RandomRegion random_region(Random& random)
{
    RandomRegion r;
    Chain chain;
    const std::uint32_t count = 1 + random.below(5);
    const bool wide = random.below(4) == 0;
    for (std::uint32_t n = 0; n < count; ++n)
        chain.cones.push_back(random_cone(random, 0.02, wide ? 2.5 : n == 0 ? 0.8 : 0.5));
    chain.closed = random.below(3) == 0;
    std::vector<swivel_region_cone> given;
    for (const DirectionCone& cone : chain.cones) given.push_back(cone.given());
    if (random.below(2) == 0) r.oracle.forbidden.push_back(random_cone(random, 0.02, 0.7));
    for (const DirectionCone& cone : r.oracle.forbidden) {
        const swivel_region_cone out = cone.given();
        r.good &= swivel_region_forbid(&r.region, &out) == SWIVEL_OK;
    }
    r.good &= swivel_region_add_cones(&r.region, given.data(), count, chain.closed) == SWIVEL_OK;
    r.oracle.chains.push_back(chain);
    if (random.below(3) == 0) {
        const Eigen::Vector3d middle = random.direction(), side = random.across(middle);
        const double angle = random.between(0.1, 1.2);
        const std::uint32_t corner_count = 3 + random.below(5);
        std::vector<Eigen::Vector3d> corners;
        std::vector<float> flat;
        for (std::uint32_t n = 0; n < corner_count; ++n) {
            const double turn = 2 * kPi * (n + random.between(0, 0.7)) / corner_count;
            const Eigen::Vector3d out = std::cos(turn) * side + std::sin(turn) * middle.cross(side);
            const Eigen::Vector3f corner = (std::cos(angle) * middle + std::sin(angle) * out).cast<float>();
            corners.push_back(corner.cast<double>().normalized());
            flat.insert(flat.end(), {corner.x(), corner.y(), corner.z()});
        }
        if (swivel_region_add_polygon(&r.region, flat.data(), corner_count) == SWIVEL_OK)
            r.oracle.polygons.push_back(corners);
        // Corners that lie within half a circle leave its middle outside. Such a polygon may be refused, never others.
        else if (corner_count > 4)
            r.good = false;
    }
    if (random.below(3) == 0) {
        r.oracle.forbidden.push_back(random_cone(random, 0.02, 0.4));
        const swivel_region_cone out = r.oracle.forbidden.back().given();
        r.good &= swivel_region_forbid(&r.region, &out) == SWIVEL_OK;
    }
    return r;
}

}  // namespace swivel::test

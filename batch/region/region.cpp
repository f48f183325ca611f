// SPDX-License-Identifier: MIT
#include "batch/region/region.h"

#include <array>
#include <cmath>

#include "batch/refusal/status.h"
#include "simd/float_env.h"

using namespace swivel;

namespace swivel {

namespace {

constexpr double kSlack = 1e-6;  // angles and sides that were floats once

swivel_half_space stored(const HalfSpace& half)
{
    return {{static_cast<float>(half.axis.at<kE1>()), static_cast<float>(half.axis.at<kE2>()),
             static_cast<float>(half.axis.at<kE3>())},
            static_cast<float>(half.cosine),
            half.is_edge};
}

bool is_valid(const swivel_half_space& half)
{
    float length2 = 0;
    for (const float x : half.axis) length2 += x * x;
    return std::fabs(length2 - 1) <= 1e-6f && std::fabs(half.cosine) <= 1 && half.is_edge <= 1;
}

}  // namespace

void RegionBuilder::add(const HalfSpace& half)
{
    const std::uint32_t at = region_.first[region_.part_count] + open_;
    if (!fits(at < SWIVEL_MAX_HALF_SPACES)) return;
    region_.half_space[at] = stored(half);
    ++open_;
}

void RegionBuilder::end_part()
{
    if (!fits(region_.part_count < SWIVEL_MAX_REGION_PARTS)) return;
    const std::uint32_t end = region_.first[region_.part_count] + open_;
    region_.first[++region_.part_count] = end;
    open_ = 0;
}

void RegionBuilder::cut(const HalfSpace& half)
{
    const std::uint32_t count = region_.first[region_.part_count];
    if (!fits(count < SWIVEL_MAX_HALF_SPACES)) return;
    for (std::uint32_t n = count; n > region_.cut_count; --n) region_.half_space[n] = region_.half_space[n - 1];
    region_.half_space[region_.cut_count++] = stored(half);
    for (std::uint32_t part = 0; part <= region_.part_count; ++part) ++region_.first[part];
}

swivel_status check_region(const char* function, const swivel_region* region)
{
    if (!region) return refuse("%s: region is null", function);
    if (region->size != sizeof(swivel_region))
        return refuse("%s: the region's size is %zu, not %zu; start from swivel_default_region()", function,
                      region->size, sizeof(swivel_region));
    if (region->part_count > SWIVEL_MAX_REGION_PARTS)
        return refuse("%s: the region has %u parts; the most are %d", function, region->part_count,
                      SWIVEL_MAX_REGION_PARTS);
    if (region->first[0] != region->cut_count)
        return refuse("%s: the region's first part starts at %u, not after its %u cuts", function, region->first[0],
                      region->cut_count);
    for (std::uint32_t part = 0; part < region->part_count; ++part)
        if (region->first[part + 1] <= region->first[part])
            return refuse("%s: part %u of the region has no half-spaces", function, part);
    const std::uint32_t count = region->first[region->part_count];
    if (count > SWIVEL_MAX_HALF_SPACES)
        return refuse("%s: the region has %u half-spaces; the most are %d", function, count, SWIVEL_MAX_HALF_SPACES);
    for (std::uint32_t n = 0; n < count; ++n)
        if (!is_valid(region->half_space[n]))
            return refuse("%s: half-space %u of the region needs a unit axis, a cosine in -1..1 and is_edge 0 or 1",
                          function, n);
    return SWIVEL_OK;
}

swivel_status read_direction(const char* function, const char* noun, std::uint32_t n, const float* direction,
                             Vector<double>& to)
{
    const auto [x, y, z] = std::array<double, 3>{direction[0], direction[1], direction[2]};
    const double length = std::hypot(x, y, z);
    if (!(length > 0) || !std::isfinite(length))
        return refuse("%s: %s %u, (%g, %g, %g), has no direction", function, noun, n, x, y, z);
    to = vector(x / length, y / length, z / length);
    return SWIVEL_OK;
}

swivel_status read_cone(const char* function, std::uint32_t n, const swivel_region_cone& cone, RegionCone& to)
{
    if (const swivel_status status = read_direction(function, "the axis of cone", n, cone.axis, to.axis);
        status != SWIVEL_OK)
        return status;
    to.angle = double{cone.angle};
    if (!(to.angle >= kMinAngle - kSlack && to.angle <= kMaxAngle + kSlack))
        return refuse("%s: the angle of cone %u, %g, is not in 0.01 to pi - 0.01", function, n, to.angle);
    return SWIVEL_OK;
}

swivel_status keep(const char* function, const RegionBuilder& builder, swivel_region* region)
{
    if (builder.is_full())
        return refuse("%s: the region would have more than %d half-spaces or %d parts", function,
                      SWIVEL_MAX_HALF_SPACES, SWIVEL_MAX_REGION_PARTS);
    *region = builder.region();
    return SWIVEL_OK;
}

}  // namespace swivel

swivel_status swivel_region_forbid(swivel_region* region, const swivel_region_cone* cone)
{
    const FloatEnv env;
    constexpr const char* kCall = "swivel_region_forbid";
    if (const swivel_status status = check_region(kCall, region); status != SWIVEL_OK) return status;
    if (!cone) return refuse("%s: cone is null", kCall);
    RegionCone out;
    if (const swivel_status status = read_cone(kCall, 0, *cone, out); status != SWIVEL_OK) return status;
    RegionBuilder builder(*region);
    builder.cut({-out.axis, -std::cos(out.angle), true});
    return keep(kCall, builder, region);
}

swivel_status swivel_region_add_polygon(swivel_region* region, const float* corners, std::uint32_t count)
{
    const FloatEnv env;
    constexpr const char* kCall = "swivel_region_add_polygon";
    if (const swivel_status status = check_region(kCall, region); status != SWIVEL_OK) return status;
    if (count < 3 || count > SWIVEL_MAX_HALF_SPACES)
        return refuse("%s: %u corners are not 3 to %d", kCall, count, SWIVEL_MAX_HALF_SPACES);
    if (!corners) return refuse("%s: corners is null", kCall);
    Vector<double> corner[SWIVEL_MAX_HALF_SPACES];
    for (std::uint32_t n = 0; n < count; ++n)
        if (const swivel_status status = read_direction(kCall, "corner", n, corners + 3 * n, corner[n]);
            status != SWIVEL_OK)
            return status;
    RegionBuilder builder(*region);
    for (std::uint32_t n = 0; n < count; ++n) {
        const std::uint32_t next = (n + 1) % count;
        const Vector<double> across = cross(corner[n], corner[next]);
        if (!(len2(across) > kSlack * kSlack))
            return refuse("%s: corners %u and %u are equal or opposite", kCall, n, next);
        const Vector<double> inwards = normalise(across);
        for (std::uint32_t m = 0; m < count; ++m)
            if (scalar_product(inwards, corner[m]) < -kSlack)
                return refuse(
                    "%s: corner %u is outside of the side from %u to %u; give a convex polygon, counter-clockwise as "
                    "seen from outside",
                    kCall, m, n, next);
        builder.add({inwards, 0, true});
    }
    builder.end_part();
    return keep(kCall, builder, region);
}

swivel_status swivel_region_mirror(const swivel_region* from, swivel_region* to)
{
    const FloatEnv env;
    constexpr const char* kCall = "swivel_region_mirror";
    if (const swivel_status status = check_region(kCall, from); status != SWIVEL_OK) return status;
    if (!to) return refuse("%s: to is null", kCall);
    *to = *from;
    for (swivel_half_space& half : to->half_space) half.axis[0] = -half.axis[0];
    return SWIVEL_OK;
}

swivel_status swivel_region_room(const swivel_region* region, const float direction[3], float* room)
{
    const FloatEnv env;
    constexpr const char* kCall = "swivel_region_room";
    if (const swivel_status status = check_region(kCall, region); status != SWIVEL_OK) return status;
    if (!direction || !room) return refuse("%s: %s is null", kCall, direction ? "room" : "direction");
    Vector<double> unit;
    if (const swivel_status status = read_direction(kCall, "direction", 0, direction, unit); status != SWIVEL_OK)
        return status;
    *room = static_cast<float>(swivel::room(*region, unit));
    return SWIVEL_OK;
}

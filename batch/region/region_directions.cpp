// SPDX-License-Identifier: MIT
//
// The cones in order that hold given directions and allow little else. For each number of cones, directions go to the
// nearest of so many centres, which move to the middles of what they have. Each centre becomes the smallest cone about
// its directions. The order is the shortest way from cone to cone. The number with the least area is kept.
//
// Sources: centres, S. Lloyd, Least squares quantization in PCM (1982); smallest cone, M. Badoiu, K. Clarkson, Smaller
// core-sets for balls (2003).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "batch/refusal/status.h"
#include "batch/region/region.h"
#include "simd/float_env.h"

using namespace swivel;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kMaxCones = 6;
constexpr int kRounds = 20;        // of moving centres; more change little
constexpr int kSteps = 200;        // that bring a cone within 1 % of the smallest
constexpr int kAreaPoints = 4096;  // an area is told to 2 % of the sphere's sixteenth

// Directions are read as they are needed, so their number is not bound.
struct Directions {
    const float* first;
    std::uint32_t count;

    Vector<double> at(std::uint32_t n) const
    {
        const float* const d = first + std::size_t{3} * n;
        return normalise(vector(double{d[0]}, double{d[1]}, double{d[2]}));
    }
};
struct Centres {
    Vector<double> at[kMaxCones];
    std::uint32_t count = 0;

    std::uint32_t nearest(const Vector<double>& d) const
    {
        std::uint32_t best = 0;
        for (std::uint32_t n = 1; n < count; ++n)
            if (scalar_product(at[n], d) > scalar_product(at[best], d)) best = n;
        return best;
    }
    double cos_to_nearest(const Vector<double>& d) const { return scalar_product(at[nearest(d)], d); }
};

Vector<double> unit_or(const Vector<double>& v, const Vector<double>& otherwise)
{
    return len2(v) > 1e-12 ? normalise(v) : otherwise;
}

// One more centre: the direction that is farthest from all.
void add_farthest(const Directions& directions, Centres& centres)
{
    Vector<double> farthest = directions.at(0);
    for (std::uint32_t n = 1; n < directions.count; ++n)
        if (const Vector<double> d = directions.at(n);
            centres.count > 0 && centres.cos_to_nearest(d) < centres.cos_to_nearest(farthest))
            farthest = d;
    centres.at[centres.count++] = farthest;
}
void move_to_middles(const Directions& directions, Centres& centres)
{
    for (int round = 0; round < kRounds; ++round) {
        Vector<double> sum[kMaxCones] = {};
        for (std::uint32_t n = 0; n < directions.count; ++n) {
            const Vector<double> d = directions.at(n);
            Vector<double>& to = sum[centres.nearest(d)];
            to = to + d;
        }
        for (std::uint32_t n = 0; n < centres.count; ++n) centres.at[n] = unit_or(sum[n], centres.at[n]);
    }
}
// The direction of each centre that is farthest from its axis.
struct Farthest {
    Vector<double> at[kMaxCones] = {};
    double cos[kMaxCones] = {2, 2, 2, 2, 2, 2};  // 2: the centre has no direction

    Farthest(const Directions& directions, const Centres& centres, const Centres& axes)
    {
        for (std::uint32_t n = 0; n < directions.count; ++n) {
            const Vector<double> d = directions.at(n);
            const std::uint32_t nearest = centres.nearest(d);
            if (const double now = scalar_product(axes.at[nearest], d); now < cos[nearest])
                cos[nearest] = now, at[nearest] = d;
        }
    }
};
// The smallest cone about each centre's directions, and the margin. Each step adds to the axis the direction that is
// farthest from it. A cone may be wider than a region's may.
void enclose(const Directions& directions, const Centres& centres, double margin, RegionCone (&cones)[kMaxCones])
{
    Centres axes = centres;
    Vector<double> sum[kMaxCones] = {};
    for (int step = 0; step < kSteps; ++step) {
        const Farthest farthest(directions, centres, axes);
        for (std::uint32_t n = 0; n < centres.count; ++n) {
            sum[n] = sum[n] + farthest.at[n];
            axes.at[n] = unit_or(sum[n], centres.at[n]);
        }
    }
    const Farthest farthest(directions, centres, axes);
    for (std::uint32_t n = 0; n < centres.count; ++n)
        cones[n] = {axes.at[n], std::fmax(std::acos(std::clamp(farthest.cos[n], -1.0, 1.0)) + margin, kMinAngle)};
}
// The order in which the way from axis to axis is shortest.
void put_in_order(RegionCone (&cones)[kMaxCones], std::uint32_t count)
{
    std::uint32_t order[kMaxCones] = {0, 1, 2, 3, 4, 5}, best[kMaxCones] = {0, 1, 2, 3, 4, 5};
    double shortest = 1e9;
    do {
        double way = 0;
        for (std::uint32_t n = 0; n + 1 < count; ++n)
            way += std::acos(std::clamp(scalar_product(cones[order[n]].axis, cones[order[n + 1]].axis), -1.0, 1.0));
        if (way < shortest) shortest = way, std::copy_n(order, kMaxCones, best);
    } while (std::next_permutation(order, order + count));
    RegionCone ordered[kMaxCones] = {};
    for (std::uint32_t n = 0; n < count; ++n) ordered[n] = cones[best[n]];
    std::copy_n(ordered, count, cones);
}
// Whether they are cones of a region, and bridges fit between them.
bool are_allowed(const RegionCone (&cones)[kMaxCones], std::uint32_t count)
{
    return std::none_of(cones, cones + count, [](const RegionCone& cone) { return cone.angle > kMaxAngle; }) &&
           first_opposite(cones, count, false) == count;
}
// How many of many directions, spread evenly, a region allows.
int area(const swivel_region& region)
{
    int inside = 0;
    for (int n = 0; n < kAreaPoints; ++n) {
        const double z = 1 - (2 * n + 1.0) / kAreaPoints, turn = n * kPi * (3 - std::sqrt(5.0));
        const double across = std::sqrt(1 - z * z);
        inside += room(region, vector(across * std::cos(turn), across * std::sin(turn), z)) >= 0;
    }
    return inside;
}

}  // namespace

swivel_status swivel_region_add_directions(swivel_region* region, const float* directions, std::uint32_t count,
                                           float margin, std::uint32_t max_cones)
{
    const FloatEnv env(margin);
    constexpr const char* kCall = "swivel_region_add_directions";
    if (const swivel_status status = check_region(kCall, region); status != SWIVEL_OK) return status;
    if (count < 1) return refuse("%s: there are no directions", kCall);
    if (!directions) return refuse("%s: directions is null", kCall);
    if (!(margin >= 0.01f && margin <= 1))
        return refuse("%s: the margin, %g, is not in 0.01 to 1", kCall, double{margin});
    if (max_cones < 1 || max_cones > kMaxCones)
        return refuse("%s: %u cones are not 1 to %u", kCall, max_cones, kMaxCones);
    Vector<double> unit;
    for (std::uint32_t n = 0; n < count; ++n)
        if (const swivel_status status = read_direction(kCall, "direction", n, directions + std::size_t{3} * n, unit);
            status != SWIVEL_OK)
            return status;

    const Directions all{directions, count};
    RegionCone best[kMaxCones] = {};
    std::uint32_t best_count = 0;
    int min = kAreaPoints + 1;
    for (std::uint32_t cone_count = 1; cone_count <= std::min(max_cones, count); ++cone_count) {
        Centres centres;
        while (centres.count < cone_count) add_farthest(all, centres);
        move_to_middles(all, centres);
        RegionCone cones[kMaxCones] = {};
        enclose(all, centres, double{margin}, cones);
        put_in_order(cones, cone_count);
        if (!are_allowed(cones, cone_count)) continue;
        RegionBuilder alone(swivel_default_region());
        add_cones(alone, cones, cone_count, false);
        if (const int now = area(alone.region()); now < min) {
            min = now, best_count = cone_count;
            std::copy_n(cones, cone_count, best);
        }
    }
    if (best_count == 0)
        return refuse("%s: found no cones that hold all these directions; leave some out, or allow more cones", kCall);
    RegionBuilder builder(*region);
    add_cones(builder, best, best_count, false);
    return keep(kCall, builder, region);
}

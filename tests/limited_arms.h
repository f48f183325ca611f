// SPDX-License-Identifier: MIT
//
// Crowds of random arms with joint limits, some with a region for their upper arms, and where their elbows may go: the
// circle of the swivel. What limits say is judged in angles, and what regions say by their half-spaces
// (limit_oracle.h).
#pragma once

#include <array>
#include <cstring>
#include <span>
#include <vector>

#include "tests/test_whole_limb.h"

namespace swivel::test {

inline constexpr swivel_features kBoxes = SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_WRIST_BOX;

struct LimitedArm {
    Arm arm;
    Quaterniond hand;
    LimbLimits limits;
};

inline AngleRange random_range(Random& random, double min)
{
    const double middle = random.between(-kPi, kPi);
    return {middle, random.spread(min, kPi)};
}
// A turn's range, or a box's three.
inline void draw_ranges(Random& random, std::span<AngleRange> ranges)
{
    const bool is_box = ranges.size() == 3;
    const double min = !is_box ? 0.05 : random.below(4) ? 0.1 : 0.004;
    for (AngleRange& range : ranges) range = random_range(random, min);
    if (is_box && random.below(2)) ranges[1] = {random.between(-0.5, 0.5), random.spread(min, 1)};
}
inline LimitedArm random_limited_arm(Random& random, swivel_euler_order shoulder_order, swivel_euler_order wrist_order)
{
    const double upper = random.between(0.2, 0.4), fore = upper * random.between(0.6, 1.6);
    const double near = std::fabs(upper - fore), far = upper + fore;
    const Vector3d line = random.direction();
    // One number a line: all compilers then draw them in the same order.
    const double distance = random.between(near + 0.02 * (far - near), far);
    const double along = random.between(-1, 1), aside = random.spread(0.05, 1);
    const Arm arm = rounded(Arm{distance * line, along * line + aside * random.across(line), upper, fore});
    Quaterniond hand = random.rotation();
    hand.coeffs() = hand.coeffs().cast<float>().cast<double>();
    LimbLimits limits(random, shoulder_order, wrist_order);
    for (Limit& limit : limits.each)
        if (limit.is_cone())
            limit.opening = std::acos(random.between(-0.99, limit.shape == LimitShape::axis_in_cone ? 0.95 : 0.99));
    for (Limit& limit : limits.each) draw_ranges(random, limit.ranges());
    return {arm, hand.normalized(), limits};
}

// The arm at a swivel from the wish, in double, from its elbow's place.
struct SwivelCircle {
    Vector3d line, wish, across;  // across: a quarter turn on from the wish
    double along, away;           // the upper arm, of length 1, along the line and from it
    Quaterniond elbow, hand;

    explicit SwivelCircle(const LimitedArm& a)
        : line(a.arm.wrist.normalized()), wish(a.arm.normal()), across(line.cross(wish)), hand(a.hand)
    {
        const double d = std::min(a.arm.wrist.norm(), a.arm.length()), upper = a.arm.upper, fore = a.arm.fore;
        along = (d * d + upper * upper - fore * fore) / (2 * d * upper);
        away = std::sqrt(std::max(0.0, 1 - along * along));
        const double cosine = (d * d - upper * upper - fore * fore) / (2 * upper * fore);
        elbow = Quaterniond(Eigen::AngleAxisd(-std::acos(std::clamp(cosine, -1.0, 1.0)), Vector3d::UnitX()));
    }
    // With the elbow as far from the line as floats put it.
    SwivelCircle(const LimitedArm& a, const LimbPose& pose) : SwivelCircle(a)
    {
        elbow = pose.elbow;
        const Vector3d wrist = a.arm.upper * Vector3d::UnitZ() + elbow * (a.arm.fore * Vector3d::UnitZ());
        along = wrist.normalized().z();
        away = wrist.normalized().head<2>().norm();
    }
    LocalPose at(double swivel) const
    {
        const Vector3d normal = std::cos(swivel) * wish + std::sin(swivel) * across;
        const Vector3d bone = along * line + away * normal.cross(line);
        Eigen::Matrix3d r;
        r << normal, bone.cross(normal), bone;
        const Quaterniond shoulder(r);
        return {shoulder, elbow, (shoulder * elbow).conjugate() * hand};
    }
};
// The swivel that a pose took, from the wish, -pi to pi.
inline double swivel_of(const LimitedArm& a, const LimbPose& pose)
{
    const Vector3d line = a.arm.wrist.normalized(), wish = a.arm.normal();
    return std::atan2(wish.cross(pose.hinge()).dot(line), wish.dot(pose.hinge()));
}

// The arms share their kinds of limits, and their region. Each has its own values.
struct LimitedArms {
    swivel_features features = SWIVEL_WITH_HAND;
    swivel_euler_order orders[2];
    RandomRegion region;
    std::vector<LimitedArm> arms;

    LimitedArms(Random& random, std::uint32_t count, bool has_region)
    {
        // The first two are there by one bit, in half of the crowds. The others are by two, in a quarter.
        std::uint32_t kinds = random.word();
        for (std::size_t n = 0; n < kOpenLimits.size(); ++n) {
            const std::uint32_t bits = n < 2 ? 1 : 3;
            if ((kinds & bits) == bits) features |= kOpenLimits[n].feature;
            kinds >>= n < 2 ? 1 : 2;
        }
        if (has_region) features |= SWIVEL_WITH_REGION, region = random_region(random);
        for (swivel_euler_order& order : orders) order = static_cast<swivel_euler_order>(random.below(6));
        for (std::uint32_t n = 0; n < count; ++n) arms.push_back(random_limited_arm(random, orders[0], orders[1]));
    }

    // With further features, whose values are left as they start.
    Crowd crowd(swivel_features more = 0) const
    {
        swivel_limb_def def = limbs(static_cast<std::uint32_t>(arms.size()), features | more);
        def.shoulder_order = orders[0], def.wrist_order = orders[1];
        swivel_region given = region.region;
        if (features & SWIVEL_WITH_REGION) def.region = &given;
        Crowd made(def);
        std::memset(&given, 0xff, sizeof given);  // the crowd has its own copy
        for (std::uint32_t n = 0; n < arms.size(); ++n) write(made, n);
        return made;
    }
    void write(Crowd& crowd, std::uint32_t n) const
    {
        const LimitedArm& arm = arms[n];
        write_arm(crowd, n, arm.arm);
        put(crowd, SWIVEL_HAND, n, floats(arm.hand));
        each_limit(arm.limits, [&](swivel_field field, const auto& value) { put(crowd, field, n, value); });
    }

    // How much room limits and region leave, in units of a cosine; negative where one is violated.
    double room(std::uint32_t n, const LocalPose& at) const { return std::min(region_room(at), limit_room(n, at)); }
    double room(std::uint32_t n, const LimbPose& pose) const
    {
        return room(n, LocalPose{pose.shoulder, pose.elbow, pose.wrist});
    }
    double region_room(const LocalPose& at) const
    {
        if (!(features & SWIVEL_WITH_REGION)) return 1;
        return room_by_half_spaces(region.region, at.shoulder * Vector3d::UnitZ());
    }
    double limit_room(std::uint32_t n, const LocalPose& at) const
    {
        return -violation_of(arms[n].limits, features, at);
    }
};

}  // namespace swivel::test

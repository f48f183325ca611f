// SPDX-License-Identifier: MIT
//
// Crowds of random arms with joint limits, some with a region for their upper arms, and where their elbows may go: the
// circle of the swivel. What limits say is judged in angles (limit_oracle.h), and what regions say by their half-spaces
// (region_oracle.h).
#pragma once

#include <array>
#include <vector>

#include "tests/free_limb.h"
#include "tests/region_oracle.h"

namespace swivel::test {

inline constexpr swivel_features kBoxes = SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_WRIST_BOX;

struct LimitedArm {
    Arm arm;
    Quaterniond hand;
    Vector3d shoulder_axis, hand_axis, twist_axis;
    double shoulder_cos, hand_cos;
    AngleRange humeral, forearm, hand_twist;
    AngleBox shoulder_box, wrist_box;
};

// cos and sin of the middle and of half the width, as floats hold them.
inline Float4 numbers(const AngleRange& range)
{
    return {static_cast<float>(std::cos(range.middle)), static_cast<float>(std::sin(range.middle)),
            static_cast<float>(std::cos(range.half)), std::fabs(static_cast<float>(std::sin(range.half)))};
}
inline AngleRange rounded(const AngleRange& range)
{
    const Float4 r = numbers(range);
    return {std::atan2(double{r[1]}, double{r[0]}), std::atan2(double{r[3]}, double{r[2]})};
}
inline std::array<float, 12> numbers(const AngleBox& box)
{
    std::array<float, 12> all;
    for (std::size_t n = 0; n < 3; ++n) std::ranges::copy(numbers(box.range[n]), all.begin() + 4 * n);
    return all;
}
inline Float4 cone_of(const Vector3d& axis, double cosine)
{
    const auto [x, y, z] = floats(axis);
    return {x, y, z, static_cast<float>(cosine)};
}

inline AngleRange random_range(Random& random, double least)
{
    return rounded(AngleRange{random.between(-kPi, kPi), random.spread(least, kPi)});
}
inline AngleBox random_box(Random& random, swivel_euler_order order)
{
    constexpr int axes[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}};
    AngleBox box;
    std::ranges::copy(axes[order], box.axes);
    const double least = random.below(4) ? 0.1 : 0.004;
    for (AngleRange& range : box.range) range = random_range(random, least);
    if (random.below(2)) box.range[1] = rounded(AngleRange{random.between(-0.5, 0.5), random.spread(least, 1)});
    return box;
}
inline LimitedArm random_limited_arm(Random& random, swivel_euler_order shoulder_order, swivel_euler_order wrist_order)
{
    LimitedArm a;
    const double upper = random.between(0.2, 0.4), fore = upper * random.between(0.6, 1.6);
    const double near = std::fabs(upper - fore), far = upper + fore;
    const Vector3d line = random.direction();
    // One number a line: all compilers then draw them in the same order.
    const double distance = random.between(near + 0.02 * (far - near), far);
    const double along = random.between(-1, 1), aside = random.spread(0.05, 1);
    a.arm = rounded(Arm{distance * line, along * line + aside * random.across(line), upper, fore});
    a.hand = random.rotation();
    a.hand.coeffs() = a.hand.coeffs().cast<float>().cast<double>();
    a.hand.normalize();
    for (Vector3d* const axis : {&a.shoulder_axis, &a.hand_axis, &a.twist_axis}) *axis = rounded(random.direction());
    a.shoulder_cos = rounded(random.between(-0.99, 0.99)), a.hand_cos = rounded(random.between(-0.99, 0.95));
    for (AngleRange* const range : {&a.humeral, &a.forearm, &a.hand_twist}) *range = random_range(random, 0.05);
    a.shoulder_box = random_box(random, shoulder_order), a.wrist_box = random_box(random, wrist_order);
    return a;
}

// The arm at a swivel from the wish, in double, from its elbow's place.
struct ArmAt {
    Quaterniond shoulder, wrist;
};
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
    ArmAt at(double swivel) const
    {
        const Vector3d normal = std::cos(swivel) * wish + std::sin(swivel) * across;
        const Vector3d bone = along * line + away * normal.cross(line);
        Eigen::Matrix3d r;
        r << normal, bone.cross(normal), bone;
        const Quaterniond shoulder(r);
        return {shoulder, (shoulder * elbow).conjugate() * hand};
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
        const std::uint32_t kinds = random.word();
        const auto add = [&](swivel_features feature, std::uint32_t bits) {
            if ((kinds & bits) == bits) features |= feature;
        };
        add(SWIVEL_WITH_SHOULDER_CONE, 0x1), add(SWIVEL_WITH_HUMERAL_TWIST, 0x2);
        add(SWIVEL_WITH_HAND_CONE, 0xc), add(SWIVEL_WITH_FOREARM_TWIST, 0x30), add(SWIVEL_WITH_HAND_TWIST, 0xc0);
        add(SWIVEL_WITH_SHOULDER_BOX, 0x300), add(SWIVEL_WITH_WRIST_BOX, 0xc00);
        if (has_region) features |= SWIVEL_WITH_REGION, region = random_region(random);
        for (swivel_euler_order& order : orders) order = static_cast<swivel_euler_order>(random.below(6));
        for (std::uint32_t n = 0; n < count; ++n) arms.push_back(random_limited_arm(random, orders[0], orders[1]));
    }

    // With further features, whose values are left as they start.
    Crowd crowd(swivel_features more = 0) const
    {
        swivel_group_def def = group(static_cast<std::uint32_t>(arms.size()), features | more);
        def.shoulder_order = orders[0], def.wrist_order = orders[1];
        if (features & SWIVEL_WITH_REGION) def.region = &region.region;
        Crowd made(def);
        for (std::uint32_t n = 0; n < arms.size(); ++n) write(made, n);
        return made;
    }
    void write(Crowd& to, std::uint32_t n) const
    {
        const LimitedArm& arm = arms[n];
        const auto put = [&](swivel_field field, const auto& value) {
            if (swivel_field_row_count(to.get(), 0, field)) to.write(field, 0, std::span(&value, 1), n);
        };
        write_arm(to, n, arm.arm);
        put(SWIVEL_HAND, floats(arm.hand));
        put(SWIVEL_SHOULDER_CONE, cone_of(arm.shoulder_axis, arm.shoulder_cos));
        put(SWIVEL_HAND_CONE, cone_of(arm.hand_axis, arm.hand_cos));
        put(SWIVEL_HUMERAL_TWIST, numbers(arm.humeral)), put(SWIVEL_FOREARM_TWIST, numbers(arm.forearm));
        const auto [x, y, z] = floats(arm.twist_axis);
        const auto [a, b, c, d] = numbers(arm.hand_twist);
        put(SWIVEL_HAND_TWIST, std::array{x, y, z, a, b, c, d});
        put(SWIVEL_SHOULDER_BOX, numbers(arm.shoulder_box)), put(SWIVEL_WRIST_BOX, numbers(arm.wrist_box));
    }

    // How much room limits and region leave, in units of a cosine; negative where one is violated.
    double room(std::uint32_t n, const ArmAt& at) const { return std::min(region_room(at), limit_room(n, at)); }
    double room(std::uint32_t n, const LimbPose& pose) const { return room(n, ArmAt{pose.shoulder, pose.wrist}); }
    double region_room(const ArmAt& at) const
    {
        if (!(features & SWIVEL_WITH_REGION)) return 1;
        return room_by_half_spaces(region.region, at.shoulder * Vector3d::UnitZ());
    }
    double limit_room(std::uint32_t n, const ArmAt& at) const
    {
        const LimitedArm& a = arms[n];
        const Vector3d e3 = Vector3d::UnitZ();
        double worst = -1;
        const auto judge = [&](swivel_features limit, const auto& violation) {
            if (features & limit) worst = std::max(worst, violation());
        };
        judge(SWIVEL_WITH_SHOULDER_CONE,
              [&] { return cone_violation(a.shoulder_axis, a.shoulder_cos, at.shoulder * e3); });
        judge(SWIVEL_WITH_HUMERAL_TWIST, [&] { return twist_violation(e3, a.humeral, at.shoulder); });
        judge(SWIVEL_WITH_SHOULDER_BOX, [&] { return box_violation(a.shoulder_box, at.shoulder.toRotationMatrix()); });
        judge(SWIVEL_WITH_HAND_CONE, [&] { return cone_violation(e3, a.hand_cos, at.wrist * a.hand_axis); });
        judge(SWIVEL_WITH_FOREARM_TWIST, [&] { return twist_violation(e3, a.forearm, at.wrist); });
        judge(SWIVEL_WITH_HAND_TWIST, [&] { return twist_violation(a.twist_axis, a.hand_twist, at.wrist); });
        judge(SWIVEL_WITH_WRIST_BOX, [&] { return box_violation(a.wrist_box, at.wrist.toRotationMatrix()); });
        return -worst;
    }
};

}  // namespace swivel::test

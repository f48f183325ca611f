// SPDX-License-Identifier: MIT
//
// Crowds of random arms whose group has a region and further limits, and the room that a swivel leaves. The judges are
// Eigen, limit_oracle.h and region_oracle.h.
#pragma once

#include <array>
#include <vector>

#include "tests/limited_arm.h"
#include "tests/region_oracle.h"
#include "tests/test_crowd.h"

namespace swivel::test {

// The arms share their kinds of limits and the region. Every limb has its own values.
struct RegionArms {
    RandomRegion region;
    swivel_features features = SWIVEL_WITH_REGION | SWIVEL_WITH_HAND;
    swivel_euler_order orders[2] = {SWIVEL_XYZ, SWIVEL_XYZ};
    std::vector<LimitedArm> arms;

    RegionArms(Random& random, std::uint32_t count) : region(random_region(random))
    {
        const LimitUse use = random_limited_arm(random).use;
        const auto add = [&](bool has, swivel_features feature) { features |= has ? feature : 0; };
        add(use.shoulder_cone, SWIVEL_WITH_SHOULDER_CONE), add(use.humeral_twist, SWIVEL_WITH_HUMERAL_TWIST);
        add(use.hand_cone, SWIVEL_WITH_HAND_CONE), add(use.forearm_twist, SWIVEL_WITH_FOREARM_TWIST);
        add(use.hand_twist, SWIVEL_WITH_HAND_TWIST), add(use.shoulder_box, SWIVEL_WITH_SHOULDER_BOX);
        add(use.wrist_box, SWIVEL_WITH_WRIST_BOX);
        orders[0] = static_cast<swivel_euler_order>(random.below(6));
        orders[1] = static_cast<swivel_euler_order>(random.below(6));
        for (std::uint32_t n = 0; n < count; ++n) {
            LimitedArm arm = random_limited_arm(random);
            arm.use = use;
            arm.use.shoulder_order = kEulerOrders[orders[0]], arm.use.wrist_order = kEulerOrders[orders[1]];
            arm.shoulder_box = random_box(random, arm.use.shoulder_order);
            arm.wrist_box = random_box(random, arm.use.wrist_order);
            arms.push_back(arm);
        }
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
        const LimbGoal<float> goal = goal_of<float>(arms[n]);
        const JointLimits<float>& limits = goal.limits;
        const auto put = [&](swivel_field field, const auto& value) {
            if (swivel_field_row_count(to.get(), 0, field)) to.write(field, 0, std::span(&value, 1), n);
        };
        put(SWIVEL_TARGET, numbers(goal.arm.wrist)), put(SWIVEL_POLE, numbers(goal.arm.pole));
        put(SWIVEL_LENGTHS, std::array{goal.arm.upper, goal.arm.fore});
        const Rotor<float>& hand = goal.hand;
        put(SWIVEL_HAND, std::array{hand.at<kI>(), hand.at<kJ>(), hand.at<kK>(), hand.at<kScalar>()});
        put(SWIVEL_SHOULDER_CONE, numbers(limits.shoulder_cone)), put(SWIVEL_HAND_CONE, numbers(limits.hand_cone));
        put(SWIVEL_HUMERAL_TWIST, numbers(limits.humeral_twist));
        put(SWIVEL_FOREARM_TWIST, numbers(limits.forearm_twist));
        const auto axis = numbers(limits.hand_twist.axis);
        const auto range = numbers(limits.hand_twist.range);
        put(SWIVEL_HAND_TWIST, std::array{axis[0], axis[1], axis[2], range[0], range[1], range[2], range[3]});
        put(SWIVEL_SHOULDER_BOX, numbers(limits.shoulder_box)), put(SWIVEL_WRIST_BOX, numbers(limits.wrist_box));
    }

    // How much room the region and the other limits leave, in units of a cosine.
    double room(std::uint32_t n, const ArmAt& at) const { return std::min(region_room(at), -violation(arms[n], at)); }
    double region_room(const ArmAt& at) const
    {
        return room_by_half_spaces(region.region, at.shoulder * Vector3d::UnitZ());
    }

    static std::array<float, 3> numbers(const Vector<float>& v) { return {v.at<kE1>(), v.at<kE2>(), v.at<kE3>()}; }
    static std::array<float, 4> numbers(const Cone<float>& cone)
    {
        const auto [x, y, z] = numbers(cone.axis);
        return {x, y, z, cone.cos_opening};
    }
    static std::array<float, 4> numbers(const Range<float>& r)
    {
        return {r.middle.cos, r.middle.sin, r.half.cos, r.half.sin};
    }
    static std::array<float, 12> numbers(const Range<float> (&box)[3])
    {
        std::array<float, 12> all;
        for (std::size_t n = 0; n < 3; ++n) std::ranges::copy(numbers(box[n]), all.begin() + 4 * n);
        return all;
    }
};

// The pose of a limb, in the formula's terms.
inline SolvedLimb<float> solved_limb(const Crowd& crowd, std::uint32_t n)
{
    std::array<float, 4> shoulder, wrist;
    std::array<float, 2> elbow;
    std::uint32_t flags = 0;
    crowd.read(SWIVEL_SHOULDER, 0, std::span(&shoulder, 1), n);
    crowd.read(SWIVEL_WRIST, 0, std::span(&wrist, 1), n);
    crowd.read(SWIVEL_ELBOW, 0, std::span(&elbow, 1), n);
    crowd.read(SWIVEL_FLAGS, 0, std::span(&flags, 1), n);
    const auto rotor_of = [](const std::array<float, 4>& q) { return rotor(q[0], q[1], q[2], q[3]); };
    SolvedLimb<float> limb{};
    limb.arm.shoulder = rotor_of(shoulder);
    limb.arm.cos_half = elbow[0], limb.arm.sin_half = elbow[1];
    limb.arm.flags = flags;
    limb.wrist = rotor_of(wrist);
    return limb;
}
inline ArmAt pose_of(const SolvedLimb<float>& limb)
{
    return {eigen(limb.arm.shoulder).normalized(), eigen(limb.wrist).normalized()};
}

}  // namespace swivel::test

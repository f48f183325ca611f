// SPDX-License-Identifier: MIT
//
// Whole limbs through the public interface: skeletons with nothing aligned, local rotations and where they put the
// wrist, by Eigen in double, and limits of angles.
#pragma once

#include "tests/limit_oracle.h"
#include "tests/test_crowd.h"
#include "tests/test_limb.h"

namespace swivel::test {

inline constexpr swivel_features kWorldJointsHand = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND;
inline constexpr swivel_features kLimits =
    SWIVEL_WITH_FLEXION_LIMIT | SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST | SWIVEL_WITH_SHOULDER_BOX |
    SWIVEL_WITH_HAND_CONE | SWIVEL_WITH_FOREARM_TWIST | SWIVEL_WITH_HAND_TWIST | SWIVEL_WITH_WRIST_BOX;

// A skeleton's limb with nothing aligned: random rest rotations, bones and bend.
inline swivel_chain skewed_chain(Random& random)
{
    swivel_chain chain = swivel_default_chain();
    const Vector3d upper = random.direction(), hinge = random.across(upper);
    const Quaterniond elbow = random.rotation();
    const Vector3d fore = elbow.conjugate() * (Eigen::AngleAxisd(-random.between(0, 1), hinge) * upper);
    std::ranges::copy(floats(random.rotation()), chain.shoulder_rotation);
    std::ranges::copy(floats(elbow), chain.elbow_rotation);
    std::ranges::copy(floats(random.rotation()), chain.wrist_rotation);
    std::ranges::copy(floats(Vector3d(random.between(0.5, 1) * upper)), chain.elbow_offset);
    std::ranges::copy(floats(Vector3d(random.between(0.5, 1) * fore)), chain.wrist_offset);
    std::ranges::copy(floats(Vector3d(upper.cross(hinge))), chain.bend);
    return chain;
}

struct Chained {
    swivel_chain chain;
    swivel_binding bound = swivel_default_binding();
};
inline Chained chained(Random& random)
{
    const swivel_chain chain = skewed_chain(random);
    return {chain, bind(chain)};
}

// The local rotations of one limb, and where the skeleton then has its wrist and its hand.
struct LocalPose {
    Quaterniond shoulder, elbow, wrist;

    Vector3d wrist_place(const swivel_chain& chain, const Parent& parent) const
    {
        const Vector3d fore = shoulder * (vec(chain.elbow_offset) + elbow * vec(chain.wrist_offset));
        return parent.position + parent.scale * (parent.rotation * fore);
    }
    Quaterniond hand(const Parent& parent) const { return parent.rotation * shoulder * elbow * wrist; }
};
inline LocalPose local_pose(const Crowd& crowd, std::uint32_t n)
{
    Float4 q[3];
    const swivel_field fields[] = {SWIVEL_SHOULDER, SWIVEL_ELBOW, SWIVEL_WRIST};
    for (int f = 0; f < 3; ++f) {
        crowd.read(fields[f], 0, std::span(q + f, 1), n);
        CHECK(is_unit(q[f]));
    }
    return {quat(q[0]).normalized(), quat(q[1]).normalized(), quat(q[2]).normalized()};
}

// What the joints add to rest, in the arm frame.
inline LocalPose added_to_rest(const LocalPose& pose, const swivel_binding& b)
{
    const Quaterniond parent = quat(b.parent_from_arm), upper = quat(b.upper_from_arm), fore = quat(b.fore_from_arm),
                      hand_rest = fore.conjugate() * quat(b.wrist_rest);
    return {(parent.conjugate() * pose.shoulder * upper).normalized(),
            (upper.conjugate() * pose.elbow * fore).normalized(),
            (fore.conjugate() * pose.wrist * hand_rest.conjugate()).normalized()};
}

template <class Value>
void put(Crowd& crowd, swivel_field field, std::uint32_t n, const Value& value)
{
    crowd.write(field, 0, std::span(&value, 1), n);
}

using Float7 = std::array<float, 7>;
using Float12 = std::array<float, 12>;

inline Float4 range_of(const AngleRange& range)
{
    Float4 value;
    CHECK(swivel_range(range.middle - range.half, range.middle + range.half, value.data()) == SWIVEL_OK);
    return value;
}

// A limb's limits in angles; at first they are wide open.
struct LimbLimits {
    Vector3d shoulder_axis, hand_axis, twist_axis;
    double shoulder = kPi, hand = kPi;  // openings of the cones
    AngleRange humeral, forearm, twist;
    AngleBox shoulder_box, wrist_box;

    explicit LimbLimits(Random& random)
        : shoulder_axis(random.direction()), hand_axis(random.direction()), twist_axis(random.direction())
    {
    }
};
// Calls put(field, value) for each limit.
template <class Put>
void each_limit(const LimbLimits& limits, const Put& put)
{
    const auto array_of = [](const Vector3d& v) { return std::array{v.x(), v.y(), v.z()}; };
    put(SWIVEL_SHOULDER_CONE, cone(array_of(limits.shoulder_axis), limits.shoulder));
    put(SWIVEL_HAND_CONE, cone(array_of(limits.hand_axis), limits.hand));
    put(SWIVEL_HUMERAL_TWIST, range_of(limits.humeral));
    put(SWIVEL_FOREARM_TWIST, range_of(limits.forearm));
    Float7 twist;
    std::ranges::copy(floats(limits.twist_axis), twist.begin());
    std::ranges::copy(range_of(limits.twist), twist.begin() + 3);
    put(SWIVEL_HAND_TWIST, twist);
    for (const bool of_wrist : {false, true}) {
        Float12 box;
        for (std::size_t n = 0; n < 3; ++n)
            std::ranges::copy(range_of((of_wrist ? limits.wrist_box : limits.shoulder_box).range[n]),
                              box.begin() + 4 * n);
        put(of_wrist ? SWIVEL_WRIST_BOX : SWIVEL_SHOULDER_BOX, box);
    }
}

}  // namespace swivel::test

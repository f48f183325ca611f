// SPDX-License-Identifier: MIT
#include "batch/explain/outside_limit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "batch/query/joint_angles.h"
#include "core/region.h"

namespace swivel {

namespace {

double outside_range(double angle, const float* range)
{
    const double middle = std::atan2(range[1], range[0]), half = std::atan2(range[3], range[2]);
    return std::fabs(std::remainder(angle - middle, 2 * std::numbers::pi)) - half;
}
double outside_twist(const Rotor<double>& q, const Vector<double>& axis, const float* range)
{
    return outside_range(2 * std::atan2(about(axis, q), q.at<kScalar>()), range);
}
double outside_cone(const Vector<double>& a, const Vector<double>& b, double cos_opening)
{
    return std::atan2(std::sqrt(len2(cross(a, b))), scalar_product(a, b)) -
           std::acos(std::clamp(cos_opening, -1.0, 1.0));
}
// The nearer one of the two triples of angles counts.
double outside_box(const Rotor<double>& q, const float* ranges, const EulerOrder& order)
{
    double outside[2];
    for (const int family : {0, 1}) {
        double angles[3];
        euler_angles(q, order, family, angles);
        outside[family] = std::max({outside_range(angles[0], ranges), outside_range(angles[1], ranges + 4),
                                    outside_range(angles[2], ranges + 8)});
    }
    return std::min(outside[0], outside[1]);
}

}  // namespace

double outside_limit(const ArmRotors& arm, swivel_field limit, const float* value, swivel_euler_order order)
{
    const Vector<double> bone = vector(0.0, 0.0, 1.0), axis = vector<double>(value[0], value[1], value[2]);
    switch (limit) {
        case SWIVEL_SHOULDER_CONE:
            return outside_cone(axis, sandwich(arm.shoulder, bone), double{value[3]});
        case SWIVEL_HAND_CONE:
            return outside_cone(bone, sandwich(arm.wrist, axis), double{value[3]});
        case SWIVEL_HUMERAL_TWIST:
            return outside_twist(arm.shoulder, bone, value);
        case SWIVEL_FOREARM_TWIST:
            return outside_twist(arm.wrist, bone, value);
        case SWIVEL_HAND_TWIST:
            return outside_twist(arm.wrist, axis, value + 3);
        case SWIVEL_SHOULDER_BOX:
            return outside_box(arm.shoulder, value, kEulerOrders[order]);
        case SWIVEL_WRIST_BOX:
            return outside_box(arm.wrist, value, kEulerOrders[order]);
        default:
            return 0;
    }
}

double outside_region(const ArmRotors& arm, const swivel_region& region)
{
    const Vector<double> bone = sandwich(arm.shoulder, vector(0.0, 0.0, 1.0));
    return -room_of_parts<double>(region, [&](std::uint32_t n) {
        const swivel_half_space& half = region.half_space[n];
        const Vector<double> axis = vector<double>(half.axis[0], half.axis[1], half.axis[2]);
        return -outside_cone(axis, bone, double{half.cosine});
    });
}

}  // namespace swivel

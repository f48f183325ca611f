// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "batch/explain/explain_probe.h"
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
    return outside_range(2 * std::atan2(scalar_product(axis, vector_part(q)), q.at<kScalar>()), range);
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
    const FieldRow& row = row_of(limit);
    const bool is_of_hand = row.needs & kHandLimits;
    const Rotor<double>& joint = is_of_hand ? arm.wrist : arm.shoulder;
    if (row.needs & kBoxFeatures) return outside_box(joint, value, kEulerOrders[order]);
    const Vector<double> bone = vector(0.0, 0.0, 1.0), axis = vector<double>(value[0], value[1], value[2]);
    if (row.value.parts[0] == ValuePart::range) return outside_twist(joint, bone, value);
    if (row.value.parts[1] == ValuePart::range) return outside_twist(joint, axis, value + 3);
    // The hand's axis turns with the hand; the upper arm's cone stays.
    return is_of_hand ? outside_cone(bone, sandwich(joint, axis), double{value[3]})
                      : outside_cone(axis, sandwich(joint, bone), double{value[3]});
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

// SPDX-License-Identifier: MIT
#include "batch/explain/joint_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/region.h"

namespace swivel {

namespace {

// The public orders are indices into the kernels' table.
constexpr bool is_order(swivel_euler_order order, int first, int middle, int last)
{
    const EulerOrder& own = kEulerOrders[order];
    return own.first == first && own.middle == middle && own.last == last;
}
static_assert(is_order(SWIVEL_XYZ, 0, 1, 2) && is_order(SWIVEL_XZY, 0, 2, 1) && is_order(SWIVEL_YZX, 1, 2, 0) &&
              is_order(SWIVEL_YXZ, 1, 0, 2) && is_order(SWIVEL_ZXY, 2, 0, 1) && is_order(SWIVEL_ZYX, 2, 1, 0));

// The three angles of R = R_p(first) R_q(middle) R_r(last); limits.h has the entries they are read from.
void euler_angles(const Rotor<double>& q, const EulerOrder& order, int family, double (&angles)[3])
{
    const Turn<double> turn = turn_by(q);
    const Vector<double> column[] = {turn.e1, turn.e2, turn.e3};
    const auto entry = [&](int row, int c) { return column[c].c[row]; };
    const double sign = order.cyclic ? 1 : -1;
    const double x = entry(order.last, order.last), y = -sign * entry(order.middle, order.last);
    const double cos_middle = std::hypot(x, y), sin_middle = sign * entry(order.first, order.last);
    angles[1] = std::atan2(sin_middle, cos_middle);
    if (cos_middle > 1e-7) {
        angles[0] = std::atan2(y, x);
        angles[2] = std::atan2(-sign * entry(order.first, order.middle), entry(order.first, order.first));
    } else {  // first and last turn about one line: the first takes it all
        angles[0] = std::atan2(sign * entry(order.last, order.middle), entry(order.middle, order.middle));
        angles[2] = 0;
    }
    if (family == 0) return;
    const auto half_turn_on = [](double angle) {
        return angle > 0 ? angle - std::numbers::pi : angle + std::numbers::pi;
    };
    angles[0] = half_turn_on(angles[0]);
    angles[1] = angles[1] >= 0 ? std::numbers::pi - angles[1] : -std::numbers::pi - angles[1];
    angles[2] = half_turn_on(angles[2]);
}

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

JointAngles joint_angles(const ArmRotors& arm, swivel_euler_order shoulder_order, swivel_euler_order wrist_order,
                         int family)
{
    JointAngles angles{};
    euler_angles(arm.shoulder, kEulerOrders[shoulder_order], family, angles.shoulder);
    euler_angles(arm.wrist, kEulerOrders[wrist_order], family, angles.wrist);
    angles.flexion = 2 * std::atan2(-arm.elbow.at<kI>(), arm.elbow.at<kScalar>());
    return angles;
}

}  // namespace swivel

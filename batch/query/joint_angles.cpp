// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "batch/query/forward.h"

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

}  // namespace

// angle_limits.h has the entries that the angles are read from.
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
    } else {  // first and last turn about one line, so the first takes the whole turn
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

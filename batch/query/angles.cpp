// SPDX-License-Identifier: MIT
//
// Values of limit fields from angles, and for the other side of the body. Trigonometry is allowed here and in the joint
// angles: before a solve, never in it.
#include <cmath>
#include <iterator>
#include <numbers>

#include "batch/api/check.h"
#include "batch/refusal/status.h"
#include "core/angle_limits.h"
#include "simd/float_env.h"
#include "simd/rows.h"

using namespace swivel;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSlack = 1e-6;  // angles that were floats once

void store_turn(double angle, float* turn)
{
    turn[0] = static_cast<float>(std::cos(angle));
    turn[1] = static_cast<float>(std::sin(angle));
}
// An angle of 0 to pi, with a sine >= 0 also after rounding.
void store_half_turn(double angle, float* turn)
{
    store_turn(std::fmin(std::fmax(angle, 0), kPi), turn);
    turn[1] = std::fabs(turn[1]);
}

// An axis, scaled to unit length. function: for the message.
swivel_status store_unit(const char* function, const double axis[3], float* unit)
{
    const double length = std::hypot(axis[0], axis[1], axis[2]);
    if (!(length > 0) || !std::isfinite(length))
        return refuse("%s: axis (%g, %g, %g) has no direction", function, axis[0], axis[1], axis[2]);
    for (int n = 0; n < 3; ++n) unit[n] = static_cast<float>(axis[n] / length);
    return SWIVEL_OK;
}

// Mirrors turns, which go the other way, and limits: their axes, and the middles of their ranges, which turn the other
// way, too. Only a box's range about the hinge stays.
void mirror_value(const FieldRow& row, const EulerOrder& order, float* value)
{
    const bool is_limit = row.needs & kSwivelLimits, is_box = row.needs & kBoxFeatures;
    const int turned_about[] = {order.first, order.middle, order.last};
    for (std::size_t n = 0; n < std::size(row.value.parts); ++n) {
        const ValuePart part = row.value.parts[n];
        if (part == ValuePart::axis && is_limit) value[0] = -value[0];
        if (part == ValuePart::turn) value[1] = -value[1];
        if (part == ValuePart::range && !(is_box && turned_about[n] == 0)) value[1] = -value[1];
        value += row_of(part).count;
    }
}

}  // namespace

swivel_status swivel_range(double min, double max, float range[4])
{
    const FloatEnv env(min, max);
    if (!range) return refuse("swivel_range: range is null");
    if (!std::isfinite(min) || !std::isfinite(max)) return refuse("swivel_range: %g to %g is not finite", min, max);
    if (min > max) return refuse("swivel_range: least %g is above most %g", min, max);
    if (max - min > 2 * kPi + kSlack)
        return refuse("swivel_range: %g to %g is wider than a whole turn, 2 pi; angles are in radians", min, max);
    store_turn(0.5 * min + 0.5 * max, range);
    store_half_turn(0.5 * max - 0.5 * min, range + 2);
    return SWIVEL_OK;
}

swivel_status swivel_cone(const double axis[3], double max, float cone[4])
{
    const FloatEnv env(max);
    if (!axis || !cone) return refuse("swivel_cone: %s is null", axis ? "cone" : "axis");
    if (!(max >= 0 && max <= kPi + kSlack))
        return refuse("swivel_cone: largest angle %g is not in 0 to pi; angles are in radians", max);
    if (const swivel_status status = store_unit("swivel_cone", axis, cone); status != SWIVEL_OK) return status;
    cone[3] = static_cast<float>(std::cos(std::fmin(max, kPi)));
    return SWIVEL_OK;
}

swivel_status swivel_flexion(double min, double max, float flexion[2])
{
    const FloatEnv env(min, max);
    if (!flexion) return refuse("swivel_flexion: flexion is null");
    if (!(min >= 0 && min <= max && max <= kPi + kSlack))
        return refuse("swivel_flexion: %g to %g is not a range within 0 to pi; angles are in radians", min, max);
    flexion[0] = min >= kPi ? 0.0f : static_cast<float>(std::cos(0.5 * min));
    flexion[1] = max >= kPi ? 0.0f : static_cast<float>(std::cos(0.5 * max));
    return SWIVEL_OK;
}

swivel_status swivel_aim(const double axis[3], double flexion, float aim[5])
{
    const FloatEnv env(flexion);
    if (!axis || !aim) return refuse("swivel_aim: %s is null", axis ? "aim" : "axis");
    if (!(flexion >= 0 && flexion <= kPi + kSlack))
        return refuse("swivel_aim: flexion %g is not in 0 to pi; angles are in radians", flexion);
    if (const swivel_status status = store_unit("swivel_aim", axis, aim); status != SWIVEL_OK) return status;
    const float cos_half = static_cast<float>(std::cos(0.5 * flexion));
    aim[3] = std::fmax(cos_half, 0.0f);
    aim[4] = static_cast<float>(std::sin(0.5 * flexion));
    return SWIVEL_OK;
}

void swivel_cos_sin(double angle, float turn[2])
{
    const FloatEnv env(angle);
    store_turn(angle, turn);
}

// The other side's arm frame is the mirror image with its hinge reversed. So vectors change sign along the hinge, and
// turns about the other two axes change direction.
swivel_status swivel_mirror(swivel_field field, swivel_euler_order order, const float* from, float* to)
{
    const FloatEnv env;
    if (!from || !to) return refuse("swivel_mirror: %s is null", from ? "to" : "from");
    if (const swivel_status status = check_field(field); status != SWIVEL_OK) return status;
    if (!is_input(field)) return refuse("swivel_mirror: %s is a result; give an input field", name_of(field));
    if (static_cast<unsigned>(order) > SWIVEL_ZYX)
        return refuse("swivel_mirror: there is no order %d", static_cast<int>(order));
    float value[kMaxComponents] = {};
    const std::uint32_t count = row_of(field).component_count;
    for (std::uint32_t n = 0; n < count; ++n) value[n] = from[n];
    mirror_value(row_of(field), kEulerOrders[order], value);
    for (std::uint32_t n = 0; n < count; ++n) to[n] = value[n];
    return SWIVEL_OK;
}

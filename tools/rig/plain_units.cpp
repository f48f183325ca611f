// SPDX-License-Identifier: MIT
#include "tools/rig/plain_units.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace swivel::tools {

LengthUnit length_unit(bool is_in_metres, double leg_length, double arm_length)
{
    if (is_in_metres) return {100, false};
    if (leg_length > 0) return {86 / leg_length, true};
    return arm_length > 0 ? LengthUnit{58 / arm_length, true} : LengthUnit{};
}

std::string unit_text(const LengthUnit& unit)
{
    if (unit.centimetres == 0) return "nothing tells how long 1 unit is, because no leg is known";
    if (!unit.is_guess) return "1 unit is 1 m, as the format says";
    return fmt::format("1 unit is about {:.3g} cm, a guess by a leg of 0.86 m", unit.centimetres);
}

std::string length_text(double length, const LengthUnit& unit)
{
    if (unit.centimetres == 0) return fmt::format("{:.3g} units", length);
    const double cm = length * unit.centimetres;
    return std::abs(cm) < 99.95 ? fmt::format("{:.1f} cm", cm) : fmt::format("{:.2f} m", cm / 100);
}

std::string error_text(double length, const LengthUnit& unit)
{
    const double cm = std::abs(length * unit.centimetres);
    if (unit.centimetres == 0 || cm >= 0.1) return length_text(length, unit);
    return cm < 0.01 ? "under 0.01 cm" : fmt::format("{:.2f} cm", cm);
}

std::string angle_text(double radians)
{
    const double degrees = std::abs(radians) * 180 / std::numbers::pi;
    if (degrees < 0.01) return "under 0.01 degrees";
    return fmt::format("{:.{}f} degrees", degrees, degrees < 0.1 ? 2 : 1);
}

std::string share_text(std::size_t count, std::size_t all, std::string_view what)
{
    return fmt::format("{} of {} {} ({:.0f} %)", count, all, what,
                       100. * static_cast<double>(count) / static_cast<double>(all));
}

}  // namespace swivel::tools

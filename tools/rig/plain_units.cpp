// SPDX-License-Identifier: MIT
#include "tools/rig/plain_units.h"

#include <fmt/format.h>

#include <cmath>

namespace swivel::tools {

LengthUnit length_unit(bool is_in_metres, double leg_length)
{
    if (is_in_metres) return {100, false};
    return leg_length > 0 ? LengthUnit{86 / leg_length, true} : LengthUnit{};
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

std::string share_text(std::size_t count, std::size_t all)
{
    return fmt::format("{} of {} frames ({:.0f} %)", count, all,
                       100. * static_cast<double>(count) / static_cast<double>(all));
}

}  // namespace swivel::tools

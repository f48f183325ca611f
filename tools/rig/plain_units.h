// SPDX-License-Identifier: MIT
//
// Lengths in centimetres, and shares beside counts, for people. Knows no clip.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace swivel::tools {

// How long the unit of a file's lengths is.
struct LengthUnit {
    double centimetres = 0;  // 0: nothing tells it
    bool is_guess = false;   // by a leg, not by the format
};

// The unit is a metre where the file's format says so, as glTF does. Else a leg, thigh and shin in the file's unit, is
// as long as in a person of 1.75 m, 0.86 m, or an arm, 0.58 m (Winter, Biomechanics of Human Movement). Lengths are 0
// of limbs that are not known.
LengthUnit length_unit(bool is_in_metres, double leg_length, double arm_length = 0);

// "1 unit is about 5.81 cm, a guess by a leg of 0.86 m"
std::string unit_text(const LengthUnit& unit);
// "3.4 cm", "2.31 m" from 1 m on; "3.4 units" where nothing tells the unit.
std::string length_text(double length, const LengthUnit& unit);
// The same, but "under 0.01 cm" of small errors and "0.04 cm".
std::string error_text(double length, const LengthUnit& unit);
// "0.4 degrees", "under 0.01 degrees"
std::string angle_text(double radians);
// "20 of 120 frames (17 %)". all: one or more.
std::string share_text(std::size_t count, std::size_t all, std::string_view what);

}  // namespace swivel::tools

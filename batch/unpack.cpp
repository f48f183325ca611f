// SPDX-License-Identifier: MIT
#include "batch/unpack.h"

#include <cstring>

#include "core/arm.h"
#include "core/compact.h"
#include "simd/rows.h"

namespace swivel {

namespace {

double component(std::uint32_t word)
{
    return (static_cast<int>(word & (kCompactTopBit - 1)) - kCompactZero) / kCompactSteps;
}

}  // namespace

bool is_packed(const Group& group, swivel_field field) { return (group.features & SWIVEL_COMPACT) && !is_input(field); }

std::array<float, 4> unpack_rotation(const std::uint16_t* words, std::size_t word_stride)
{
    const std::uint32_t first = words[0], second = words[word_stride], third = words[2 * word_stride];
    if ((first | second | third) == 0) return {};  // not yet solved; solving gives no integer below 1
    const std::uint32_t left_out = first >> 15 | second >> 15 << 1;
    const double a = component(first), b = component(second), c = component(third);
    const double rest = 1 - ((a * a + b * b) + c * c), largest = std::sqrt(rest > 0 ? rest : 0);
    const Rotor<double> q = hemisphere(rotor(left_out == 0 ? largest : a,
                                             left_out == 1  ? largest
                                             : left_out < 1 ? a
                                                            : b,
                                             left_out == 2  ? largest
                                             : left_out < 2 ? b
                                                            : c,
                                             left_out == 3 ? largest : c));
    return {static_cast<float>(q.at<kI>()), static_cast<float>(q.at<kJ>()), static_cast<float>(q.at<kK>()),
            static_cast<float>(q.at<kScalar>())};
}

// By integers where that is exact in any floating-point environment: denormals may be off in the caller's.
float unpack_half(std::uint16_t word)
{
    const std::uint32_t sign = std::uint32_t{word} >> 15 << 31, exponent = word >> 10 & 31u, digits = word & 1023u;
    if (exponent == 0) {
        const float size = static_cast<float>(digits) * 0x1p-24f;
        return bit_cast<float>(bit_cast<std::uint32_t>(size) | sign);
    }
    const std::uint32_t of_float = exponent == 31 ? 255 : exponent + 112;  // 112: the biases' difference
    return bit_cast<float>(sign | of_float << 23 | digits << 13);
}

std::array<float, 4> unpack_value(const Group& group, swivel_field field, std::size_t limb)
{
    const std::uint16_t* const words =
        group.words + row_offset(limb, group.result_row_count, field_first_row(group.features, field));
    if (field == SWIVEL_FLAGS) return {bit_cast<float>(words[0] | std::uint32_t{words[SWIVEL_LANES]} << 16), 0, 0, 0};
    if (field == SWIVEL_ELBOW && !(group.features & SWIVEL_JOINTS))
        return {unpack_half(words[0]), unpack_half(words[SWIVEL_LANES]), 0, 0};
    return unpack_rotation(words, SWIVEL_LANES);
}

void unpack_out(const Group& group, swivel_field field, std::size_t first, std::size_t limb_count, swivel_out values)
{
    const std::size_t bytes = field_component_count(group.features, field) * sizeof(float);
    for (std::size_t n = 0; n < limb_count; ++n) {
        const std::array<float, 4> value = unpack_value(group, field, first + n);
        std::memcpy(static_cast<char*>(values.data) + n * values.stride, value.data(), bytes);
    }
}

}  // namespace swivel
